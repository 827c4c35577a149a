// SPDX-License-Identifier: MIT
#include "verdigris/appearance/material_judgment.h"

#include <gtest/gtest.h>

#include <cmath>

#include "verdigris/appearance/frame_sheet.h"
#include "verdigris/appearance/material_contact.h"
#include "verdigris/appearance/material_report.h"
#include "verdigris/appearance/testing.h"
#include "verdigris/error.h"
#include "verdigris/forecast/affine.h"
#include "verdigris/pixels/parallel_rows.h"
#include "verdigris/report/table_formats.h"

namespace verdigris {
namespace {

using testing::aging_protocol;
using testing::small_options;

Entrant named(Forecaster forecaster, const std::string& name) {
    Entrant e = training_free(std::move(forecaster));
    e.name = name;
    return e;
}

/// Persistence under another name, the future itself, and its mirror image.
MaterialJudgment judged(const std::vector<Observation>& list, const MaterialJudgeOptions& options) {
    std::vector<const Observation*> all;
    for (const Observation& o : list) all.push_back(&o);
    const int far = options.horizons.back();
    return judge_materials(
        aging_protocol(), list,
        {named(persistence(), "still"), training_free(testing::oracle(all, far, 1)),
         training_free(testing::oracle(all, far, -1))},
        options);
}

TEST(JudgeMaterials, KnownAnswers) {
    const std::vector<Observation> list = testing::two_agings();
    const MaterialJudgment j = judged(list, small_options());
    ASSERT_EQ(j.directions.size(), 2u);
    for (const MaterialDirection& d : j.directions) {
        ASSERT_EQ(d.rows.size(), 6u);
        EXPECT_EQ(d.rows[0].name, "persistence");
        EXPECT_EQ(d.rows[1].name, "canvas");
        EXPECT_EQ(d.rows[2].name, "true-finish");
        EXPECT_EQ(d.rows[3].name, "still");
        const MaterialScores &control = d.rows[0], &canvas = d.rows[1], &finish = d.rows[2],
                             &still = d.rows[3], &perfect = d.rows[4], &mirrored = d.rows[5];
        ASSERT_EQ(control.flip.windows, 3);
        for (int w = 0; w < 3; ++w) {
            for (int h = 0; h < 2; ++h) {
                EXPECT_GT(control.flip.at(w, h), 0.005);
                EXPECT_EQ(still.flip.at(w, h), control.flip.at(w, h));
                // The true frame's own material, to the bit.
                EXPECT_EQ(perfect.flip.at(w, h), 0);
                EXPECT_EQ(perfect.ssim.at(w, h), 1);
                EXPECT_EQ(perfect.delta_e.at(w, h), 0);
                EXPECT_NEAR(perfect.agreement.at(w, h), 1, 1e-9);
                EXPECT_NEAR(mirrored.agreement.at(w, h), -1, 1e-6);
                EXPECT_TRUE(std::isnan(control.agreement.at(w, h)));
                EXPECT_NEAR(mirrored.moved.at(w, h), d.truth_moved.at(w, h), 1e-6);
                EXPECT_NEAR(mirrored.error.at(w, h), 4 * control.error.at(w, h), 1e-6);
                // Only its color is wrong.
                EXPECT_GT(finish.flip.at(w, h), 0);
                EXPECT_LT(finish.flip.at(w, h), control.flip.at(w, h));
                EXPECT_EQ(finish.error.at(w, h), control.error.at(w, h));
                // The canvas is two units older than the last frame: farther from the future.
                EXPECT_GT(canvas.error.at(w, h), control.error.at(w, h));
            }
            EXPECT_GT(control.flip.at(w, 1), control.flip.at(w, 0));
        }
        EXPECT_GT(d.noise_flip, 0);
    }
    const auto list_of = material_verdicts(j);
    for (const MaterialDirectionVerdict& v : list_of) {
        for (std::size_t h = 0; h < 2; ++h) {
            EXPECT_EQ(v.rows[2][h].gain.value, 0);  // still
            EXPECT_EQ(v.rows[3][h].gain.value, 1);  // perfect: 100 %
        }
        EXPECT_NE(v.sentences[0].find("still look no different at +2"), std::string::npos)
            << v.sentences[0];
        EXPECT_NE(v.sentences[1].find("perfect look closer at +2 (FLIP 0.0000 against"),
                  std::string::npos)
            << v.sentences[1];
    }
}

TEST(JudgeMaterials, AMirroredForecastIsToldApartByItsColorOnly) {
    // By the coverage alone it would be perfect: as far from the clean state. The color is not.
    const MaterialJudgment j = judged(testing::two_agings(), small_options());
    for (const MaterialDirection& d : j.directions) {
        const std::size_t far = 1;
        EXPECT_GT(horizon_means(d.rows[5].delta_e)[far], horizon_means(d.rows[4].delta_e)[far] + 1);
        EXPECT_GT(horizon_means(d.rows[5].flip)[far], 0.02);
    }
}

TEST(JudgeMaterials, SameBytesAtAnyThreadCount) {
    // Numbers in CSV are exact.
    const auto numbers = [] {
        return table_csv(material_windows(judged(testing::two_agings(), small_options()))).rows;
    };
    const auto many = numbers();
    set_thread_count(1);
    const auto one = numbers();
    set_thread_count(0);
    EXPECT_EQ(many.size(), 2u * 6 * 3 * 2);
    EXPECT_EQ(many, one);
}

TEST(JudgeMaterials, EveryWindowServesAllHorizonsAndBlocksAreAsLongAsTheirHorizon) {
    MaterialJudgeOptions options = small_options();
    const EvaluationProtocol base = aging_protocol();
    EXPECT_EQ(material_protocol(base, {2, 8}).span(), 120);
    EXPECT_EQ(material_protocol(base, {2, 8}).embargo_samples(), base.embargo_samples());
    const MaterialJudgment j = judged(testing::two_agings(), options);
    for (const MaterialDirection& d : j.directions) {
        EXPECT_EQ(d.starts, (std::vector<int>{0, 39, 79}));
        EXPECT_EQ(d.shown, (Rect{13, 0, 11, 16}));  // the specimen less its rim
        ASSERT_EQ(d.examples.size(), 2u);
        EXPECT_EQ(d.examples[0].start, 39);
    }
    EXPECT_EQ(flip_bootstrap(j, 0).block, 60);
    EXPECT_EQ(flip_bootstrap(j, 1).block, 120);
    options.whole = true;
    EXPECT_EQ(judged(testing::two_agings(), options).directions[0].shown, (Rect{0, 0, 24, 16}));
}

TEST(JudgeMaterials, LpipsIsAskedForEveryPictureOrMissing) {
    MaterialJudgeOptions options = small_options();
    options.horizons = {2};
    EXPECT_TRUE(judged(testing::two_agings(), options).directions[0].rows[0].lpips.empty());
    int asked = 0;
    options.lpips = [&](const Image<SrgbF>&, const Image<SrgbF>&) {
        ++asked;
        return 0.25;
    };
    const MaterialJudgment j = judged(testing::two_agings(), options);
    EXPECT_EQ(asked, 2 * 3 * 6);
    EXPECT_EQ(j.directions[0].rows[5].lpips.at(2, 0), 0.25);
}

TEST(JudgeMaterials, RefusesInASentence) {
    const std::vector<Observation> list = testing::two_agings();
    const auto says = [&](const std::vector<int>& horizons) {
        MaterialJudgeOptions o = small_options();
        o.horizons = horizons;
        try {
            judge_materials(aging_protocol(), list, {}, o);
        } catch (const Error& e) {
            return std::string(e.what());
        }
        return std::string("nothing");
    };
    EXPECT_EQ(says({}), "horizons are whole units from 1 to 1000, increasing");
    EXPECT_EQ(says({5, 5}), "horizons are whole units from 1 to 1000, increasing");
    EXPECT_NE(says({2, 16}).find("first: is too short for +16: behind 5 observed frames its "
                                 "furthest horizon is +15"),
              std::string::npos)
        << says({2, 16});
}

/// Is `tile`, each pixel `zoom` times, what `sheet` shows there?
bool shows(const Image<SrgbU8>& sheet, const Image<SrgbU8>& tile, int x0, int y0, int zoom) {
    for (int y = 0; y < tile.height() * zoom; ++y)
        for (int x = 0; x < tile.width() * zoom; ++x)
            if (!(sheet(x0 + x, y0 + y) == tile(x / zoom, y / zoom))) return false;
    return true;
}

TEST(JudgeMaterials, TheSheetHasEveryForecasterBesideTheTruth) {
    const MaterialJudgment j = judged(testing::two_agings(), small_options());
    const Image<SrgbU8> sheet = draw_material_contact(j, 1);
    // Two directions of three tiles, six rows; 48 pixels are too few for words below, so each is
    // three wide.
    EXPECT_EQ(sheet.width(), 2 * 28 + 2 * (3 * 144 + 16) + 40);
    const MaterialExample& e = j.directions[0].examples[1];
    EXPECT_TRUE(shows(sheet, e.rows[0].picture, 28, 118, 3));
    EXPECT_TRUE(shows(sheet, e.truth, 28 + 152, 118, 3));
    EXPECT_TRUE(shows(sheet, e.rows[4].picture, 28, 118 + 4 * 178, 3));
    EXPECT_TRUE(shows(sheet, e.truth, 28, 118 + 4 * 178, 3));  // of the perfect one they are equal
    EXPECT_THROW(draw_material_contact(j, 2), Error);
}

TEST(JudgeMaterials, TheFramesOfAWindowStandBelowTheTrueOnes) {
    const MaterialJudgment j = judged(testing::two_agings(), small_options());
    const MaterialDirection& d = j.directions[1];
    const Image<SrgbU8> sheet = draw_frame_sheet(j, 1);
    const MaterialExample& e = d.examples[1];
    const int zoom = (128 + e.last.width() - 1) / e.last.width();
    const int wide = e.last.width() * zoom + 8, high = 2 * e.last.height() * zoom + 2 + 16;
    EXPECT_TRUE(shows(sheet, e.last, 28, 118, zoom));
    EXPECT_TRUE(shows(sheet, e.true_frame.picture, 28 + 170 + 8 + wide, 118, zoom));
    for (std::size_t i = 0; i + 3 < e.rows.size(); ++i)
        EXPECT_TRUE(shows(sheet, e.rows[3 + i].frame.picture, 28 + 170 + 8 + wide,
                          118 + int(i + 1) * high, zoom))
            << e.rows[3 + i].name;
    // What is perfect has moved as far as the truth, and holding still not at all.
    EXPECT_TRUE(std::ranges::equal(e.rows[4].frame.change.pixels(), e.true_frame.change.pixels()));
    EXPECT_GT(std::ranges::max(e.true_frame.change.pixels()), 0.01f);
    EXPECT_EQ(std::ranges::max(e.rows[0].frame.change.pixels()), 0);
    EXPECT_THROW(draw_frame_sheet(j, 2), Error);
}

}  // namespace
}  // namespace verdigris
