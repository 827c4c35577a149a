// SPDX-License-Identifier: MIT
#include "verdigris/report/child_process.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string>

#include "verdigris/files/testing.h"

namespace verdigris {
namespace {

using namespace std::chrono_literals;

TEST(ChildProcess, GivesBackWhatItIsGiven) {
    // More than any pipe holds, in both directions at once.
    const std::string input(3 << 20, 'x');
    const ProcessResult result = run_process({find_program("cat"), {}, input});
    EXPECT_EQ(result.exit_status, 0);
    EXPECT_EQ(result.output, input);
    EXPECT_EQ(result.errors, "");
}

TEST(ChildProcess, ArgumentsPassNoShell) {
    const ProcessResult result =
        run_process({find_program("printf"), {"%s|%s", "$(id) `id` ; *", "'\"\\"}, ""});
    EXPECT_EQ(result.output, "$(id) `id` ; *|'\"\\");
}

TEST(ChildProcess, StatusAndErrorsAreResults) {
    const ProcessResult result =
        run_process({find_program("sh"), {"-c", "echo wrong >&2; exit 7"}, ""});
    EXPECT_EQ(result.exit_status, 7);
    EXPECT_EQ(result.errors, "wrong\n");
}

TEST(ChildProcess, RunsInAFixedLocale) {
    ::setenv("LC_ALL", "de_DE.UTF-8", 1);
    const ProcessResult result = run_process({find_program("sh"), {"-c", "echo $LC_ALL"}, ""});
    ::unsetenv("LC_ALL");
    EXPECT_EQ(result.output, "C.UTF-8\n");
}

TEST(ChildProcess, IsStoppedWhenItTakesTooLong) {
    const auto start = std::chrono::steady_clock::now();
    const Error error = error_of([] { run_process({find_program("sleep"), {"30"}, "", 100ms}); });
    EXPECT_EQ(error.code(), ErrorCode::failed);
    EXPECT_NE(error.sentence().find("0.100 seconds"), std::string::npos) << error.what();
    EXPECT_LT(std::chrono::steady_clock::now() - start, 20s);
}

TEST(ChildProcess, SaysWhatWentWrong) {
    const Error missing = error_of([] { run_process({"/nowhere/gnuplot", {}, ""}); });
    EXPECT_EQ(std::string(missing.what()).find("gnuplot: cannot be started"), 0u) << missing.what();
    const Error killed = error_of([] {
        run_process({find_program("sh"), {"-c", "kill -9 $$"}, ""});
    });
    EXPECT_NE(killed.sentence().find("signal 9"), std::string::npos);
    EXPECT_TRUE(find_program("no-such-program-anywhere").empty());
}

}  // namespace
}  // namespace verdigris
