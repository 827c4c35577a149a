// SPDX-License-Identifier: MIT
#include "verdigris/pixels/image.h"

#include <gtest/gtest.h>

#include <set>
#include <thread>

#include <array>
#include <atomic>
#include <cstdint>
#include <numeric>
#include <stdexcept>

#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

TEST(Image, IsZeroFilledAndAligned) {
    Image<float> image(7, 3);
    EXPECT_EQ(image.pixel_count(), 21u);
    for (float v : image.pixels()) EXPECT_EQ(v, 0.0f);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(image.row(0)) % 64, 0u);
}

TEST(Image, MovesAndClones) {
    Image<int> image(4, 4);
    image(2, 1) = 5;
    Image<int> copy = image.clone();
    Image<int> moved = std::move(image);
    EXPECT_TRUE(image.empty());  // NOLINT(bugprone-use-after-move): the moved-from state is defined
    EXPECT_EQ(moved(2, 1), 5);
    moved(2, 1) = 6;
    EXPECT_EQ(copy(2, 1), 5);
    static_assert(!std::is_copy_constructible_v<Image<int>>);
}

TEST(Image, RefusesImpossibleExtents) {
    EXPECT_THROW(Image<double>(-1, 2), std::length_error);
    EXPECT_THROW((Image<std::array<char, 4096>>::for_overwrite(2147483647, 2147483647)),
                 std::length_error);
}

TEST(ImageView, WindowSharesPixels) {
    Image<int> image(5, 4);
    ImageView<int> window = image.view().window({1, 2, 3, 2});
    window(0, 0) = 9;
    EXPECT_EQ(image(1, 2), 9);
    EXPECT_EQ(window.stride(), 5);
}

TEST(ParallelRows, VisitsEveryRowOnceWhateverTheRunLength) {
    for (int rows_per_run : {1, 3, 16, 1000}) {
        std::vector<std::atomic<int>> seen(101);
        parallel_rows(101, rows_per_run, [&](RowRun run) {
            for (int y = run.begin; y < run.end; ++y) ++seen[std::size_t(y)];
        });
        for (auto& s : seen) EXPECT_EQ(s.load(), 1);
    }
}

TEST(ParallelRows, PartialSumsDoNotDependOnTheThreadCount) {
    const auto sum = [] {
        auto partials = map_rows<float>(1000, 16, [](RowRun run) {
            float total = 0;
            for (int y = run.begin; y < run.end; ++y) total += 1.0f / float(y + 1);
            return total;
        });
        return std::accumulate(partials.begin(), partials.end(), 0.0f);
    };
    set_thread_count(1);
    const float one = sum();
    set_thread_count(0);
    EXPECT_EQ(one, sum());
}

TEST(ParallelRows, PassesExceptionsOn) {
    EXPECT_THROW(parallel_rows(100, 1,
                               [](RowRun run) {
                                   if (run.index == 50) throw std::runtime_error("row 50");
                               }),
                 std::runtime_error);
}

TEST(OnOneThread, WhatIsInsideStaysOnIt) {
    std::set<std::thread::id> threads;
    on_one_thread(
        [&] { parallel_for(1000, [&](int) { threads.insert(std::this_thread::get_id()); }); });
    EXPECT_EQ(threads.size(), 1u);
}

}  // namespace
}  // namespace verdigris
