// SPDX-License-Identifier: MIT
#include "verdigris/recording/natural_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

namespace verdigris {
namespace {

TEST(NaturalOrder, NumbersCompareAsNumbers) {
    const std::vector<std::string> sorted{"",
                                          "1.png",
                                          "2.png",
                                          "010.png",
                                          "10.png",
                                          "a.png",
                                          "A1.png",
                                          "a2.png",
                                          "IMG_9.jpg",
                                          "img_10.jpg",
                                          "IMG_11.jpg",
                                          "x99999999999999999999998",
                                          "x99999999999999999999999"};
    std::vector<std::string> shuffled = sorted;
    std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(3));
    std::sort(shuffled.begin(), shuffled.end(), natural_less);
    EXPECT_EQ(shuffled, sorted);
}

TEST(NaturalOrder, IsATotalOrder) {
    std::mt19937 random(5);
    std::vector<std::string> names;
    for (int i = 0; i < 60; ++i) {
        std::string name;
        for (unsigned k = random() % 6; k > 0; --k) name += "0129aAb._"[random() % 9];
        names.push_back(name);
    }
    for (const auto& a : names) {
        EXPECT_FALSE(natural_less(a, a));
        for (const auto& b : names) {
            if (a != b) {
                EXPECT_NE(natural_less(a, b), natural_less(b, a)) << a << " " << b;
            }
            for (const auto& c : names) {
                if (natural_less(a, b) && natural_less(b, c)) {
                    EXPECT_TRUE(natural_less(a, c)) << a << " " << b << " " << c;
                }
            }
        }
    }
}

}  // namespace
}  // namespace verdigris
