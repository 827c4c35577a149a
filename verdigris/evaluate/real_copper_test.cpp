// SPDX-License-Identifier: MIT
// The protocol on real frames: 100 photographs of a patinating plate, 3 frames per unit, by itself.
// What it says is reported as it is. Skipped where the shared data are absent.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <vector>

#include "verdigris/evaluate/bootstrap.h"
#include "verdigris/evaluate/characterize.h"
#include "verdigris/forecast/choose.h"
#include "verdigris/observe/drift_correction.h"

namespace verdigris {
namespace {

namespace fs = std::filesystem;

TEST(RealCopper, TheProtocolSaysWhatADriftIsWorthThere) {
    const fs::path folder = fs::path(VERDIGRIS_SHARED_DATA) / "real" / "copper_patinating";
    if (!fs::exists(folder)) GTEST_SKIP() << "no real copper frames at " << folder;
    ObserveOptions options;
    options.size = 128;
    options.keep = Keep::every_sample;
    std::vector<Observation> list;
    list.push_back(observe(open_recording(folder), options));
    EvaluationProtocol protocol = short_recording_protocol();
    protocol.single = true;
    const Evaluation e = evaluate(
        protocol, list, {training_free(affinergb(paper_affine())), training_free(automatic())});
    const Direction& d = e.directions.at(0);
    EXPECT_EQ(d.plan.all_starts, 58);
    EXPECT_EQ(d.starts.size(), 58u);
    EXPECT_EQ(d.plan.independent, 2);
    EXPECT_TRUE(e.notes.empty()) << e.notes.front().sentence;
    std::printf("%s: sigma %.5f, tau %.5f\n", d.label().c_str(), d.sigma, d.tau);
    for (const EntrantScores& s : d.entrants) {
        const WindowRatios ratios = gain_ratios(d, s);
        std::printf("%-24s mse %.3e  gain %+7.1f %%  |error| %.4f  delta E %.2f  blocks",
                    s.name.c_str(), overall_mean(s.foreground), 100 * gain(d, s),
                    overall_mean(s.absolute), overall_mean(s.delta_e));
        for (const BlockGain& b : block_gains(ratios, d.plan.span)) {
            std::printf(" %+.0f %%", 100 * b.value);
        }
        std::printf("\n");
    }
    // Strong early change and a glint: a drift that is followed without a ridge does harm here
    // (measured; the sign is what the test holds).
    EXPECT_LT(gain(d, d.entrants[1]), 0);
    EXPECT_GT(gain(d, d.entrants[2]), gain(d, d.entrants[1]));

    const ReferenceRegion region = find_reference_region(*list[0].store, list[0].specimen);
    std::printf("reference: %s\n", region.sentence.c_str());
}

}  // namespace
}  // namespace verdigris
