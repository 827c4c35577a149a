// SPDX-License-Identifier: MIT
// Arithmetic on directions and on light (internal).
#pragma once

#include <algorithm>
#include <cmath>

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

inline constexpr float kPi = 3.14159265358979f;

inline Vec3F operator+(Vec3F a, Vec3F b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec3F operator-(Vec3F a, Vec3F b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec3F operator*(Vec3F a, float s) {
    return {a.x * s, a.y * s, a.z * s};
}
inline Vec3F operator-(Vec3F a) {
    return {-a.x, -a.y, -a.z};
}
inline float dot(Vec3F a, Vec3F b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec3F cross(Vec3F a, Vec3F b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float length(Vec3F a) {
    return std::sqrt(dot(a, a));
}
/// Of a vector that is not zero.
inline Vec3F unit(Vec3F a) {
    return a * (1 / length(a));
}
/// The zero vector stays zero, and so does what is too short to have a direction.
inline Vec3F unit_or_zero(Vec3F a) {
    const float square = dot(a, a);
    return square > 1e-30f ? a * (1 / std::sqrt(square)) : Vec3F{};
}

inline LinearF operator+(LinearF a, LinearF b) {
    return {a.r + b.r, a.g + b.g, a.b + b.b};
}
inline LinearF operator-(LinearF a, LinearF b) {
    return {a.r - b.r, a.g - b.g, a.b - b.b};
}
inline LinearF operator*(LinearF a, LinearF b) {
    return {a.r * b.r, a.g * b.g, a.b * b.b};
}
inline LinearF operator*(LinearF a, float s) {
    return {a.r * s, a.g * s, a.b * s};
}
inline LinearF& operator+=(LinearF& a, LinearF b) {
    return a = a + b;
}
inline LinearF gray(float v) {
    return {v, v, v};
}
inline LinearF mix(LinearF a, LinearF b, float t) {
    return a * (1 - t) + b * t;
}
/// Y of XYZ: what the eye weighs light by.
inline float luminance(LinearF c) {
    return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b;
}

/// Three unit axes at right angles. Local coordinates: x along `tangent`, z along `normal`.
struct LocalFrame {
    Vec3F tangent, bitangent, normal;
    Vec3F local(Vec3F v) const { return {dot(v, tangent), dot(v, bitangent), dot(v, normal)}; }
    Vec3F world(Vec3F v) const { return tangent * v.x + bitangent * v.y + normal * v.z; }
};
/// Any frame around a unit normal, continuous but at -Z [Duff2017].
inline LocalFrame frame_around(Vec3F n) {
    const float sign = std::copysign(1.0f, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
    return {{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

}  // namespace verdigris
