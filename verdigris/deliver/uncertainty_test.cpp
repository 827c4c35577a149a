// SPDX-License-Identifier: MIT
#include "verdigris/deliver/uncertainty.h"

#include <nlohmann/json.hpp>

#include "verdigris/deliver/testing.h"

namespace verdigris {
namespace {

TEST(Uncertainty, IsTheSpreadAtTheDeliveredHorizons) {
    MadeDelivery made;
    EXPECT_TRUE(uncertainty_of(made.delivery).empty());
    EXPECT_EQ(uncertainty_sentence({}), "");
    // 3 and 5 codes at +5; half way to 9 and 15 of variance at +20.
    const auto variance = [](double codes) { return codes * codes / (255.0 * 255.0); };
    made.forecast.spread.own = made.forecast.trajectory.base.clone();
    made.forecast.spread.nodes = {{5, variance(3), variance(4)}, {20, variance(6), variance(8)}};
    const auto list = uncertainty_of(made.delivery);
    ASSERT_EQ(list.size(), 2u);
    EXPECT_EQ(codes_text(list[0].pixel80), "5.7");
    EXPECT_EQ(codes_text(list[1].pixel80), "11");
    EXPECT_NEAR(255 * list[0].mean80, 3 * kMeanHalfWidth80, 1e-9);
    EXPECT_NEAR(255 * list[0].pixel95, 5 * kHalfWidth95, 1e-9);
    EXPECT_NEAR(255 * list[1].pixel80, 10 * kHalfWidth80, 1e-9);
    EXPECT_EQ(uncertainty_sentence(list),
              "Nominally four times in five, the mean color is off by at most 3 codes of 255 (a "
              "pixel: 6) at +5, and by 7 codes of 255 (a pixel: 11) at +20.");
}

}  // namespace
}  // namespace verdigris
