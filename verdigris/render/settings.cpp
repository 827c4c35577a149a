// SPDX-License-Identifier: MIT
#include "verdigris/render/settings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "verdigris/render/vector.h"

namespace verdigris {
namespace {

constexpr std::array<std::pair<SceneKind, std::string_view>, 3> kNames{
    {{SceneKind::plate, "plate"}, {SceneKind::sphere, "sphere"}, {SceneKind::drape, "drape"}}};

// Leans back around +X.
void lean_back(Shape& shape, double radians) {
    const float c = float(std::cos(radians)), s = float(std::sin(radians));
    const auto turned = [&](Vec3F v) {
        return Vec3F{v.x, v.y * c + v.z * s, v.z * c - v.y * s};
    };
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
            lean_back(s.shape, 0.24);
            s.view = {{0, 0.35f, 6.2f}, {0, 0, 0}, 24};
            s.swings = true;
            s.rest_turn = 0.3;
            break;
        case SceneKind::sphere:
            s.shape = sphere_shape();
            s.view = {{0, 0.9f, 5.2f}, {0, 0, 0}, 26};
            break;
        case SceneKind::drape:
            s.shape = drape_shape();
            s.view = {{0, 1.6f, 5.4f}, {0, 0.02f, 0}, 24};
            s.rest_turn = 0.35;
            break;
    }
    return s;
}

Setting make_setting(Shape model) {
    Vec3F low{1e30f, 1e30f, 1e30f}, high{-1e30f, -1e30f, -1e30f};
    for (const Vec3F& p : model.positions) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const Vec3F middle = (low + high) * 0.5f;
    float radius = 0;
    for (const Vec3F& p : model.positions) radius = std::max(radius, length(p - middle));
    const float scale = radius > 0 ? 1 / radius : 1;
    for (Vec3F& p : model.positions) p = (p - middle) * scale;
    return {std::move(model), {{0, 1.3f, 5.1f}, {0, 0, 0}, 26}, false, 0.4};
}

double turntable_turn(const Setting& setting, double phase) {
    const double angle = 2 * double(kPi) * phase;
    return setting.swings ? 0.75 * std::sin(angle + 0.41) : setting.rest_turn + angle;
}

Lighting studio_lighting() {
    // All chosen by eye on copper, so that a sphere shows a large soft highlight, a bright edge and
    // a dark core: docs/models/render.md.
    SkyLight room({0.16f, 0.155f, 0.15f}, {0.10f, 0.10f, 0.105f}, {0.05f, 0.05f, 0.055f});
    return Lighting(std::move(room),
                    {softbox({-3.6f, 3.4f, 3.6f}, 1.7f, 1.7f, gray(6.5f)),
                     softbox({4.6f, 1.2f, 0.2f}, 0.5f, 2.2f, gray(7.0f)),
                     softbox({0.6f, 5.0f, -1.2f}, 2.4f, 1.2f, gray(4.0f)),
                     softbox({3.2f, 0.4f, 4.6f}, 1.4f, 1.8f, gray(0.7f))});
}
Lighting sky_lighting(SkyLight sky) {
    return Lighting(std::move(sky), {});
}
Backdrop studio_backdrop() {
    return {gray(0.125f), gray(0.062f)};
}

}  // namespace verdigris
