// SPDX-License-Identifier: MIT
#include "verdigris/metrics/flip_filters.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace verdigris {
namespace {

constexpr double kPi = std::numbers::pi;

/// a sqrt(pi / b) exp(-pi^2 r^2 / b), r in degrees: the contrast sensitivity of a channel turned
/// into a blur. Constants: [Andersson2020], Table 1.
struct Sensitivity {
    double a, b;
};
constexpr Sensitivity kLuma{1, 0.0047}, kRedGreen{1, 0.0053}, kBlueWide{34.1, 0.04},
    kBlueNarrow{13.5, 0.025};
/// Degrees from the middle of a feature detector to where its second derivative changes sign, and
/// back: [Andersson2020], Section 4.2.
constexpr double kFeatureWidth = 0.082;
constexpr double kReach = 3;  ///< standard deviations that are summed over

std::vector<double> gaussian(double sigma, int radius) {
    std::vector<double> taps;
    for (int i = 0; i <= radius; ++i) taps.push_back(std::exp(-0.5 * (i / sigma) * (i / sigma)));
    return taps;
}

double two_sided_sum(const std::vector<double>& taps) {
    double sum = taps[0];
    for (std::size_t i = 1; i < taps.size(); ++i) sum += 2 * taps[i];
    return sum;
}

std::vector<float> scaled(const std::vector<double>& taps, double by) {
    std::vector<float> out;
    for (const double t : taps) out.push_back(float(t * by));
    return out;
}

/// Without the taps that together weigh less than half the last digit of 1.
std::vector<float> trimmed(std::vector<float> taps) {
    double tail = 0;
    while (taps.size() > 1 && (tail += 2 * double(taps.back())) < 0x1p-25) taps.pop_back();
    return taps;
}

}  // namespace

int FlipFilters::reach() const {
    return int(std::max(blue_wide.size(), smooth.size())) - 1;
}

FlipFilters flip_filters(double pixels_per_degree) {
    FlipFilters out;
    const auto sigma = [&](Sensitivity s) {
        return std::sqrt(s.b / (2 * kPi * kPi)) * pixels_per_degree;
    };
    const int radius = int(std::ceil(kReach * sigma(kBlueWide)));
    for (const auto& [channel, taps] : {std::pair{kLuma, &out.luma}, {kRedGreen, &out.red_green}}) {
        const std::vector<double> g = gaussian(sigma(channel), radius);
        *taps = trimmed(scaled(g, 1 / two_sided_sum(g)));
    }
    std::vector<double> wide = gaussian(sigma(kBlueWide), radius),
                        narrow = gaussian(sigma(kBlueNarrow), radius);
    const auto height = [](Sensitivity s) { return std::sqrt(s.a * std::sqrt(kPi / s.b)); };
    for (double& t : wide) t *= height(kBlueWide);
    for (double& t : narrow) t *= height(kBlueNarrow);
    const double norm = 1 / std::hypot(two_sided_sum(wide), two_sided_sum(narrow));
    out.blue_wide = scaled(wide, norm);
    out.blue_narrow = scaled(narrow, norm);

    const double s = 0.5 * kFeatureWidth * pixels_per_degree;
    const int feature_radius = int(std::ceil(kReach * s));
    const std::vector<double> g = gaussian(s, feature_radius);
    out.smooth = scaled(g, 1 / two_sided_sum(g));
    std::vector<double> edge, point;
    double edge_sum = 0, rise = 0, fall = 0;
    for (int i = 0; i <= feature_radius; ++i) {
        edge.push_back(i * g[std::size_t(i)]);
        point.push_back((i * i / (s * s) - 1) * g[std::size_t(i)]);
        edge_sum += edge.back();
        (point.back() > 0 ? rise : fall) += (i == 0 ? 1 : 2) * point.back();
    }
    for (double& p : point) p /= p > 0 ? rise : -fall;
    out.edge = scaled(edge, 1 / edge_sum);
    out.point = scaled(point, 1);
    // One loop over the luminance serves blur and features: pad the shorter with nothing.
    const std::size_t longest = std::max(out.smooth.size(), out.luma.size());
    for (auto* taps : {&out.smooth, &out.edge, &out.point}) taps->resize(longest);
    return out;
}

}  // namespace verdigris
