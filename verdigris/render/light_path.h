// SPDX-License-Identifier: MIT
// The light that reaches a picture along one path (internal).
#pragma once

#include <cstdint>

#include "verdigris/render/render.h"

namespace verdigris {

/// For one thread.
class LightPaths {
  public:
    LightPaths(const RenderScene& scene, int bounces);

    /// Of a ray of the camera: it splits where it meets the object, because finding that point and
    /// reading its maps costs as much as two looks for light from there. chosen: the fastest of
    /// 1, 2, 4 and 8 for the same noise on copper in the studio.
    static constexpr std::uint32_t kSplits = 4;

    /// Light from `direction` as seen at `from`, the mean of kSplits paths; false if the object is
    /// not there. `seed` stands for the pixel; a different `sample` has different paths.
    bool light(Vec3F from, Vec3F direction, std::uint32_t sample, std::uint32_t seed,
               LinearF& result);

    std::int64_t rays() const { return rays_; }

  private:
    struct Vertex;
    Vertex vertex(const RayHit& hit, Vec3F direction) const;
    LinearF path(const Vertex& first, std::uint32_t sample, std::uint32_t seed);
    LinearF direct(const Vertex& at, std::uint32_t sample, std::uint32_t pair, std::uint32_t seed);
    RayHit nearest(Vec3F from, Vec3F direction);
    bool blocked(Vec3F from, Vec3F direction);
    Vec3F to_object(Vec3F v) const {
        return {v.x * cos_ - v.z * sin_, v.y, v.x * sin_ + v.z * cos_};
    }
    Vec3F to_world(Vec3F v) const {
        return {v.x * cos_ + v.z * sin_, v.y, v.z * cos_ - v.x * sin_};
    }

    const RenderScene& scene_;
    int bounces_;
    float cos_, sin_;
    std::int64_t rays_ = 0;
};

}  // namespace verdigris
