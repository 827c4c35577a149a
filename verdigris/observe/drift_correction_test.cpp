// SPDX-License-Identifier: MIT
#include "verdigris/observe/drift_correction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "verdigris/error.h"
#include "verdigris/observe/testing/drifting_store.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

using testing::DriftingScene;
using testing::seen_through;

/// Slow, different in each channel, bent: half a period over the recording.
double slow(const DriftingScene& scene, int t, double amplitude, double phase) {
    return amplitude * (std::sin(std::numbers::pi * t / scene.samples + phase) - std::sin(phase));
}
ChannelMap gain_at(const DriftingScene& scene, int t) {
    ChannelMap m;
    m.gain = {1 + slow(scene, t, 0.05, 0), 1 + slow(scene, t, 0.04, 1),
              1 - slow(scene, t, 0.03, 0.4)};
    return m;
}
ChannelMap offset_at(const DriftingScene& scene, int t) {
    ChannelMap m;
    m.offset = {slow(scene, t, 0.03, 0), slow(scene, t, -0.02, 1), slow(scene, t, 0.025, 0.4)};
    return m;
}
ChannelMap both_at(const DriftingScene& scene, int t) {
    ChannelMap m = gain_at(scene, t);
    m.offset = offset_at(scene, t).offset;
    return m;
}

using Camera = ChannelMap (*)(const DriftingScene&, int);

struct Corrected {
    DriftSeries series;
    double before = 0, after = 0;  ///< largest difference from the undrifted samples
};

Corrected correct(const DriftingScene& scene, Camera camera, DriftCorrection correction,
                  double sigma = 0) {
    const auto seen = seen_through(scene, [&](int t) { return camera(scene, t); });
    const ReferenceRegion region = find_reference_region(*seen, scene.specimen());
    Corrected out;
    out.series = measure_drift_series(*seen, scene.specimen(), region);
    const auto fixed = corrected_samples(seen, correction_maps(out.series, correction, sigma));
    for (int t = 0; t < scene.samples; t += 7) {
        const Image<SrgbF> drifted = seen->image(t), image = fixed->image(t);
        for (int y = 0; y < scene.height; ++y) {
            for (int x = 0; x < scene.width; ++x) {
                const SrgbF truth = scene.undrifted(x, y, t);
                const auto worst = [&](SrgbF v) {
                    return double(std::max({std::fabs(v.r - truth.r), std::fabs(v.g - truth.g),
                                            std::fabs(v.b - truth.b)}));
                };
                out.before = std::max(out.before, worst(drifted(x, y)));
                out.after = std::max(out.after, worst(image(x, y)));
            }
        }
    }
    return out;
}

TEST(DriftCorrection, UndoesAGainThatDrifts) {
    const Corrected c = correct({}, gain_at, DriftCorrection::gain);
    EXPECT_GT(c.before, 0.02);
    EXPECT_LT(c.after, 1e-3);
}

TEST(DriftCorrection, UndoesAnOffsetThatDrifts) {
    const Corrected c = correct({}, offset_at, DriftCorrection::offset);
    EXPECT_GT(c.before, 0.02);
    EXPECT_LT(c.after, 1e-3);
}

TEST(DriftCorrection, UndoesBothWhereTheBackdropHasContrast) {
    DriftingScene scene;
    scene.gradient = 0.3;
    // The paper's length: over 400 samples the same bend is no longer slow against a window of 101,
    // and smoothing alone costs 2e-3.
    scene.samples = 950;
    const Corrected c = correct(scene, both_at, DriftCorrection::both);
    EXPECT_GT(c.before, 0.04);
    EXPECT_LT(c.after, 1e-3);
}

TEST(DriftCorrection, TheWrongKindDoesNotUndoIt) {
    EXPECT_GT(correct({}, offset_at, DriftCorrection::gain).after, 3e-3);
    EXPECT_GT(correct({}, gain_at, DriftCorrection::offset).after, 3e-3);
}

TEST(DriftCorrection, OnAFlatBackdropBothFallsBackToTheOffset) {
    DriftingScene scene;
    scene.gradient = 0;
    scene.noise = 0.004;
    scene.samples = 150;
    const Corrected c = correct(scene, offset_at, DriftCorrection::both, scene.noise);
    for (const ChannelMap& m : correction_maps(c.series, DriftCorrection::both, scene.noise)) {
        for (const double g : m.gain) EXPECT_NEAR(g, 1, 2e-3);
    }
    // Without the shrinking the ratio of two noises would be believed.
    double worst = 0;
    for (const ChannelMap& m : correction_maps(c.series, DriftCorrection::both, 0)) {
        for (const double g : m.gain) worst = std::max(worst, std::fabs(g - 1));
    }
    EXPECT_GT(worst, 2e-3);
}

TEST(DriftCorrection, SampleZeroIsLeftAsItIs) {
    const DriftingScene scene;
    const Corrected c = correct(scene, both_at, DriftCorrection::both);
    for (const auto kind :
         {DriftCorrection::gain, DriftCorrection::offset, DriftCorrection::both}) {
        const ChannelMap first = correction_maps(c.series, kind, 0.001)[0];
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_DOUBLE_EQ(first.gain[i], 1) << to_string(kind);
            EXPECT_NEAR(first.offset[i], 0, 1e-15) << to_string(kind);
        }
    }
}

TEST(DriftCorrection, ReportsHowMuchSpecimenAndReferenceMove) {
    // A camera that brightens linearly by 0.02 while the plate darkens: an exposure loop.
    const DriftingScene scene;
    const auto seen = seen_through(scene, [&](int t) {
        const double v = 0.02 * t / (scene.samples - 1);
        return ChannelMap{{1, 1, 1}, {v, v, v}};
    });
    const DriftSeries series = measure_drift_series(*seen, scene.specimen(),
                                                    find_reference_region(*seen, scene.specimen()));
    EXPECT_NEAR(series.reference_movement, 0.02, 1e-6);
    const double share = double(scene.samples - 1) / scene.samples;
    const double darker = scene.darkening * share * (0.65 + 0.42 + 0.30) / 3;
    EXPECT_NEAR(series.specimen_movement, darker - 0.02, 1e-5);
    ASSERT_TRUE(series.ratio);
    EXPECT_NEAR(*series.ratio, (darker - 0.02) / 0.02, 0.01);
    ASSERT_TRUE(series.luma_correlation);
    EXPECT_NEAR(*series.luma_correlation, -1, 1e-6);
}

TEST(DriftCorrection, AReferenceThatStandsStillCorrelatesWithNothing) {
    DriftingScene scene;
    scene.samples = 60;
    const auto seen = seen_through(scene, [](int) { return ChannelMap{}; });
    const DriftSeries series = measure_drift_series(*seen, scene.specimen(),
                                                    find_reference_region(*seen, scene.specimen()));
    EXPECT_LT(series.reference_movement, 1e-9);
    EXPECT_FALSE(series.luma_correlation);
    EXPECT_GT(series.specimen_movement, 0.05);
}

TEST(DriftCorrection, TheCorrectedObservationMeasuresItsNoiseAgain) {
    DriftingScene scene;
    scene.samples = 80;
    scene.noise = 0.003;
    Observation observation;
    observation.source_name = "made";
    observation.store = seen_through(scene, [&](int t) {
        return ChannelMap{{1.0 + t * 0.001, 1.0 + t * 0.001, 1}, {}};
    });
    observation.specimen = scene.specimen();
    observation.noise = {0.02, 0.05, false};  // wrong on purpose
    const ReferenceRegion region = find_reference_region(*observation.store, observation.specimen);
    const DriftSeries series =
        measure_drift_series(*observation.store, observation.specimen, region);
    const Observation fixed = corrected_observation(observation, series, DriftCorrection::gain);
    EXPECT_NEAR(fixed.noise.sigma, 0.003, 3e-4);
    EXPECT_NEAR(fixed.noise.tau, 2.4 * fixed.noise.sigma, 1e-12);
    EXPECT_EQ(fixed.source_name, "made");
    EXPECT_EQ(fixed.store->count(), 80);
    observation.noise = {0.003, 0.05, true};
    EXPECT_EQ(corrected_observation(observation, series, DriftCorrection::gain).noise.tau, 0.05);
}

TEST(DriftCorrection, IsTheSameOnAnyNumberOfThreads) {
    DriftingScene scene;
    scene.samples = 40;
    scene.noise = 0.003;
    const auto seen = seen_through(scene, [&](int t) { return both_at(scene, t); });
    const ReferenceRegion region = find_reference_region(*seen, scene.specimen());
    set_thread_count(1);
    const DriftSeries one = measure_drift_series(*seen, scene.specimen(), region);
    set_thread_count(0);
    const DriftSeries all = measure_drift_series(*seen, scene.specimen(), region);
    EXPECT_EQ(one.reference, all.reference);
    EXPECT_EQ(one.spread, all.spread);
    EXPECT_EQ(one.specimen, all.specimen);
}

TEST(DriftCorrection, RefusesWhatMakesNoSense) {
    const DriftingScene scene;
    const auto seen = seen_through(scene, [](int) { return ChannelMap{}; });
    const ReferenceRegion region = find_reference_region(*seen, scene.specimen());
    EXPECT_THROW(measure_drift_series(*seen, scene.specimen(), {}), Error);
    EXPECT_THROW(measure_drift_series(*seen, Mask(2, 2), region), Error);
    DriftSeriesOptions even;
    even.smoothing = 100;
    EXPECT_THROW(measure_drift_series(*seen, scene.specimen(), region, even), Error);
    EXPECT_THROW(corrected_samples(seen, {}), Error);
}

}  // namespace
}  // namespace verdigris
