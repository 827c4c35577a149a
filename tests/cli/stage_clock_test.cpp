// SPDX-License-Identifier: MIT
#include "../../apps/cli/stage_clock.h"

#include <gtest/gtest.h>

namespace verdigris::cli {
namespace {

TEST(StageClock, IsTheRuleOfThree) {
    StageClock clock;
    EXPECT_FALSE(clock.remaining("decode", 0, 10, 100));
    EXPECT_DOUBLE_EQ(*clock.remaining("decode", 2, 10, 104), 16);
    EXPECT_DOUBLE_EQ(*clock.remaining("decode", 10, 10, 120), 0);
    EXPECT_FALSE(clock.remaining("look", 5, 0, 130));
    EXPECT_FALSE(clock.remaining("look", 6, 0, 131));
}

// Epochs: 10 steps of a second, then 5 s of validation. Half of the way is half of the time.
TEST(StageClock, AStageThatIsInterruptedByAnotherGoesOn) {
    StageClock clock;
    double now = 0;
    for (int epoch = 0; epoch < 2; ++epoch) {
        for (int i = 0; i < 10; ++i) clock.remaining("train", epoch * 10 + i, 40, now++);
        for (int i = 0; i < 5; ++i) clock.remaining("validate", i, 5, now++);
    }
    EXPECT_NEAR(*clock.remaining("train", 20, 40, now), 30, 1e-9);
    EXPECT_FALSE(clock.remaining("validate", 0, 5, now));  // a new one, not a long one
    EXPECT_DOUBLE_EQ(*clock.remaining("validate", 1, 5, now + 1), 4);
}

// 900 of 1000 steps were done before we came.
TEST(StageClock, WhatWasDoneBeforeTookNoTime) {
    StageClock clock;
    EXPECT_FALSE(clock.remaining("train", 900, 1000, 0));
    EXPECT_DOUBLE_EQ(*clock.remaining("train", 910, 1000, 20), 180);
}

TEST(StageClock, AnotherTotalIsAnotherWork) {
    StageClock clock;
    clock.remaining("observe", 0, 10, 0);
    clock.remaining("observe", 5, 10, 50);
    EXPECT_FALSE(clock.remaining("observe", 6, 100, 60));
}

}  // namespace
}  // namespace verdigris::cli
