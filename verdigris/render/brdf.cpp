// SPDX-License-Identifier: MIT
#include "verdigris/render/brdf.h"

#include <cmath>

#include "verdigris/render/microfacet.h"
#include "verdigris/render/vector.h"

namespace verdigris {
namespace {

// A cosine-weighted direction: a disc, lifted.
Vec3F cosine_direction(UnitPoint u) {
    const float r = std::sqrt(u.x), phi = 2 * kPi * u.y;
    return {r * std::cos(phi), r * std::sin(phi), std::sqrt(std::max(0.0f, 1 - u.x))};
}

}  // namespace

Brdf::Brdf(const SurfacePoint& point, Vec3F to_viewer)
    : v_(to_viewer), alpha_(alpha_of(point.roughness)), row_(point.roughness) {
    const float metallic = point.metallic, mean = row_.mean_whole();
    f0_ = mix(gray(kDielectricF0), point.base_color, metallic);
    const Reflectance seen = row_.at(v_.z);
    // glTF mixes two materials, and both give their own share back [Gltf20, B.3.3].
    const float plain = again_scattered(kDielectricF0, mean);
    const LinearF again =
        mix(gray(plain),
            {again_scattered(point.base_color.r, mean), again_scattered(point.base_color.g, mean),
             again_scattered(point.base_color.b, mean)},
            metallic);
    const float lost = 1 - seen.whole();
    again_ = again * (lost / (kPi * std::max(1 - mean, 1e-4f)));
    const LinearF under = point.base_color * (1 - metallic);
    const float enters = 1 - seen.dielectric;
    diffuse_ = under * (enters / (kPi * std::max(1 - row_.mean_dielectric(), 1e-4f)));

    const float highlight = luminance(f0_) * seen.scale + seen.bias;
    const float rest = luminance(again) * lost + luminance(under) * enters;
    highlight_share_ = rest > 1e-4f ? highlight / (highlight + rest) : 1.0f;
}

Brdf::Value Brdf::evaluate(Vec3F l) const {
    if (l.z <= 0) return {};
    const Vec3F h = unit(v_ + l);
    const float fresnel = fifth_power(1 - std::clamp(dot(v_, h), 0.0f, 1.0f));
    const float specular = ggx_density(h, alpha_) * smith_visibility(v_.z, l.z, alpha_);
    const Reflectance lit = row_.at(l.z);
    const LinearF f = mix(f0_, gray(1), fresnel) * specular + again_ * (1 - lit.whole()) +
                      diffuse_ * (1 - lit.dielectric);
    const float pdf =
        highlight_share_ * visible_pdf(v_, h, alpha_) + (1 - highlight_share_) * l.z * (1 / kPi);
    return {f, pdf};
}

Brdf::Sample Brdf::sample(UnitPoint u) const {
    // u.y picks highlight or the rest and is stretched again: its even spread is kept.
    const bool highlight = u.y < highlight_share_;
    u.y = highlight ? u.y / highlight_share_
                    : std::min((u.y - highlight_share_) / (1 - highlight_share_), 1.0f);
    const Vec3F l =
        highlight ? reflected(v_, visible_half(v_, alpha_, u)) : cosine_direction({u.y, u.x});
    if (l.z <= 1e-6f) return {};
    const Value value = evaluate(l);
    if (!(value.pdf > 0)) return {};
    return {l, value.f * (l.z / value.pdf), value.pdf};
}

}  // namespace verdigris
