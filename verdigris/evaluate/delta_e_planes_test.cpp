// SPDX-License-Identifier: MIT
#include "verdigris/evaluate/delta_e_planes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "verdigris/color/convert.h"
#include "verdigris/color/delta_e.h"

namespace verdigris {
namespace {

LabPlanes planes_of(std::vector<Lab> colors) {
    LabPlanes planes;
    planes.count = colors.size();
    colors.resize((colors.size() + 63) / 64 * 64);
    for (const Lab& c : colors) {
        planes.l.push_back(c.l);
        planes.a.push_back(c.a);
        planes.b.push_back(c.b);
    }
    return planes;
}

double fast(Lab p, Lab q) {
    return mean_delta_e2000(planes_of({p}), planes_of({q}));
}

TEST(DeltaEPlanes, LabIsTheScalarOnesForEveryColor) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> value(-0.1f, 1.1f);
    Image<SrgbF> image(61, 33);
    for (SrgbF& c : image.pixels()) c = {value(random), value(random), value(random)};
    image(0, 0) = {0, 0, 0};
    image(1, 0) = {1, 1, 1};
    image(2, 0) = {0.04045f, 0.04046f, 0.0404f};
    std::vector<std::uint32_t> where(image.pixel_count() - 3);
    std::iota(where.begin(), where.end(), 0u);
    LabPlanes lab;
    lab_of_pixels(image, where, lab);
    ASSERT_EQ(lab.count, where.size());
    for (const std::uint32_t i : where) {
        SrgbF c = image.pixels()[i];
        for (float* v : {&c.r, &c.g, &c.b}) *v = std::clamp(*v, 0.0f, 1.0f);
        const Lab exact = lab_from_srgb(c);
        EXPECT_NEAR(lab.l[i], exact.l, 2e-3);
        EXPECT_NEAR(lab.a[i], exact.a, 2e-3);
        EXPECT_NEAR(lab.b[i], exact.b, 2e-3);
    }
}

TEST(DeltaEPlanes, DifferencesAreTheScalarOnesNearAndFar) {
    std::mt19937 random(2);
    std::uniform_real_distribution<float> l(0, 100), ab(-90, 90);
    for (const float step : {0.05f, 1.0f, 20.0f, 90.0f}) {
        std::uniform_real_distribution<float> move(-step, step);
        for (int i = 0; i < 20000; ++i) {
            const Lab p{l(random), ab(random), ab(random)};
            const Lab q{std::clamp(p.l + move(random), 0.0f, 100.0f), p.a + move(random),
                        p.b + move(random)};
            const double exact = delta_e2000(p, q);
            EXPECT_NEAR(fast(p, q), exact, 1e-3 + 1e-5 * exact)
                << p.l << " " << p.a << " " << p.b << " : " << q.l << " " << q.a << " " << q.b;
        }
    }
}

TEST(DeltaEPlanes, GraysAndOppositeHuesAreRight) {
    // From [Sharma2005]: without chroma, and on either side of exactly opposite.
    EXPECT_NEAR(fast({50, 0, 0}, {50, -1, 2}), 2.3669, 1e-4);
    EXPECT_NEAR(fast({50, -1, 2}, {50, 0, 0}), 2.3669, 1e-4);
    EXPECT_NEAR(fast({50, 2.49f, -0.001f}, {50, -2.49f, 0.0009f}), 7.1792, 1e-3);
    EXPECT_NEAR(fast({50, 2.49f, -0.001f}, {50, -2.49f, 0.0012f}), 7.2195, 1e-3);
    EXPECT_NEAR(fast({50, 2.6772f, -79.7751f}, {50, 0, -82.7485f}), 2.0425, 1e-3);
    EXPECT_NEAR(fast({49, 0, 0}, {51, 0, 0}), 2, 1e-5);
    EXPECT_EQ(fast({50, 10, 10}, {50, 10, 10}), 0);
    EXPECT_EQ(fast({50, 0, 0}, {50, 0, 0}), 0);
}

TEST(DeltaEPlanes, NextToGrayNothingBlowsUp) {
    // Found on real frames: an 8-bit gray has a chroma of 1e-6 or of 0, and a cross product of
    // rounding alone.
    std::mt19937 random(3);
    std::uniform_real_distribution<float> l(0, 100), ab(-30, 30);
    for (const float chroma : {0.0f, 1e-12f, 1e-9f, 1e-6f, 1e-4f, 1e-2f}) {
        for (int i = 0; i < 5000; ++i) {
            const Lab p{l(random), ab(random), ab(random)};
            const Lab q{p.l + 0.1f, chroma * ab(random), chroma * ab(random)};
            EXPECT_NEAR(fast(p, q), delta_e2000(p, q), 2e-3) << chroma;
            EXPECT_NEAR(fast(q, p), delta_e2000(q, p), 2e-3) << chroma;
        }
    }
}

TEST(DeltaEPlanes, TheMeanCountsEveryPixelOnce) {
    std::vector<Lab> p, q;
    double sum = 0;
    for (int i = 0; i < 77; ++i) {  // no multiple of any vector
        p.push_back({50, 20, 30});
        q.push_back({50 + float(i) * 0.1f, 20, 30});
        sum += delta_e2000(p.back(), q.back());
    }
    EXPECT_NEAR(mean_delta_e2000(planes_of(p), planes_of(q)), sum / 77, 1e-4);
    EXPECT_EQ(mean_delta_e2000({}, {}), 0);
}

}  // namespace
}  // namespace verdigris
