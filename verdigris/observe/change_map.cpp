// SPDX-License-Identifier: MIT
#include "verdigris/observe/change_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "verdigris/color/convert.h"
#include "verdigris/observe/noise.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

constexpr int kEndLooks = 4;  // chosen: a median of four outvotes one bad frame
// Second differences need a few triples before their median means anything.
constexpr std::size_t kLooksForNoise = 6;
constexpr double kSigmaOverMad = 1.4826;
// chosen: half an 8-bit step. Compressed video repeats pixels exactly; its noise is not zero.
constexpr float kNoiseFloor = 0.5f / 255;
// chosen: bare and tarnishing copper has hues of 50..60 degrees; widened on both sides.
constexpr double kHueFrom = 25, kHueTo = 80, kChromaFrom = 10;
// chosen: with less than this share of other colors, the gain is measured on everything.
constexpr double kOtherColors = 0.1;

float median_of(float* begin, float* end) {
    float* middle = begin + (end - begin) / 2;
    std::nth_element(begin, middle, end);
    return *middle;
}
// For even counts the mean of the two middle values.
float even_median(float* begin, float* end) {
    const float upper = median_of(begin, end);
    if ((end - begin) % 2 == 1) return upper;
    return 0.5f * (upper + *std::max_element(begin, begin + (end - begin) / 2));
}

Image<SrgbF> median_frame(const std::vector<Image<SrgbF>>& frames, std::size_t begin,
                          std::size_t end) {
    Image<SrgbF> out(frames[0].width(), frames[0].height());
    parallel_rows(out.height(), 16, [&](RowRun run) {
        std::vector<float> values(end - begin);
        for (int y = run.begin; y < run.end; ++y) {
            for (int x = 0; x < out.width(); ++x) {
                for (auto c : {&SrgbF::r, &SrgbF::g, &SrgbF::b}) {
                    for (std::size_t i = begin; i < end; ++i) {
                        values[i - begin] = frames[i](x, y).*c;
                    }
                    out(x, y).*c = even_median(values.data(), values.data() + values.size());
                }
            }
        }
    });
    return out;
}

Mask copper_colored(const Image<SrgbF>& image) {
    Mask mask(image.width(), image.height());
    parallel_rows(image.height(), 16, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            for (int x = 0; x < image.width(); ++x) {
                const Lab lab = lab_from_srgb(image(x, y));
                const double hue = std::atan2(double(lab.b), double(lab.a)) * 180 / CV_PI;
                const double chroma = std::hypot(double(lab.a), double(lab.b));
                if (hue >= kHueFrom && hue <= kHueTo && chroma >= kChromaFrom) {
                    mask(x, y) = kInside;
                }
            }
        }
    });
    return mask;
}

// Positions t whose neighbors are about equally far away, and near: a second difference over a gap
// in the looks holds aging. Falls back to all where too few are left.
std::vector<std::size_t> even_triples(const std::vector<int>& index) {
    int shortest = std::numeric_limits<int>::max();
    for (std::size_t t = 1; t < index.size(); ++t) {
        shortest = std::min(shortest, index[t] - index[t - 1]);
    }
    std::vector<std::size_t> even, all;
    for (std::size_t t = 1; t + 1 < index.size(); ++t) {
        all.push_back(t);
        const int longer = std::max(index[t] - index[t - 1], index[t + 1] - index[t]);
        if (2 * longer <= 3 * shortest) even.push_back(t);
    }
    return even.size() >= 2 ? even : all;
}

// Per pixel, over time and channels: 1.4826 median |second difference| / sqrt(6).
std::vector<float> temporal_noise(const std::vector<Image<SrgbF>>& frames,
                                  const std::vector<int>& index) {
    const std::vector<std::size_t> triples = even_triples(index);
    const int width = frames[0].width(), height = frames[0].height();
    std::vector<float> sigma(frames[0].pixel_count());
    parallel_rows(height, 8, [&](RowRun run) {
        std::vector<float> values;
        for (int y = run.begin; y < run.end; ++y) {
            for (int x = 0; x < width; ++x) {
                values.clear();
                for (const std::size_t t : triples) {
                    const SrgbF a = frames[t - 1](x, y), b = frames[t](x, y),
                                c = frames[t + 1](x, y);
                    values.push_back(std::fabs(a.r - 2 * b.r + c.r));
                    values.push_back(std::fabs(a.g - 2 * b.g + c.g));
                    values.push_back(std::fabs(a.b - 2 * b.b + c.b));
                }
                sigma[std::size_t(y) * std::size_t(width) + std::size_t(x)] =
                    float(kSigmaOverMad / std::sqrt(6.0)) *
                    median_of(values.data(), values.data() + values.size());
            }
        }
    });
    return sigma;
}

}  // namespace

ChangeMap change_map(const Look& look) {
    const std::size_t count = look.frames.size();
    const std::size_t ends = std::min<std::size_t>(kEndLooks, std::max<std::size_t>(count / 2, 1));
    ChangeMap map;
    map.width = look.frames[0].width();
    map.height = look.frames[0].height();
    const std::size_t pixels = look.frames[0].pixel_count();

    // The gain is measured on what is not copper-colored, if there is enough of it: a specimen
    // that covers most of the frame must not pass for the unchanging majority.
    const Image<SrgbF> first = median_frame(look.frames, 0, ends);
    map.copper = copper_colored(first);
    Mask others(map.width, map.height);
    std::size_t other_pixels = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
        if (map.copper.pixels()[i] == kInside) continue;
        others.pixels()[i] = kInside;
        ++other_pixels;
    }
    map.majority = double(other_pixels) >= kOtherColors * double(pixels);
    if (!map.majority) others = Mask();

    std::vector<Image<SrgbF>> even(count);  // without the drift of exposure and white balance
    // Without such a majority the gain would be fitted on the specimen and its aging divided out:
    // light and aging cannot be told apart then, and all change counts. Nor can they before a
    // backdrop too dark or too bright to measure on.
    std::vector<std::optional<Gain>> measured(count);
    if (map.majority) {
        parallel_for(int(count), [&](int i) {
            const auto n = std::size_t(i);
            measured[n] = robust_gain(first, look.frames[n], others);
        });
        map.majority = std::all_of(measured.begin(), measured.end(),
                                   [](const auto& gain) { return gain.has_value(); });
    }
    map.gains.resize(count);
    parallel_for(int(count), [&](int i) {
        const auto n = std::size_t(i);
        if (map.majority) map.gains[n] = *measured[n];
        even[n] = Image<SrgbF>::for_overwrite(map.width, map.height);
        for (std::size_t p = 0; p < pixels; ++p) {
            even[n].pixels()[p] = apart_from(look.frames[n].pixels()[p], map.gains[n]);
        }
    });

    const Image<SrgbF> early = median_frame(even, 0, ends);
    const Image<SrgbF> late = median_frame(even, count - ends, count);
    std::vector<float> sigma;
    float typical = 0;
    if (count >= kLooksForNoise) {
        sigma = temporal_noise(even, look.index);
        std::vector<float> sorted = sigma;
        typical = median_of(sorted.data(), sorted.data() + sorted.size());
    } else {
        sigma.assign(pixels, 0.0f);
        typical = float(spatial_sigma(early, {}));
    }
    typical = std::max(typical, kNoiseFloor);

    map.change.resize(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        const SrgbF a = early.pixels()[i], b = late.pixels()[i];
        map.change[i] = (std::fabs(a.r - b.r) + std::fabs(a.g - b.g) + std::fabs(a.b - b.b)) / 3;
    }
    const cv::Mat change(map.height, map.width, CV_32F, map.change.data());
    cv::Mat smooth;
    cv::medianBlur(change, smooth, 3);
    smooth = smooth.reshape(1, 1);
    map.z.resize(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        map.z[i] = smooth.at<float>(int(i)) / std::max(sigma[i], typical);
    }
    map.early = early.clone();
    return map;
}

}  // namespace verdigris
