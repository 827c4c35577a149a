// SPDX-License-Identifier: MIT
// What [Paper] prints, held to what else it prints: the arithmetic behind docs/PROTOCOL.md. Counts
// are in protocol_test.cpp.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "verdigris/evaluate/scores.h"

namespace verdigris {
namespace {

TEST(PaperNumbers, Table1IsARatioOfMeans) {
    // Mean column of Table 1 and the improvement printed beside it, to the rounding of the three
    // digits that a mean is printed with.
    struct Row {
        double model, persistence, percent;
    };
    const Row rows[] = {{1.85e-4, 2.14e-4, 13.4},    {3.06e-4, 2.14e-4, -43.2},
                        {4.28e-4, 2.14e-4, -100.0},  {9.51e-4, 2.14e-4, -344.5},
                        {8.31e-3, 2.14e-4, -3785.0}, {5.26e-5, 1.06e-4, 50.6},
                        {1.35e-4, 1.06e-4, -27.2},   {1.72e-4, 1.06e-4, -61.2},
                        {1.83e-4, 1.06e-4, -72.3},   {4.38e-4, 1.06e-4, -311.5}};
    for (const Row& row : rows) {
        const double half_m = 0.5 * std::pow(10, std::floor(std::log10(row.model)) - 2);
        const double half_p = 0.5 * std::pow(10, std::floor(std::log10(row.persistence)) - 2);
        const double slack =
            100 * row.model / row.persistence * (half_m / row.model + half_p / row.persistence);
        EXPECT_NEAR(100 * gain_over(row.model, row.persistence), row.percent, slack + 0.05);
    }
    // The same for t+1, t+5 and t+10 of affinergb; the mean of these three is not the mean's gain.
    const double air[][3] = {
        {3.22e-5, 3.42e-5, 5.8}, {1.54e-4, 1.71e-4, 9.6}, {3.81e-4, 4.58e-4, 16.7}};
    const double chamber[][3] = {
        {1.26e-5, 1.58e-5, 19.8}, {4.04e-5, 7.68e-5, 47.4}, {1.09e-4, 2.44e-4, 55.5}};
    for (const auto& table : {air, chamber}) {
        for (int i = 0; i < 3; ++i) {
            EXPECT_NEAR(100 * gain_over(table[i][0], table[i][1]), table[i][2], 0.5);
        }
    }
    EXPECT_GT(std::fabs((5.8 + 9.6 + 16.7) / 3 - 13.4), 2);
    EXPECT_TRUE(std::isnan(gain_over(1, 0)));
}

TEST(PaperNumbers, Table2AgreesWithItself) {
    // One configuration under three names, and order 0 is the persistence reference.
    const double usual_air = 1.72e-4, usual_chamber = 5.43e-5, held_air = 2.06e-4,
                 held_chamber = 1.07e-4;
    EXPECT_NEAR(1.83e-3 / usual_air, 11, 0.5);  // "roughly 11 x worse in both directions"
    EXPECT_NEAR(5.80e-4 / usual_chamber, 11, 0.5);
    EXPECT_NEAR(100 * (8.86e-5 / usual_chamber - 1), 63, 0.5);  // per-channel: "a 63 % increase"
    // n = 10 against the persistence of its own windows: 34 % and 58 %.
    EXPECT_NEAR(100 * gain_over(1.43e-4, 2.16e-4), 34, 0.7);
    EXPECT_NEAR(100 * gain_over(4.68e-5, 1.12e-4), 58, 0.7);
    // n = 3: -7 % against a reference of "the same order", which is not printed; it follows.
    EXPECT_NEAR(2.19e-4 / 1.07, held_air, 0.05e-4);
    // The sweep's 60 windows and the table's 810 disagree about the same forecaster: 16.5 % and
    // 13.4 %, 49.3 % and 50.6 %.
    EXPECT_NEAR(100 * gain_over(usual_air, held_air), 16.5, 0.5);
    EXPECT_NEAR(100 * gain_over(usual_chamber, held_chamber), 49.3, 0.5);
}

TEST(PaperNumbers, TheDriftsRatioIsOfUnroundedNumbers) {
    // 0.128 / 0.001 would be 128; 0.128 / 105 = 0.00122 prints as 0.001.
    EXPECT_EQ(std::round(0.128 / 105 * 1000), 1);
}

}  // namespace
}  // namespace verdigris
