// SPDX-License-Identifier: MIT
#include "verdigris/reproduce/compare.h"

#include <gtest/gtest.h>

#include <cmath>

namespace verdigris {
namespace {

Resolved gain(double value, double low, double high, std::size_t blocks = 6) {
    Resolved r;
    r.value = value;
    r.block = Interval{low, high};
    r.blocks.resize(blocks);
    return r;
}

TEST(Compare, SaysOfSignsWhatIsPrinted) {
    EXPECT_EQ(signs_in_words(0.134, 0.5), "same sign");
    EXPECT_EQ(signs_in_words(-0.134, -0.5), "same sign");
    EXPECT_EQ(signs_in_words(0.134, -0.5), "opposite signs");
    EXPECT_EQ(signs_in_words(0.134, -0.0004), "one of the two is zero as printed");
    EXPECT_EQ(signs_in_words(0, 0.0001), "both zero as printed");
}

TEST(Compare, SaysNoMoreThanTheBlocksGive) {
    EXPECT_EQ(compare_gain("affinergb", 0.134, gain(-0.594, -1.146, -0.182)),
              "affinergb: +13.4 % in the paper, -59.4 % here: opposite signs; the paper's value "
              "lies outside our block interval -114.6 % to -18.2 %, which excludes zero.");
    EXPECT_EQ(compare_gain("x", 0.134, gain(0.2, -0.1, 0.5)),
              "x: +13.4 % in the paper, +20.0 % here: same sign; the paper's value lies within our "
              "block interval -10.0 % to +50.0 %, which includes zero: our sign is not settled.");
    const std::string few = compare_gain("x", 0.134, gain(0.2, 0.1, 0.5, 3));
    EXPECT_NE(few.find("3 blocks are too few"), std::string::npos) << few;
    EXPECT_EQ(few.find("interval"), std::string::npos) << few;
    EXPECT_EQ(compare_gain("x", 0.134, gain(std::nan(""), 0, 0)),
              "x: +13.4 % in the paper, no number here.");
    // On the end as printed is within.
    EXPECT_NE(compare_gain("x", 0.134, gain(0.2, 0.13404, 0.5)).find("lies within"),
              std::string::npos);
}

TEST(Compare, NamesThoseThatBeatHoldingStill) {
    const std::vector<NamedGain> paper{{"affinergb", 0.134}, {"patinanet", -0.4}};
    EXPECT_EQ(
        compare_winners("a -> b", paper, {{"affinergb", -0.1, true}, {"patinanet", -0.2, true}}),
        "a -> b: better than holding still in the paper: affinergb; here, of 2 judged: none.");
    EXPECT_EQ(
        compare_winners("a -> b", paper, {{"affinergb", 0.1, true}, {"patinanet", 0.2, false}}),
        "a -> b: better than holding still in the paper: affinergb; here, of 2 judged: "
        "affinergb and patinanet; our blocks settle that sign for affinergb.");
    EXPECT_EQ(compare_winners("a -> b", paper, {{"affinergb", 0.1, false}}),
              "a -> b: better than holding still in the paper: affinergb; here, of 1 judged: "
              "affinergb; our blocks settle that sign for none.");
    EXPECT_EQ(compare_winners("a -> b", paper, {}),
              "a -> b: better than holding still in the paper: affinergb; here none was judged.");
}

TEST(Compare, ErrorsAndCorrelations) {
    EXPECT_EQ(compare_error("still", 2e-4, 1e-4),
              "still: 2.00e-04 in the paper, 1.00e-04 here, 0.5 times as much.");
    EXPECT_EQ(compare_correlation("r", 0.34, 0.32, 0.03),
              "r: +0.34 in the paper, +0.32 ± 0.03 here: within two of our standard errors of it.");
    EXPECT_NE(compare_correlation("r", 0.34, 0.2, 0.03).find("not within"), std::string::npos);
    EXPECT_NE(compare_correlation("r", 0.34, 0.2, std::nan("")).find("too few windows"),
              std::string::npos);
    EXPECT_EQ(least({{"a", 2}, {"b", 1}, {"c", std::nan("")}}), "b");
    EXPECT_EQ(least({}), "");
}

}  // namespace
}  // namespace verdigris
