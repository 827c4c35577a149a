// SPDX-License-Identifier: MIT
#include "verdigris/forecast/capture_advice.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "verdigris/forecast/backdrop_light.h"
#include "verdigris/forecast/band_method.h"
#include "verdigris/forecast/band_spread.h"
#include "verdigris/forecast/context_pixels.h"
#include "verdigris/forecast/trend_outlook.h"

namespace verdigris {
namespace {

constexpr int kFewest = 5;                    // the least that a forecast wants
constexpr double kUsualContext = 10;          // of `age`
constexpr double kInvisible = 0.5 / 255;      // chosen: half an 8-bit step
constexpr double kLonger = 3;                 // chosen: four times as long is as far as is looked
constexpr double kHardly = 0.8;               // chosen: less is not worth waiting for
constexpr double kMostly = 0.5, kMuch = 0.3;  // chosen: shares worth a sentence
// More units: coarse, because that is how well it is known (docs/RESULTS.md, capture advice).
constexpr std::array kMore{5., 7., 10., 15., 20., 30., 50., 70., 100., 150., 200., 300.};

/// What the forecaster expects to be off by, component by component.
class Outlook {
  public:
    Outlook(const Components& components, int increments, double recorded, double doubt)
        : increments_(increments), recorded_(recorded), models_(doubt) {
        for (const Component& c : components.all) {
            const double told = (c.trend.error + withheld(c)).head(kOutlookUnits).mean();
            if (c.light) {
                light_ += told;
                continue;
            }
            const double known = models_.expected_error(c.trend, {increments, 0, 1});
            parts_.push_back({&c.trend, std::max(0.0, told - frame_noise(c.trend) - known)});
        }
    }
    /// Mean squares. Of light: how it goes on is not known better for having been watched longer;
    /// in trials that was closer than any fall of it (docs/RESULTS.md, capture advice).
    double light() const { return light_; }
    /// Of all else, where nothing of it was for want of frames or for their noise.
    double unforeseen() { return known({kLongestContext - 1, 0, 0}); }
    /// Of everything. What is not sure yet becomes so as the variance of a mean does. Later on
    /// there is less change to miss: half as the models saw it slow down, half as layers that grow
    /// by diffusion through themselves do, with the square root of their age. Either alone was
    /// farther off on seed 701 of the simulated presets and on real copper and clay.
    double error(const Circumstances& c) {
        double sum = light_;
        for (const Part& p : parts_) {
            const double now = models_.expected_error(*p.trend, {c.increments, 0, c.noise});
            const double then = models_.expected_error(*p.trend, c);
            const double slowed = now > 0 ? then / now : 1;
            sum += slowed * (now + p.unsure * increments_ / c.increments);
        }
        return sum;
    }

  private:
    struct Part {
        const Trend* trend;
        double unsure;  ///< of its error, what its likely models do not say of themselves
    };
    double known(const Circumstances& c) {
        double sum = 0;
        for (const Part& p : parts_) sum += models_.expected_error(*p.trend, c);
        return sum;
    }
    std::vector<Part> parts_;
    double light_ = 0;
    int increments_;
    double recorded_;
    TrendOutlook models_;
};

std::string count(double n, const char* what) {
    return fmt::format("{:.0f} {}{}", n, what, std::lround(n) == 1 ? "" : "s");
}

/// Two digits at most: more would be a lie.
double coarse(double n) {
    if (n < 10) return std::max(1.0, std::round(n));
    const double step = std::pow(10, std::floor(std::log10(n)) - 1);
    return std::round(n / step) * step;
}

std::string time_text(double seconds) {
    if (seconds < 90) return count(coarse(seconds), "second");
    if (seconds < 90 * 60) return count(coarse(seconds / 60), "minute");
    return count(coarse(seconds / 3600), "hour");
}

/// "about 30 more frames (30 units; 2 minutes by the recording's own clock)"
std::string how_long(const CaptureOutlook& o, const RecentUnits& recent) {
    const std::string time = recent.seconds_per_unit > 0
                                 ? fmt::format("; {} by the recording's own clock",
                                               time_text(o.units * recent.seconds_per_unit))
                                 : "";
    // By default a forecast looks at the last ten.
    const double all = std::min(recent.units + o.units, double(kLongestContext));
    const std::string context =
        all > kUsualContext ? fmt::format("; age with --context {:.0f}", all) : "";
    return fmt::format("roughly {} ({}{}{})", count(coarse(o.frames), "more frame"),
                       count(o.units, "unit"), time, context);
}

std::string levers(const CaptureAdvice& a) {
    std::string out;
    if (a.light_share >= kMuch)
        out += a.backdrop ? "; a steadier lamp and locked exposure would lower it"
                          : "; show more of the backdrop, so that light can be told from copper";
    if (a.noise_share >= kMuch)
        out += fmt::format("; four times as many photographs per unit would lower it by {:.0f} %",
                           100 * (1 - std::sqrt(1 - a.noise_share)));
    return out;
}

void say(const RecentUnits& recent, CaptureAdvice& a) {
    a.sentence = fmt::format(
        "over the next ten units the forecast may be off by about {:.2g} % of full scale",
        100 * a.error);
    if (a.error < kInvisible) {
        a.id = "enough";
        a.sentence += ", which nobody sees: for these ten, enough is recorded";
        return;
    }
    if (a.halved) {
        a.id = "record_on";
        a.sentence += fmt::format("; {} may halve that for the ten units that follow then",
                                  how_long(*a.halved, recent));
    } else {
        const CaptureOutlook& far = a.outlooks.back();
        const double left = far.error / a.error;
        a.sentence += left >= kHardly
                          ? "; recording on will hardly lower that"
                          : fmt::format(
                                "; recording on will not halve that, {} may leave {:.0f} % "
                                "of it",
                                how_long(far, recent), 10 * std::ceil(10 * left));
        a.id = "unforeseen";
        if (a.light_share >= kMostly) {
            a.id = "light";
            a.sentence += ": most of it is the light";
        } else if (a.noise_share >= kMostly) {
            a.id = "noise";
            a.sentence += ": most of it is the noise of the frames";
        } else if (a.unforeseen_share >= kMostly) {
            a.sentence += ": most of it is change that no past frame foretells";
        }
    }
    a.sentence += levers(a);
}

}  // namespace

CaptureAdvice capture_advice(const RecentUnits& recent) {
    CaptureAdvice out;
    if (recent.still) {
        out.id = "still";
        out.sentence =
            "nothing changes by more than the noise: what is to be forecast has not "
            "begun, so record on until it is seen to";
        return out;
    }
    if (int(recent.frames.size()) < kFewest) {
        out.id = "too_few";
        out.sentence = fmt::format(
            "too little is recorded to say what more would be worth; record "
            "at least {} frames, better a hundred",
            2 * kFewest);
        if (recent.units >= 2 * kFewest)
            out.sentence =
                "too few pictures at the end can be read to say what more would be "
                "worth";
        return out;
    }
    Context context;
    for (const Image<SrgbF>& frame : recent.frames) context.frames.push_back(frame.clone());
    context.specimen = recent.specimen.clone();
    BandMethod method;
    const Mask moving = specimen_of(context);
    const Components components =
        count_inside(moving) < 16 ? Components() : held_components(context, moving, method);
    if (components.all.empty()) {
        out.id = "still";
        out.sentence =
            "the last frames are all the same: there is nothing to learn from them yet, "
            "so record on until something changes";
        return out;
    }
    const int seen = context.length() - 1;
    // A forecast may look further back than was looked here.
    const auto increments_at = [&](double more) {
        return std::max(seen, std::min(int(recent.units + more), kLongestContext) - 1);
    };
    Outlook outlook(components, seen, recent.units, method.design.prior.doubt);
    // One frame was looked at where a forecast averages several.
    const double noise = 1 / recent.frames_per_sample;
    const auto error_at = [&](double more, double less_noise) {
        return outlook.error({increments_at(more), more, noise * less_noise});
    };
    const double now = error_at(0, 1);
    out.error = std::sqrt(now);
    out.backdrop = shows_light(context);
    if (now > 0) {
        out.noise_share = std::clamp(1 - error_at(0, 0.25) / now, 0.0, 1.0);
        out.light_share = outlook.light() / now;
        out.unforeseen_share = std::min(outlook.unforeseen() / now, 1.0);
    }
    for (const double more : kMore) {
        if (more > std::max(kLonger * recent.units, kMore.front())) break;
        out.outlooks.push_back({more, more * recent.frames_per_unit, std::sqrt(error_at(more, 1))});
        if (!out.halved && out.outlooks.back().error <= out.error / 2)
            out.halved = out.outlooks.back();
    }
    say(recent, out);
    return out;
}

}  // namespace verdigris
