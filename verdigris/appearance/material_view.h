// SPDX-License-Identifier: MIT
// Materials as pictures that can be compared: one shape, one light, one viewpoint, and the same
// rays for all of them.
#pragma once

#include <cstdint>

#include "verdigris/color/pixel_types.h"
#include "verdigris/material/material.h"
#include "verdigris/pixels/image.h"
#include "verdigris/render/render.h"
#include "verdigris/render/settings.h"

namespace verdigris {

struct ViewOptions {
    SceneKind scene = SceneKind::sphere;
    /// Side of the picture in pixels, 32 to 2048. chosen: of the paper's samples of 128 x 128 a
    /// pixel on the sphere shows about one.
    int size = 128;
    /// Rays of the camera per pixel, a power of two from 8 on. Every pixel gets as many, and the
    /// same in every picture: what is left of noise is nearly the same in two pictures, and
    /// cancels.
    int samples = 16;
};

class MaterialView {
  public:
    /// `shown` is the part of the maps that is put on the shape. Throws Error{usage}: options.
    MaterialView(const ViewOptions& options, Rect shown);
    MaterialView(const MaterialView&) = delete;
    MaterialView& operator=(const MaterialView&) = delete;

    /// As a screen shows it: Khronos PBR Neutral, encoded sRGB, not rounded. For any number of
    /// threads at once; the same material gives the same bytes. Another `seed` gives other rays.
    /// Cost: size^2 samples, about 2 us each and core.
    Image<SrgbF> picture(const Material& material, std::uint32_t seed = 0) const;

    Rect shown() const { return shown_; }

  private:
    ViewOptions options_;
    Rect shown_;
    Setting setting_;
    Tracer tracer_;
    Lighting lighting_;
};

}  // namespace verdigris
