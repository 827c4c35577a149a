// SPDX-License-Identifier: MIT
#include "verdigris/render/lighting.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "verdigris/error.h"
#include "verdigris/render/vector.h"

namespace verdigris {
namespace {

// 1 in the middle, 0 at the edge; t in [-1, 1].
float falloff(float t) {
    const float c = 1 - t * t;
    return c * c;
}
// A tent over [-1, 1], nearly as bright as falloff(): places drawn from it and their density.
float tent_place(float u) {
    return u < 0.5f ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 - 2 * u);
}
float tent_density(float t) {
    return 1 - std::abs(t);
}

}  // namespace

Lighting::Lighting(SkyLight sky, std::vector<RectangleLight> rectangles) : sky_(std::move(sky)) {
    if (rectangles.size() > kMostRectangles) {
        throw Error(ErrorCode::usage, "a scene may have 8 rectangles that shine");
    }
    for (const RectangleLight& light : rectangles) {
        const Vec3F normal = cross(light.half_width, light.half_height);
        const float area = 4 * length(normal);
        if (!(area > 0)) throw Error(ErrorCode::usage, "a light has no area");
        const float mean = light.soft ? 64.0f / 225 : 1.0f;  // of falloff(), squared
        rectangles_.push_back({light, unit(normal),
                               light.half_width * (1 / dot(light.half_width, light.half_width)),
                               light.half_height * (1 / dot(light.half_height, light.half_height)),
                               area, mean * area * luminance(light.radiance)});
    }
}

// About what the rectangle brings, never 0 where it could bring anything.
float Lighting::weight(const Rectangle& r, const Receiver& receiver) const {
    const Vec3F to = r.light.center - receiver.position;
    const float faces = -dot(to, r.normal);
    if (faces <= 0) return 0;  // the whole front looks the other way
    const float square = dot(to, to), near = 1 / std::sqrt(square);
    const float extent = 0.5f * std::sqrt(r.area) * near;
    // Of a large light a part stands higher than its center.
    const float high = std::clamp(dot(to, receiver.normal) * near + extent, 0.0f, 1.0f);
    // How near to the highlight, which the extent of the light widens.
    const Vec3F h = unit_or_zero(receiver.viewer + to * near);
    const float z = dot(h, receiver.normal), wide = std::min(receiver.alpha + 0.5f * extent, 1.0f);
    const float spread = (1 - z * z) / (wide * wide) + z * z;
    const float lobe = std::max(receiver.matte, 0.05f) + 1 / (spread * spread);
    return r.power * std::max(faces * near, 0.05f) * high * lobe / (square + r.area);
}

Lighting::Weights Lighting::weights(const Receiver& receiver) const {
    Weights w;
    w.of[0] = sky_.has_picture() ? sky_.mean_luminance() : 0;
    w.sum = w.of[0];
    for (std::size_t i = 0; i < rectangles_.size(); ++i) {
        w.of[i + 1] = weight(rectangles_[i], receiver);
        w.sum += w.of[i + 1];
    }
    return w;
}

Lighting::Light Lighting::along(Vec3F from, Vec3F direction, const Weights& weights) const {
    Light found{sky_.radiance(direction), 0};
    if (weights.of[0] > 0) found.pdf = weights.of[0] * sky_.pdf(direction);
    for (std::size_t i = 0; i < rectangles_.size(); ++i) {
        const Rectangle& r = rectangles_[i];
        const float cosine = -dot(direction, r.normal);
        if (cosine <= 1e-6f) continue;  // from behind
        const Vec3F to = r.light.center - from;
        const float distance = -dot(to, r.normal) / cosine;
        if (!(distance > 0)) continue;
        const Vec3F at = direction * distance - to;
        const float s = dot(at, r.u_axis), t = dot(at, r.v_axis);
        if (std::abs(s) >= 1 || std::abs(t) >= 1) continue;
        float density = weights.of[i + 1] * distance * distance / (cosine * r.area);
        if (r.light.soft) {
            found.radiance += r.light.radiance * (falloff(s) * falloff(t));
            density *= 4 * tent_density(s) * tent_density(t);
        } else {
            found.radiance += r.light.radiance;
        }
        found.pdf += density;
    }
    found.pdf = weights.sum > 0 ? found.pdf / weights.sum : 0;
    return found;
}

Vec3F Lighting::sample(Vec3F from, const Weights& weights, UnitPoint u) const {
    if (!(weights.sum > 0)) return {};
    // u.x picks the light and, stretched again, the place in it: its even spread is kept.
    float at = u.x * weights.sum;
    std::size_t i = 0;
    while (i < rectangles_.size() && at >= weights.of[i]) at -= weights.of[i++];
    u.x = weights.of[i] > 0 ? std::min(at / weights.of[i], 1.0f) : 0.5f;
    if (i == 0) return sky_.sample(u).direction;
    const RectangleLight& light = rectangles_[i - 1].light;
    const float s = light.soft ? tent_place(u.x) : 2 * u.x - 1;
    const float t = light.soft ? tent_place(u.y) : 2 * u.y - 1;
    return unit(light.center + light.half_width * s + light.half_height * t - from);
}

}  // namespace verdigris
