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

/// Planted: another pattern triples the error, another pose costs a tenth, nothing beyond.
TransferStudy planted(int seeds) {
    TransferStudy study;
    study.options.presets = {"chamber"};
    study.options.seeds = seeds;
    study.options.specimens = {1};
    for (int seed = 1; seed <= seeds; ++seed) {
        const double base = 0.4 + 0.1 * seed;
        for (const bool pose : {true, false}) {
            for (const bool pattern : {true, false}) {
                const double ratio = base * (pose ? 1 : 1.1) * (pattern ? 1 : 3);
                study.cells.push_back({"chamber",
                                       seed,
                                       pose,
                                       pattern,
                                       {scored("patinanet", ratio), scored("affinergb", 0.5)}});
            }
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
    EXPECT_NEAR(e.pattern.mean, std::log(3), 1e-12);
    EXPECT_NEAR(e.pose.mean, std::log(1.1), 1e-12);
    EXPECT_NEAR(e.interaction.mean, 0, 1e-12);
    EXPECT_NEAR(e.pattern.high - e.pattern.low, 0, 1e-9);  // the same in every seed
    EXPECT_NEAR(effects[0].pattern.mean, 0, 1e-12);
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
    const SimulationSpec a = transfer_spec("chamber", 1, 1, true, 32),
                         day = transfer_spec("chamber", 1, 2, true, 32),
                         pattern = transfer_spec("chamber", 7, 1, true, 32),
                         pose = transfer_spec("chamber", 1, 1, false, 32);
    EXPECT_EQ(a.pattern_seed(), day.pattern_seed());
    EXPECT_NE(a.seed, day.seed);
    EXPECT_NE(a.pattern_seed(), pattern.pattern_seed());
    EXPECT_EQ(a.seed, pattern.seed);
    EXPECT_NE(a.scene.tilt, pose.scene.tilt);
    EXPECT_EQ(a.pattern_seed(), pose.pattern_seed());
    check_spec(pose);
    check_spec(transfer_spec("air", 1, 1, false, 32));
}

TEST(TransferReport, SaysWhatTheIntervalsAllow) {
    const TransferStudy study = planted(3);
    check_report(transfer_report(study));
    const std::vector<std::string> said = transfer_sentences(study);
    ASSERT_EQ(said.size(), 1u);
    EXPECT_NE(said[0].find("Another pattern: 3.00 times the error"), std::string::npos) << said[0];
    TransferStudy noisy = study;
    for (std::size_t i = 0; i < noisy.cells.size(); ++i)
        noisy.cells[i].scores[0].error *= i % 3 == 0 ? 4 : 0.5;
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
    EXPECT_EQ(first.cells.size(), 4u);
    EXPECT_EQ(first.counts.size(), 2u);
    EXPECT_EQ(first.own.size(), 1u);
    const TransferStudy second = run_transfer_study(options, folder.path());
    for (std::size_t i = 0; i < first.cells.size(); ++i)
        EXPECT_EQ(first.cells[i].scores[0].error, second.cells[i].scores[0].error);
    check_report(transfer_report(first));
    options.networks.push_back(options.networks.front());
    EXPECT_THROW(run_transfer_study(options, folder.path()), Error);
    options.networks.pop_back();
    options.seeds = 0;
    EXPECT_THROW(run_transfer_study(options, folder.path()), Error);
}

}  // namespace
}  // namespace verdigris
