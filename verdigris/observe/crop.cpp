// SPDX-License-Identifier: MIT
#include "verdigris/observe/crop.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "verdigris/observe/area_average.h"
#include "verdigris/observe/change_map.h"
#include "verdigris/observe/color_clusters.h"

namespace verdigris {
namespace {

// Spec E.1, all for a long side of 480.
constexpr float kChanged = 4, kChangedCopper = 2;  // in units of the noise
constexpr int kCloseRadius = 5, kOpenRadius = 3;
constexpr double kNear = 0.25;  // centroids closer than this share of sqrt(area) are one
constexpr double kPad = 0.08;
constexpr double kClearWin = 2, kSmallest = 0.02;
// chosen: two candidates whose common convex hull is hardly more than they are one plate with a
// glint or a scratch between them.
constexpr double kOneHull = 1.2;
// chosen: a mask this close to its hull is a plate with nicks; the hull is the better outline.
constexpr double kConvex = 0.9;
// chosen: the specimen reaches the border along more than half of it, and covers more than half.
constexpr double kFillsShare = 0.6, kFillsBorder = 0.6;
constexpr double kBorderRing = 0.03;  // of the shorter side
// chosen: a picture in which less than this changes is still.
constexpr double kStill = 0.002;

cv::Mat disc(int radius) {
    return cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * radius + 1, 2 * radius + 1});
}

std::vector<std::vector<cv::Point>> outlines(const cv::Mat& mask) {
    std::vector<std::vector<cv::Point>> contours;
    cv::findContours(mask, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
    return contours;
}

cv::Mat cleaned(const cv::Mat& seed) {
    cv::Mat mask;
    cv::morphologyEx(seed, mask, cv::MORPH_CLOSE, disc(kCloseRadius));
    cv::drawContours(mask, outlines(mask), -1, cv::Scalar(255), cv::FILLED);  // fills holes
    cv::morphologyEx(mask, mask, cv::MORPH_OPEN, disc(kOpenRadius));
    return mask;
}

std::vector<cv::Point> hull_of(const cv::Mat& mask) {
    std::vector<cv::Point> points, hull;
    for (const auto& contour : outlines(mask)) {
        points.insert(points.end(), contour.begin(), contour.end());
    }
    if (!points.empty()) cv::convexHull(points, hull);
    return hull;
}

double area_of(const std::vector<cv::Point>& polygon) {
    cv::Mat1b canvas;
    if (polygon.empty()) return 0;
    const cv::Rect box = cv::boundingRect(polygon);
    canvas = cv::Mat1b(box.size(), 0);
    std::vector<cv::Point> moved;
    for (const auto& p : polygon) moved.push_back(p - box.tl());
    cv::fillConvexPoly(canvas, moved, cv::Scalar(255));
    return cv::countNonZero(canvas);
}

struct Candidate {
    cv::Mat mask;
    double area = 0, score = 0;
    cv::Point2d center;
};

// Connected parts of `mask` that hold at least one pixel of `strong`, best first.
std::vector<Candidate> candidates(const cv::Mat& mask, const cv::Mat& strong, const cv::Mat& z) {
    cv::Mat labels, stats, centers;
    const int count = cv::connectedComponentsWithStats(mask, labels, stats, centers, 8, CV_32S);
    std::vector<Candidate> found;
    for (int k = 1; k < count; ++k) {
        Candidate c;
        c.mask = labels == k;
        if (cv::countNonZero(c.mask & strong) == 0) continue;
        c.area = stats.at<int>(k, cv::CC_STAT_AREA);
        c.center = {centers.at<double>(k, 0), centers.at<double>(k, 1)};
        int at_border = 0, perimeter = 0;
        for (const auto& contour : outlines(c.mask)) {
            for (const auto& p : contour) {
                ++perimeter;
                at_border += p.x == 0 || p.y == 0 || p.x == mask.cols - 1 || p.y == mask.rows - 1;
            }
        }
        const double border = perimeter > 0 ? double(at_border) / perimeter : 0;
        c.score = c.area * cv::mean(z, c.mask)[0] * (1 - border);
        found.push_back(std::move(c));
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
    return found;
}

bool belong_together(const Candidate& a, const Candidate& b) {
    const double distance = std::hypot(a.center.x - b.center.x, a.center.y - b.center.y);
    if (distance < kNear * std::sqrt(a.area)) return true;
    return area_of(hull_of(a.mask | b.mask)) <= kOneHull * (a.area + b.area);
}

// Merges into the best what belongs to it; the rest stays in order.
void merge_best(std::vector<Candidate>& found) {
    for (std::size_t i = 1; i < found.size();) {
        Candidate& best = found.front();
        if (!belong_together(best, found[i])) {
            ++i;
            continue;
        }
        const double total = best.area + found[i].area;
        best.center = (best.center * best.area + found[i].center * found[i].area) / total;
        best.mask |= found[i].mask;
        best.area = total;
        best.score += found[i].score;
        found.erase(found.begin() + std::ptrdiff_t(i));
        i = 1;
    }
}

Rect box_of(const cv::Mat& mask) {
    const auto range = [](std::vector<int> counts) {
        long total = 0, below = 0;
        for (const int c : counts) total += c;
        int first = -1, last = 0;
        for (int i = 0; i < int(counts.size()); ++i) {  // the 1..99 % of the coordinates
            below += counts[std::size_t(i)];
            if (first < 0 && 100 * below > total) first = i;
            if (100 * (total - below) >= total) last = i + 1;
        }
        return std::pair<int, int>{std::max(first, 0), std::min(last, int(counts.size()) - 1)};
    };
    std::vector<int> columns(std::size_t(mask.cols)), rows(std::size_t(mask.rows));
    for (int y = 0; y < mask.rows; ++y) {
        for (int x = 0; x < mask.cols; ++x) {
            if (mask.at<std::uint8_t>(y, x) == 0) continue;
            ++columns[std::size_t(x)];
            ++rows[std::size_t(y)];
        }
    }
    const auto [x0, x1] = range(columns);
    const auto [y0, y1] = range(rows);
    return {x0, y0, x1 - x0 + 1, y1 - y0 + 1};
}

double share_of(const cv::Mat& mask) {
    return double(cv::countNonZero(mask)) / double(mask.total());
}

bool reaches_round(const cv::Mat& changed) {
    const int ring =
        std::max(1, int(std::lround(kBorderRing * std::min(changed.cols, changed.rows))));
    cv::Mat border(changed.size(), CV_8U, cv::Scalar(255));
    border(cv::Rect(ring, ring, changed.cols - 2 * ring, changed.rows - 2 * ring)) = 0;
    return cv::countNonZero(changed & border) >= kFillsBorder * cv::countNonZero(border);
}

double otsu_of(const cv::Mat& z) {
    // On a logarithmic scale, so that a corner that changes violently does not hide the rest.
    cv::Mat log, bytes;
    cv::log(z + 1, log);
    double most = 0;
    cv::minMaxLoc(log, nullptr, &most);
    if (!(most > 0)) return 0;
    log.convertTo(bytes, CV_8U, 255 / most);
    cv::Mat ignored;
    const double level = cv::threshold(bytes, ignored, 0, 255, cv::THRESH_BINARY | cv::THRESH_OTSU);
    return std::expm1(level * most / 255);
}

Mask to_mask(const cv::Mat& mat) {
    Mask mask(mat.cols, mat.rows);
    for (int y = 0; y < mat.rows; ++y) std::copy_n(mat.ptr(y), mat.cols, mask.row(y));
    return mask;
}
cv::Mat view_of(const Mask& mask) {
    return {mask.height(), mask.width(), CV_8U, const_cast<std::uint8_t*>(mask.row(0))};
}

double mean_change(const ChangeMap& map, const Mask& mask) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < map.change.size(); ++i) {
        if (mask.pixels()[i] == kInside) sum += double(map.change[i]), ++count;
    }
    return count > 0 ? sum / count : 0;
}

void whole_frame(SpecimenFinding& finding, SpecimenKind kind, const cv::Mat& z) {
    finding.kind = kind;
    finding.mask = Mask(z.cols, z.rows);
    for (auto& m : finding.mask.pixels()) m = kInside;
    finding.box = {0, 0, z.cols, z.rows};
    finding.area_share = 1;
}

}  // namespace

SpecimenFinding find_specimen(const Look& look) {
    ChangeMap map = change_map(look);
    SpecimenFinding finding;
    finding.gains = map.gains;
    finding.majority = map.majority;
    const cv::Mat z(map.height, map.width, CV_32F, map.z.data());
    const cv::Mat changed = z > kChanged;

    if (share_of(changed) >= kFillsShare && reaches_round(changed)) {
        whole_frame(finding, SpecimenKind::fills_frame, z);
        finding.change = mean_change(map, finding.mask);
        return finding;
    }
    const Mask cluster = specimen_cluster(map);
    const cv::Mat copper = view_of(map.copper) | view_of(cluster);
    const cv::Mat seed = changed | (copper & (z > kChangedCopper));
    // Otsu [Otsu1979] picks the parts that count; it does not shape them.
    const cv::Mat strong = z > std::max(double(kChanged), otsu_of(z));
    std::vector<Candidate> found = candidates(cleaned(seed), strong, z);
    merge_best(found);
    if (found.empty() || found.front().area < kStill * double(z.total())) {
        whole_frame(finding, SpecimenKind::still, z);
        finding.change = mean_change(map, finding.mask);
        return finding;
    }
    Candidate& best = found.front();
    if (found.size() > 1) finding.score_ratio = best.score / std::max(found[1].score, 1e-12);
    const std::vector<cv::Point> hull = hull_of(best.mask);
    if (best.area >= kConvex * area_of(hull)) {
        cv::fillConvexPoly(best.mask, hull, cv::Scalar(255));
    }
    finding.mask = to_mask(best.mask);
    finding.box = box_of(best.mask);
    finding.area_share = share_of(best.mask);
    finding.change = mean_change(map, finding.mask);
    const bool clear = found.size() == 1 || finding.score_ratio >= kClearWin;
    finding.kind =
        clear && finding.area_share >= kSmallest ? SpecimenKind::found : SpecimenKind::ambiguous;
    const Rect crop = crop_around(finding.box, look);
    if (clear && finding.area_share >= kFillsShare && crop.width == look.frame_width &&
        crop.height == look.frame_height) {
        const double share = finding.area_share;
        whole_frame(finding, SpecimenKind::fills_frame, z);
        finding.area_share = share;
    }
    return finding;
}

Rect crop_around(Rect box, const Look& look) {
    const double sx = double(look.frame_width) / look.frames[0].width();
    const double sy = double(look.frame_height) / look.frames[0].height();
    const double cx = (box.x + 0.5 * box.width) * sx, cy = (box.y + 0.5 * box.height) * sy;
    const double side = (1 + 2 * kPad) * std::max(box.width * sx, box.height * sy);
    const auto fit = [&](double center, int extent, int& start, int& length) {
        const int whole = std::max(2, extent / 2 * 2);  // even
        length = std::min(2 * int(std::lround(side / 2)), whole);
        start = std::clamp(int(std::lround(center - 0.5 * length)), 0, extent - length);
        if (length == whole && extent < side) length = extent, start = 0;  // the frame's extent
    };
    Rect crop;
    fit(cx, look.frame_width, crop.x, crop.width);
    fit(cy, look.frame_height, crop.y, crop.height);
    return crop;
}

CropReport crop_report(const SpecimenFinding& finding, const Look& look) {
    CropReport report;
    report.area_share = finding.area_share;
    report.score_ratio = finding.score_ratio;
    report.frame_width = look.frame_width;
    report.frame_height = look.frame_height;
    const Rect frame{0, 0, look.frame_width, look.frame_height};
    switch (finding.kind) {
        case SpecimenKind::fills_frame:
            report.rect = frame;
            report.fills_frame = true;
            report.sentence =
                "nearly everything in the frame changes, up to its border: the "
                "specimen fills the frame, which is used whole";
            break;
        case SpecimenKind::still:
            report.rect = frame;
            report.fills_frame = true;
            report.sentence =
                "nothing in the frame changes by more than the noise: the whole "
                "frame is used";
            break;
        case SpecimenKind::found:
            report.rect = crop_around(finding.box, look);
            report.sentence = fmt::format(
                "the specimen covers {:.0f} % of the frame and is cropped to {},{},{},{} "
                "(x,y,width,height)",
                100 * finding.area_share, report.rect.x, report.rect.y, report.rect.width,
                report.rect.height);
            break;
        case SpecimenKind::ambiguous:
            report.rect = crop_around(finding.box, look);
            report.sentence = fmt::format(
                "{}; say which part to use with --crop x,y,w,h; the best guess is {},{},{},{}",
                finding.area_share < kSmallest
                    ? fmt::format("what changes covers only {:.1f} % of the frame",
                                  100 * finding.area_share)
                    : "several parts of the frame change, and none stands out as the specimen",
                report.rect.x, report.rect.y, report.rect.width, report.rect.height);
            break;
    }
    return report;
}

Mask specimen_mask(const SpecimenFinding& finding, const Look& look, Rect rect, int width,
                   int height) {
    // Bilinear between the centers of the look's pixels, cut at one half.
    Mask mask(width, height);
    const double sx = double(finding.mask.width()) / look.frame_width;
    const double sy = double(finding.mask.height()) / look.frame_height;
    const auto value = [&](int x, int y) {
        x = std::clamp(x, 0, finding.mask.width() - 1);
        y = std::clamp(y, 0, finding.mask.height() - 1);
        return finding.mask(x, y) == kInside ? 1.0 : 0.0;
    };
    for (int y = 0; y < height; ++y) {
        const double v = (rect.y + (y + 0.5) * rect.height / height) * sy - 0.5;
        const int y0 = int(std::floor(v));
        for (int x = 0; x < width; ++x) {
            const double u = (rect.x + (x + 0.5) * rect.width / width) * sx - 0.5;
            const int x0 = int(std::floor(u));
            const double fx = u - x0, fy = v - y0;
            const double m = (1 - fy) * ((1 - fx) * value(x0, y0) + fx * value(x0 + 1, y0)) +
                             fy * ((1 - fx) * value(x0, y0 + 1) + fx * value(x0 + 1, y0 + 1));
            if (m >= 0.5) mask(x, y) = kInside;
        }
    }
    return mask;
}

}  // namespace verdigris
