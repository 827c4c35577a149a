// SPDX-License-Identifier: MIT
#include "verdigris/observe/color_clusters.h"

#include <algorithm>
#include <array>
#include <limits>
#include <opencv2/core.hpp>

#include "verdigris/color/convert.h"

namespace verdigris {
namespace {

constexpr int kClusters = 4;              // chosen: metal, patina, mount, backdrop
constexpr float kLightnessWeight = 0.5f;  // chosen: light and shadow on one metal stay together
constexpr int kStride = 3;  // chosen: every ninth pixel places the centers well enough
constexpr std::uint64_t kSeed = 0x9E3779B97F4A7C15;  // any fixed number
// chosen: less copper color than this is chance.
constexpr double kSomeCopper = 0.01;

using Point = std::array<float, 3>;

Point point_of(SrgbF c) {
    const Lab lab = lab_from_srgb(c);
    return {kLightnessWeight * lab.l, lab.a, lab.b};
}

int nearest(const Point& p, const std::array<Point, kClusters>& centers) {
    int best = 0;
    float least = std::numeric_limits<float>::max();
    for (int k = 0; k < kClusters; ++k) {
        float d = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            const float delta = p[c] - centers[std::size_t(k)][c];
            d += delta * delta;
        }
        if (d < least) least = d, best = k;
    }
    return best;
}

}  // namespace

Mask specimen_cluster(const ChangeMap& map) {
    std::vector<Point> points;
    for (int y = 0; y < map.height; y += kStride) {
        for (int x = 0; x < map.width; x += kStride) points.push_back(point_of(map.early(x, y)));
    }
    if (points.size() < 4 * kClusters) return Mask(map.width, map.height);
    cv::Mat data(int(points.size()), 3, CV_32F, points.data());
    cv::Mat labels, found;
    const cv::RNG before = cv::theRNG();
    cv::theRNG() = cv::RNG(kSeed);
    cv::kmeans(data, kClusters, labels,
               cv::TermCriteria(cv::TermCriteria::EPS + cv::TermCriteria::COUNT, 30, 0.1), 3,
               cv::KMEANS_PP_CENTERS, found);
    cv::theRNG() = before;
    std::array<Point, kClusters> centers{};
    for (int k = 0; k < kClusters; ++k) {
        for (int c = 0; c < 3; ++c) centers[std::size_t(k)][std::size_t(c)] = found.at<float>(k, c);
    }

    std::vector<int> label(map.z.size());
    std::array<double, kClusters> count{}, z{}, copper{};
    double all_copper = 0;
    for (std::size_t i = 0; i < label.size(); ++i) {
        label[i] = nearest(point_of(map.early.pixels()[i]), centers);
        const auto k = std::size_t(label[i]);
        ++count[k];
        z[k] += double(map.z[i]);
        if (map.copper.pixels()[i] == kInside) ++copper[k], ++all_copper;
    }
    const bool by_color = all_copper >= kSomeCopper * double(label.size());
    int best = -1;
    double most = 0;
    for (int k = 0; k < kClusters; ++k) {
        const auto n = std::size_t(k);
        if (count[n] == 0) continue;
        // Half of a cluster must look like copper, or the backdrop beside it would count.
        if (by_color && copper[n] < 0.5 * count[n]) continue;
        const double mean = z[n] / count[n];
        if (mean > most) most = mean, best = k;
    }
    Mask mask(map.width, map.height);
    for (std::size_t i = 0; i < label.size(); ++i) {
        if (label[i] == best) mask.pixels()[i] = kInside;
    }
    return mask;
}

}  // namespace verdigris
