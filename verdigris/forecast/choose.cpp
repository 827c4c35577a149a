// SPDX-License-Identifier: MIT
#include "verdigris/forecast/choose.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "verdigris/error.h"
#include "verdigris/forecast/backtest.h"
#include "verdigris/forecast/band_trend.h"
#include "verdigris/forecast/context_pixels.h"
#include "verdigris/forecast/guards.h"

namespace verdigris {
namespace {

constexpr AffineFamily kFamilies[] = {AffineFamily::full, AffineFamily::per_channel,
                                      AffineFamily::single_gain};

Forecast hold(const Context& context, std::string explanation) {
    Forecast forecast = persistence().forecast(context);
    forecast.explanation = std::move(explanation);
    return forecast;
}

std::string frames_word(int count) {
    return count == 1 ? "frame" : fmt::format("{} frames", count);
}

std::string why_hold(const BacktestTrial& best) {
    const double worse = 1 - best.row.gain_over_persistence;  // error over persistence's
    std::string compared;
    if (worse >= 2) {
        compared = fmt::format("{} was {:.1f} times worse", best.row.forecaster, worse);
    } else if (worse > 1.005) {
        compared = fmt::format("{} was {:.0f} % worse", best.row.forecaster, 100 * (worse - 1));
    } else if (best.row.gain_over_persistence > 0.0005) {
        compared = fmt::format("{} was {:.1f} % better, which noise alone can explain",
                               best.row.forecaster, 100 * best.row.gain_over_persistence);
    } else {
        compared = fmt::format("{} was no better", best.row.forecaster);
    }
    const char* verdict =
        worse > 1.005 ? "predicted the last {} best" : "did as well on the last {}";
    return fmt::format(
        "Back-tested inside the context: holding still {} ({}), so the last "
        "observed state is held.",
        fmt::format(fmt::runtime(verdict), frames_word(best.row.frames_predicted)), compared);
}

Forecast choose(const Context& context, const ChooseOptions& options) {
    const std::vector<BacktestTrial> trials = run_backtest(context, options);
    if (trials.empty()) {
        return hold(context,
                    context.length() < kMinContext
                        ? fmt::format("With {} observed there is nothing to hold back for a test, "
                                      "so the last observed state is held.",
                                      context.length() == 1 ? std::string("1 frame")
                                                            : frames_word(context.length()))
                        : "No usable pixel lies on the specimen, so the last observed state is "
                          "held.");
    }
    const auto smaller = [](const BacktestTrial& a, const BacktestTrial& b) {
        return a.row.mean_squared_error < b.row.mean_squared_error;
    };
    const BacktestTrial* winner = nullptr;
    for (const BacktestTrial& trial : trials) {
        if (trial.beats_persistence && (winner == nullptr || smaller(trial, *winner))) {
            winner = &trial;
        }
    }
    if (winner == nullptr) {
        return hold(context,
                    why_hold(*std::min_element(trials.begin() + 1, trials.end(), smaller)));
    }
    Forecast forecast = affinergb(*winner->affine).forecast(context);
    forecast.explanation = fmt::format(
        "Back-tested inside the context: {} predicted the last {} {:.0f} % better than holding "
        "still.",
        winner->row.forecaster, frames_word(winner->row.frames_predicted),
        100 * winner->row.gain_over_persistence);
    return forecast;
}

}  // namespace

Forecaster automatic(const ChooseOptions& options) {
    Forecaster best = band_trend({.clamp = options.clamp});
    best.name = "auto";
    return best;
}

Forecaster back_tested(const ChooseOptions& options) {
    return {"backtest", [options](const Context& context) { return choose(context, options); }};
}

std::vector<std::string> forecaster_names() {
    std::vector<std::string> names{"auto", "bandtrend", "backtest", "persistence", "affinergb"};
    for (AffineFamily family : kFamilies) {
        for (int order : {1, 2}) {
            names.push_back(fmt::format("affinergb-{}-{}", to_string(family), order));
        }
    }
    return names;
}

Forecaster forecaster_by_name(const std::string& name, const ChooseOptions& options) {
    if (name == "auto") return automatic(options);
    if (name == "backtest") return back_tested(options);
    if (name == "persistence") return persistence();
    if (name == "bandtrend" || name.starts_with("bandtrend:")) {
        Forecaster f = band_trend(
            {.clamp = options.clamp,
             .design = band_trend_design(name.substr(std::string_view("bandtrend").size()))});
        f.name = name;
        return f;
    }
    AffineOptions affine{AffineFamily::full, 1, options.ridge_k, options.pixels, options.clamp};
    if (name == "affinergb") return affinergb(affine);
    for (AffineFamily family : kFamilies) {
        for (int order : {1, 2}) {
            if (name != fmt::format("affinergb-{}-{}", to_string(family), order)) continue;
            affine.family = family;
            affine.order = order;
            return affinergb(affine);
        }
    }
    throw Error(ErrorCode::usage, fmt::format("there is no forecaster '{}'; choose one of: {}",
                                              name, fmt::join(forecaster_names(), ", ")));
}

}  // namespace verdigris
