// SPDX-License-Identifier: MIT
// glTF's metallic-roughness material as a function of two directions: GGX with height-correlated
// Smith, Schlick's Fresnel, F0 0.04 for what is no metal, and Lambert under it; light scattered
// more than once between facets is given back [KullaConty2017]. Reciprocal, and never reflects more
// than it gets: docs/models/render.md says where glTF's own sum would.
// Directions are local: z along the normal, away from the surface.
#pragma once

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"
#include "verdigris/render/reflectance.h"
#include "verdigris/render/sobol.h"

namespace verdigris {

/// What a map says of one point. All in [0, 1].
struct SurfacePoint {
    LinearF base_color;
    float roughness = 1, metallic = 0;
};

class Brdf {
  public:
    /// Seen from `to_viewer`, a unit vector with z > 0.
    Brdf(const SurfacePoint& point, Vec3F to_viewer);

    struct Value {
        LinearF f;      ///< 1/sr, without the cosine
        float pdf = 0;  ///< of sample(), 1/sr
    };
    /// Zero for light from below (z <= 0).
    Value evaluate(Vec3F to_light) const;

    struct Sample {
        Vec3F to_light;
        LinearF weight;  ///< f * cosine / pdf
        float pdf = 0;   ///< 0: no direction was found (the facet reflects into the surface)
    };
    Sample sample(UnitPoint u) const;

    float alpha() const { return alpha_; }
    /// Of sample(): how often a direction comes from the highlight.
    float highlight_share() const { return highlight_share_; }

  private:
    Vec3F v_;
    float alpha_, highlight_share_;
    ReflectanceRow row_;
    LinearF f0_;
    LinearF again_;    // factor of (1 - E(l)) of light scattered more than once
    LinearF diffuse_;  // factor of (1 - Ed(l))
};

}  // namespace verdigris
