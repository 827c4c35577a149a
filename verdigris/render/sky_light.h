// SPDX-License-Identifier: MIT
// Light from all around, infinitely far away.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"
#include "verdigris/render/sobol.h"

namespace verdigris {

/// A picture of the surroundings, equirectangular: +Y up, the middle of the picture looks along +X,
/// u = atan2(z, x) / 2 pi + 1/2 and v = acos(y) / pi, as three.js and Blender (with Z up) read it.
/// Or a ramp from below to above, which needs no picture.
class SkyLight {
  public:
    /// The same light from everywhere.
    explicit SkyLight(LinearF radiance) : SkyLight(radiance, radiance, radiance) {}
    /// Straight down, at the horizon, straight up; smooth between.
    SkyLight(LinearF below, LinearF horizon, LinearF above)
        : below_(below), horizon_(horizon), above_(above) {}
    /// Negative radiance counts as 0 and what is over 65504 (OpenEXR's half) as 65504.
    /// Throws Error{usage} if it is empty or black everywhere.
    explicit SkyLight(Image<LinearF> picture);

    /// Along a unit direction.
    LinearF radiance(Vec3F direction) const;

    /// True if sample() finds the bright parts; a ramp has none worth looking for.
    bool has_picture() const { return !picture_.empty(); }
    struct Sample {
        Vec3F direction;
        float pdf = 0;  ///< 1/sr
    };
    /// In proportion to the brightness of the picture.
    Sample sample(UnitPoint u) const;
    float pdf(Vec3F direction) const;
    /// Of the whole sphere, over 4 pi.
    float mean_luminance() const { return mean_; }

  private:
    LinearF below_, horizon_, above_;
    Image<LinearF> picture_;
    // Cumulative brightness: of rows, and within each row; each ends with 1.
    std::vector<float> row_cumulative_;
    Image<float> cumulative_;
    float mean_ = 0;
};

/// chosen: 8192 x 4096, the largest that libraries of surroundings usually offer; 600 MB while
/// read.
inline constexpr std::int64_t kMaxSkyPixels = std::int64_t(1) << 25;

/// An OpenEXR, or another picture that read_image() takes (then encoded sRGB is made linear).
/// Throws Error{bad_input}: what read_image() says, more than kMaxSkyPixels, not twice as wide as
/// high, black everywhere.
SkyLight read_sky_light(const std::filesystem::path& path);

}  // namespace verdigris
