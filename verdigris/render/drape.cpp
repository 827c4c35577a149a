// SPDX-License-Identifier: MIT
#include "verdigris/render/drape.h"

#include <algorithm>
#include <cmath>

namespace verdigris {
namespace {

/// A number and its derivatives along u and v: the formula is written once, and its derivatives
/// follow by the chain rule.
struct Dual {
    double v = 0, du = 0, dv = 0;
};
Dual operator+(Dual a, Dual b) {
    return {a.v + b.v, a.du + b.du, a.dv + b.dv};
}
Dual operator-(Dual a, Dual b) {
    return {a.v - b.v, a.du - b.du, a.dv - b.dv};
}
Dual operator*(Dual a, Dual b) {
    return {a.v * b.v, a.du * b.v + a.v * b.du, a.dv * b.v + a.v * b.dv};
}
Dual number(double v) {
    return {v, 0, 0};
}
Dual operator*(double s, Dual a) {
    return number(s) * a;
}
// f(a), given f and its derivative there.
Dual chain(Dual a, double value, double slope) {
    return {value, slope * a.du, slope * a.dv};
}
Dual sine(Dual a) {
    return chain(a, std::sin(a.v), std::cos(a.v));
}
Dual cosine(Dual a) {
    return chain(a, std::cos(a.v), -std::sin(a.v));
}
Dual root(Dual a) {
    return chain(a, std::sqrt(a.v), 0.5 / std::sqrt(a.v));
}
// atan2(y, x)
Dual angle(Dual y, Dual x) {
    const double square = x.v * x.v + y.v * y.v;
    return {std::atan2(y.v, x.v), (x.v * y.du - y.v * x.du) / square,
            (x.v * y.dv - y.v * x.dv) / square};
}
/// 0 below `from`, 1 above `to`, smooth to the second derivative.
Dual rise(Dual a, double from, double to) {
    const double t = std::clamp((a.v - from) / (to - from), 0.0, 1.0);
    return chain(a, t * t * t * (t * (6 * t - 15) + 10),
                 30 * t * t * (t - 1) * (t - 1) / (to - from));
}

// All chosen by eye, so that folds catch light at every angle and none cuts through another.
constexpr double kBall = 0.46;       // radius of the ball under the cloth
constexpr double kHalfSide = 1.18;   // of the cloth, at rest
constexpr double kLift = 0.36;       // center of the ball above the middle of the picture
constexpr double kLastAngle = 1.33;  // radians from the top at which the cloth leaves the ball
constexpr double kFirstFold = 0.35;  // arc length from the top where folds begin
constexpr double kDepth = 0.115;     // of the folds at the hem

// How far the profile has turned from level, at arc length s from the top: evenly over the ball,
// then straight down the skirt. Height and radius are its integrals, in closed form.
struct Profile {
    Dual radius, height;
};
Profile profile(Dual s) {
    const double end = kBall * kLastAngle;
    if (s.v <= end) {
        const Dual a = (1 / kBall) * s;
        return {kBall * sine(a), kBall * cosine(a)};
    }
    const Dual rest = s - number(end);
    return {number(kBall * std::sin(kLastAngle)) + std::cos(kLastAngle) * rest,
            number(kBall * std::cos(kLastAngle)) - std::sin(kLastAngle) * rest};
}

}  // namespace

DrapePoint drape_point(double u, double v) {
    const Dual x = {(2 * u - 1) * kHalfSide, 2 * kHalfSide, 0};
    const Dual z = {(2 * v - 1) * kHalfSide, 0, 2 * kHalfSide};
    const Dual s = root(x * x + z * z + number(1e-6));  // 1e-6: the root of 0 has no derivative
    const Profile p = profile(s);
    const auto point = [](Dual px, Dual py, Dual pz) {
        const auto vec = [&](auto part) {
            return Vec3F{float(part(px)), float(part(py)), float(part(pz))};
        };
        return DrapePoint{vec([](const Dual& d) { return d.v; }),
                          vec([](const Dual& d) { return d.du; }),
                          vec([](const Dual& d) { return d.dv; })};
    };
    // Around the top there is no fold, and the angle around it has no derivative.
    if (s.v < kFirstFold) {
        const Dual share = p.radius * chain(s, 1 / s.v, -1 / (s.v * s.v));
        return point(share * x, p.height + number(kLift), share * z);
    }
    const Dual around = angle(z, x);
    // Folds begin where the cloth leaves the ball. Four corners make four great ones; the rest is
    // uneven, as cloth is.
    const Dual depth = kDepth * rise(s, kFirstFold, 1.25);
    const Dual folds = cosine(8 * around + number(0.35)) + 0.34 * cosine(5 * around + number(1.9)) +
                       0.30 * cosine(13 * around + number(0.7) + 1.5 * s);
    const Dual radius = p.radius + depth * folds;
    const Dual swing = 0.045 * (rise(s, 0.45, 1.4) * sine(6 * around + number(0.4)));
    const Dual turned = around + swing;
    const Dual px = radius * cosine(turned), pz = radius * sine(turned);
    const Dual py = p.height + number(kLift) - 0.03 * (rise(s, 0.5, 1.4) * folds);
    return point(px, py, pz);
}

}  // namespace verdigris
