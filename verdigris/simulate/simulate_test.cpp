// SPDX-License-Identifier: MIT
#include "verdigris/simulate/simulate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "verdigris/error.h"
#include "verdigris/files/testing.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

SimulationSpec small(const std::string& preset) {
    SimulationSpec spec = preset_spec(preset);
    spec.seed = 4;
    spec.grid = 32;
    spec.frames.width = spec.frames.height = 48;
    spec.frames.count = 60;
    return spec;
}

std::vector<SrgbU8> all_pixels(const SimulationSpec& spec) {
    std::vector<SrgbU8> pixels;
    simulate(spec, {.frame8 =
                        [&](int, ImageView<const SrgbU8> frame) {
                            for (int y = 0; y < frame.height(); ++y)
                                pixels.insert(pixels.end(), frame.row(y),
                                              frame.row(y) + frame.width());
                        },
                    .frame16 = {},
                    .state = {}});
    return pixels;
}

TEST(Simulate, SameSpecSameFramesAtAnyThreadCount) {
    for (const std::string& preset : preset_names()) {
        const SimulationSpec spec = small(preset);
        set_thread_count(1);
        const auto one = all_pixels(spec);
        set_thread_count(3);
        const auto three = all_pixels(spec);
        set_thread_count(0);
        ASSERT_EQ(one.size(), std::size_t(60 * 48 * 48));
        EXPECT_TRUE(one == three) << preset;
        SimulationSpec other = spec;
        other.seed = 5;
        EXPECT_FALSE(all_pixels(other) == one) << preset;
    }
}

TEST(Simulate, StatesComeAtWholeUnitsAndAtTheEnd) {
    std::vector<double> units;
    simulate(small("air"), {.frame8 = {}, .frame16 = {}, .state = [&](const Specimen& s) {
                                units.push_back(s.unit());
                            }});
    ASSERT_EQ(units.size(), 100u);
    for (int i = 0; i < 99; ++i) EXPECT_NEAR(units[std::size_t(i)], i, 1e-6);
    EXPECT_NEAR(units.back(), 98.4, 1e-9);
}

TEST(Simulate, TheNumberOfFramesDoesNotChangeTheSpecimen) {
    Image<double> ends[2];
    for (const int many : {0, 1}) {
        SimulationSpec spec = small("spotted");
        spec.frames.count = many ? 2000 : 7;
        spec.frames.width = spec.frames.height = many ? 16 : 48;
        simulate(spec, {.frame8 = {}, .frame16 = {}, .state = [&](const Specimen& s) {
                            ends[many] = s.film_nm().clone();
                        }});
    }
    EXPECT_TRUE(
        std::equal(ends[0].pixels().begin(), ends[0].pixels().end(), ends[1].pixels().begin()));
}

TEST(Simulate, GainsAreOnePerFrame) {
    const SimulationSpec spec = small("air");
    const SimulationResult result = simulate(spec, {});
    ASSERT_EQ(result.gains.size(), 60u);
    for (int i = 0; i < 60; ++i)
        EXPECT_EQ(result.gains[std::size_t(i)].unit, frame_unit(spec.frames, i));
}

TEST(Simulate, ItStopsWhenAsked) {
    int calls = 0;
    const Error error = error_of([&] {
        simulate(small("uniform"), {},
                 [&](std::string_view, std::int64_t, std::int64_t) { return ++calls < 10; });
    });
    EXPECT_EQ(error.code(), ErrorCode::interrupted);
}

TEST(Simulate, SixteenBitsAreTheSameRecordingAndFiner) {
    SimulationSpec spec = small("uniform");
    const auto eight = all_pixels(spec);
    spec.camera.bits = 16;
    std::size_t at = 0;
    int worst = 0;
    simulate(spec, {.frame8 = {},
                    .frame16 =
                        [&](int, ImageView<const SrgbU16> frame) {
                            for (int y = 0; y < frame.height(); ++y) {
                                for (int x = 0; x < frame.width(); ++x, ++at) {
                                    const int fine = (frame(x, y).g + 128) / 257;
                                    worst = std::max(worst, std::abs(fine - eight[at].g));
                                }
                            }
                        },
                    .state = {}});
    EXPECT_EQ(at, eight.size());
    EXPECT_LE(worst, 1);
}

TEST(Simulate, ReversalTurnsEachChannelAndRedInTheLastContext) {
    SimulationSpec spec = preset_spec("reversal");
    spec.grid = 32;
    Specimen specimen(spec);
    std::vector<std::array<double, 3>> path;
    for (double unit = 0; unit <= 98.41; unit += 0.6) {
        specimen.advance_to(std::min(unit, 98.4));
        std::array<double, 3> mean{};
        const Image<LinearF> colors = specimen.color();
        for (const LinearF c : colors.pixels()) {
            mean[0] += double(c.r), mean[1] += double(c.g), mean[2] += double(c.b);
        }
        path.push_back(mean);
    }
    // Where each channel is darkest: inside the recording, and red inside its last ten units.
    std::array<double, 3> turn{};
    for (std::size_t c = 0; c < 3; ++c) {
        const auto least = std::min_element(path.begin(), path.end(),
                                            [c](auto& a, auto& b) { return a[c] < b[c]; });
        turn[c] = 0.6 * double(least - path.begin());
        EXPECT_GT(turn[c], 2) << c;
        EXPECT_LT(turn[c], 97.5) << c;
    }
    std::printf("measured: reversal: red turns at %.1f units, green at %.1f, blue at %.1f\n",
                turn[0], turn[1], turn[2]);
    EXPECT_GT(turn[0], 89);
    EXPECT_LT(turn[0], 96);
}

}  // namespace
}  // namespace verdigris
