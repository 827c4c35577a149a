// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

#include "verdigris/render/sobol.h"

namespace verdigris {
namespace {

TEST(Sobol, SecondDimensionIsTheGeneratorMatrix) {
    // The loop over direction numbers that everybody prints.
    for (std::uint32_t index : {0u, 1u, 2u, 3u, 5u, 100u, 65535u, 0xdeadbeefu, 0xffffffffu}) {
        std::uint32_t bits = 0, direction = 1u << 31;
        for (std::uint32_t i = index; i != 0; i >>= 1, direction ^= direction >> 1) {
            if (i & 1) bits ^= direction;
        }
        EXPECT_EQ(reversed_bits(second_sobol_reversed(index)), bits) << index;
    }
}

TEST(Sobol, EveryRunOfSixteenIsStratified) {
    for (const std::uint32_t seed : {1u, 7u, 12345u}) {
        for (const std::uint32_t first : {0u, 16u, 160u}) {
            for (const std::array<int, 2>& cells :
                 {std::array{16, 1}, {8, 2}, {4, 4}, {2, 8}, {1, 16}}) {
                std::set<int> hit;
                for (std::uint32_t i = first; i < first + 16; ++i) {
                    const UnitPoint p = sobol_point(i, 2, seed);
                    hit.insert(int(p.x * float(cells[0])) * 16 + int(p.y * float(cells[1])));
                }
                EXPECT_EQ(hit.size(), 16u) << cells[0] << " x " << cells[1];
            }
        }
    }
}

TEST(Sobol, PairsDoNotFollowEachOther) {
    double sum = 0;
    constexpr int kCount = 4096;
    for (std::uint32_t i = 0; i < kCount; ++i) {
        sum += (double(sobol_point(i, 0, 3).x) - 0.5) * (double(sobol_point(i, 1, 3).x) - 0.5);
    }
    EXPECT_LT(std::abs(sum / kCount) * 12, 0.06);  // correlation; 1 would be the same numbers
}

}  // namespace
}  // namespace verdigris
