// SPDX-License-Identifier: MIT
#include "verdigris/render/settings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "verdigris/render/vector.h"

namespace verdigris {
namespace {

constexpr std::array<std::pair<SceneKind, std::string_view>, 3> kNames{
    {{SceneKind::plate, "plate"}, {SceneKind::sphere, "sphere"}, {SceneKind::drape, "drape"}}};

// Leans back around +X.
void lean_back(Shape& shape, double radians) {
    const float c = float(std::cos(radians)), s = float(std::sin(radians));
    const auto turned = [&](Vec3F v) { return Vec3F{v.x, v.y * c + v.z * s, v.z * c - v.y * s}; };
    for (Vec3F& p : shape.positions) p = turned(p);
    for (Vec3F& n : shape.normals) n = turned(n);
    for (Tangent& t : shape.tangents) t.direction = turned(t.direction);
}

// A softbox at `center` that looks at the origin; half extents.
RectangleLight softbox(Vec3F center, float half_width, float half_height, LinearF radiance) {
    const Vec3F to = unit(-center);
    Vec3F right = cross(to, {0, 1, 0});
    right = length(right) > 1e-3f ? unit(right) : Vec3F{1, 0, 0};
    const Vec3F up = cross(right, to);
    return {center, up * half_height, right * half_width, radiance, true};
}

}  // namespace

std::string_view to_string(SceneKind kind) {
    for (const auto& [k, name] : kNames) {
        if (k == kind) return name;
    }
    return "plate";
}
std::optional<SceneKind> scene_kind_from(std::string_view name) {
    for (const auto& [kind, n] : kNames) {
        if (n == name) return kind;
    }
    return std::nullopt;
}

Setting make_setting(SceneKind kind, double width_over_height) {
    Setting s;
    switch (kind) {
        case SceneKind::plate:
            s.shape = plate_shape(width_over_height);
            lean_back(s.shape, 0.2);
            s.view = {{0, 0.3f, 5.6f}, {0, 0, 0}, 24};
            s.swings = true;
            s.rest_turn = -0.27;
            break;
        case SceneKind::sphere:
            s.shape = sphere_shape();
            s.view = {{0, 0.9f, 5.2f}, {0, 0, 0}, 26};
            break;
        case SceneKind::drape:
            s.shape = drape_shape();
            s.view = {{0, 1.5f, 4.7f}, {0, -0.04f, 0}, 24};
            s.rest_turn = 0.35;
            break;
    }
    return s;
}

Setting make_setting(Shape model) {
    constexpr float kMost = std::numeric_limits<float>::max();
    Vec3F low{kMost, kMost, kMost}, high{-kMost, -kMost, -kMost};
    for (const Vec3F& p : model.positions) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    // In double: the square of what a float can hold need not be one.
    const double x = (double(low.x) + double(high.x)) / 2, y = (double(low.y) + double(high.y)) / 2,
                 z = (double(low.z) + double(high.z)) / 2;
    double radius = 0;
    for (const Vec3F& p : model.positions) {
        radius = std::max(radius, std::hypot(double(p.x) - x, double(p.y) - y, double(p.z) - z));
    }
    const double scale = radius > 0 ? 1 / radius : 1;
    for (Vec3F& p : model.positions) {
        p = {float((double(p.x) - x) * scale), float((double(p.y) - y) * scale),
             float((double(p.z) - z) * scale)};
    }
    return {std::move(model), {{0, 1.3f, 5.1f}, {0, 0, 0}, 26}, false, 0.4};
}

double turntable_turn(const Setting& setting, double phase) {
    const double angle = 2 * std::numbers::pi * phase;
    return setting.swings ? 0.7 * std::sin(angle - 0.396) : setting.rest_turn + angle;
}

Lighting studio_lighting() {
    // All chosen by eye on copper, so that a sphere shows a large soft highlight, a bright edge and
    // a dark core: docs/models/render.md.
    SkyLight room({0.30f, 0.29f, 0.28f}, {0.15f, 0.15f, 0.154f}, {0.08f, 0.08f, 0.084f});
    return Lighting(std::move(room), {softbox({-3.4f, 3.0f, 3.8f}, 2.3f, 2.3f, gray(7.0f)),
                                      softbox({4.4f, 1.0f, 0.6f}, 0.9f, 2.6f, gray(7.0f)),
                                      softbox({0.4f, 5.0f, -1.0f}, 3.0f, 1.6f, gray(4.5f)),
                                      softbox({3.4f, -0.6f, 5.0f}, 2.6f, 2.6f, gray(1.1f))});
}
Lighting sky_lighting(SkyLight sky) {
    return Lighting(std::move(sky), {});
}
Backdrop studio_backdrop() {
    return {gray(0.125f), gray(0.062f)};
}

}  // namespace verdigris
