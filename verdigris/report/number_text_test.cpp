// SPDX-License-Identifier: MIT
#include "verdigris/report/number_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

namespace verdigris {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(NumberText, KnownAnswers) {
    const auto significant = [](double v, int d) {
        return number_text(v, {NumberStyle::significant, d});
    };
    EXPECT_EQ(significant(0.012, 3), "0.0120");
    EXPECT_EQ(significant(123, 3), "123");
    EXPECT_EQ(significant(1234, 3), "1.23e+03");
    EXPECT_EQ(significant(9.99, 1), "1e+01");
    EXPECT_EQ(significant(99.96, 3), "100");
    EXPECT_EQ(significant(0.00001234, 2), "0.000012");
    EXPECT_EQ(significant(-0.5, 3), "-0.500");
    EXPECT_EQ(significant(0, 3), "0.00");
    EXPECT_EQ(significant(1e-7, 1), "1e-07");
    EXPECT_EQ(significant(1e-7, 3), "1.00e-07");
    EXPECT_EQ(number_text(12.5, {NumberStyle::fixed, 2}), "12.50");
    EXPECT_EQ(number_text(0.0012, {NumberStyle::scientific, 2}), "1.20e-03");
    EXPECT_EQ(number_text(0.1234, {NumberStyle::percent, 1}), "12.3 %");
    EXPECT_EQ(number_text(809.6, {NumberStyle::integer}), "810");
}

TEST(NumberText, ASignIsShownOnlyWhereTheDigitsShowADirection) {
    const NumberFormat gain{NumberStyle::percent, 1, true};
    EXPECT_EQ(number_text(0.0641, gain), "+6.4 %");
    EXPECT_EQ(number_text(-0.0641, gain), "-6.4 %");
    EXPECT_EQ(number_text(0.00001, gain), "0.0 %");
    EXPECT_EQ(number_text(-0.00001, gain), "0.0 %");
    EXPECT_EQ(number_text(-0.0, {NumberStyle::fixed, 2}), "0.00");
    EXPECT_EQ(number_text(-1e-9, {NumberStyle::scientific, 1}), "-1.0e-09");
}

TEST(NumberText, WhatIsNoNumberSaysSo) {
    EXPECT_EQ(number_text(kNan, {}), "NaN");
    EXPECT_EQ(number_text(-kNan, {NumberStyle::percent, 1, true}), "NaN");
    EXPECT_EQ(number_text(kInf, {}), "inf");
    EXPECT_EQ(number_text(-kInf, {}), "-inf");
    EXPECT_EQ(typeset_number(-kInf, {}), "−∞");
    EXPECT_EQ(typeset_number(kInf, {NumberStyle::fixed, 1, true}), "+∞");
}

TEST(NumberText, TypesetHasTrueMinusAndPowers) {
    EXPECT_EQ(typeset_number(-0.5, {NumberStyle::fixed, 1}), "−0.5");
    EXPECT_EQ(typeset_number(0.00123, {NumberStyle::scientific, 1}), "1.2×10⁻³");
    EXPECT_EQ(typeset_number(2e21, {NumberStyle::scientific, 0, true}), "+2×10²¹");
    EXPECT_EQ(typeset_number(1, {NumberStyle::scientific, 0}), "1×10⁰");
}

TEST(NumberText, ExactNumbersReturnBitForBit) {
    for (const double v : {0.1, 1.0 / 3, 1e-300, 5e-324, 1.7976931348623157e308, -0.0, 810.0}) {
        const double back = std::strtod(exact_number(v).c_str(), nullptr);
        EXPECT_EQ(back, v);
        EXPECT_EQ(std::signbit(back), std::signbit(v));
    }
    EXPECT_EQ(exact_number(-kNan), "nan");
    EXPECT_EQ(exact_number(-kInf), "-inf");
}

}  // namespace
}  // namespace verdigris
