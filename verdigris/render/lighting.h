// SPDX-License-Identifier: MIT
// All light of a scene: what is around, and rectangles that shine. Lights add up, do not hide each
// other and lie outside of the object: what hides a light hides all that lies behind.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "verdigris/render/sky_light.h"

namespace verdigris {

/// A softbox: a rectangle that shines to the side that cross(half_width, half_height) points to.
struct RectangleLight {
    Vec3F center, half_width, half_height;  ///< at right angles; scene units (the object's radius
                                            ///< is 1)
    LinearF radiance;                       ///< in the middle
    bool soft = true;  ///< falls off to the edges as (1 - s^2)^2 (1 - t^2)^2, or is even
};

class Lighting {
  public:
    static constexpr std::size_t kMostRectangles = 8;

    /// Throws Error{usage}: more rectangles, or one without area.
    Lighting(SkyLight sky, std::vector<RectangleLight> rectangles);

    /// Who looks for light: lights that matter more to it are looked for more often.
    struct Receiver {
        Vec3F position, normal, viewer;  ///< normal and viewer unit
        float alpha = 1;                 ///< of its highlight
        float matte = 1;                 ///< share of what it reflects outside of the highlight
    };
    /// The chances of the lights for one receiver: the sky's first. Filled by weights().
    struct Weights {
        std::array<float, kMostRectangles + 1> of{};
        float sum = 0;
    };
    Weights weights(const Receiver& receiver) const;

    struct Light {
        LinearF radiance;
        float pdf = 0;  ///< with which sample() finds the direction, 1/sr
    };
    /// What a ray that hits nothing else brings.
    Light along(Vec3F from, Vec3F direction, const Weights& weights) const;
    /// A unit direction towards a light; the zero vector if there is none.
    Vec3F sample(Vec3F from, const Weights& weights, UnitPoint u) const;

    const SkyLight& sky() const { return sky_; }

  private:
    struct Rectangle {
        RectangleLight light;
        Vec3F normal, u_axis, v_axis;  // the axes over their squared lengths
        float area = 0, power = 0;
    };
    float weight(const Rectangle& r, const Receiver& receiver) const;
    SkyLight sky_;
    std::vector<Rectangle> rectangles_;
};

}  // namespace verdigris
