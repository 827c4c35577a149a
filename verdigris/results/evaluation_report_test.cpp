// SPDX-License-Identifier: MIT
#include "verdigris/results/evaluation_report.h"

#include <gtest/gtest.h>

#include <cmath>

#include "verdigris/error.h"
#include "verdigris/files/testing.h"
#include "verdigris/results/resolved.h"
#include "verdigris/results/testing.h"

namespace verdigris {
namespace {

TEST(EvaluationReport, TablesHoldTheNumbersOfTheEvaluation) {
    const Evaluation e = testing::small_evaluation();
    const Table table = error_table(e);
    check_table(table);
    ASSERT_EQ(table.groups.size(), 2u);
    ASSERT_EQ(table.groups[0].rows.size(), 2u);
    const auto column = [&](const std::string& id) {
        for (std::size_t i = 0; i < table.columns.size(); ++i)
            if (table.columns[i].id == id) return i;
        ADD_FAILURE() << id;
        return std::size_t(0);
    };
    const Direction& d = e.directions[1];
    const TableRow& row = table.groups[1].rows[1];
    EXPECT_EQ(row[0].words(), "affinergb");
    EXPECT_EQ(row[column("mean")].value(), overall_mean(d.entrants[1].foreground));
    EXPECT_EQ(row[column("t4")].value(), horizon_means(d.entrants[1].foreground)[3]);
    EXPECT_EQ(row[column("gain")].value(), gain(d, d.entrants[1]));
    EXPECT_TRUE(row[column("mean")].is_best());
    EXPECT_FALSE(table.groups[1].rows[0][column("mean")].is_best());
}

TEST(EvaluationReport, EveryErrorIsInTheWindowTable) {
    const Evaluation e = testing::small_evaluation();
    const Table table = window_errors(e);
    std::size_t expected = 0;
    for (const Direction& d : e.directions) expected += d.starts.size() * 4 * d.entrants.size();
    ASSERT_EQ(table.groups[0].rows.size(), expected);
    // The mean follows from them.
    double sum = 0, count = 0;
    for (const TableRow& row : table.groups[0].rows) {
        if (row[0].words() != e.directions[0].label() || row[1].words() != "affinergb") continue;
        sum += row[4].value(), ++count;
    }
    EXPECT_NEAR(sum / count, overall_mean(e.directions[0].entrants[1].foreground),
                1e-12 * sum / count);
}

TEST(EvaluationReport, VerdictsSayWhatTheNumbersSay) {
    Evaluation e = testing::small_evaluation();
    for (const DirectionVerdict& d : verdicts(e)) {
        for (const EntrantVerdict& v : d.entrants) {
            EXPECT_NEAR(v.gain, 1 - v.error / v.persistence, 1e-12);
            EXPECT_NE(v.sentence.find("better than holding still"), std::string::npos)
                << v.sentence;
        }
    }
    // The same errors the other way round: what was better is now worse.
    for (Direction& d : e.directions) std::swap(d.entrants[0].foreground, d.entrants[1].foreground);
    for (const DirectionVerdict& d : verdicts(e)) {
        for (const EntrantVerdict& v : d.entrants) {
            EXPECT_LT(v.gain, 0);
            EXPECT_NE(v.sentence.find("worse than holding still"), std::string::npos) << v.sentence;
            EXPECT_EQ(v.sentence.find("better than"), std::string::npos) << v.sentence;
        }
    }
}

TEST(EvaluationReport, AnIntervalAcrossZeroIsNotCalledSettled) {
    Evaluation e = testing::small_evaluation();
    // A model that alternates between worse and better than persistence from block to block.
    Direction& d = e.directions[0];
    const int span = e.protocol.span();
    for (int w = 0; w < d.entrants[1].foreground.windows; ++w) {
        for (int k = 0; k < 4; ++k) {
            const bool odd = (d.starts[std::size_t(w)] - d.starts.front()) / span % 2 == 1;
            d.entrants[1].foreground.at(w, k) =
                d.entrants[0].foreground.at(w, k) * (odd ? 1.5 : 0.6);
        }
    }
    const EntrantVerdict v = verdicts(e)[0].entrants[0];
    ASSERT_GE(v.blocks.size(), 5u);
    ASSERT_TRUE(v.block.has_value());
    EXPECT_LT(v.block->low, 0);
    EXPECT_GT(v.block->high, 0);
    EXPECT_NE(v.sentence.find("includes zero, so the sign is not settled"), std::string::npos)
        << v.sentence;
}

// Blocks of one span each, in which the model's error is persistence's times a factor.
EntrantVerdict verdict_of(const std::vector<double>& factors) {
    Evaluation e = testing::small_evaluation();
    e.directions.resize(1);
    Direction& d = e.directions[0];
    const int span = e.protocol.span();
    d.starts.clear();
    EntrantScores &held = d.entrants[0], &model = d.entrants[1];
    held.delta_e = model.delta_e = {};
    held.foreground = model.foreground = ErrorTable(int(factors.size()) * span, 4);
    for (int w = 0; w < held.foreground.windows; ++w) {
        d.starts.push_back(w);
        for (int k = 0; k < 4; ++k) {
            held.foreground.at(w, k) = 1;
            model.foreground.at(w, k) = factors[std::size_t(w / span)];
        }
    }
    return verdicts(e)[0].entrants[0];
}

TEST(EvaluationReport, WhatIsSaidAgreesWithWhatIsPrinted) {
    // The low end is +0.02 %, which prints as 0.0 %: nobody could see that it excludes zero.
    const EntrantVerdict v = verdict_of({0.9998, 0.9998, 0.9998, 0.9998, 0.9998, 0.5});
    ASSERT_TRUE(v.block);
    EXPECT_GT(v.block->low, 0);
    EXPECT_LT(v.block->low, 5e-4);
    EXPECT_NE(v.sentence.find("the block interval 0.0 % to +"), std::string::npos) << v.sentence;
    EXPECT_NE(v.sentence.find("includes zero"), std::string::npos) << v.sentence;
    EXPECT_FALSE(sign_is_settled({v.gain, 6, v.block, v.blocks}));
    // From below it is no "-0.0 %" either.
    const EntrantVerdict w = verdict_of({1.0002, 1.0002, 1.0002, 1.0002, 1.0002, 1.5});
    EXPECT_NE(w.sentence.find(" to 0.0 % includes zero"), std::string::npos) << w.sentence;
    // A tenth of a percent is printed, and settles.
    EXPECT_NE(verdict_of({0.999, 0.999, 0.999, 0.999, 0.999, 0.5}).sentence.find("excludes zero"),
              std::string::npos);
}

TEST(EvaluationReport, EqualBlocksAreNoLosses) {
    const EntrantVerdict v = verdict_of({1, 1, 0.5, 0.6, 0.7, 1.2});
    EXPECT_NE(v.sentence.find("better in 3 of 6 blocks and equal in 2;"), std::string::npos)
        << v.sentence;
    EXPECT_NE(verdict_of({0.5, 0.5, 0.5, 0.5, 0.5, 2}).sentence.find("in 5 of 6 blocks;"),
              std::string::npos);
}

TEST(EvaluationReport, HoldingStillAloneSaysWhatThereIsToImproveOn) {
    Evaluation e = testing::small_evaluation();
    for (Direction& d : e.directions) d.entrants.resize(1);
    const auto list = verdicts(e);
    const auto sentences = verdict_sentences(list);
    ASSERT_EQ(sentences.size(), 2u);
    EXPECT_NE(sentences[0].find("only holding still: its foreground MSE over"), std::string::npos)
        << sentences[0];
    const Report report = evaluation_report(e, list);
    check_report(report);
    for (const ReportSection& s : report.sections) {
        EXPECT_NE(s.id, "how-sure") << "there is no gain to be sure of";
        for (const ReportBlock& block : s.blocks) {
            const auto* table = std::get_if<Table>(&block);
            if (table) {
                EXPECT_GT(table->groups.size(), 0u) << table->id;
            }
        }
    }
}

TEST(EvaluationReport, PairsAreDifferencesOfGains) {
    Evaluation e = testing::small_evaluation();
    Direction& d = e.directions[0];
    EntrantScores worse = d.entrants[1];
    worse.name = "worse";
    for (double& v : worse.foreground.values) v *= 3;
    d.entrants.push_back(worse);
    const DirectionVerdict v = verdicts(e)[0];
    ASSERT_EQ(v.pairs.size(), 1u);
    EXPECT_EQ(v.pairs[0].second, "worse");
    EXPECT_NEAR(v.pairs[0].difference, v.entrants[0].gain - v.entrants[1].gain, 1e-12);
    ASSERT_TRUE(v.pairs[0].block.has_value());
    EXPECT_GT(v.pairs[0].block->low, 0) << "three times the error in every window";
    check_table(pair_table({v}));
}

TEST(EvaluationReport, NamedBlocksGetGainsOfTheirOwn) {
    const Evaluation e = testing::small_evaluation();
    const auto list = verdicts(e, {{"first", "early", 0, 8}, {"first", "empty", 500, 501}});
    const auto& named = list[0].entrants[0].named;
    ASSERT_EQ(named.size(), 2u);
    double over = 0, under = 0;
    int windows = 0;
    const Direction& d = e.directions[0];
    const auto p = window_means(d.entrants[0].foreground),
               m = window_means(d.entrants[1].foreground);
    for (std::size_t i = 0; i < d.starts.size(); ++i) {
        if (d.starts[i] >= 80) continue;
        over += p[i] - m[i], under += p[i], ++windows;
    }
    EXPECT_EQ(named[0].windows, windows);
    EXPECT_NEAR(named[0].gain, over / under, 1e-12);
    EXPECT_TRUE(std::isnan(named[1].gain));
    EXPECT_TRUE(list[1].entrants[0].named.empty());
    EXPECT_EQ(error_of([&] { verdicts(e, {{"third", "x", 0, 1}}); }).code(), ErrorCode::usage);
}

TEST(EvaluationReport, ThePageCanBeWritten) {
    const Evaluation e = testing::small_evaluation();
    const Report report = evaluation_report(e, verdicts(e));
    check_report(report);
    PageOptions still;
    still.interactive = false;  // the scripts know calendars, the report does not
    const std::string page = page_html(report, still);
    EXPECT_NE(page.find("holding still"), std::string::npos);
    EXPECT_EQ(page.find("year"), std::string::npos) << "calendar time appears nowhere";
}

}  // namespace
}  // namespace verdigris
