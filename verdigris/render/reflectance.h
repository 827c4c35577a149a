// SPDX-License-Identifier: MIT
// How much a rough surface reflects in all, by roughness and direction: what multiple scattering
// between its facets must make up for (internal).
#pragma once

#include <array>

namespace verdigris {

/// Reflectance of a dielectric at normal incidence, index of refraction 1.5 [Gltf20, B.3.2].
inline constexpr float kDielectricF0 = 0.04f;

/// Of one roughness and one cosine. Schlick's Fresnel is linear in F0, so that one scattering
/// reflects f0 * scale + bias in all.
struct Reflectance {
    float scale = 0, bias = 0;
    float dielectric = 0;  ///< at F0 = 0.04, multiple scattering included
    float whole() const { return scale + bias; }
};

/// Share of light that a second and further scatterings give back, of F0 `f0`
/// [KullaConty2017, p. 45; Hill2018]: Favg^2 Eavg / (1 - Favg (1 - Eavg)).
float again_scattered(float f0, float mean_whole);

/// Of one roughness; made from the table when shading begins, then cheap to ask.
class ReflectanceRow {
  public:
    explicit ReflectanceRow(float roughness);
    /// cosine in [0, 1].
    Reflectance at(float cosine) const;
    /// Cosine-weighted means over the hemisphere, of whole() and of `dielectric`.
    float mean_whole() const { return mean_whole_; }
    float mean_dielectric() const { return mean_dielectric_; }

    static constexpr int kNodes = 32;

  private:
    const Reflectance* low_;
    const Reflectance* high_;
    float weight_, mean_whole_, mean_dielectric_;
};

}  // namespace verdigris
