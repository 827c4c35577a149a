// SPDX-License-Identifier: MIT
#include "verdigris/results/characterization_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "verdigris/error.h"
#include "verdigris/files/testing.h"
#include "verdigris/results/testing.h"

namespace verdigris {
namespace {

struct Made {
    EvaluationProtocol protocol = short_recording_protocol(10);
    Characterization table;
    Evaluation far;
};

/// Two recordings with a planted affine drift that mixes channels.
const Made& made() {
    static const Made result = [] {
        Made m;
        m.protocol.horizons = 4;
        m.protocol.max_windows = 12;
        m.protocol.delta_e = false;
        std::vector<Observation> list;
        list.push_back(testing::affine_recording("first", 300, 2e-5, 1, 1));
        list.push_back(testing::affine_recording("second", 300, 2e-5, 0.8, 2));
        CharacterizeOptions options;
        options.contexts = {3, 5};
        options.ridges = {0, 30};
        options.windows = 12;
        m.table = characterize(m.protocol, list, options);
        m.far = long_horizons(m.protocol, list, 20);
        return m;
    }();
    return result;
}

bool said(const CharacterizationVerdict& v, const std::string& direction, const std::string& part) {
    return std::ranges::any_of(v.sentences, [&](const std::string& s) {
        return s.starts_with(direction) && s.find(part) != std::string::npos;
    });
}

TEST(CharacterizationReport, TheTableHoldsTheNumbers) {
    const auto verdict = characterization_verdict(made().protocol, made().table, made().far);
    const Table table = characterization_table(made().table, verdict);
    check_table(table);
    ASSERT_EQ(table.groups.size(), 6u);
    const TableRow& five = table.groups[0].rows[1];
    EXPECT_EQ(five[0].words(), "n = 5 \u2020");
    EXPECT_EQ(five[1].value(), made().table.rows[1].cells[0].error);
    EXPECT_NEAR(five[2].value(), made().table.rows[1].cells[0].gain, 1e-12);
    EXPECT_FALSE(five[2].bounds().has_value()) << "of so few blocks an interval says nothing";
    EXPECT_EQ(table.groups[0].rows[3][1].value(), made().table.rows[1].cells[0].persistence);
    EXPECT_EQ(table.groups[3].title, "only the specimen moves and counts; fitted to all pixels");
    EXPECT_EQ(table.groups[3].rows.size(), 4u);
    // The table follows from the windows.
    const Table windows = characterization_windows(made().table);
    double error = 0, still = 0;
    for (const TableRow& row : windows.groups[0].rows) {
        if (row[1].words() != "n = 3" || row[2].words() != made().table.directions[1]) continue;
        error += row[4].value(), still += row[5].value();
    }
    EXPECT_NEAR(1 - error / still, table.groups[0].rows[0][4].value(), 1e-12);
}

TEST(CharacterizationReport, SentencesFollowThePlantedTruth) {
    const auto verdict = characterization_verdict(made().protocol, made().table, made().far);
    for (const std::string& direction : made().table.directions) {
        EXPECT_TRUE(said(verdict, direction, "fitted to all pixels, the full matrix wins"));
        EXPECT_TRUE(
            said(verdict, direction, "fitted to the specimen's pixels only, the full matrix wins"));
        EXPECT_TRUE(said(verdict, direction, "order 2 does not pay"));
        EXPECT_TRUE(said(verdict, direction, "the unclamped forecast stays better"));
    }
}

TEST(CharacterizationReport, SentencesTurnWithTheNumbers) {
    Characterization table = made().table;
    for (CharacterizationRow& row : table.rows) {
        CharacterizationCell& cell = row.cells[0];
        const bool spoiled = (row.block == "fit-pixels" && row.setting.starts_with("full")) ||
                             row.setting == "n = 5";
        for (std::size_t i = 0; spoiled && i < cell.ratios.over.size(); ++i)
            cell.ratios.over[i] = -20 * cell.ratios.under[i];
        if (!spoiled) continue;
        cell.gain = -20;
        cell.error = 21 * cell.persistence;
    }
    const auto verdict = characterization_verdict(made().protocol, table, made().far);
    const std::string& first = table.directions[0];
    EXPECT_TRUE(said(verdict, first, "the specimen's pixels only, the full matrix does not win"));
    EXPECT_TRUE(said(verdict, first, "of the contexts tried n = 3 is best"));
    EXPECT_TRUE(
        said(verdict, table.directions[1], "the specimen's pixels only, the full matrix wins"));
}

TEST(CharacterizationReport, CrossingsAreWhereTheCurvesCross) {
    Evaluation far = made().far;
    Direction& d = far.directions[0];
    auto& unclamped = const_cast<EntrantScores&>(d.entrant("affinergb unclamped")).foreground;
    for (int w = 0; w < unclamped.windows; ++w)
        for (int k = 0; k < unclamped.horizons; ++k)
            unclamped.at(w, k) = d.persistence().foreground.at(w, k) * (k < 7 ? 0.5 : 3.0);
    const auto verdict = characterization_verdict(made().protocol, made().table, far);
    EXPECT_EQ(verdict.far[0].crossings, std::vector<int>{8});
    EXPECT_TRUE(said(verdict, made().table.directions[0],
                     "better than holding still up to t+7 and worse from t+8 on (with 3 times the "
                     "error of holding still at t+20)"));
    EXPECT_TRUE(verdict.far[1].crossings.empty());
}

TEST(CharacterizationReport, ThePageAndTheJsonCanBeWritten) {
    const auto verdict = characterization_verdict(made().protocol, made().table, made().far);
    const std::string page = page_html(
        characterization_report(made().protocol, made().table, verdict), {false, {}, false});
    EXPECT_NE(page.find("Error by horizon"), std::string::npos);
    EXPECT_EQ(page.find("year"), std::string::npos) << "calendar time appears nowhere";
    const auto json = json_of(made().protocol, made().table, verdict);
    EXPECT_EQ(json["rows"].size(), made().table.rows.size());
    EXPECT_EQ(json["long_horizons"][made().table.directions[0]]["unclamped"].size(), 20u);
}

TEST(CharacterizationReport, DifferencesArePairedOrRefused) {
    const WindowRatios a{{0, 1}, {1, 2}, {4, 4}}, b{{0, 1}, {1, 1}, {4, 4}},
        c{{0, 2}, {1, 1}, {4, 4}};
    EXPECT_EQ(paired_difference(a, b).over, (std::vector<double>{0, 1}));
    EXPECT_EQ(error_of([&] { paired_difference(a, c); }).code(), ErrorCode::usage);
}

TEST(CharacterizationReport, FewBlocksAreNotCalledSure) {
    Resolved r;
    r.value = 0.2;
    r.block = Interval{0.1, 0.3};
    r.blocks.resize(3);
    EXPECT_FALSE(sign_is_settled(r));
    EXPECT_EQ(how_sure(r), "3 blocks are too few to say how sure that is");
    EXPECT_FALSE(cell_of(r).bounds().has_value());
    r.blocks.resize(6);
    EXPECT_TRUE(sign_is_settled(r));
    EXPECT_TRUE(cell_of(r).bounds().has_value());
    r.block->low = -0.1;
    EXPECT_FALSE(sign_is_settled(r));
}

}  // namespace
}  // namespace verdigris
