// SPDX-License-Identifier: MIT
#include "verdigris/color/delta_e.h"

#include <cmath>
#include <numbers>

namespace verdigris {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double radians(double degrees) {
    return degrees * kPi / 180;
}

// sqrt(C^7 / (C^7 + 25^7)): 0 for grays, 1 for vivid colors.
double vividness(double chroma) {
    const double c7 = std::pow(chroma, 7);
    return std::sqrt(c7 / (c7 + 6103515625.0));
}

struct Polar {
    double chroma, hue;  // hue in [0, 2 pi)
};
Polar polar(double a, double b) {
    const double hue = std::atan2(b, a);
    return {std::hypot(a, b), hue < 0 ? hue + 2 * kPi : hue};
}

// The formula jumps where two hues are exactly opposite. [Sharma2005] has pairs that lie on that
// edge by construction; the last bit of atan2 must not decide on which side they fall.
constexpr double kOpposite = kPi + 1e-9;

}  // namespace

double delta_e2000(Lab first, Lab second) {
    const double l1 = first.l, l2 = second.l;
    const double mean_ab = (std::hypot(double(first.a), double(first.b)) +
                            std::hypot(double(second.a), double(second.b))) /
                           2;
    const double stretch = 1 + 0.5 * (1 - vividness(mean_ab));
    const Polar p1 = polar(first.a * stretch, first.b), p2 = polar(second.a * stretch, second.b);

    // Without chroma there is no hue: its difference is 0 and the mean is the other one's.
    const bool gray = p1.chroma * p2.chroma == 0;
    double hue_step = gray ? 0 : p2.hue - p1.hue;
    double hue = gray ? p1.hue + p2.hue : (p1.hue + p2.hue) / 2;
    if (std::abs(hue_step) > kOpposite) {  // the short way around the circle
        hue_step += hue_step > 0 ? -2 * kPi : 2 * kPi;
        hue += hue < kPi ? kPi : -kPi;
    }

    const double dl = l2 - l1, dc = p2.chroma - p1.chroma;
    const double dh = 2 * std::sqrt(p1.chroma * p2.chroma) * std::sin(hue_step / 2);

    const double l = (l1 + l2) / 2 - 50, c = (p1.chroma + p2.chroma) / 2;
    const double t = 1 - 0.17 * std::cos(hue - radians(30)) + 0.24 * std::cos(2 * hue) +
                     0.32 * std::cos(3 * hue + radians(6)) - 0.20 * std::cos(4 * hue - radians(63));
    const double blue = (hue * 180 / kPi - 275) / 25;
    const double turn = -std::sin(radians(60) * std::exp(-blue * blue)) * 2 * vividness(c);
    const double wl = dl / (1 + 0.015 * l * l / std::sqrt(20 + l * l));
    const double wc = dc / (1 + 0.045 * c);
    const double wh = dh / (1 + 0.015 * c * t);
    return std::sqrt(wl * wl + wc * wc + wh * wh + turn * wc * wh);
}

}  // namespace verdigris
