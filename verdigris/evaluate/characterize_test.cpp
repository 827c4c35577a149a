// SPDX-License-Identifier: MIT
#include "verdigris/evaluate/characterize.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "verdigris/error.h"
#include "verdigris/evaluate/testing.h"

namespace verdigris {
namespace {

using testing::affine_recording;
using testing::observed;

EvaluationProtocol small() {
    EvaluationProtocol p = short_recording_protocol(10);
    p.train_fraction = p.validation_fraction = 0;
    return p;
}

std::vector<Observation> pair(double sigma) {
    std::vector<Observation> list;
    list.push_back(affine_recording("chamber", 400, sigma, 1, 1));
    list.push_back(affine_recording("air", 400, sigma, -1, 2));
    return list;
}

const CharacterizationRow& row(const Characterization& c, const std::string& block,
                               const std::string& setting) {
    const auto at = std::ranges::find_if(c.rows, [&](const CharacterizationRow& r) {
        return r.block == block && r.setting.starts_with(setting);
    });
    EXPECT_NE(at, c.rows.end()) << block << " " << setting;
    return at == c.rows.end() ? c.rows.front() : *at;
}

TEST(Characterize, HasThePapersBlocksInTheirOrder) {
    CharacterizeOptions options;
    options.windows = 12;
    const Characterization c = characterize(small(), pair(0.001), options);
    EXPECT_EQ(c.directions, (std::vector<std::string>{"air -> chamber", "chamber -> air"}));
    std::vector<std::string> blocks, contexts;
    for (const CharacterizationRow& r : c.rows) {
        if (blocks.empty() || blocks.back() != r.block) blocks.push_back(r.block);
        if (r.block == "context") contexts.push_back(r.setting);
        ASSERT_EQ(r.cells.size(), 2u);
        for (const CharacterizationCell& cell : r.cells) {
            EXPECT_EQ(cell.ratios.starts.size(), 12u);
            EXPECT_NEAR(cell.gain, 1 - cell.error / cell.persistence, 1e-12);
            EXPECT_NEAR(ratio(cell.ratios), cell.gain, 1e-9);
        }
    }
    EXPECT_EQ(blocks,
              (std::vector<std::string>{"context", "family", "order", "fit-pixels", "ridge"}));
    EXPECT_EQ(contexts, (std::vector<std::string>{"n = 3", "n = 5", "n = 7", "n = 10"}));
    // The usual configuration is one and the same wherever a dagger stands.
    const double usual = row(c, "context", "n = 5").cells[0].error;
    EXPECT_EQ(row(c, "family", "full").cells[0].error, usual);
    EXPECT_EQ(row(c, "order", "linear").cells[0].error, usual);
    EXPECT_EQ(row(c, "ridge", "lambda = 0").cells[0].error, usual);
    EXPECT_TRUE(row(c, "context", "n = 5").usual);
}

TEST(Characterize, SeesWhatThePaperSaw) {
    // A drift that mixes channels under a color jitter of whole frames, as the paper's own numbers
    // imply: holding is the 0th order to the bit, the 2nd order multiplies the jitter, more context
    // helps, and fewer parameters cannot follow.
    std::vector<Observation> list;
    for (const std::uint64_t seed : {1u, 2u}) {
        list.push_back(observed(
            seed == 1 ? "chamber" : "air", 24, 16, 400,
            [seed](int x, int y, int t) {
                SrgbF c = testing::drifted(x, y, t / 10.0 + double(seed));
                const std::uint64_t key = 3 * (1000 * seed + std::uint64_t(t));
                c.r += float(3e-4 * testing::normal(key));
                c.g += float(3e-4 * testing::normal(key + 1));
                c.b += float(3e-4 * testing::normal(key + 2));
                return c;
            },
            3e-4));
    }
    const Characterization c = characterize(small(), list, {});
    for (std::size_t d = 0; d < 2; ++d) {
        const auto error = [&](const char* block, const char* setting) {
            return row(c, block, setting).cells[d].error;
        };
        EXPECT_EQ(error("order", "hold"), row(c, "order", "hold").cells[d].persistence);
        EXPECT_LT(error("order", "linear"), error("order", "hold"));
        EXPECT_GT(error("order", "accelerating"), 5 * error("order", "linear"));
        EXPECT_LT(error("context", "n = 10"), error("context", "n = 5"));
        EXPECT_LT(error("context", "n = 5"), error("context", "n = 3"));
        EXPECT_LT(error("family", "full"), error("family", "per-channel"));
        EXPECT_LT(error("family", "per-channel"), error("family", "single"));
    }
}

TEST(Characterize, TheBackdropsShareInTheFamilyBlockIsSeen) {
    // A neutral backdrop that stands still, and a specimen whose channels each drift by themselves.
    // Fitted to all pixels, one gain and bias per channel cannot hold the one and move the other;
    // fitted to the specimen it is exact.
    std::vector<Observation> list;
    for (const double speed : {0.004, 0.005}) {
        list.push_back(observed(
            speed == 0.004 ? "a" : "b", 24, 16, 250,
            [speed](int x, int y, int t) {
                if (x < 12) {
                    const float v = 0.3f + 0.02f * float(x) + 0.01f * float(y);
                    return SrgbF{v, v, v};
                }
                SrgbF c = testing::texture(x, y);
                c.r -= float(speed * t / 10 * 1.5);
                c.g += float(speed * t / 10);
                return c;
            },
            0));
    }
    const Characterization c = characterize(small(), list, {{5}, {0}, 20});
    for (std::size_t d = 0; d < 2; ++d) {
        const auto gain = [&](const char* setting) {
            return row(c, "fit-pixels", setting).cells[d].gain;
        };
        EXPECT_GT(gain("per-channel gain + bias (6), fitted to the specimen"), 0.999);
        EXPECT_LT(gain("per-channel gain + bias (6), fitted to all"), 0.9);
        EXPECT_GT(gain("full 3x3 + bias (12), fitted to all"),
                  gain("per-channel gain + bias (6), fitted to all"));
    }
}

TEST(LongHorizons, ReachAsFarAsTheRecordingAllows) {
    EvaluationProtocol paper;
    EXPECT_EQ(longest_horizon(paper, 984), 90);
    paper.context = 10;
    EXPECT_EQ(longest_horizon(paper, 984), 85);  // the paper's +85
    EXPECT_EQ(longest_horizon(small(), 43), 0);
}

TEST(LongHorizons, TheClampHoldsWhatLeavesTheGamut) {
    // Red rises by 0.01 per unit and saturates at 1: the drift is continued beyond, unless clamped.
    std::vector<Observation> list;
    for (const float start : {0.80f, 0.82f}) {
        list.push_back(
            observed(start == 0.80f ? "a" : "b", 24, 16, 500, [start](int x, int y, int t) {
                const SrgbF c = testing::texture(x, y);
                return SrgbF{std::min(1.0f, start + 0.001f * float(t) + 0.002f * float(y)), c.g,
                             c.b * start};
            }));
    }
    const Evaluation e = long_horizons(small(), list, 30);
    const Direction& d = e.directions[0];
    EXPECT_EQ(d.persistence().foreground.horizons, 30);
    const EntrantScores &clamped = d.entrant("affinergb clamped"),
                        &unclamped = d.entrant("affinergb unclamped");
    EXPECT_EQ(clamped.outside.at(0, 3), 0);
    EXPECT_EQ(clamped.outside.at(0, 29), 1);  // of the unclamped drift, whatever is delivered
    EXPECT_EQ(unclamped.outside.at(0, 29), 1);
    EXPECT_LT(clamped.foreground.at(0, 29), 0.1 * unclamped.foreground.at(0, 29));
    EXPECT_NEAR(d.persistence().absolute.at(0, 9), 0.1 / 3, 1e-4);
    // As far as it goes, if less than was asked for.
    EXPECT_EQ(long_horizons(small(), list, 1000).directions[0].persistence().foreground.horizons,
              45);
    EXPECT_THROW(long_horizons(small(), list, 0), Error);
}

}  // namespace
}  // namespace verdigris
