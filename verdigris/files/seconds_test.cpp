// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>

#include "verdigris/files/csv.h"
#include "verdigris/files/testing.h"

namespace verdigris {
namespace {

TEST(SecondsFromText, PlainNumbers) {
    EXPECT_EQ(seconds_from_text("0"), 0);
    EXPECT_EQ(seconds_from_text(" 12.5 "), 12.5);
    EXPECT_EQ(seconds_from_text("-3"), -3);
    EXPECT_EQ(seconds_from_text("+1e3"), 1000);
    EXPECT_EQ(seconds_from_text("20260301"), 20260301);
}

// Known points: the epoch, the billionth second, the leap day of 2000, the day before the epoch,
// the last second before 2038 overflows 32 bits.
TEST(SecondsFromText, PublishedPointsInTime) {
    EXPECT_EQ(seconds_from_text("1970-01-01T00:00:00Z"), 0);
    EXPECT_EQ(seconds_from_text("2001-09-09T01:46:40Z"), 1e9);
    EXPECT_EQ(seconds_from_text("2000-02-29"), 951782400);
    EXPECT_EQ(seconds_from_text("1969-12-31T23:59:59Z"), -1);
    EXPECT_EQ(seconds_from_text("2038-01-19T03:14:07Z"), 2147483647);
    EXPECT_EQ(seconds_from_text("1900-03-01"), -2203891200);  // 1900 was no leap year
    EXPECT_EQ(seconds_from_text("0001-01-01"), -62135596800);
}

TEST(SecondsFromText, OneInstantInManySpellings) {
    const double noon = seconds_from_text("2026-03-01T12:00:00Z");
    for (const std::string text :
         {"2026-03-01 12:00:00", "2026:03:01 12:00:00", "2026-03-01T12:00", "2026-03-01t12:00:00z",
          "2026-03-01T14:00:00+02:00", "2026-03-01T14:00:00+0200", "2026-03-01T14:00:00+02",
          "2026-03-01 14:00:00 +02:00", "2026-03-01T08:30:00-03:30", "2026-03-02T02:00:00+14:00",
          "2026-03-01T11:59:60Z", "\t2026-03-01T12:00:00.000Z "}) {
        EXPECT_EQ(seconds_from_text(text), noon) << text;
    }
    EXPECT_DOUBLE_EQ(seconds_from_text("2026-03-01T12:00:00.5+00:00"), noon + 0.5);
    EXPECT_DOUBLE_EQ(seconds_from_text("2026-03-01T12:00:00,25"), noon + 0.25);
    EXPECT_NEAR(seconds_from_text("2026-03-01T12:00:00." + std::string(400, '3')), noon + 1.0 / 3,
                1e-6);
}

TEST(SecondsFromText, RefusesNonsense) {
    for (const std::string text : {"",
                                   " ",
                                   "yesterday",
                                   "nan",
                                   "inf",
                                   "1e999",
                                   "12s",
                                   "1,5",
                                   "2026-02-29",
                                   "2026-13-01",
                                   "2026-00-01",
                                   "2026-03-00",
                                   "2026-03-32",
                                   "2026-3-1",
                                   "26-03-01",
                                   "2026-03:01",
                                   "2026-03-01T",
                                   "2026-03-01T12",
                                   "2026-03-01T24:00:00",
                                   "2026-03-01T12:60:00",
                                   "2026-03-01T12:00:61",
                                   "2026-03-01T12:00:00.",
                                   "2026-03-01T12:00:00+",
                                   "2026/03/01",
                                   "2026-03-01T12:00:00+2",
                                   "2026-03-01T12:00:00+15:00",
                                   "2026-03-01T12:00:00+02:60",
                                   "2026-03-01T12:00:00+02:",
                                   "2026-03-01T12:00:00Zx",
                                   "2026-03-01T12:00:00Z Z",
                                   "0000:00:00 00:00:00",
                                   "    :  :     :  :  "}) {
        const Error error = error_of([&] { seconds_from_text(text); });
        EXPECT_EQ(error.code(), ErrorCode::bad_input) << text;
        EXPECT_NE(error.sentence().find("'" + text + "'"), std::string::npos) << text;
    }
}

}  // namespace
}  // namespace verdigris
