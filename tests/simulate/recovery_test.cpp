// SPDX-License-Identifier: MIT
// What the authoring loop makes of a recording whose truth is known: the specimen it finds, and the
// frames it gives back when the camera drifted.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "verdigris/files/testing.h"
#include "verdigris/observe/drift_correction.h"
#include "verdigris/observe/observe.h"
#include "verdigris/observe/reference_region.h"
#include "verdigris/recording/recording_writer.h"
#include "verdigris/simulate/simulate.h"

namespace verdigris {
namespace {

/// Intersection over union of the mask that was found, which lies in the crop, and the true one.
double overlap(const Observation& found, const Mask& truth) {
    const Rect crop = found.crop.rect;
    double both = 0, either = 0;
    for (int y = 0; y < truth.height(); ++y) {
        for (int x = 0; x < truth.width(); ++x) {
            const int u = x - crop.x, v = y - crop.y;
            const bool in_crop = u >= 0 && v >= 0 && u < crop.width && v < crop.height;
            const bool here = in_crop && found.specimen(u, v) != 0, there = truth(x, y) != 0;
            both += here && there;
            either += here || there;
        }
    }
    return both / either;
}

class RecoverMask : public testing::TestWithParam<std::string> {};

TEST_P(RecoverMask, ObserveFindsTheSpecimen) {
    for (const std::uint64_t seed : {1, 2, 3}) {
        SimulationSpec spec = preset_spec(GetParam());
        spec.seed = seed;
        spec.frames.count = 246;  // a quarter of them, over the same units
        const Observation found = observe(simulated_recording(spec));
        const Mask truth = Scene(spec, specimen_grid(spec)).specimen();
        const double iou = overlap(found, truth);
        std::printf("measured: IoU %s seed %d: %.3f\n", GetParam().c_str(), int(seed), iou);
        EXPECT_GE(iou, 0.9) << found.crop.sentence;
    }
}

INSTANTIATE_TEST_SUITE_P(Presets, RecoverMask, testing::ValuesIn(preset_names()),
                         [](const auto& kind) { return kind.param; });

/// Samples of a 16-bit recording without noise, written to disk and read back as a user's would be.
Observation observed(const SimulationSpec& spec, const std::filesystem::path& folder) {
    const auto writer = write_recording(folder, {.width = spec.frames.width,
                                                 .height = spec.frames.height,
                                                 .fps = spec.frames.fps,
                                                 .bits = 16});
    simulate(spec, {.frame8 = {},
                    .frame16 = [&](int, ImageView<const SrgbU16> frame) { writer->add(frame); },
                    .state = {}});
    writer->commit();
    ObserveOptions options;
    options.keep = Keep::every_sample;
    options.crop.mode = CropMode::none;
    return observe(open_recording(folder), options);
}

SimulationSpec still_camera() {
    SimulationSpec spec = preset_spec("chamber");
    // The spread of the reference is a mean over nine samples, shifted at the ends: of a short
    // recording that is a large part.
    spec.frames = {.width = 160, .height = 120, .count = 300};
    spec.grid = 48;
    spec.camera = CameraSpec{.bits = 16};
    return spec;
}

/// Largest and mean absolute difference of all samples, corrected against undrifted.
struct Difference {
    double largest = 0, mean = 0;
};
Difference difference(const SampleStore& a, const SampleStore& b) {
    Difference d;
    double count = 0;
    for (int i = 0; i < a.count(); ++i) {
        const Image<SrgbF> p = a.image(i), q = b.image(i);
        for (std::size_t k = 0; k < p.pixel_count(); ++k) {
            const SrgbF s = p.pixels()[k], t = q.pixels()[k];
            for (const float e : {s.r - t.r, s.g - t.g, s.b - t.b}) {
                d.largest = std::max(d.largest, double(std::abs(e)));
                d.mean += double(std::abs(e)), ++count;
            }
        }
    }
    d.mean /= count;
    return d;
}

struct DriftCase {
    DriftCorrection correction;
    std::array<double, 3> gain, offset;
    double contrast;  ///< of the backdrop: `both` needs some to tell gain from offset
};
class RecoverFrames : public testing::TestWithParam<DriftCase> {};

TEST_P(RecoverFrames, FromPureAffineDrift) {
    const DriftCase& drift = GetParam();
    SimulationSpec spec = still_camera();
    spec.scene.backdrop_gradient = drift.contrast;
    ScratchFolder folder;
    const Observation still = observed(spec, folder / "still");
    spec.camera.drift_gain = drift.gain;
    spec.camera.drift_offset = drift.offset;
    const Observation drifted = observed(spec, folder / "drifted");

    const Difference before = difference(*drifted.store, *still.store);
    EXPECT_GT(before.largest, 0.02) << "nothing to correct";
    const Mask specimen = Scene(spec, specimen_grid(spec)).specimen();
    const ReferenceRegion region = find_reference_region(*drifted.store, specimen);
    ASSERT_TRUE(region.found()) << region.sentence;
    const DriftSeries series = measure_drift_series(*drifted.store, specimen, region);
    const auto corrected = corrected_samples(
        drifted.store, correction_maps(series, drift.correction, drifted.noise.sigma));
    const Difference after = difference(*corrected, *still.store);
    std::printf("measured: drift %s: largest difference %.2g before, %.2g after; mean %.2g, %.2g\n",
                to_string(drift.correction).c_str(), before.largest, after.largest, before.mean,
                after.mean);
    EXPECT_LE(after.largest, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, RecoverFrames,
    testing::Values(DriftCase{DriftCorrection::gain, {1.06, 0.97, 1.02}, {0, 0, 0}, 0.03},
                    DriftCase{DriftCorrection::offset, {1, 1, 1}, {0.04, -0.03, 0.01}, 0.03},
                    DriftCase{DriftCorrection::both, {1.05, 0.96, 1}, {0.02, 0.03, -0.02}, 0.3}),
    [](const auto& kind) { return to_string(kind.param.correction); });

}  // namespace
}  // namespace verdigris
