// SPDX-License-Identifier: MIT
// GGX: how many facets of a rough surface look where, and how much of each other they hide.
// Directions are local, z along the normal. alpha is roughness squared [Gltf20, B.2.4] (internal).
#pragma once

#include <algorithm>
#include <cmath>

#include "verdigris/render/sobol.h"
#include "verdigris/render/vector.h"

namespace verdigris {

/// chosen: below, a highlight is a fifth of a degree wide and 32-bit arithmetic wears thin.
inline constexpr float kLeastAlpha = 1e-3f;

inline float alpha_of(float roughness) {
    return std::max(roughness * roughness, kLeastAlpha);
}

/// Trowbridge-Reitz density of half vectors [Walter2007, Eq. 33], from all three components so that
/// nothing cancels near the normal.
inline float ggx_density(Vec3F h, float alpha) {
    const float a2 = alpha * alpha, s = (h.x * h.x + h.y * h.y) / a2 + h.z * h.z;
    return 1 / (kPi * a2 * s * s);
}

/// sqrt(a2 + (1 - a2) z^2), of which all of Smith's terms are made.
inline float smith_root(float z, float alpha) {
    const float a2 = alpha * alpha;
    return std::sqrt(a2 + (1 - a2) * z * z);
}

/// Height-correlated masking and shadowing over 4 (n.l)(n.v) [Heitz2014, Eq. 99], both z > 0.
inline float smith_visibility(float v_z, float l_z, float alpha) {
    return 0.5f / (l_z * smith_root(v_z, alpha) + v_z * smith_root(l_z, alpha));
}

/// Density of the reflected direction, per solid angle, when half vectors are drawn by
/// visible_half(): D(h) G1(v) / (4 v_z).
inline float visible_pdf(Vec3F v, Vec3F h, float alpha) {
    return ggx_density(h, alpha) * 0.5f / (v.z + smith_root(v.z, alpha));
}

/// A half vector among the visible ones [Heitz2018], as a point on a spherical cap
/// [DupuyBenyoub2023, Listing 3].
inline Vec3F visible_half(Vec3F v, float alpha, UnitPoint u) {
    const Vec3F w = unit({v.x * alpha, v.y * alpha, v.z});
    const float z = (1 - u.y) * (1 + w.z) - w.z, phi = 2 * kPi * u.x;
    const float r = std::sqrt(std::clamp(1 - z * z, 0.0f, 1.0f));
    const Vec3F h{r * std::cos(phi) + w.x, r * std::sin(phi) + w.y, z + w.z};
    return unit_or_zero({h.x * alpha, h.y * alpha, std::max(h.z, 1e-7f)});
}

inline float fifth_power(float x) {
    const float x2 = x * x;
    return x2 * x2 * x;
}

/// Mirrored at h.
inline Vec3F reflected(Vec3F v, Vec3F h) {
    return h * (2 * dot(v, h)) - v;
}

}  // namespace verdigris
