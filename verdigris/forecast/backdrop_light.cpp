// SPDX-License-Identifier: MIT
#include "verdigris/forecast/backdrop_light.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "verdigris/color/convert.h"
#include "verdigris/forecast/context_noise.h"
#include "verdigris/forecast/context_pixels.h"
#include "verdigris/forecast/increments.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

constexpr std::int64_t kFewestPixels = 200;  // chosen: a median of fewer is noise
constexpr std::int64_t kMostPixels = 20000;  // chosen: more say little more
// Encoded. chosen: L* 8, as where the reference region is looked for: darker ratios are noise; and
// of a single channel of a colored backdrop, less will do.
constexpr float kDarkest = 0.094f, kDarkestChannel = 0.026f;
// Linear, added to both sides of a ratio: none is infinite, and the median of noise stays 1.
constexpr float kFloor = 1e-4f;
// chosen: of the shorter side, kept from the specimen: the least that the reference region keeps.
// The edge of a mask is off by a pixel or two, and what it leaves out ages.
constexpr double kDistance = 0.015;
// chosen: of the backdrop, what has to stay as it was for that which moved to be no light; and how
// much more the specimen has to differ under the light than without.
constexpr double kStayed = 0.05, kWorse = 4;
// chosen: odds that the specimen does not have all of the light of the backdrop; how much of it it
// can have; and what is noise in the log of a light.
constexpr double kShareOdds = 0.3, kMostShare = 1.5, kLightNoise = 2e-4;
constexpr double kSmall = 0.02;  // log of a gain that is not worth the question
constexpr std::int64_t kGlance = 2000;
constexpr double kGray = 1.0 / 7;  // chosen
constexpr int kTable = 1024;

/// `out` is 1 where any of `in` within `reach` is not 0; `count` values, `stride` apart.
void grow(const std::uint8_t* in, std::uint8_t* out, int count, int stride, int reach) {
    int last = -reach - 1, next = 0;  // the nearest before, and where to look on for one after
    for (int i = 0; i < count; ++i) {
        for (; next < std::min(i + reach + 1, count); ++next)
            if (in[std::ptrdiff_t(next) * stride] != 0) last = next;
        out[std::ptrdiff_t(i) * stride] = last >= i - reach;
    }
}

/// What is said to be backdrop, or else what is not specimen, at some distance from the rest.
Mask backdrop(const Context& context) {
    const bool said = !context.backdrop.empty();
    const Mask& known = said ? context.backdrop : context.specimen;
    const int width = known.width(), height = known.height();
    const int reach = int(std::ceil(kDistance * std::min(width, height)));
    Mask other(width, height), across(width, height);
    for (std::size_t i = 0; i < other.pixels().size(); ++i)
        other.pixels()[i] = (known.pixels()[i] != 0) != said;
    parallel_rows(height, 32, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y)
            grow(other.row(y), across.row(y), width, 1, reach);
    });
    parallel_for(width,
                 [&](int x) { grow(across.row(0) + x, other.row(0) + x, height, width, reach); });
    Mask mask = fit_mask(context, FitPixels::all);
    for (std::size_t i = 0; i < mask.pixels().size(); ++i)
        if (other.pixels()[i] != 0) mask.pixels()[i] = 0;
    return mask;
}

float channel(const SrgbF& c, int k) {
    return k == 0 ? c.r : k == 1 ? c.g : c.b;
}

/// Mean over frames: to ask a single frame would prefer the pixels that its noise made brighter.
SrgbF mean_at(const Context& context, std::size_t at) {
    SrgbF sum{};
    for (const Image<SrgbF>& frame : context.frames) {
        const SrgbF c = frame.pixels()[at];
        sum = {sum.r + c.r, sum.g + c.g, sum.b + c.b};
    }
    const float share = 1 / float(context.frames.size());
    return {share * sum.r, share * sum.g, share * sum.b};
}

/// Some of the pixels inside a mask, those that are too dark left out.
std::vector<std::size_t> lit_pixels(const Context& context, const Mask& inside) {
    std::vector<std::size_t> pixels = sample_inside(inside, kMostPixels);
    std::erase_if(pixels, [&](std::size_t at) {
        const SrgbF c = mean_at(context, at);
        return c.r + c.g + c.b < 3 * kDarkest;
    });
    return pixels;
}

LightGains median_light(const Context& context, const std::vector<std::size_t>& sampled) {
    LightGains light(context.frames.size(), {1, 1, 1});
    std::array<std::vector<std::size_t>, 3> pixels;
    for (const std::size_t at : sampled) {
        const SrgbF c = mean_at(context, at);
        for (int k = 0; k < 3; ++k)
            if (channel(c, k) > kDarkestChannel) pixels[std::size_t(k)].push_back(at);
    }
    const auto linear = [&](const Image<SrgbF>& frame, std::size_t k) {
        std::vector<float> out;
        for (const std::size_t at : pixels[k])
            out.push_back(kFloor + linear_from_srgb(channel(frame.pixels()[at], int(k))));
        return out;
    };
    std::array<std::vector<float>, 3> last;
    parallel_for(
        3, [&](int k) { last[std::size_t(k)] = linear(context.frames.back(), std::size_t(k)); });
    parallel_for(3 * (int(context.frames.size()) - 1), [&](int job) {
        const auto i = std::size_t(job / 3), k = std::size_t(job % 3);
        if (std::int64_t(pixels[k].size()) < kFewestPixels) return;
        std::vector<float> ratios = linear(context.frames[i], k);
        for (std::size_t at = 0; at < ratios.size(); ++at) ratios[at] = last[k][at] / ratios[at];
        const auto middle = ratios.begin() + std::ptrdiff_t(ratios.size() / 2);
        std::nth_element(ratios.begin(), middle, ratios.end());
        if (*middle > 0) light[i][k] = double(*middle);
    });
    return light;
}

double gray_log(const std::array<double, 3>& gain) {
    return (std::log(gain[0]) + std::log(gain[1]) + std::log(gain[2])) / 3;
}

/// Of the gain that a frame is to be brought under the last one's light with: is it something that
/// stands before most of the backdrop? Then the rest of the backdrop stays as it was, and the
/// specimen does, too. Neither is so where light changes, or an exposure that follows the specimen.
bool stands_before(const Context& context, std::size_t frame, const std::array<double, 3>& gain,
                   const std::vector<std::size_t>& backdrop, const Mask& specimen) {
    const auto gray = [](const SrgbF& c) {
        return linear_from_srgb(c.r) + linear_from_srgb(c.g) + linear_from_srgb(c.b) + 3 * kFloor;
    };
    const Image<SrgbF>&now = context.frames[frame], &last = context.frames.back();
    const double half = std::abs(gray_log(gain)) / 2;
    if (half < kSmall / 2) return false;
    std::size_t stayed = 0;
    for (const std::size_t at : backdrop) {
        const float ratio = gray(last.pixels()[at]) / gray(now.pixels()[at]);
        stayed += std::abs(std::log(double(ratio))) < half;
    }
    if (double(stayed) < kStayed * double(backdrop.size())) return false;
    return mean_square_difference(relit(now, gain), last, specimen) >
           kWorse * mean_square_difference(now, last, specimen);
}

/// How much of what the light does to the backdrop it does to the specimen. A window that lights
/// the wall behind and a lamp that lights the plate, a table that dries: then less than 1. From how
/// both fluctuate about their means, by least squares, and 1 as far as that does as well.
double share_of_light(const LightGains& backdrop, const LightGains& specimen) {
    const auto q = Eigen::Index(backdrop.size()) - 1;
    if (q < 3) return 1;
    Eigen::ArrayXd b(q), s(q);
    for (Eigen::Index i = 0; i < q; ++i) {
        const auto at = std::size_t(i);
        b[i] = gray_log(backdrop[at]) - gray_log(backdrop[at + 1]);
        s[i] = gray_log(specimen[at]) - gray_log(specimen[at + 1]);
    }
    b -= b.mean();
    s -= s.mean();
    const double bb = b.square().sum();
    if (!(bb > 0)) return 1;
    const double share = (b * s).sum() / bb, noise = double(q) * kLightNoise * kLightNoise;
    const double with_all = (s - b).square().sum() + noise,
                 with_share = (s - share * b).square().sum() + noise;
    // As is the evidence of two Gaussian models whose variance is fitted.
    const double odds = kShareOdds * std::pow(with_all / with_share, 0.5 * double(q - 2));
    return std::clamp(1 + (share - 1) * odds / (1 + odds), 0.0, kMostShare);
}

/// One gain for all channels, as light and exposure have it and copper has not: channels differ by
/// at most this share of the largest change.
bool is_gray(const LightGains& light, double share) {
    double largest = 0, apart = 0;
    for (const auto& gain : light) {
        const double r = std::log(gain[0]), g = std::log(gain[1]), b = std::log(gain[2]);
        largest = std::max(largest, std::abs(r + g + b) / 3);
        apart = std::max(apart, std::max({r, g, b}) - std::min({r, g, b}));
    }
    return largest > 0 && apart <= share * largest;
}

/// Do frames under this light differ by their noise alone, and as they are by more?
bool explains_all(const Context& context, const LightGains& light, const Mask& inside) {
    const double sigma =
        context.sigma > 0 ? context.sigma : context_noise(context.frames, inside, 1e-3);
    const double noise = 2 * sigma * sigma;
    double as_it_is = 0, under_it = 0;
    for (std::size_t i = 0; i + 1 < context.frames.size(); ++i) {
        const auto& last = context.frames.back();
        as_it_is = std::max(as_it_is, mean_square_difference(context.frames[i], last, inside));
        under_it = std::max(
            under_it, mean_square_difference(relit(context.frames[i], light[i]), last, inside));
    }
    // chosen: half as much again, for noise that is not known better.
    return under_it <= 1.5 * noise && as_it_is > 1.5 * noise;
}

}  // namespace

bool shows_light(const Context& context) {
    if (context.specimen.empty() && context.backdrop.empty()) return false;
    return std::int64_t(lit_pixels(context, backdrop(context)).size()) >= kFewestPixels;
}

LightGains backdrop_light(const Context& context) {
    const LightGains none(context.frames.size(), {1, 1, 1});
    if (!context.specimen.empty() || !context.backdrop.empty()) {
        const auto pixels = lit_pixels(context, backdrop(context));
        if (std::int64_t(pixels.size()) >= kFewestPixels) {
            LightGains light = median_light(context, pixels);
            const Mask specimen = specimen_of(context);
            for (std::size_t i = 0; i + 1 < light.size(); ++i)
                if (stands_before(context, i, light[i], pixels, specimen)) light[i] = {1, 1, 1};
            const auto seen_on = sample_inside(specimen, kMostPixels);
            if (std::int64_t(seen_on.size()) < kFewestPixels) return light;
            const double share = share_of_light(light, median_light(context, seen_on));
            for (auto& gain : light)
                for (double& g : gain) g = std::pow(g, share);
            return light;
        }
    }
    const Mask all = fit_mask(context, FitPixels::all);
    const auto pixels = sample_inside(all, kMostPixels);
    if (std::int64_t(pixels.size()) < kFewestPixels) return none;
    // Hardly any picture is like that, and a glance shows it.
    if (!is_gray(median_light(context, sample_inside(all, kGlance)), 2 * kGray)) return none;
    LightGains light = median_light(context, pixels);
    return is_gray(light, kGray) && explains_all(context, light, all) ? light : none;
}

Image<SrgbF> relit(const Image<SrgbF>& frame, const std::array<double, 3>& gain) {
    // By a table: the curve is smooth, and two powers per channel would cost more than all else.
    if (gain == std::array<double, 3>{1, 1, 1}) return frame.clone();
    std::array<std::vector<float>, 3> factor;
    for (std::size_t k = 0; k < 3; ++k) {
        for (int i = 0; i <= kTable; ++i) {
            const float v = std::max(float(i) / float(kTable), 1e-4f);
            factor[k].push_back(srgb_from_linear(linear_from_srgb(v) * float(gain[k])) / v);
        }
    }
    const auto changed = [&](float v, std::size_t k) {
        const float at = std::clamp(v, 0.0f, 1.0f) * float(kTable);
        const int i = std::min(int(at), kTable - 1);
        const float a = factor[k][std::size_t(i)], b = factor[k][std::size_t(i) + 1];
        return v * (a + (at - float(i)) * (b - a));
    };
    Image<SrgbF> out = Image<SrgbF>::for_overwrite(frame.width(), frame.height());
    parallel_rows(frame.height(), 32, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            const SrgbF* from = frame.row(y);
            SrgbF* to = out.row(y);
            for (int x = 0; x < frame.width(); ++x)
                to[x] = {changed(from[x].r, 0), changed(from[x].g, 1), changed(from[x].b, 2)};
        }
    });
    return out;
}

}  // namespace verdigris
