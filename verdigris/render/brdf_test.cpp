// SPDX-License-Identifier: MIT
#include "verdigris/render/brdf.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "verdigris/render/microfacet.h"
#include "verdigris/render/vector.h"

namespace verdigris {
namespace {

constexpr std::array<float, 7> kRoughness{0.05f, 0.1f, 0.2f, 0.4f, 0.6f, 0.8f, 1.0f};
constexpr std::array<float, 5> kCosine{0.05f, 0.2f, 0.5f, 0.8f, 0.999f};

Vec3F direction(float cosine, float phi = 0.4f) {
    const float r = std::sqrt(1 - cosine * cosine);
    return {r * std::cos(phi), r * std::sin(phi), cosine};
}

// What a surface under even light of radiance 1 sends to the viewer, by its own sampling.
LinearF reflected_in_all(const Brdf& brdf, int samples = 1 << 14) {
    LinearF sum{};
    for (std::uint32_t i = 0; i < std::uint32_t(samples); ++i) {
        const Brdf::Sample s = brdf.sample(sobol_point(i, 3, 17));
        if (s.pdf > 0) sum += s.weight;
    }
    return sum * (1 / float(samples));
}

// Of a function, by a grid over the hemisphere that knows nothing of the sampling.
template <class F>
double over_hemisphere(F f, int rings = 900, int spokes = 900) {
    double sum = 0;
    for (int i = 0; i < rings; ++i) {
        const double z = (i + 0.5) / rings;
        for (int j = 0; j < spokes; ++j) {
            const double phi = 2 * double(kPi) * (j + 0.5) / spokes, r = std::sqrt(1 - z * z);
            sum += f(Vec3F{float(r * std::cos(phi)), float(r * std::sin(phi)), float(z)});
        }
    }
    return sum * 2 * double(kPi) / rings / spokes;
}

TEST(Brdf, WhiteMetalReflectsAllItGets) {
    for (const float roughness : kRoughness) {
        for (const float cosine : kCosine) {
            const Brdf brdf({gray(1), roughness, 1}, direction(cosine));
            EXPECT_NEAR(reflected_in_all(brdf).g, 1, 0.015)  // how well the table is interpolated
                << "roughness " << roughness << ", cosine " << cosine;
        }
    }
}

TEST(Reflectance, TheTableAgreesWithManyMorePoints) {
    for (const int r : {3, 10, 31}) {  // at its own nodes: how they are interpolated is above
        const float alpha = alpha_of(float(r) / 31);
        for (const int c : {6, 16, 31}) {
            const float z = float(c * c) / (31 * 31);
            const Vec3F v = direction(z, 0);
            constexpr std::uint32_t kMany = 1 << 16;
            double sum = 0;
            for (std::uint32_t i = 0; i < kMany; ++i) {
                const Vec3F l = reflected(v, visible_half(v, alpha, sobol_point(i, 1, 5)));
                if (l.z <= 0) continue;
                // G2 / G1(v), from the masking of each direction alone.
                const auto lambda = [&](float x) { return (smith_root(x, alpha) / x - 1) / 2; };
                sum += double((1 + lambda(v.z)) / (1 + lambda(v.z) + lambda(l.z)));
            }
            EXPECT_NEAR(ReflectanceRow(float(r) / 31).at(z).whole(), sum / kMany, 0.003)
                << "roughness " << r << " / 31, cosine " << z;
        }
    }
}

TEST(Brdf, WithoutSecondScatteringRoughMetalWouldLoseAThird) {
    // What the test above would measure without compensation: proof that it can fail.
    EXPECT_LT(ReflectanceRow(1).at(0.8f).whole(), 0.7f);
    EXPECT_GT(ReflectanceRow(0.1f).at(0.8f).whole(), 0.995f);
}

TEST(Brdf, NothingReflectsMoreThanItGets) {
    for (const float metallic : {0.0f, 0.5f, 1.0f}) {
        for (const float roughness : kRoughness) {
            for (const float cosine : kCosine) {
                const Brdf brdf({gray(1), roughness, metallic}, direction(cosine));
                EXPECT_LE(reflected_in_all(brdf).g, 1.015f)
                    << "metallic " << metallic << ", roughness " << roughness << ", cosine "
                    << cosine;
            }
        }
    }
}

// Why diffuse is not glTF's own (1 - F(v.h)) / pi: seen at a grazing angle a smooth white
// dielectric would reflect more than it gets [Gltf20, B.3.3].
TEST(Brdf, GltfsOwnSumWouldReflectMoreThanItGets) {
    const Vec3F v = direction(0.05f);
    const float alpha = alpha_of(0.3f);
    const double sum = over_hemisphere([&](Vec3F l) {
        const Vec3F h = unit(v + l);
        const float fresnel = 0.04f + 0.96f * fifth_power(1 - dot(v, h));
        const float highlight = ggx_density(h, alpha) * smith_visibility(v.z, l.z, alpha);
        return double((fresnel * highlight + (1 - fresnel) / kPi) * l.z);
    });
    RecordProperty("reflected", std::to_string(sum));
    EXPECT_GT(sum, 1.2);
}

TEST(Brdf, WhiteDielectricGivesBackWhatItDoesNotAbsorb) {
    for (const float roughness : kRoughness) {
        const Brdf brdf({gray(1), roughness, 0}, direction(0.6f));
        EXPECT_NEAR(reflected_in_all(brdf).g, 1, 0.01) << roughness;
    }
    const Brdf black({gray(0), 0.5f, 0}, direction(1));
    EXPECT_NEAR(reflected_in_all(black).g, 0.04f, 0.005);  // F0
}

TEST(Brdf, IsReciprocal) {
    for (const float metallic : {0.0f, 0.3f, 1.0f}) {
        for (const float roughness : kRoughness) {
            for (const float a : kCosine) {
                for (const float b : kCosine) {
                    const SurfacePoint p{{0.9f, 0.6f, 0.4f}, roughness, metallic};
                    const Vec3F v = direction(a, 0.2f), l = direction(b, 2.3f);
                    const LinearF there = Brdf(p, v).evaluate(l).f, back = Brdf(p, l).evaluate(v).f;
                    EXPECT_NEAR(there.r, back.r, 1e-4f * there.r + 1e-6f);
                    EXPECT_NEAR(there.b, back.b, 1e-4f * there.b + 1e-6f);
                }
            }
        }
    }
}

TEST(Brdf, ColorsOfCopperAtNormalIncidence) {
    const SurfacePoint copper{{0.955f, 0.638f, 0.538f}, 0.05f, 1};
    const LinearF c = reflected_in_all(Brdf(copper, direction(0.9999f)));
    EXPECT_NEAR(c.r, 0.955f, 0.005);
    EXPECT_NEAR(c.g, 0.638f, 0.005);
    EXPECT_NEAR(c.b, 0.538f, 0.005);
}

// The density of directions and the share that finds none make 1.
TEST(Brdf, DensityIntegratesToOne) {
    for (const float metallic : {0.0f, 1.0f}) {
        for (const float roughness : {0.3f, 0.5f, 0.8f, 1.0f}) {
            for (const float cosine : kCosine) {
                const Brdf brdf({gray(0.5f), roughness, metallic}, direction(cosine));
                const double density =
                    over_hemisphere([&](Vec3F l) { return double(brdf.evaluate(l).pdf); });
                int lost = 0;
                constexpr int kCount = 1 << 14;
                for (std::uint32_t i = 0; i < kCount; ++i) {
                    lost += brdf.sample(sobol_point(i, 1, 5)).pdf <= 0;
                }
                EXPECT_NEAR(density + double(lost) / kCount, 1, 0.01)
                    << "metallic " << metallic << ", roughness " << roughness << ", cosine "
                    << cosine;
            }
        }
    }
}

// Where samples fall is where the density says: shares of 8 x 16 cells of the hemisphere.
TEST(Brdf, SamplesFollowTheirDensity) {
    constexpr int kRings = 8, kSpokes = 16, kCount = 1 << 16;
    for (const float metallic : {0.0f, 1.0f}) {
        for (const float roughness : {0.35f, 0.7f}) {
            const Brdf brdf({gray(0.5f), roughness, metallic}, direction(0.6f));
            const auto cell = [&](Vec3F l) {
                const int ring = std::min(int(l.z * kRings), kRings - 1);
                const float phi = std::atan2(l.y, l.x) / (2 * kPi) + 0.5f;
                return std::size_t(ring * kSpokes + std::min(int(phi * kSpokes), kSpokes - 1));
            };
            std::array<double, kRings * kSpokes> drawn{}, wanted{};
            for (std::uint32_t i = 0; i < kCount; ++i) {
                const Brdf::Sample s = brdf.sample(sobol_point(i, 2, 9));
                if (s.pdf > 0) drawn[cell(s.to_light)] += 1.0 / kCount;
            }
            over_hemisphere([&](Vec3F l) {
                wanted[cell(l)] += double(brdf.evaluate(l).pdf) * 2 * double(kPi) / (900.0 * 900);
                return 0.0;
            });
            for (std::size_t i = 0; i < drawn.size(); ++i) {
                EXPECT_NEAR(drawn[i], wanted[i], 0.002 + 0.02 * wanted[i]) << "cell " << i;
            }
        }
    }
}

TEST(Brdf, SampleWeightsAreValueOverDensity) {
    const Brdf brdf({{0.9f, 0.6f, 0.4f}, 0.4f, 0.8f}, direction(0.5f));
    for (std::uint32_t i = 0; i < 256; ++i) {
        const Brdf::Sample s = brdf.sample(sobol_point(i, 0, 1));
        if (s.pdf <= 0) continue;
        const Brdf::Value v = brdf.evaluate(s.to_light);
        EXPECT_FLOAT_EQ(s.pdf, v.pdf);
        EXPECT_NEAR(s.weight.r, v.f.r * s.to_light.z / v.pdf, 1e-5f * s.weight.r);
    }
}

TEST(Brdf, LightFromBelowBringsNothing) {
    const Brdf brdf({gray(0.5f), 0.4f, 0.5f}, direction(0.5f));
    EXPECT_EQ(brdf.evaluate({0, 0.6f, -0.8f}).f, LinearF{});
}

TEST(Microfacet, DensityOfFacetsProjectsToOne) {  // [Walter2007, Eq. 4]
    for (const float roughness : {0.45f, 0.6f, 1.0f}) {
        const float alpha = alpha_of(roughness);
        EXPECT_NEAR(over_hemisphere([&](Vec3F h) { return double(ggx_density(h, alpha) * h.z); }),
                    1, 0.005)
            << roughness;
    }
}

TEST(Microfacet, KnownValues) {
    // alpha 1: every direction is as likely, D = 1 / pi; visible from above, V = 1 / 4.
    EXPECT_NEAR(ggx_density({0.6f, 0, 0.8f}, 1), 1 / kPi, 1e-6f);
    EXPECT_NEAR(smith_visibility(1, 1, 0.3f), 0.25f, 1e-6f);
    EXPECT_NEAR(ggx_density({0, 0, 1}, 0.25f), 1 / (kPi * 0.0625f), 1e-4f);
}

TEST(Reflectance, TableAgreesWithManyMorePoints) {
    for (const float roughness : {0.17f, 0.45f, 0.77f, 1.0f}) {
        for (const float cosine : {0.11f, 0.37f, 0.9f}) {
            // The whole, by a grid over the hemisphere at F = 1.
            const Vec3F v = direction(cosine);
            const float alpha = alpha_of(roughness);
            if (alpha < 0.1f) continue;  // the grid is too coarse for a narrow lobe
            const double whole = over_hemisphere([&](Vec3F l) {
                return double(ggx_density(unit(v + l), alpha) * smith_visibility(v.z, l.z, alpha) *
                              l.z);
            });
            EXPECT_NEAR(double(ReflectanceRow(roughness).at(cosine).whole()), whole, 0.005)
                << "roughness " << roughness << ", cosine " << cosine;
        }
    }
}

}  // namespace
}  // namespace verdigris
