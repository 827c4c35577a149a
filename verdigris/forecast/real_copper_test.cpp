// SPDX-License-Identifier: MIT
// The choice on real frames: a patinating plate with a glint, strong early change and much noise,
// where a drift that is always followed does harm. Skipped where the shared data are absent.
#include <gtest/gtest.h>

#include <filesystem>
#include <variant>

#include "verdigris/color/convert.h"
#include "verdigris/files/image_file.h"
#include "verdigris/forecast/choose.h"
#include "verdigris/forecast/testing.h"

namespace verdigris {
namespace {

namespace fs = std::filesystem;

/// Every second pixel of frame `index`, averaged 2 x 2.
Image<SrgbF> frame(const fs::path& folder, int index) {
    char name[16];
    std::snprintf(name, sizeof name, "%04d.png", index);
    const ImageFile file = read_image(folder / name);
    const auto& full = std::get<Image<SrgbU8>>(file.pixels);
    return paint(full.width() / 2, full.height() / 2, [&](int x, int y) {
        SrgbF sum;
        for (int k = 0; k < 4; ++k) {
            const SrgbF c = srgb_from_u8(full(2 * x + k % 2, 2 * y + k / 2));
            sum = {sum.r + c.r / 4, sum.g + c.g / 4, sum.b + c.b / 4};
        }
        return sum;
    });
}

double squared_error(const Image<SrgbF>& a, const Image<SrgbF>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixel_count(); ++i) {
        const SrgbF p = a.pixels()[i], q = b.pixels()[i];
        sum += std::pow(double(p.r) - double(q.r), 2) + std::pow(double(p.g) - double(q.g), 2) +
               std::pow(double(p.b) - double(q.b), 2);
    }
    return sum;
}

TEST(RealCopper, TheChoiceDoesNoHarm) {
    const fs::path folder = fs::path(VERDIGRIS_SHARED_DATA) / "real" / "copper_patinating";
    if (!fs::exists(folder)) GTEST_SKIP() << "no real copper frames at " << folder;
    constexpr int kUnit = 2, kContext = 5, kHorizon = 10;  // frames per unit, as the paper's K
    double held = 0, chosen = 0, automatically = 0, followed = 0;
    for (int start = 1; start + kUnit * (kContext + kHorizon - 1) < 100; start += 10) {
        Context context;
        for (int i = 0; i < kContext; ++i) {
            context.frames.push_back(frame(folder, start + i * kUnit));
        }
        context.sigma = 3.4 / 255 / 2;  // of one frame (README of the data), four pixels averaged
        context.tau = 2.4 * context.sigma;
        const Forecast hold = persistence().forecast(context);
        const Forecast choice = back_tested().forecast(context);
        const Forecast best = automatic().forecast(context);
        AffineOptions paper;
        paper.ridge_k = 0;
        const Forecast drift = affinergb(paper).forecast(context);
        for (int k = 1; k <= kHorizon; k += 3) {
            const Image<SrgbF> truth = frame(folder, start + (kContext - 1 + k) * kUnit);
            held += squared_error(hold.at(k), truth);
            chosen += squared_error(choice.at(k), truth);
            automatically += squared_error(best.at(k), truth);
            followed += squared_error(drift.at(k), truth);
        }
    }
    EXPECT_GT(followed, 1.1 * held);  // the trap is real ...
    EXPECT_LT(chosen, 1.05 * held);   // ... and avoided
    EXPECT_LT(automatically, 0.9 * held);
}

}  // namespace
}  // namespace verdigris
