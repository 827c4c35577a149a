// SPDX-License-Identifier: MIT
#include "verdigris/simulate/simulate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "verdigris/color/convert.h"
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

// The same plate on another day: its pattern stays, the noise and the light do not.
TEST(Simulate, TheSpecimenHasASeedOfItsOwn) {
    for (const std::string& preset : preset_names()) {
        const SimulationSpec first = small(preset);
        SimulationSpec again = first;
        again.seed = 9;
        again.specimen_seed = first.seed;
        const CellGrid grid = specimen_grid(first);
        const auto pattern = [&](const SimulationSpec& spec) {
            const Image<double> field = susceptibility_field(spec, grid, {});
            return std::vector<double>(field.pixels().begin(), field.pixels().end());
        };
        EXPECT_EQ(pattern(again), pattern(first)) << preset;
        EXPECT_FALSE(all_pixels(again) == all_pixels(first)) << preset;
        again.specimen_seed = 0;
        EXPECT_NE(pattern(again), pattern(first)) << preset;
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

TEST(Simulate, AFrameIsTheSceneUnderItsGains) {
    // Everything that the camera does but noise; then undone with the truth.
    SimulationSpec spec = small("air");
    spec.camera.bits = 16;
    spec.camera.shot_noise = spec.camera.read_noise = 0;
    spec.camera.flicker = 0.03;
    spec.camera.drift_gain = {1.04, 0.97, 1};
    spec.camera.drift_offset = {0, 0.02, -0.01};
    std::vector<Image<SrgbU16>> frames;
    const SimulationResult result =
        simulate(spec, {.frame8 = {},
                        .frame16 =
                            [&](int, ImageView<const SrgbU16> view) {
                                Image<SrgbU16> copy(view.width(), view.height());
                                for (int y = 0; y < view.height(); ++y)
                                    std::copy(view.row(y), view.row(y) + view.width(), copy.row(y));
                                frames.push_back(std::move(copy));
                            },
                        .state = {}});
    Specimen specimen(spec);
    const Scene scene(spec, specimen.grid());
    const Mask backdrop = scene.reference();
    Image<LinearF> light;
    scene.compose(specimen.color(), light);  // the backdrop never changes
    int checked = 0;
    for (const std::size_t i : {std::size_t(0), std::size_t(31), std::size_t(59)}) {
        const FrameGains& g = result.gains[i];
        for (int y = 0; y < 48; y += 5) {
            for (int x = 0; x < 48; x += 5) {
                if (!backdrop(x, y)) continue;
                const double turns = spec.camera.flicker_bands * y / 48 + g.flicker_phase;
                const double band = 1 + 0.03 * std::sin(2 * std::numbers::pi * turns);
                const double linear = double(light(x, y).g) * g.linear[1] * band;
                const double encoded = double(srgb_from_linear(float(linear))) * g.encoded_gain[1] +
                                       g.encoded_offset[1];
                EXPECT_NEAR(frames[i](x, y).g / 65535.0, encoded, 2e-5);
                ++checked;
            }
        }
        EXPECT_NEAR(g.linear[2],
                    spec.camera.exposure * g.exposure * g.light * g.jitter * g.balance[2], 1e-12);
    }
    EXPECT_GT(checked, 20);
}

TEST(Simulate, TheLastFrameShowsTheEndEvenOffTheGridOfTenths) {
    SimulationSpec spec = small("uniform");
    spec.frames.units = 0.15;
    spec.frames.count = 100;
    spec.oxide.growth.parabolic_rate = 2000;  // visible within so little
    spec.camera = CameraSpec{.bits = 16};
    Image<SrgbU16> last(48, 48);
    std::vector<double> units;
    simulate(spec, {.frame8 = {},
                    .frame16 =
                        [&](int, ImageView<const SrgbU16> view) {
                            for (int y = 0; y < 48; ++y)
                                std::copy(view.row(y), view.row(y) + 48, last.row(y));
                        },
                    .state = [&](const Specimen& s) { units.push_back(s.unit()); }});
    EXPECT_EQ(units, (std::vector<double>{0, 0.15}));
    Specimen specimen(spec);
    specimen.advance_to(0.15);
    const Scene scene(spec, specimen.grid());
    Image<LinearF> light;
    scene.compose(specimen.color(), light);
    // The last frame is taken half a frame before the end.
    EXPECT_NEAR(last(24, 24).b / 65535.0,
                double(srgb_from_linear(float(double(light(24, 24).b) * spec.camera.exposure))),
                0.004);
}

TEST(Simulate, ItStopsBetweenFramesToo) {
    SimulationSpec spec = small("spotted");
    spec.frames.count = 2;
    int calls = 0;
    const Error error = error_of([&] {
        simulate(spec, {},
                 [&](std::string_view, std::int64_t, std::int64_t) { return ++calls < 50; });
    });
    EXPECT_EQ(error.code(), ErrorCode::interrupted);
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
