// SPDX-License-Identifier: MIT
// The question the drift control answers: is a gain on the metal or on the camera?
#include <gtest/gtest.h>

#include <span>

#include "verdigris/evaluate/characterize.h"
#include "verdigris/evaluate/evaluate.h"
#include "verdigris/observe/drift_correction.h"
#include "verdigris/observe/testing/drifting_store.h"

namespace verdigris {
namespace {

using testing::DriftingScene;

/// A plate under a camera that brightens by 4 % over the recording.
Observation recorded(double darkening) {
    DriftingScene scene;
    scene.samples = 240;
    scene.noise = 3e-4;
    scene.darkening = darkening;
    Observation o;
    o.source_name = "plate";
    o.axis = {24, scene.samples, 10, 1};
    o.samples.resize(std::size_t(scene.samples));
    o.store = testing::seen_through(scene, [scene](int t) {
        const double gain = 1 + 0.04 * t / scene.samples;
        return ChannelMap{{gain, gain, gain}, {}};
    });
    o.specimen = scene.specimen();
    o.noise = {3e-4, 2.4 * 3e-4, false};
    return o;
}

struct Gains {
    double before = 0, after = 0;
    std::size_t windows_after = 0;
};

Gains gains_of(double darkening) {
    const Observation seen = recorded(darkening);
    const ReferenceRegion region = find_reference_region(*seen.store, seen.specimen);
    const DriftSeries series = measure_drift_series(*seen.store, seen.specimen, region);
    EvaluationProtocol protocol = short_recording_protocol(10);
    protocol.single = true;
    protocol.area = EvaluatedArea::specimen;
    protocol.max_windows = 30;
    protocol.delta_e = false;
    const std::vector<Entrant> entrants{training_free(affinergb(paper_affine()))};
    std::vector<Observation> list;
    list.push_back(corrected_observation(seen, series, DriftCorrection::gain));
    const Direction after = evaluate(protocol, list, entrants).directions[0];
    const Direction before = evaluate(protocol, std::span(&seen, 1), entrants).directions[0];
    Gains gains;
    gains.before = gain(before, before.entrants[1]);
    gains.windows_after = after.starts.size();
    if (gains.windows_after > 0) gains.after = gain(after, after.entrants[1]);
    return gains;
}

TEST(DriftEvaluation, AGainThatIsOnTheCameraIsGoneAfterCorrection) {
    const Gains still = gains_of(0);
    EXPECT_GT(still.before, 0.8);        // it looks like foresight ...
    EXPECT_EQ(still.windows_after, 0u);  // ... and nothing changes: no window is left
}

TEST(DriftEvaluation, AGainThatIsOnTheMetalStays) {
    const Gains aging = gains_of(0.2);
    EXPECT_GT(aging.before, 0.8);
    EXPECT_EQ(aging.windows_after, 30u);
    EXPECT_GT(aging.after, 0.8);
}

}  // namespace
}  // namespace verdigris
