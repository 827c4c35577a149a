// SPDX-License-Identifier: MIT
#include "verdigris/forecast/forecast.h"

#include <gtest/gtest.h>

#include "verdigris/error.h"
#include "verdigris/forecast/testing.h"

namespace verdigris {
namespace {

/// Sample i is an image of the constant i / 100.
class CountingStore : public SampleStore {
  public:
    explicit CountingStore(int count) : count_(count) {}
    int count() const override { return count_; }
    int width() const override { return 3; }
    int height() const override { return 2; }
    Image<SrgbF> image(int index) const override {
        return paint(3, 2, [index](int, int) { return SrgbF{float(index) / 100, 0, 0}; });
    }

  private:
    int count_;
};

Observation observed(int kept, int samples_per_unit, bool every_sample) {
    Observation o;
    o.store = std::make_shared<CountingStore>(kept);
    o.axis.samples_per_unit = samples_per_unit;
    o.axis.samples = every_sample ? kept : kept * samples_per_unit;
    o.axis.units = double(o.axis.samples) / samples_per_unit;
    for (int i = 0; i < kept; ++i) {
        o.samples.push_back({every_sample ? double(i) / samples_per_unit : double(i), 0, 1, false});
    }
    o.specimen = Mask(3, 2);
    o.clipped = Mask(3, 2);
    o.noise = {0.001, 0.0024, false};
    return o;
}

std::vector<int> indices_of(const Context& context) {
    std::vector<int> out;
    for (const auto& f : context.frames) out.push_back(int(std::lround(f(0, 0).r * 100)));
    return out;
}

TEST(ContextFrom, TakesTheLastUnitSteps) {
    EXPECT_EQ(indices_of(context_from(observed(9, 10, false), 3)), (std::vector{6, 7, 8}));
    EXPECT_EQ(indices_of(context_from(observed(95, 10, true), 4)), (std::vector{64, 74, 84, 94}));
    EXPECT_EQ(indices_of(context_from(observed(7, 1, true), 3)), (std::vector{4, 5, 6}));
}

TEST(ContextFrom, TakesAllThereAreIfFewer) {
    EXPECT_EQ(indices_of(context_from(observed(2, 10, false), 10)), (std::vector{0, 1}));
    EXPECT_EQ(indices_of(context_from(observed(21, 10, true), 10)), (std::vector{0, 10, 20}));
}

TEST(ContextFrom, CarriesNoiseAndRefusesNothing) {
    const Context context = context_from(observed(9, 10, false), 3);
    EXPECT_DOUBLE_EQ(context.sigma, 0.001);
    EXPECT_DOUBLE_EQ(context.tau, 0.0024);
    EXPECT_THROW(context_from(Observation{}, 5), Error);
    EXPECT_THROW(context_from(observed(9, 10, false), 0), Error);
}

TEST(Persistence, HoldsTheLastFrameExactly) {
    const Context context = drifting(6, planted_drift(), 0.01);
    const Forecast forecast = persistence().forecast(context);
    for (double h : {0.0, 1.0, 7.5, 50.0}) {
        EXPECT_TRUE(same_bytes(forecast.at(h), context.frames.back())) << h;
    }
}

TEST(FrameStack, InterpolatesBetweenItsFrames) {
    Forecast forecast;
    const auto flat = [](float v) {
        return paint(2, 2, [v](int, int) { return SrgbF{v, v / 2, 0}; });
    };
    forecast.stack.base = flat(0.2f);
    forecast.stack.horizons = {1, 3};
    forecast.stack.frames.push_back(flat(0.4f));
    forecast.stack.frames.push_back(flat(0.8f));
    ASSERT_FALSE(forecast.is_trajectory());
    EXPECT_TRUE(same_bytes(forecast.at(0), forecast.stack.base));
    EXPECT_NEAR(forecast.at(0.5)(0, 0).r, 0.3, 1e-6);
    EXPECT_TRUE(same_bytes(forecast.at(1), forecast.stack.frames[0]));
    EXPECT_NEAR(forecast.at(2.5)(1, 1).g, 0.35, 1e-6);
    EXPECT_TRUE(same_bytes(forecast.at(3), forecast.stack.frames[1]));
    EXPECT_THROW(forecast.at(3.5), Error);  // a network knows nothing beyond
    EXPECT_THROW(forecast.at(-1), Error);
}

TEST(Forecasters, RefuseContextsThatMakeNoSense) {
    EXPECT_THROW(persistence().forecast(Context{}), Error);
    Context mixed = drifting(2, {}, 0);
    mixed.frames[1] = Image<SrgbF>(5, 5);
    EXPECT_THROW(persistence().forecast(mixed), Error);
    Context masked = drifting(2, {}, 0);
    masked.specimen = Mask(5, 5);
    EXPECT_THROW(affinergb().forecast(masked), Error);
}

}  // namespace
}  // namespace verdigris
