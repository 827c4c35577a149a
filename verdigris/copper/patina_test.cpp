// SPDX-License-Identifier: MIT
#include "verdigris/copper/patina.h"

#include <gtest/gtest.h>

#include "verdigris/files/testing.h"

namespace verdigris {
namespace {

TEST(OxideChemistry, GoesOverFromFreshToAged) {
    EXPECT_EQ(cu2o_fraction(0), 1);
    EXPECT_EQ(cu2o_fraction(30), 1);
    EXPECT_NEAR(cu2o_fraction(90), 0.7, 1e-12);  // smoothstep is 1/2 half way
    EXPECT_NEAR(cu2o_fraction(150), 0.4, 1e-12);
    EXPECT_NEAR(cu2o_fraction(1e6), 0.4, 1e-12);
    double before = 1;
    for (double nm = 0; nm < 200; nm += 0.5) {
        EXPECT_LE(cu2o_fraction(nm), before);
        before = cu2o_fraction(nm);
    }
}

TEST(OxideChemistry, MayBeASwitchOrAConstant) {
    EXPECT_EQ(cu2o_fraction(9, {1, 0, 10, 10}), 1);
    EXPECT_EQ(cu2o_fraction(10, {1, 0, 10, 10}), 0);
    EXPECT_EQ(cu2o_fraction(77, {0.5, 0.5}), 0.5);
}

TEST(Patina, WaitsForTheOxideThenGrowsWithWetness) {
    const GrowthLaw law;
    EXPECT_EQ(grow_patina({2, 20, 1, 5}, law), 2);              // oxide too thin
    EXPECT_NEAR(grow_patina({2, 200, 1, 5}, law), 2.5, 1e-15);  // rate 0.1
    EXPECT_NEAR(grow_patina({2, 200, 0, 5}, law), 2.5, 1e-15);  // the oxide may rest meanwhile
    EXPECT_EQ(grow_patina({2, 200, 1, 0}, law), 2);
    EXPECT_EQ(grow_patina({2, 200, 1, -3}, law), 2);  // never shrinks
}

TEST(Patina, CrossesTheOnsetInsideAStepExactly) {
    const GrowthLaw law;
    const double needed = law.exposure_between(149, 150);
    EXPECT_NEAR(grow_patina({0, 149, 4 * needed, 8}, law), 0.1 * 8 * 0.75, 1e-12);
    EXPECT_EQ(grow_patina({0, 149, needed * 0.999, 8}, law), 0);
}

TEST(Patina, HalfStepsCompose) {
    const GrowthLaw law;
    for (double start = 140; start < 152; start += 0.37) {
        const double oxide = 3000, wet = 40;
        const double whole = grow_patina({1, start, oxide, wet}, law);
        const double half = grow_patina({1, start, oxide / 2, wet / 2}, law);
        const double both =
            grow_patina({half, law.grow(start, oxide / 2), oxide / 2, wet / 2}, law);
        EXPECT_NEAR(both, whole, 1e-11) << start;
    }
}

TEST(Patina, RefusesOptionsOutOfRange) {
    EXPECT_EQ(error_of([] {
                  grow_patina({}, GrowthLaw(), {-1, 150});
              }).sentence(),
              "rate is -1; allowed are 0 to 1000");
}

}  // namespace
}  // namespace verdigris
