// SPDX-License-Identifier: MIT
// FLIP as its authors define it, in double and without any shortcut (whole two-dimensional filters,
// every power by std::pow), against the fused kernel: odd sizes, seams of tiles, other distances.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "verdigris/metrics/flip.h"
#include "verdigris/metrics/testing.h"

namespace verdigris {
namespace {

using Vec = std::array<double, 3>;
constexpr double kPi = std::numbers::pi, kDelta = 6.0 / 29;
constexpr Vec kWhite{0.950428545, 1, 1.088900371};

Vec xyz_of(const Vec& c) {
    return {(10135552 * c[0] + 8788810 * c[1] + 4435075 * c[2]) / 24577794,
            (2613072 * c[0] + 8788810 * c[1] + 887015 * c[2]) / 12288897,
            (1425312 * c[0] + 8788810 * c[1] + 70074185 * c[2]) / 73733382};
}
Vec linear_of(const Vec& c) {
    return {3.241003275 * c[0] - 1.537398934 * c[1] - 0.498615861 * c[2],
            -0.969224334 * c[0] + 1.875930071 * c[1] + 0.041554224 * c[2],
            0.055639423 * c[0] - 0.204011202 * c[1] + 1.057148933 * c[2]};
}
double decoded(double v) {
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}
Vec ycxcz_of(SrgbF c) {
    const Vec xyz = xyz_of({decoded(c.r), decoded(c.g), decoded(c.b)});
    const double x = xyz[0] / kWhite[0], y = xyz[1], z = xyz[2] / kWhite[2];
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}
Vec hunt_lab_of(const Vec& xyz) {
    Vec f{};
    for (std::size_t i = 0; i < 3; ++i) {
        const double t = xyz[i] / kWhite[i];
        f[i] = t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29;
    }
    const double l = 116 * f[1] - 16;
    return {l, 0.01 * l * 500 * (f[0] - f[1]), 0.01 * l * 200 * (f[1] - f[2])};
}
double hyab(const Vec& a, const Vec& b) {
    return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

struct Kernel {
    int radius;
    std::vector<double> taps;
    Kernel(int r, const std::function<double(int, int)>& value) : radius(r) {
        for (int y = -r; y <= r; ++y)
            for (int x = -r; x <= r; ++x) taps.push_back(value(x, y));
    }
    void normalize_parts() {
        double up = 0, down = 0;
        for (const double t : taps) (t > 0 ? up : down) += t;
        for (double& t : taps) t /= t > 0 ? up : -down;
    }
};

class Definition {
  public:
    Definition(const Image<SrgbF>& image, double ppd) : width_(image.width()), ppd_(ppd) {
        for (const SrgbF& c : image.pixels()) pixels_.push_back(ycxcz_of(c));
        height_ = image.height();
    }

    double filtered(const Kernel& k, int x, int y, const std::function<double(const Vec&)>& of) {
        double sum = 0;
        std::size_t i = 0;
        for (int v = y - k.radius; v <= y + k.radius; ++v)
            for (int u = x - k.radius; u <= x + k.radius; ++u, ++i)
                sum += k.taps[i] * of(pixels_[std::size_t(std::clamp(v, 0, height_ - 1) * width_ +
                                                          std::clamp(u, 0, width_ - 1))]);
        return sum;
    }

    Vec lab(int x, int y) {
        constexpr double a[3][4] = {
            {1, 0.0047, 0, 1e-5}, {1, 0.0053, 0, 1e-5}, {34.1, 0.04, 13.5, 0.025}};
        const int radius = int(std::ceil(3 * std::sqrt(0.04 / (2 * kPi * kPi)) * ppd_));
        Vec opponent{};
        for (std::size_t c = 0; c < 3; ++c) {
            Kernel k(radius, [&](int u, int v) {
                const double r2 = (u * u + v * v) / (ppd_ * ppd_);
                const auto g = [&](double scale, double b) {
                    return scale * std::sqrt(kPi / b) * std::exp(-kPi * kPi * r2 / b);
                };
                return g(a[c][0], a[c][1]) + g(a[c][2], a[c][3]);
            });
            double sum = 0;
            for (const double t : k.taps) sum += t;
            for (double& t : k.taps) t /= sum;
            opponent[c] = filtered(k, x, y, [&](const Vec& p) { return p[c]; });
        }
        const double luma = (opponent[0] + 16) / 116;
        Vec rgb = linear_of(
            {(luma + opponent[1] / 500) * kWhite[0], luma, (luma - opponent[2] / 200) * kWhite[2]});
        for (double& v : rgb) v = std::clamp(v, 0.0, 1.0);
        return hunt_lab_of(xyz_of(rgb));
    }

    std::array<double, 2> features(int x, int y) {
        const double s = 0.5 * 0.082 * ppd_;
        const int radius = int(std::ceil(3 * s));
        const auto size = [&](const std::function<double(int)>& derivative) {
            const auto g = [&](int u, int v) { return std::exp(-(u * u + v * v) / (2 * s * s)); };
            Kernel across(radius, [&](int u, int v) { return derivative(u) * g(u, v); });
            Kernel down(radius, [&](int u, int v) { return derivative(v) * g(u, v); });
            across.normalize_parts();
            down.normalize_parts();
            const auto gray = [](const Vec& p) { return (p[0] + 16) / 116; };
            return std::hypot(filtered(across, x, y, gray), filtered(down, x, y, gray));
        };
        return {size([](int u) { return double(-u); }),
                size([&](int u) { return u * u / (s * s) - 1; })};
    }

  private:
    int width_, height_ = 0;
    double ppd_;
    std::vector<Vec> pixels_;
};

double defined_flip(Definition& reference, Definition& test, int x, int y) {
    const double largest =
        std::pow(hyab(hunt_lab_of(xyz_of({0, 1, 0})), hunt_lab_of(xyz_of({0, 0, 1}))), 0.7);
    const double d = std::pow(hyab(reference.lab(x, y), test.lab(x, y)), 0.7), knee = 0.4 * largest;
    const double color = d < knee ? d * 0.95 / knee : 0.95 + (d - knee) / (largest - knee) * 0.05;
    const auto a = reference.features(x, y), b = test.features(x, y);
    const double feature = std::max(std::abs(a[0] - b[0]), std::abs(a[1] - b[1]));
    return std::pow(color, 1 - std::sqrt(feature / std::numbers::sqrt2));
}

/// Soft shapes with an edge, dark and bright corners, and a little noise.
Image<SrgbF> scene(int width, int height, float shift, std::uint32_t seed) {
    const Image<SrgbF> grain = testing::noise(width, height, seed);
    return testing::picture(width, height, [&](int x, int y) {
        const float u = float(x) / float(width), v = float(y) / float(height);
        const float wave = 0.5f + 0.5f * std::sin(9 * u + 5 * v * v + shift);
        const float step = (x / 23 + y / 17) % 2 == 0 ? 0.0f : 0.25f;
        const SrgbF g = grain(x, y);
        return SrgbF{0.7f * wave * u + step + 0.05f * g.r, 0.6f * v * wave + 0.05f * g.g,
                     0.5f * (1 - u) + step + 0.05f * g.b + 0.2f * shift};
    });
}

void expect_agreement(int width, int height, double ppd, int stride) {
    const Image<SrgbF> a = scene(width, height, 0, 1), b = scene(width, height, 0.3f, 2);
    const FlipResult r = flip(a, b, {.pixels_per_degree = ppd});
    Definition reference(a, ppd), test(b, ppd);
    double worst = 0;
    for (int y = 0; y < height; y += stride)
        for (int x = y % stride; x < width; x += stride)
            worst = std::max(worst,
                             std::abs(double(r.map(x, y)) - defined_flip(reference, test, x, y)));
    EXPECT_LT(worst, 1e-5) << width << " x " << height << ", " << ppd;
}

TEST(FlipDefinition, AgreesWhereTilesMeet) {
    // 263 columns and 261 rows are two tiles each way, met at 131 and 130.
    expect_agreement(263, 261, kFlipPixelsPerDegree, 7);
}
TEST(FlipDefinition, AgreesOnSmallAndOddSizes) {
    expect_agreement(1, 1, kFlipPixelsPerDegree, 1);
    expect_agreement(1, 40, kFlipPixelsPerDegree, 1);
    expect_agreement(37, 2, kFlipPixelsPerDegree, 1);
    expect_agreement(17, 33, kFlipPixelsPerDegree, 3);
}
TEST(FlipDefinition, AgreesFromOtherDistances) {
    for (const double ppd : {1.0, 2.5, 7.0, 20.0, 40.0, 110.0}) expect_agreement(45, 39, ppd, 9);
    expect_agreement(30, 20, 400, 19);
}

}  // namespace
}  // namespace verdigris
