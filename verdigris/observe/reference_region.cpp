// SPDX-License-Identifier: MIT
#include "verdigris/observe/reference_region.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "verdigris/color/convert.h"
#include "verdigris/error.h"
#include "verdigris/observe/noise.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

// chosen: gray cards and walls under a tinted lamp stay below a chroma of 8; copper starts at 10
// (change_map.cpp). Darker than L* 8 a ratio is mostly noise; above 95 the curve saturates.
constexpr double kChroma = 8, kDarkest = 8, kLightest = 95;

Mask neutral(const Image<SrgbF>& image) {
    Mask mask(image.width(), image.height());
    parallel_rows(image.height(), 16, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            for (int x = 0; x < image.width(); ++x) {
                const SrgbF c = image(x, y);
                if (std::max({c.r, c.g, c.b}) > kSaturated) continue;
                const Lab lab = lab_from_srgb(c);
                const double l = double(lab.l);
                if (l > kDarkest && l < kLightest &&
                    std::hypot(double(lab.a), double(lab.b)) < kChroma) {
                    mask(x, y) = kInside;
                }
            }
        }
    });
    return mask;
}

cv::Mat view_of(const Mask& mask) {
    return {mask.height(), mask.width(), CV_8U, const_cast<std::uint8_t*>(mask.row(0))};
}

cv::Mat disc(double radius) {
    const int r = std::max(1, int(std::lround(radius)));
    return cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * r + 1, 2 * r + 1});
}

// The border of the picture is no edge of the backdrop: OpenCV's default lets neither operation
// come in from there.
Mask region_of(const Mask& neutral_pixels, const Mask& specimen, const ReferenceOptions& options,
               double margin) {
    const int side = std::min(specimen.width(), specimen.height());
    cv::Mat grown, region = view_of(neutral_pixels).clone();
    cv::dilate(view_of(specimen), grown, disc(margin * options.distance * side));
    region.setTo(0, grown);
    cv::erode(region, region, disc(margin * options.erosion * side));
    cv::Mat labels, stats, centers;
    const int count = cv::connectedComponentsWithStats(region, labels, stats, centers, 8, CV_32S);
    const double smallest = options.smallest_part * double(specimen.pixel_count());
    Mask mask(specimen.width(), specimen.height());
    std::vector<bool> keep(std::size_t(std::max(count, 1)));
    for (int k = 1; k < count; ++k) {
        keep[std::size_t(k)] = stats.at<int>(k, cv::CC_STAT_AREA) >= smallest;
    }
    for (int y = 0; y < mask.height(); ++y) {
        const int* label = labels.ptr<int>(y);
        for (int x = 0; x < mask.width(); ++x) {
            mask(x, y) = keep[std::size_t(label[x])] ? kInside : 0;
        }
    }
    return mask;
}

std::int64_t count_of(const Mask& mask) {
    return std::count(mask.pixels().begin(), mask.pixels().end(), kInside);
}

void check(const SampleStore& samples, const Mask& specimen, const ReferenceOptions& options) {
    if (samples.count() < 1) {
        throw Error(ErrorCode::usage, "a reference region needs at least one sample");
    }
    if (!specimen.same_size(samples.width(), samples.height())) {
        throw Error(ErrorCode::usage, "the specimen's mask and the samples differ in size");
    }
    const auto share = [](double v) { return v >= 0 && v <= 1; };
    if (options.first_samples < 1 || !share(options.distance) || !share(options.erosion) ||
        !share(options.smallest_part) || !share(options.share_of_small) || options.pixels < 1) {
        throw Error(ErrorCode::usage,
                    "a reference region takes 1 sample or more, 1 pixel or more, and shares "
                    "between 0 and 1");
    }
}

}  // namespace

Image<SrgbF> median_of_first(const SampleStore& samples, int count) {
    const int n = std::clamp(count, 1, std::max(samples.count(), 1));
    std::vector<Image<SrgbU16>> held(static_cast<std::size_t>(n));
    parallel_for(n, [&](int i) {
        const Image<SrgbF> image = samples.image(i);
        Image<SrgbU16> codes = Image<SrgbU16>::for_overwrite(image.width(), image.height());
        std::transform(image.pixels().begin(), image.pixels().end(), codes.pixels().begin(),
                       [](SrgbF c) { return u16_from_srgb(c); });
        held[std::size_t(i)] = std::move(codes);
    });
    Image<SrgbF> out = Image<SrgbF>::for_overwrite(samples.width(), samples.height());
    parallel_rows(out.height(), 8, [&](RowRun run) {
        std::vector<std::uint16_t> values(held.size());
        const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
        const auto median = [&](int x, int y, std::uint16_t SrgbU16::*c) {
            for (std::size_t i = 0; i < held.size(); ++i) values[i] = held[i](x, y).*c;
            std::nth_element(values.begin(), middle, values.end());
            const float upper = *middle;
            if (values.size() % 2 == 1) return upper / 65535.0f;
            return 0.5f * (upper + float(*std::max_element(values.begin(), middle))) / 65535.0f;
        };
        for (int y = run.begin; y < run.end; ++y) {
            for (int x = 0; x < out.width(); ++x) {
                out(x, y) = {median(x, y, &SrgbU16::r), median(x, y, &SrgbU16::g),
                             median(x, y, &SrgbU16::b)};
            }
        }
    });
    return out;
}

ReferenceRegion find_reference_region(const SampleStore& samples, const Mask& specimen,
                                      const ReferenceOptions& options) {
    check(samples, specimen, options);
    const Mask candidates = neutral(median_of_first(samples, options.first_samples));
    const double all = double(specimen.pixel_count());
    const auto needed = std::max<std::int64_t>(
        1, std::min(options.pixels, std::int64_t(options.share_of_small * all)));
    ReferenceRegion region;
    for (const double margin : {1.0, 0.5, 0.25}) {
        Mask mask = region_of(candidates, specimen, options, margin);
        const std::int64_t pixels = count_of(mask);
        if (pixels < needed) continue;
        region.mask = std::move(mask);
        region.pixels = pixels;
        region.margin = margin;
        region.sentence = fmt::format("the backdrop serves as reference: {:.1f} % of the picture",
                                      100 * double(pixels) / all);
        if (margin < 1) {
            region.sentence += fmt::format(
                ", at {:.0f} % of the usual distance from the specimen, whose light may tint it",
                100 * margin);
        }
        return region;
    }
    region.sentence = fmt::format(
        "no reference region: less than {} pixels look neutral (a gray backdrop, neither black nor "
        "overexposed) away from the specimen; observe with more of the frame (--crop) if it shows "
        "one",
        needed);
    return region;
}

}  // namespace verdigris
