// SPDX-License-Identifier: MIT
// How much of a camera's noise is still there after a recording was written: recording_writer.h and
// docs/BENCHMARKS.md quote what this prints.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <random>
#include <vector>

#include "verdigris/color/convert.h"
#include "verdigris/recording/recording.h"
#include "verdigris/recording/recording_writer.h"
#include "verdigris/recording/testing/scratch.h"
#include "verdigris/recording/testing/written.h"
#include "verdigris/recording/to_srgb.h"

namespace verdigris {
namespace {

using namespace testing;

// How much of a temporal noise of one code value (independent in R, G, B) is still there, and
// how strong what there is.
struct Survival {
    double gain = 0;      // of the planted noise, pixel by pixel
    double strength = 0;  // standard deviation read over the one sent
};
Survival survival(const std::filesystem::path& target, WriterOptions options, float sigma) {
    const int width = options.width = 320, height = options.height = 240, frames = 24;
    std::mt19937 random(7);
    std::normal_distribution<float> noise(0, sigma);
    std::vector<std::vector<double>> planted, sent_luma, read_luma;
    const auto luma = [](double r, double g, double b) {
        return 0.2126 * r + 0.7152 * g + 0.0722 * b;
    };
    const auto writer = write_recording(target, options);
    for (int i = 0; i < frames; ++i) {
        Image<SrgbU8> image(width, height);
        planted.emplace_back();
        sent_luma.emplace_back();
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const float base = 60 + 0.4f * float(x) +
                                   20 * std::sin(float(x) * 0.2f) * std::sin(float(y) * 0.17f);
                const float r = noise(random), g = noise(random), b = noise(random);
                image(x, y) = u8_from_srgb(
                    {(base + r) / 255, (0.8f * base + g) / 255, (0.6f * base + b) / 255});
                const SrgbU8 p = image(x, y);
                planted.back().push_back(luma(r, g, b));
                sent_luma.back().push_back(luma(p.r, p.g, p.b));
            }
        }
        writer->add(image);
    }
    writer->commit();
    const Recording recording = open_recording(target);
    const auto reader = recording.read();
    for (Frame frame; reader->next(frame);) {
        read_luma.emplace_back();
        const auto shown =
            srgb_from_planes(frame.planes, recording.info().format, {0, 0, width, height});
        for (const SrgbF& c : shown.pixels()) read_luma.back().push_back(255 * luma(c.r, c.g, c.b));
    }
    // Only what changes with time is noise.
    const auto product = [&](const auto& a, const auto& b) {
        double sum = 0;
        for (std::size_t k = 0; k < a[0].size(); ++k) {
            double sum_a = 0, sum_b = 0, sum_ab = 0;
            for (std::size_t i = 0; i < a.size(); ++i) {
                sum_a += a[i][k];
                sum_b += b[i][k];
                sum_ab += a[i][k] * b[i][k];
            }
            sum += sum_ab - sum_a * sum_b / double(a.size());
        }
        return sum;
    };
    return {product(planted, read_luma) / product(planted, planted),
            std::sqrt(product(read_luma, read_luma) / product(sent_luma, sent_luma))};
}

TEST(WriterNoise, HowMuchSurvives) {
    NEEDS_X264();
    const Scratch scratch;
    const auto measure = [&](const char* name, double crf, double fps, float sigma) {
        const Survival s =
            survival(scratch / name, {.fps = fps, .replace = true, .crf = crf}, sigma);
        std::printf(
            "%s, crf %2.0f, %2.0f fps, noise of %.0f: %5.1f KB a frame, %3.0f %% of it left, "
            "strength x %.2f\n",
            name, crf, fps, double(sigma),
            double(std::filesystem::file_size(scratch / name)) / 24e3, 100 * s.gain, s.strength);
        return s;
    };
    const Survival lossless = measure("a.mkv", 0, 24, 1);
    EXPECT_NEAR(lossless.gain, 1, 0.01);
    EXPECT_NEAR(lossless.strength, 1, 1e-4);
    EXPECT_GT(measure("a.mp4", 0, 24, 1).gain, 0.95);
    EXPECT_GT(measure("a.mp4", 4, 24, 1).gain, 0.7);
    EXPECT_GT(measure("a.mp4", 8, 24, 1).gain, 0.5);
    const Survival usual = measure("a.mp4", 12, 24, 1);
    EXPECT_GT(usual.gain, 0.2);
    EXPECT_NEAR(usual.strength, 1, 0.2);
    EXPECT_NEAR(measure("a.mp4", 12, 60, 1).gain, usual.gain, 0.01);
    EXPECT_GT(measure("a.mp4", 12, 24, 3).gain, 0.5);
    EXPECT_LT(measure("a.mp4", 24, 24, 1).gain, 0.1);
}

}  // namespace
}  // namespace verdigris
