// SPDX-License-Identifier: MIT
#include "verdigris/metrics/ssim.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "verdigris/error.h"
#include "verdigris/files/testing.h"
#include "verdigris/metrics/testing.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

using testing::flat;
using testing::noise;
using testing::picture;

constexpr double kC1 = 1e-4, kC2 = 9e-4;

struct Naive {
    double whole = 0, structure = 0;
};
using Gray = std::vector<std::vector<double>>;

Gray channel(const Image<SrgbF>& image, float SrgbF::*c) {
    Gray out(std::size_t(image.height()));
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) out[std::size_t(y)].push_back(image(x, y).*c);
    return out;
}

/// [Wang2004] by a whole window at each place; moments around the mean, not from squares.
Naive naive(const Gray& a, const Gray& b) {
    Naive sum;
    const int rows = int(a.size()) - 10, columns = int(a[0].size()) - 10;
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) {
            const auto over = [&](const std::function<double(double, double)>& f) {
                double value = 0, weights = 0;
                for (int v = 0; v < 11; ++v) {
                    for (int u = 0; u < 11; ++u) {
                        const double r2 = (u - 5) * (u - 5) + (v - 5) * (v - 5);
                        const double w = std::exp(-r2 / (2 * 1.5 * 1.5));
                        value += w * f(a[std::size_t(y + v)][std::size_t(x + u)],
                                       b[std::size_t(y + v)][std::size_t(x + u)]);
                        weights += w;
                    }
                }
                return value / weights;
            };
            const double ma = over([](double p, double) { return p; });
            const double mb = over([](double, double q) { return q; });
            const double va = over([&](double p, double) { return (p - ma) * (p - ma); });
            const double vb = over([&](double, double q) { return (q - mb) * (q - mb); });
            const double cov = over([&](double p, double q) { return (p - ma) * (q - mb); });
            const double structure = (2 * cov + kC2) / (va + vb + kC2);
            sum.structure += structure;
            sum.whole += structure * (2 * ma * mb + kC1) / (ma * ma + mb * mb + kC1);
        }
    }
    return {sum.whole / (rows * columns), sum.structure / (rows * columns)};
}

constexpr std::array<float SrgbF::*, 3> kChannels{&SrgbF::r, &SrgbF::g, &SrgbF::b};

Image<SrgbF> scene(int width, int height, float grain, std::uint32_t seed) {
    const Image<SrgbF> n = noise(width, height, seed);
    return picture(width, height, [&](int x, int y) {
        const float v = 0.4f + 0.3f * std::sin(0.2f * float(x)) * std::cos(0.13f * float(y));
        const SrgbF g = n(x, y);
        return SrgbF{v + grain * g.r, 0.8f * v + grain * g.g, 0.5f * v + 2 * grain * g.b};
    });
}

TEST(Ssim, AgreesWithTheDefinition) {
    const auto a = scene(33, 27, 0.1f, 1), b = scene(33, 27, 0.2f, 2);
    double sum = 0;
    for (const auto c : kChannels) sum += naive(channel(a, c), channel(b, c)).whole;
    EXPECT_NEAR(ssim(a, b), sum / 3, 1e-12);
    EXPECT_LT(sum / 3, 0.9);
    EXPECT_NEAR(ssim(a, b), ssim(b, a), 1e-14);
}

// Of two flat pictures only the luminance term is left: (2 m n + C1) / (m^2 + n^2 + C1).
TEST(Ssim, OfFlatPictures) {
    const auto a = flat(11, 11, {0.5f, 0.25f, 0.75f}), b = flat(11, 11, {0.25f, 0.25f, 0.25f});
    const double r = (0.25 + kC1) / (0.3125 + kC1), blue = (0.375 + kC1) / (0.625 + kC1);
    EXPECT_NEAR(ssim(a, b), (r + 1 + blue) / 3, 1e-12);
}

// x against 1 - x: means are equal up to the window, covariance is minus the variance.
TEST(Ssim, OfANegativeIsNegative) {
    const auto a = noise(40, 40, 3);
    const auto b = picture(40, 40, [&](int x, int y) {
        const SrgbF c = a(x, y);
        return SrgbF{1 - c.r, 1 - c.g, 1 - c.b};
    });
    EXPECT_LT(ssim(a, b), -0.8);
}

TEST(Ssim, OfEqualPicturesIsOne) {
    const auto a = noise(200, 170, 3);
    EXPECT_EQ(ssim(a, a), 1);
    EXPECT_EQ(ms_ssim(a, a), 1);
}

TEST(Ssim, SameAtAnyThreadCount) {
    const auto a = noise(180, 190, 1), b = noise(180, 190, 2);
    const double one_scale = ssim(a, b), five = ms_ssim(a, b);
    set_thread_count(1);
    EXPECT_EQ(ssim(a, b), one_scale);
    EXPECT_EQ(ms_ssim(a, b), five);
    set_thread_count(0);
}

// Mean of 2 x 2; what has no neighbor is its own.
Gray halved(const Gray& g) {
    Gray out((g.size() + 1) / 2, std::vector<double>((g[0].size() + 1) / 2));
    for (std::size_t y = 0; y < out.size(); ++y) {
        for (std::size_t x = 0; x < out[0].size(); ++x) {
            const std::size_t v = std::min(2 * y + 1, g.size() - 1),
                              u = std::min(2 * x + 1, g[0].size() - 1);
            out[y][x] = (g[2 * y][2 * x] + g[2 * y][u] + g[v][2 * x] + g[v][u]) / 4;
        }
    }
    return out;
}

TEST(MsSsim, AgreesWithTheDefinition) {
    constexpr double kWeights[5] = {0.0448, 0.2856, 0.3001, 0.2363, 0.1333};
    const auto a = scene(163, 161, 0.2f, 1), b = scene(163, 161, 0.3f, 2);
    Gray p = channel(a, &SrgbF::r), q = channel(b, &SrgbF::r);
    double product = 1;
    for (int scale = 0; scale < 5; ++scale) {
        const Naive n = naive(p, q);
        product *= std::pow(scale == 4 ? n.whole : n.structure, kWeights[scale]);
        p = halved(p);
        q = halved(q);
    }
    const auto gray = [](const Image<SrgbF>& image) {
        return picture(image.width(), image.height(), [&](int x, int y) {
            const float r = image(x, y).r;
            return SrgbF{r, r, r};
        });
    };
    EXPECT_NEAR(ms_ssim(gray(a), gray(b)), product, 1e-12);
    EXPECT_LT(product, 0.95);
}

// Flat pictures: every scale's structure is 1, and the luminance of the last counts 0.1333.
TEST(MsSsim, OfFlatPictures) {
    const auto a = flat(161, 161, {0.5f, 0.5f, 0.5f}), b = flat(161, 161, {0.25f, 0.25f, 0.25f});
    EXPECT_NEAR(ms_ssim(a, b), std::pow((0.25 + kC1) / (0.3125 + kC1), 0.1333), 1e-9);
}

TEST(MsSsim, OfANegativeIsZero) {
    const auto a = noise(161, 161, 3);
    const auto b = picture(161, 161, [&](int x, int y) {
        const SrgbF c = a(x, y);
        return SrgbF{1 - c.r, 1 - c.g, 1 - c.b};
    });
    EXPECT_EQ(ms_ssim(a, b), 0);
}

TEST(Ssim, RefusesWhatIsTooSmall) {
    const auto a = flat(300, 10, {}), b = flat(160, 400, {});
    const Error one = error_of([&] { ssim(a, a); }), five = error_of([&] { ms_ssim(b, b); });
    EXPECT_EQ(one.code(), ErrorCode::bad_input);
    EXPECT_NE(one.sentence().find("at least 11 x 11"), std::string::npos);
    EXPECT_NE(five.sentence().find("at least 161 x 161"), std::string::npos);
    EXPECT_EQ(error_of([&] { ssim(a, b); }).code(), ErrorCode::bad_input);
}

}  // namespace
}  // namespace verdigris
