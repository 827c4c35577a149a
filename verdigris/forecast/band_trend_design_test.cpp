// SPDX-License-Identifier: MIT
#include "verdigris/forecast/band_trend_design.h"

#include <gtest/gtest.h>

#include "verdigris/error.h"
#include "verdigris/forecast/choose.h"

namespace verdigris {
namespace {

TEST(BandTrendDesign, ChangesWhatIsNamedAndNothingElse) {
    const BandTrendDesign d = band_trend_design(":bands=0:confidence=0.5:global-count=6");
    EXPECT_FALSE(d.bands);
    EXPECT_EQ(d.confidence, 0.5);
    EXPECT_EQ(d.global_count, 6);
    EXPECT_TRUE(d.light && d.global && d.local && d.prior.slowing && d.prior.noise);
    EXPECT_EQ(d.prior.event, BandTrendDesign().prior.event);
    EXPECT_EQ(band_trend_design(":events=0").prior.event, 0);
    EXPECT_FALSE(band_trend_design(":bending=0").prior.bending);
}

TEST(BandTrendDesign, NamesWhatItDoesNotKnow) {
    const auto says = [](const std::string& text) {
        try {
            band_trend_design(text);
        } catch (const Error& e) {
            EXPECT_EQ(e.code(), ErrorCode::usage);
            return std::string(e.what());
        }
        return std::string("nothing");
    };
    EXPECT_NE(says(":ligt=0").find("has no 'ligt'; it has bands, bending"), std::string::npos);
    EXPECT_EQ(says(":light=2"), "bandtrend's light is 0 or 1, not '2'");
    EXPECT_EQ(says(":light"), "bandtrend's light is 0 or 1, not ''");
    EXPECT_EQ(says(":doubt=nan"), "bandtrend's doubt is a number from 0 to 1000000, not 'nan'");
    EXPECT_EQ(says(":doubt=1x"), "bandtrend's doubt is a number from 0 to 1000000, not '1x'");
    EXPECT_EQ(says(":band-count=0"),
              "bandtrend's band-count is a number from 1 to 1000000, not '0'");
    EXPECT_NE(says(":").find("has no ''"), std::string::npos);
    EXPECT_NE(says("light=0").find("has no"), std::string::npos);
    EXPECT_NE(says("::").find("has no"), std::string::npos);
    EXPECT_EQ(says(""), "nothing");
}

TEST(BandTrendDesign, IsPartOfAForecastersName) {
    EXPECT_EQ(forecaster_by_name("bandtrend:bands=0").name, "bandtrend:bands=0");
    EXPECT_THROW(forecaster_by_name("bandtrend:"), Error);
    EXPECT_THROW(forecaster_by_name("bandtrends"), Error);
}

}  // namespace
}  // namespace verdigris
