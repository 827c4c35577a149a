// SPDX-License-Identifier: MIT
// The maps of a material as the renderer reads them: linear light, all maps of a texel side by
// side.
#pragma once

#include <array>
#include <cstdint>

#include "verdigris/material/material.h"
#include "verdigris/render/brdf.h"

namespace verdigris {

/// What lies outside of [0, 1]: the edge goes on, or the picture begins again (glTF's default).
enum class Beyond { edge, repeat };

/// 16 bytes a texel.
class SurfaceMaps {
  public:
    /// Height and coverage are not used. Throws Error{usage} if the maps are empty or differ in
    /// size.
    explicit SurfaceMaps(const Material& material);
    /// Of a part of them, which must lie within.
    SurfaceMaps(const Material& material, Rect window);

    struct Point {
        SurfacePoint surface;
        Vec3F normal;  ///< unit, +X along u, +Y up (against v), z > 0
    };
    /// Bilinear between texel centers; u to the right, v down, as glTF counts. Linear light is
    /// interpolated, not encoded color.
    Point at(float u, float v, Beyond beyond) const;

    int width() const { return texels_.width(); }
    int height() const { return texels_.height(); }

  private:
    struct Texel {
        std::array<std::uint16_t, 8> v;  // r g b roughness, normal x y z (0.5 is 0), metallic
    };
    Image<Texel> texels_;
};

}  // namespace verdigris
