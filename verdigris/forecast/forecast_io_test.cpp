// SPDX-License-Identifier: MIT
#include "verdigris/forecast/forecast_io.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "verdigris/error.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/files/testing.h"
#include "verdigris/forecast/affine.h"
#include "verdigris/forecast/guards.h"
#include "verdigris/forecast/testing.h"

namespace verdigris {
namespace {

namespace fs = std::filesystem;

class ForecastIo : public testing::Test {
  protected:
    SavedForecast example(int order) const {
        SavedForecast saved;
        saved.context = drifting(6, planted_drift(), 0.002, 3, 21, 13);
        saved.context.specimen = Mask(21, 13);
        for (int x = 3; x < 18; ++x) saved.context.specimen(x, 6) = kInside;
        AffineOptions options;
        options.order = order;
        saved.forecast = affinergb(options).forecast(saved.context);
        saved.horizons = {5, 7.5, 50};
        saved.forecast.guards = check_guards(saved.context, saved.forecast, saved.horizons);
        saved.source_name = "plate \"7\".mp4";
        saved.source_sha256 = std::string(64, 'a');
        return saved;
    }
    ScratchFolder scratch_;
    fs::path folder_ = scratch_ / "forecast";
};

TEST_F(ForecastIo, RoundTripsEveryBit) {
    for (int order : {0, 1, 2}) {
        const SavedForecast saved = example(order);
        write_forecast(saved, folder_);
        const SavedForecast read = read_forecast(folder_);
        EXPECT_EQ(read.forecast.forecaster, saved.forecast.forecaster);
        EXPECT_EQ(read.forecast.explanation, saved.forecast.explanation);
        EXPECT_EQ(read.forecast.context_length, 6);
        EXPECT_EQ(read.horizons, saved.horizons);
        EXPECT_EQ(read.source_name, saved.source_name);
        EXPECT_EQ(read.source_sha256, saved.source_sha256);
        EXPECT_EQ(read.context.sigma, saved.context.sigma);
        EXPECT_EQ(read.context.tau, saved.context.tau);
        ASSERT_EQ(read.forecast.guards.size(), saved.forecast.guards.size());
        ASSERT_FALSE(read.forecast.guards.empty());
        EXPECT_EQ(read.forecast.guards[0].id, saved.forecast.guards[0].id);
        EXPECT_EQ(read.forecast.guards[0].severity, saved.forecast.guards[0].severity);
        EXPECT_EQ(read.forecast.guards[0].sentence, saved.forecast.guards[0].sentence);
        ASSERT_EQ(read.context.length(), 6);
        for (std::size_t i = 0; i < 6; ++i) {
            EXPECT_TRUE(same_bytes(read.context.frames[i], saved.context.frames[i]));
        }
        EXPECT_TRUE(
            std::ranges::equal(read.context.specimen.pixels(), saved.context.specimen.pixels()));
        EXPECT_TRUE(read.context.clipped.empty());
        for (double h : {0.0, 5.0, 50.0}) {
            EXPECT_TRUE(same_bytes(read.forecast.at(h), saved.forecast.at(h))) << order << " " << h;
        }
        for (const char* name : {"forecast_u005.png", "forecast_u007_5.png", "forecast_u050.png"}) {
            EXPECT_TRUE(fs::exists(folder_ / name)) << name;
        }
    }
}

TEST_F(ForecastIo, RoundTripsANetworksFrames) {
    SavedForecast saved = example(1);
    saved.forecast.stack.base = saved.context.frames.back().clone();
    saved.forecast.stack.horizons = {5, 60};
    saved.forecast.stack.frames.push_back(saved.context.frames[0].clone());
    saved.forecast.stack.frames.push_back(saved.context.frames[1].clone());
    write_forecast(saved, folder_);
    const SavedForecast read = read_forecast(folder_);
    ASSERT_FALSE(read.forecast.is_trajectory());
    EXPECT_TRUE(same_bytes(read.forecast.at(30), saved.forecast.at(30)));
}

void expect_bad(const fs::path& folder, const std::string& file) {
    try {
        read_forecast(folder);
        FAIL() << "accepted a damaged " << file;
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::bad_input);
        EXPECT_NE(e.where().find(file), std::string::npos) << e.what();
    }
}

TEST_F(ForecastIo, NamesTheFileThatIsWrong) {
    expect_bad(folder_, "forecast.json");  // nothing there
    write_forecast(example(1), folder_);
    write_file(folder_ / "forecast.json", "{\"format\": 7");
    expect_bad(folder_, "forecast.json");
    write_file(folder_ / "forecast.json", "{\"format\": \"something else\"}");
    expect_bad(folder_, "forecast.json");
    write_file(folder_ / "forecast.json", "{}");
    expect_bad(folder_, "forecast.json");
    write_forecast(example(1), folder_);
    std::string text = read_text(folder_ / "forecast.json");
    const std::string caution = "\"severity\": \"caution\"";
    ASSERT_NE(text.find(caution), std::string::npos) << text;
    text.replace(text.find(caution), caution.size(), "\"severity\": \"dire\"");
    write_file(folder_ / "forecast.json", text);
    expect_bad(folder_, "forecast.json");
    write_forecast(example(1), folder_);
    fs::resize_file(folder_ / "rate.npy", fs::file_size(folder_ / "rate.npy") - 8);
    expect_bad(folder_, "rate.npy");
    write_forecast(example(1), folder_);
    fs::copy_file(folder_ / "context.npy", folder_ / "base.npy",
                  fs::copy_options::overwrite_existing);
    expect_bad(folder_, "base.npy");
    write_forecast(example(1), folder_);
    fs::remove(folder_ / "specimen.png");
    expect_bad(folder_, "specimen.png");
}

TEST_F(ForecastIo, RefusesAFolderItCannotWrite) {
    write_file(folder_, "a file stands here");
    try {
        write_forecast(example(1), folder_);
        FAIL();
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::failed);
    }
}

TEST_F(ForecastIo, ALawWithNodesRoundTripsAndMustIncrease) {
    SavedForecast saved = example(2);
    saved.forecast.trajectory.law.nodes = {{1, 0.3, -0.1}, {2.5, 1.0 / 3, 0.2}, {50, 2, 0.25}};
    write_forecast(saved, folder_);
    const SavedForecast read = read_forecast(folder_);
    EXPECT_EQ(read.forecast.trajectory.law.nodes, saved.forecast.trajectory.law.nodes);
    EXPECT_TRUE(same_bytes(read.forecast.at(7.5), saved.forecast.at(7.5)));
    std::string text = read_text(folder_ / "forecast.json");
    const auto at = text.find("2.5");
    ASSERT_NE(at, std::string::npos);
    write_file(folder_ / "forecast.json", text.replace(at, 3, "0.5"));
    EXPECT_THROW(read_forecast(folder_), Error);
}

TEST_F(ForecastIo, TheSpreadRoundTripsAndIsChecked) {
    SavedForecast saved = example(1);
    Spread& spread = saved.forecast.spread;
    spread.common = {1.5f, 1, 0.5f};
    spread.own = saved.forecast.trajectory.base.clone();
    spread.nodes = {{1, 1e-6, 2e-6}, {2.5, 1e-5, 3e-5}};
    write_forecast(saved, folder_);
    const Spread read = read_forecast(folder_).forecast.spread;
    EXPECT_EQ(read.nodes, spread.nodes);
    EXPECT_EQ(read.common.r, 1.5f);
    EXPECT_TRUE(same_bytes(read.own, spread.own));
    const std::string text = read_text(folder_ / "forecast.json");
    for (const auto& [from, to] : {std::pair{"2.5", "0.5"}, std::pair{"1.5", "-2"}}) {
        std::string changed = text;
        const auto at = changed.find(from);
        ASSERT_NE(at, std::string::npos);
        write_file(folder_ / "forecast.json", changed.replace(at, 3, to));
        expect_bad(folder_, "forecast.json");
    }
    write_file(folder_ / "forecast.json", text);
    fs::remove(folder_ / "spread.npy");
    expect_bad(folder_, "spread.npy");
    // A forecast that states none removes what one before it stated.
    write_forecast(example(1), folder_);
    EXPECT_FALSE(read_forecast(folder_).forecast.spread.known());
    EXPECT_FALSE(fs::exists(folder_ / "spread.npy"));
}

TEST(HorizonLabel, Sorts) {
    EXPECT_EQ(horizon_label(5), "u005");
    EXPECT_EQ(horizon_label(10), "u010");
    EXPECT_EQ(horizon_label(7.5), "u007_5");
    EXPECT_EQ(horizon_label(0), "u000");
    EXPECT_EQ(horizon_label(123.25), "u123_25");
    EXPECT_EQ(horizon_label(1001), "u1001");  // never four digits alone: no UDIM tile
    EXPECT_LT(horizon_label(7.5), horizon_label(10));
    EXPECT_THROW(horizon_label(-1), Error);
}

}  // namespace
}  // namespace verdigris
