// SPDX-License-Identifier: MIT
#include "verdigris/results/evaluation_json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "verdigris/error.h"
#include "verdigris/evaluate/testing.h"
#include "verdigris/files/testing.h"
#include "verdigris/results/testing.h"

namespace verdigris {
namespace {

TEST(EvaluationJson, SaysForEachForecasterWhatWasMeasured) {
    const Evaluation e = testing::small_evaluation();
    const auto json = json_of(e, verdicts(e));
    ASSERT_EQ(json["directions"].size(), 2u);
    const auto& direction = json["directions"][0];
    EXPECT_EQ(direction["held_out"], "first");
    EXPECT_EQ(direction["windows"], e.directions[0].starts.size());
    const auto& affine = direction["forecasters"]["affinergb"];
    EXPECT_EQ(affine["error"]["per_horizon"].size(), 4u);
    EXPECT_DOUBLE_EQ(affine["gain"].get<double>(),
                     gain(e.directions[0], e.directions[0].entrants[1]));
    // A planted affine drift is followed nearly exactly.
    EXPECT_GT(affine["gain"].get<double>(), 0.99);
    EXPECT_TRUE(direction["forecasters"].contains("persistence"));
    const std::string verdict = affine["verdict"];
    EXPECT_NE(verdict.find("better than holding still"), std::string::npos) << verdict;
}

TEST(EvaluationJson, TheRecordSurvivesItsJson) {
    const Evaluation e = testing::small_evaluation();
    const auto json = json_of(e.record);
    const EvaluationRecord back = record_from(json, "record.json");
    EXPECT_EQ(json_of(back).dump(), json.dump());
    EXPECT_TRUE(audit(back).empty() || audit(back).front().severity != Severity::refusal);
}

TEST(EvaluationJson, APlantedLeakIsFoundInWhatWasReadBack) {
    auto json = json_of(testing::small_evaluation().record);
    // The held-out recording had a part in training.
    json["directions"][0]["uses"].push_back({{"role", "train"},
                                             {"recording", "first"},
                                             {"allowed", {0, 40}},
                                             {"starts", {0}},
                                             {"samples", nlohmann::ordered_json::array()},
                                             {"planned", 0},
                                             {"skipped", 0}});
    const Statuses findings = audit(record_from(json, "record.json"));
    ASSERT_FALSE(findings.empty());
    EXPECT_TRUE(std::any_of(findings.begin(), findings.end(),
                            [](const Status& s) { return s.id == "test_recording_in_training"; }));
}

TEST(EvaluationJson, WhatIsNoRecordIsRefused) {
    for (const char* text : {"{}", "[]", "3", R"({"format":"verdigris-evaluation-record/1"})",
                             R"({"format":"verdigris-evaluation-record/9"})"}) {
        const Error e =
            error_of([&] { record_from(nlohmann::ordered_json::parse(text), "record.json"); });
        EXPECT_EQ(e.code(), ErrorCode::bad_input) << text;
        EXPECT_EQ(e.where(), "record.json");
    }
}

}  // namespace
}  // namespace verdigris
