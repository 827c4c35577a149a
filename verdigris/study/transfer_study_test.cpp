// SPDX-License-Identifier: MIT
#include "verdigris/study/transfer_study.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "verdigris/error.h"
#include "verdigris/files/testing.h"
#include "verdigris/study/transfer_report.h"

namespace verdigris {
namespace {

TransferScore scored(const std::string& name, double ratio) {
    return {name, ratio, 1};
}

/// Planted: another pattern triples the error, another pose costs a tenth and another camera a
/// fifth; other kinetics halve it, but not under another camera.
TransferStudy planted(int seeds) {
    TransferStudy study;
    study.options.presets = {"chamber"};
    study.options.seeds = seeds;
    study.options.specimens = {1};
    for (int seed = 1; seed <= seeds; ++seed) {
        const double base = 0.4 + 0.1 * seed;
        for (int i = 0; i < 16; ++i) {
            const TransferChange c = transfer_change(i);
            const double ratio = base * (c.pattern ? 3 : 1) * (c.pose ? 1.1 : 1) *
                                 (c.camera ? 1.2 : 1) * (c.kinetics && !c.camera ? 0.5 : 1);
            study.cells.push_back(
                {"chamber", seed, c, {scored("patinanet", ratio), scored("affinergb", 0.5)}});
        }
        study.counts.push_back(
            {"chamber", seed, 1, {scored("patinanet", 2), scored("affinergb", 0.5)}});
    }
    return study;
}

TEST(TransferStudy, FindsThePlantedEffects) {
    const auto effects = transfer_effects(planted(3));
    ASSERT_EQ(effects.size(), 2u);
    const TransferEffects& e = effects[1];
    EXPECT_EQ(e.forecaster, "patinanet");
    EXPECT_NEAR(e.of[0].mean, std::log(3), 1e-12);
    EXPECT_NEAR(e.of[1].mean, std::log(1.1), 1e-12);
    // In half of the states the kinetics do nothing.
    EXPECT_NEAR(e.of[2].mean, std::log(1.2) + std::log(2) / 2, 1e-12);
    EXPECT_NEAR(e.of[3].mean, -std::log(2) / 2, 1e-12);
    EXPECT_NEAR(e.pattern_and_pose.mean, 0, 1e-12);
    EXPECT_NEAR(e.camera_and_kinetics.mean, std::log(2), 1e-12);
    EXPECT_NEAR(e.day_only.mean, (std::log(0.5) + std::log(0.6) + std::log(0.7)) / 3, 1e-12);
    EXPECT_NEAR(e.of[0].high - e.of[0].low, 0, 1e-9);  // the same in every seed
    EXPECT_NEAR(effects[0].of[0].mean, 0, 1e-12);
}

// Student's t for three values: mean 2, deviation 1, 4.303 / sqrt(3).
TEST(TransferStudy, IntervalsAreStudents) {
    const SeedMean m = seed_mean({1, 2, 3});
    EXPECT_NEAR(m.mean, 2, 1e-12);
    EXPECT_NEAR(m.high - m.mean, 4.303 / std::sqrt(3.0), 1e-3);
    EXPECT_FALSE(seed_mean({5}).has_interval());
    // Beyond the table: 2.201 for 11 degrees of freedom, 2.045 for 29.
    for (const auto& [n, point] : {std::pair{12, 2.201}, {30, 2.045}}) {
        std::vector<double> values(static_cast<std::size_t>(n), 0.0);
        for (std::size_t i = 0; i < values.size(); i += 2) values[i] = 1;
        const SeedMean s = seed_mean(values);
        EXPECT_NEAR((s.high - s.mean) / std::sqrt(0.25 / (n - 1)), point, 1e-3) << n;
    }
}

// What is learned from is judged on nowhere, in any seed: neither its pattern nor its day.
TEST(TransferStudy, LearnsFromNothingThatItIsJudgedOn) {
    std::set<int> learned, judged;
    for (int seed = 1; seed <= 50; ++seed) {
        for (int i = 0; i < 16; ++i) EXPECT_TRUE(learned.insert(learned_specimen(seed, i)).second);
        for (const int offset : {500, 1000, 2000}) judged.insert(offset + seed);
    }
    for (const int number : judged) EXPECT_FALSE(learned.contains(number)) << number;
    EXPECT_EQ(learned_specimen(3, 7), 307);  // trainings are kept: these stay
}

TEST(TransferStudy, SpecsChangeOneThingAtATime) {
    const SimulationSpec a = transfer_spec("chamber", 1, 1, {}, 32),
                         day = transfer_spec("chamber", 1, 2, {}, 32),
                         pattern = transfer_spec("chamber", 7, 1, {.pattern = true}, 32),
                         pose = transfer_spec("chamber", 1, 1, {.pose = true}, 32),
                         camera = transfer_spec("chamber", 1, 1, {.camera = true}, 32),
                         kinetics = transfer_spec("chamber", 1, 1, {.kinetics = true}, 32);
    EXPECT_EQ(a.pattern_seed(), day.pattern_seed());
    EXPECT_NE(a.seed, day.seed);
    EXPECT_NE(a.pattern_seed(), pattern.pattern_seed());
    EXPECT_EQ(a.seed, pattern.seed);
    EXPECT_NE(a.scene.tilt, pose.scene.tilt);
    EXPECT_EQ(a.pattern_seed(), pose.pattern_seed());
    const SimulationSpec air = preset_spec("air");
    EXPECT_EQ(camera.camera.light_drift, air.camera.light_drift);
    EXPECT_EQ(camera.scene.light_direction, air.scene.light_direction);
    EXPECT_EQ(camera.scene.tilt, a.scene.tilt);
    EXPECT_EQ(camera.oxide.initial_nm, a.oxide.initial_nm);
    EXPECT_EQ(kinetics.oxide.initial_nm, air.oxide.initial_nm);
    EXPECT_EQ(kinetics.environment.noise, air.environment.noise);
    EXPECT_EQ(kinetics.camera.light_drift, a.camera.light_drift);
    EXPECT_EQ(kinetics.susceptibility.drip, a.susceptibility.drip);  // that is the pattern's
    for (const char* preset : {"chamber", "air"}) {
        for (int i = 0; i < 16; ++i)
            check_spec(transfer_spec(preset, 1, 1, transfer_change(i), 32));
    }
}

TEST(TransferReport, SaysWhatTheIntervalsAllow) {
    const TransferStudy study = planted(3);
    check_report(transfer_report(study));
    const std::vector<std::string> said = transfer_sentences(study);
    ASSERT_EQ(said.size(), 1u);
    EXPECT_NE(said[0].find("another pattern: 3.00 times the error"), std::string::npos) << said[0];
    TransferStudy noisy = study;
    for (std::size_t i = 0; i < noisy.cells.size(); ++i)
        noisy.cells[i].scores[0].error *= i % 3 == 0 ? 20 : 0.1;
    EXPECT_NE(transfer_sentences(noisy)[0].find("not told from none"), std::string::npos)
        << transfer_sentences(noisy)[0];
}

// The whole of it, as small as it gets; resumed, it gives the same.
TEST(TransferStudy, RunsAndResumes) {
    TransferStudyOptions options = quick_transfer_study();
    options.seeds = 1;
    options.specimens = {1, 2};
    options.size = 16;
    options.epochs = 1;
    options.train_windows = 8;
    options.test_windows = 4;
    options.threads = 1;
    const ScratchFolder folder;
    const TransferStudy first = run_transfer_study(options, folder.path());
    EXPECT_EQ(first.cells.size(), 16u);
    EXPECT_EQ(first.counts.size(), 2u);
    EXPECT_EQ(first.own.size(), 1u);
    const TransferStudy second = run_transfer_study(options, folder.path());
    for (std::size_t i = 0; i < first.cells.size(); ++i)
        EXPECT_EQ(first.cells[i].scores[0].error, second.cells[i].scores[0].error);
    check_report(transfer_report(first));
    options.networks.push_back(options.networks.front());
    EXPECT_THROW(run_transfer_study(options, folder.path()), Error);
    options.networks.pop_back();
    for (const char* preset : {"chamber", "mars"}) {
        options.presets = {"chamber", preset};
        EXPECT_THROW(check_transfer_options(options), Error) << preset;
    }
    options.presets = {"chamber"};
    options.seeds = 0;
    EXPECT_THROW(run_transfer_study(options, folder.path()), Error);
}

}  // namespace
}  // namespace verdigris
