// SPDX-License-Identifier: MIT
#include "verdigris/forecast/guards.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "verdigris/error.h"
#include "verdigris/forecast/color_reversal.h"
#include "verdigris/forecast/context_pixels.h"

namespace verdigris {
namespace {

constexpr double kTrustedContexts = 2;   // horizons up to 2 n: chosen, see docs/models
constexpr double kMaxOutOfGamut = 0.01;  // chosen: one pixel in a hundred is seen
constexpr double kMaxClipped = 0.20;     // chosen: a fifth of the specimen has no measured color
// derived: tau covers |frame - median of 5| at 99.9 %, of standard deviation 1.13 sigma; the
// difference of two single frames has 1.41 sigma.
constexpr double kTwoFrames = 1.25;
constexpr double kStillShare = 0.01;    // chosen: ten times the share noise alone puts over it
constexpr double kExposureStep = 0.02;  // chosen: 2 % of brightness in one step, about what is seen
constexpr double kUnusualStep = 4;      // chosen: times the median step of the backdrop
constexpr double kTogether = 0.5;       // chosen: the specimen takes at least half of the step
constexpr double kMinBackdropShare = 0.02;  // chosen: of the frame, or there is no backdrop
// chosen: half a percent over a context of 10 is 5 % over a recording of 100 units, where observe/
// calls a drift of the light visible; and a trend is one from four standard errors on.
constexpr double kLightRamp = 0.005, kClearTrend = 4;

std::string percent(double share) {
    const double p = 100 * share;
    return p < 10 ? fmt::format("{:.1f} %", p) : fmt::format("{:.0f} %", p);
}

std::string frames_word(int n) {
    return n == 1 ? "1 frame" : fmt::format("{} frames", n);
}

std::optional<Status> few_frames(const Context& context) {
    if (context.length() >= kMinContext) return {};
    return Status{
        "few_frames", Severity::refusal,
        fmt::format("The context has only {}; below {} the fit is worse than doing nothing. "
                    "Raise --context or record more; --force goes on all the same.",
                    frames_word(context.length()), kMinContext)};
}

std::optional<Status> long_horizon(const Context& context, const Forecast& forecast,
                                   const std::vector<double>& horizons) {
    const double limit = kTrustedContexts * context.length();
    std::vector<std::string> beyond;
    double nearest = 1e9;
    for (double h : horizons) {
        if (h <= limit) continue;
        beyond.push_back(fmt::format("+{}", h));
        nearest = std::min(nearest, h);
    }
    if (beyond.empty()) return {};
    const bool one = beyond.size() == 1;
    const std::string where =
        fmt::format("{} {} beyond +{}, twice the context of {} frames", fmt::join(beyond, ", "),
                    one ? "lies" : "lie", limit, context.length());
    if (forecast.is_trajectory() && forecast.trajectory.law.order == 0) {
        return Status{"long_horizon", Severity::caution,
                      where +
                          ": the surface is shown as it was last seen, and nothing observed "
                          "says that it stays so for that long."};
    }
    const TimeLaw* law = forecast.is_trajectory() ? &forecast.trajectory.law : nullptr;
    if (law && law->tabulated() && law->nodes.back().horizon <= nearest) {
        return Status{
            "long_horizon", Severity::caution,
            fmt::format("{}: the forecast stands still from +{:.0f} on, so {} what +{:.0f} "
                        "shows, and nothing observed says that it stays so for that long.",
                        where, law->nodes.back().horizon, one ? "it shows" : "they show",
                        law->nodes.back().horizon)};
    }
    return Status{"long_horizon", Severity::caution,
                  fmt::format("{}: the drift was not measured over such a span, so read {} as a "
                              "direction, not as a prediction.",
                              where, one ? "it" : "them")};
}

std::optional<Status> color_reversal(const Context& context) {
    const std::vector<Reversal> reversals = find_reversals(context);
    if (reversals.empty()) return {};
    constexpr std::array<const char*, 3> kNames{"red", "green", "blue"};
    std::vector<std::string> parts;
    for (const Reversal& r : reversals) {
        parts.push_back(fmt::format(
            "{} {} until about frame {:.0f} of {} and then {} again (in {})",
            kNames[std::size_t(r.channel)], r.turn.rises_first ? "rose" : "fell", r.turn.at + 1,
            context.length(), r.turn.rises_first ? "fell" : "rose",
            r.share > 0.001 ? percent(r.share) + " of the specimen" : "the specimen's mean"));
    }
    return Status{"color_reversal", Severity::caution,
                  fmt::format("The color turned around while it was observed: {}. A drift fitted "
                              "through the turn averages both directions; forecast from the "
                              "frames after the turn only.",
                              fmt::join(parts, "; "))};
}

bool outside(SrgbF c) {
    const auto out = [](float v) { return !(v >= 0 && v <= 1); };
    return out(c.r) || out(c.g) || out(c.b);
}

double share_outside(const Forecast& forecast, double horizon, const Mask& where) {
    if (forecast.is_trajectory()) return out_of_gamut_share(forecast.trajectory, horizon, where);
    const Image<SrgbF> frame = forecast.at(horizon);
    std::int64_t count = 0, all = 0;
    for (std::size_t i = 0; i < frame.pixel_count(); ++i) {
        if (where.pixels()[i] == 0) continue;
        ++all;
        count += outside(frame.pixels()[i]);
    }
    return all == 0 ? 0 : double(count) / double(all);
}

std::optional<Status> out_of_gamut(const Forecast& forecast, const Mask& moving,
                                   const std::vector<double>& horizons) {
    std::vector<std::string> parts;
    for (double h : horizons) {
        const double share = share_outside(forecast, h, moving);
        if (share > kMaxOutOfGamut)
            parts.push_back(fmt::format("{} of the specimen at +{}", percent(share), h));
    }
    if (parts.empty()) return {};
    const bool held = forecast.is_trajectory() && forecast.trajectory.clamp;
    return Status{
        "out_of_gamut", Severity::caution,
        fmt::format("The drift carries {} past black or white; {}", fmt::join(parts, ", "),
                    held ? "there each pixel was frozen at the last color it could have, "
                           "so its later age is understated."
                         : "those colors do not exist and will be cut off on display.")};
}

std::optional<Status> mostly_clipped(const Context& context) {
    if (context.clipped.empty()) return {};
    std::int64_t specimen = 0, clipped = 0;
    for (std::size_t i = 0; i < context.clipped.pixel_count(); ++i) {
        if (!context.specimen.empty() && context.specimen.pixels()[i] == 0) continue;
        ++specimen;
        clipped += context.clipped.pixels()[i] != 0;
    }
    if (specimen == 0 || double(clipped) <= kMaxClipped * double(specimen)) return {};
    return Status{"mostly_clipped", Severity::caution,
                  fmt::format("{} of the specimen was saturated in some observed frame, or lies "
                              "beside a pixel that was (a glint, or pure black), and is left as it "
                              "is. Move the light, or expose less.",
                              percent(double(clipped) / double(specimen)))};
}

std::optional<Status> no_change(const Context& context, const Mask& moving) {
    if (context.length() < 2) return {};
    const auto first = context.frames.front().pixels(), last = context.frames.back().pixels();
    const double limit = kTwoFrames * context.tau;
    std::int64_t all = 0, moved = 0;
    for (std::size_t i = 0; i < first.size(); ++i) {
        if (moving.pixels()[i] == 0) continue;
        ++all;
        const double change = (std::abs(double(last[i].r) - double(first[i].r)) +
                               std::abs(double(last[i].g) - double(first[i].g)) +
                               std::abs(double(last[i].b) - double(first[i].b))) /
                              3;
        moved += change > limit;
    }
    if (all == 0 || double(moved) > kStillShare * double(all)) return {};
    return Status{"no_change", Severity::info,
                  fmt::format("Between the first and the last of the {} observed frames the "
                              "pixels of the specimen changed by less than their noise; only the "
                              "mean over many of them can show aging here.",
                              context.length())};
}

/// log of the mean brightness per frame, of the pixels inside.
std::vector<double> log_brightness(const Context& context, const Mask& inside) {
    std::vector<double> out;
    for (const Image<SrgbF>& frame : context.frames) {
        double sum = 0, count = 0;
        for (std::size_t i = 0; i < frame.pixel_count(); ++i) {
            if (inside.pixels()[i] == 0) continue;
            const SrgbF c = frame.pixels()[i];
            sum += (double(c.r) + double(c.g) + double(c.b)) / 3;
            ++count;
        }
        out.push_back(std::log(std::max(sum / count, 1e-4)));  // chosen: far below one code value
    }
    return out;
}

std::vector<double> steps_of(const std::vector<double>& series) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < series.size(); ++i) steps.push_back(series[i] - series[i - 1]);
    return steps;
}

double median(std::vector<double> v) {
    const auto middle = v.begin() + std::ptrdiff_t(v.size() / 2);
    std::nth_element(v.begin(), middle, v.end());
    return *middle;
}

/// log brightness per frame of what is and of what is not specimen.
struct Brightness {
    std::vector<double> metal, behind;
};

/// Nothing if the context is too short, or shows no backdrop or no specimen to compare.
std::optional<Brightness> brightness_of(const Context& context, const Mask& moving) {
    if (context.length() < 3 || context.specimen.empty()) return {};
    Mask backdrop = fit_mask(context, FitPixels::all);
    for (std::size_t i = 0; i < backdrop.pixel_count(); ++i) {
        if (context.specimen.pixels()[i] != 0) backdrop.pixels()[i] = 0;
    }
    const double frame = double(backdrop.pixel_count());
    if (double(count_inside(backdrop)) < kMinBackdropShare * frame) return {};
    if (count_inside(moving) == 0) return {};
    return Brightness{log_brightness(context, moving), log_brightness(context, backdrop)};
}

std::optional<Status> exposure_jump(const Context& context, const Brightness& brightness) {
    const auto behind = steps_of(brightness.behind), metal = steps_of(brightness.metal);
    std::vector<double> sizes;
    for (double s : behind) sizes.push_back(std::abs(s));
    const double usual_size = median(sizes), usual_metal = median(metal);
    std::size_t worst = 0;
    bool found = false;
    for (std::size_t i = 0; i < behind.size(); ++i) {
        const double unusual = metal[i] - usual_metal;
        const bool jumps = std::abs(behind[i]) > std::max(kExposureStep, kUnusualStep * usual_size);
        const bool together =
            unusual * behind[i] > 0 && std::abs(unusual) >= kTogether * std::abs(behind[i]);
        if (jumps && together && (!found || std::abs(behind[i]) > std::abs(behind[worst]))) {
            worst = i;
            found = true;
        }
    }
    if (!found) return {};
    return Status{"exposure_jump", Severity::caution,
                  fmt::format("Between frames {} and {} of {} specimen and backdrop got {} {} "
                              "together: the camera changed its exposure, not the metal. Lock "
                              "exposure and white balance, or correct the drift while observing.",
                              worst + 1, worst + 2, context.length(),
                              percent(std::abs(std::expm1(behind[worst]))),
                              behind[worst] > 0 ? "brighter" : "darker")};
}

/// A straight line through a series: its rise from the first to the last value, and how sure.
struct Trend {
    double rise = 0, standard_error = 0;
};
Trend trend_of(const std::vector<double>& y) {
    const double n = double(y.size()), center = (n - 1) / 2;
    double mean = 0, sxx = 0, sxy = 0, residual = 0;
    for (double v : y) mean += v / n;
    for (std::size_t i = 0; i < y.size(); ++i) {
        sxx += (double(i) - center) * (double(i) - center);
        sxy += (double(i) - center) * (y[i] - mean);
    }
    const double slope = sxy / sxx;
    for (std::size_t i = 0; i < y.size(); ++i) {
        const double r = y[i] - mean - slope * (double(i) - center);
        residual += r * r;
    }
    return {slope * (n - 1), std::sqrt(residual / (n - 2) / sxx) * (n - 1)};
}

/// What moves backdrop and specimen alike is continued by every forecaster as if it were aging.
std::optional<Status> light_ramp(const Context& context, const Brightness& brightness) {
    if (context.length() < kMinContext) return {};
    const Trend behind = trend_of(brightness.behind), metal = trend_of(brightness.metal);
    const bool clear = std::abs(behind.rise) > kLightRamp &&
                       std::abs(behind.rise) > kClearTrend * behind.standard_error;
    const bool together =
        behind.rise * metal.rise > 0 && std::abs(behind.rise) >= kTogether * std::abs(metal.rise);
    if (!clear || !together) return {};
    const char* direction = behind.rise > 0 ? "brighter" : "darker";
    return Status{
        "light_ramp", Severity::caution,
        fmt::format("Over the {} observed frames the backdrop moves with the specimen: it gets {} "
                    "{}, the specimen {}. This may be the light, not the copper, and a forecast "
                    "goes on with it. Keep lamp and exposure fixed.",
                    context.length(), percent(std::abs(std::expm1(behind.rise))), direction,
                    percent(std::abs(std::expm1(metal.rise))))};
}

}  // namespace

Statuses check_guards(const Context& context, const Forecast& forecast,
                      const std::vector<double>& horizons) {
    check_context(context);
    const Mask moving = moving_mask(context);
    Statuses found;
    const auto add = [&found](std::optional<Status> status) {
        if (status) found.push_back(std::move(*status));
    };
    add(few_frames(context));
    add(no_change(context, moving));
    add(color_reversal(context));
    if (const auto brightness = brightness_of(context, moving)) {
        auto jump = exposure_jump(context, *brightness);
        // A step is a slope too: one of the two sentences is enough.
        if (!jump) add(light_ramp(context, *brightness));
        add(std::move(jump));
    }
    add(mostly_clipped(context));
    add(long_horizon(context, forecast, horizons));
    add(out_of_gamut(forecast, moving, horizons));
    return found;
}

void refuse_if_needed(const Statuses& guards) {
    for (const Status& status : guards) {
        if (status.severity == Severity::refusal) {
            throw Error(ErrorCode::refused, status.sentence);
        }
    }
}

}  // namespace verdigris
