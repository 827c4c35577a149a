// SPDX-License-Identifier: MIT
#include "verdigris/appearance/material_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "verdigris/report/page.h"

namespace verdigris {
namespace {

/// One direction, horizons +5 and +50, FLIP as given per window: nothing rendered.
MaterialJudgment made(const std::vector<std::vector<double>>& control,
                      const std::vector<std::vector<double>>& free,
                      const std::vector<std::vector<double>>& clamped, double outside) {
    MaterialJudgment j;
    j.options.horizons = {5, 50};
    j.options.no_lpips = "this build has none";
    j.evaluation.protocol = material_protocol(short_recording_protocol(10), {5, 50});
    MaterialDirection d;
    d.label = "a -> b";
    d.held_out = "b";
    d.shown = {0, 0, 4, 4};
    const auto table = [](const std::vector<std::vector<double>>& rows) {
        ErrorTable t(int(rows.size()), 2);
        for (int w = 0; w < t.windows; ++w)
            for (int h = 0; h < 2; ++h) t.at(w, h) = rows[std::size_t(w)][std::size_t(h)];
        return t;
    };
    for (std::size_t w = 0; w < control.size(); ++w) d.starts.push_back(int(w) * 90);
    const std::vector<std::vector<double>> ones(control.size(), {1, 1}),
        shares(control.size(), {0, outside});
    for (const auto& [name, flips] :
         {std::pair("persistence", control), std::pair("canvas", control),
          std::pair("true-finish", control), std::pair("affinergb", free),
          std::pair("affinergb-clamped", clamped)}) {
        MaterialScores s;
        s.name = name;
        s.flip = table(flips);
        s.ssim = s.delta_e = s.error = s.moved = s.agreement = table(ones);
        s.outside_pixels = s.outside_channels = table(shares);
        d.rows.push_back(std::move(s));
    }
    d.truth_moved = table(ones);
    j.directions.push_back(std::move(d));
    return j;
}

MaterialJudgment crossing(double outside) {
    const std::vector<std::vector<double>> control(6, {0.1, 0.2});
    return made(control, std::vector<std::vector<double>>(6, {0.05, 0.3}),
                std::vector<std::vector<double>>(6, {0.05, 0.25}), outside);
}

TEST(MaterialReport, NumbersAndWordsFollowFromTheFlips) {
    const MaterialJudgment j = crossing(0);
    const auto list = material_verdicts(j);
    ASSERT_EQ(list.size(), 1u);
    EXPECT_NEAR(list[0].rows[2][0].gain.value, 0.5, 1e-12);
    EXPECT_NEAR(list[0].rows[2][1].gain.value, -0.5, 1e-12);
    // Six windows 90 samples apart: six blocks at +5 (span 90), one at +50 (span 540).
    EXPECT_EQ(list[0].rows[2][0].gain.blocks.size(), 6u);
    EXPECT_EQ(list[0].rows[2][1].gain.blocks.size(), 1u);
    const std::string& s = list[0].sentences[0];
    EXPECT_NE(s.find("the materials of affinergb look closer at +5 (FLIP 0.0500 against 0.1000, "
                     "+50.0 %); farther off at +50 (FLIP 0.3000 against 0.2000, -50.0 %)."),
              std::string::npos)
        << s;
    EXPECT_NE(s.find("at +5 the block interval +50.0 % to +50.0 % excludes zero"),
              std::string::npos)
        << s;
    EXPECT_NE(s.find("Too few blocks to say how sure that is: +50 (1)."), std::string::npos) << s;
    EXPECT_NE(s.find("crosses over between +5 and +50"), std::string::npos) << s;
    EXPECT_NE(s.find("so leaving the gamut is not why"), std::string::npos) << s;
    const auto gamut = crossing(0.08);  // the verdicts point into it
    const std::string out = material_verdicts(gamut)[0].sentences[0];
    EXPECT_NE(out.find("8.00 % of their channels lie outside [0, 1] before any clamp."),
              std::string::npos)
        << out;
}

TEST(MaterialReport, ALimitIsComparedWithWhatItLimits) {
    const MaterialJudgment j = crossing(0.08);
    const auto list = material_verdicts(j);
    ASSERT_EQ(list[0].fixes.size(), 2u);
    const FixVerdict& f = list[0].fixes[1];
    EXPECT_EQ(f.free, "affinergb");
    EXPECT_EQ(f.limited, "affinergb-clamped");
    EXPECT_NEAR(f.difference.value, 0.25, 1e-12);  // (0.30 - 0.25) / 0.20
    EXPECT_EQ(list[0].fixes[0].difference.value, 0);
}

TEST(MaterialReport, TablesFiguresAndPageHold) {
    const MaterialJudgment j = crossing(0.08);
    const auto list = material_verdicts(j);
    const Table table = material_table(j, list);
    check_table(table);
    EXPECT_EQ(table.columns[3].id, "flip_u50");
    EXPECT_TRUE(table.groups[0].rows[0][3].is_best());   // the static control at +50
    EXPECT_FALSE(table.groups[0].rows[0][1].is_best());  // affinergb at +5
    EXPECT_FALSE(
        table.groups[0].rows[2][3].is_best());  // true-finish ties with it and is no forecast
    EXPECT_TRUE(table.groups[0].rows[3][2].bounds().has_value());
    EXPECT_FALSE(table.groups[0].rows[3][4].bounds().has_value());  // one block: no interval
    const Table measures = material_measure_table(j, list);
    check_table(measures);
    EXPECT_EQ(measures.groups[0].rows.size(), 10u);
    EXPECT_EQ(measures.groups[0].rows[0][5].kind(), TableCell::Kind::missing);  // LPIPS: n/a
    EXPECT_EQ(measures.note, "LPIPS: this build has none");
    check_table(material_windows(j));
    EXPECT_EQ(material_windows(j).groups[0].rows.size(), 6u * 2 * 5);
    const Report report = material_report(j, list);
    check_report(report);
    EXPECT_NE(page_html(report, {}).find("Do limits on the color help?"), std::string::npos);
}

TEST(MaterialReport, JsonHasNoNumberWhereThereIsNone) {
    const MaterialJudgment j = crossing(0);
    const auto json = json_of(j, material_verdicts(j));
    const auto& at = json["directions"][0]["forecasters"]["affinergb"]["horizons"][1];
    EXPECT_EQ(at["horizon"], 50);
    EXPECT_NEAR(at["flip"].get<double>(), 0.3, 1e-12);
    EXPECT_TRUE(at["lpips"].is_null());
    EXPECT_NEAR(at["gain"]["gain"].get<double>(), -0.5, 1e-12);
    EXPECT_EQ(json["lpips_unavailable"], "this build has none");
    EXPECT_FALSE(
        json["directions"][0]["forecasters"]["persistence"]["horizons"][0].contains("gain"));
}

}  // namespace
}  // namespace verdigris
