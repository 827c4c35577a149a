// SPDX-License-Identifier: MIT
#include "verdigris/evaluate/characterize.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "verdigris/error.h"

namespace verdigris {
namespace {

/// A row and the entrant whose errors fill it.
struct Planned {
    CharacterizationRow row;
    std::string entrant;
};

const char* family_setting(AffineFamily family) {
    switch (family) {
        case AffineFamily::full:
            return "full 3x3 + bias (12)";
        case AffineFamily::per_channel:
            return "per-channel gain + bias (6)";
        case AffineFamily::single_gain:
            return "single gain + bias (2)";
    }
    return "unknown";
}

const char* order_setting(int order) {
    constexpr const char* kSettings[] = {"hold last transform (0th order)", "linear drift (1st)",
                                         "accelerating drift (2nd)"};
    return kSettings[order];
}

constexpr AffineFamily kFamilies[] = {AffineFamily::full, AffineFamily::per_channel,
                                      AffineFamily::single_gain};

/// One evaluation and the rows it fills.
class Sweep {
  public:
    explicit Sweep(const EvaluationProtocol& protocol) : protocol_(protocol) {}

    void add(std::string block, std::string setting, bool usual, const AffineOptions& options) {
        const std::string name =
            fmt::format("{} order {} ridge {} {}", to_string(options.family), options.order,
                        options.ridge_k, options.pixels == FitPixels::all ? "all" : "specimen");
        const auto known = [&](const Entrant& e) { return e.name == name; };
        if (std::ranges::none_of(entrants_, known)) {
            entrants_.push_back(training_free(affinergb(options)));
            entrants_.back().name = name;
        }
        planned_.push_back(
            {{std::move(block), std::move(setting), usual, {}, protocol_.context}, name});
    }
    Evaluation run(std::span<const Observation> observations, const Progress& progress,
                   std::vector<CharacterizationRow>& rows) {
        Evaluation evaluation = evaluate(protocol_, observations, entrants_, progress);
        for (const Direction& d : evaluation.directions) {
            if (d.starts.empty())
                throw Error(ErrorCode::refused,
                            fmt::format("leaves no window to score: {}",
                                        d.skipped.empty() ? "none fits" : d.skipped.front().why),
                            d.held_out);
        }
        for (Planned& p : planned_) {
            for (const Direction& d : evaluation.directions) {
                const EntrantScores& scores = d.entrant(p.entrant);
                CharacterizationCell cell;
                cell.error = overall_mean(scores.foreground);
                cell.persistence = overall_mean(d.persistence().foreground);
                cell.gain = gain(d, scores);
                cell.ratios = gain_ratios(d, scores);
                p.row.cells.push_back(std::move(cell));
            }
            rows.push_back(std::move(p.row));
        }
        return evaluation;
    }

  private:
    EvaluationProtocol protocol_;
    std::vector<Entrant> entrants_;
    std::vector<Planned> planned_;
};

void add_usual_context(Sweep& sweep, const EvaluationProtocol& protocol,
                       const CharacterizeOptions& options) {
    if (std::ranges::count(options.contexts, protocol.context) > 0) {
        sweep.add("context", fmt::format("n = {}", protocol.context), true, paper_affine());
    }
    for (const AffineFamily family : kFamilies) {
        sweep.add("family", family_setting(family), family == AffineFamily::full,
                  paper_affine(family));
    }
    for (const int order : {0, 1, 2}) {
        sweep.add("order", order_setting(order), order == 1,
                  paper_affine(AffineFamily::full, order));
    }
    for (const double ridge : options.ridges) {
        AffineOptions affine = paper_affine();
        affine.ridge_k = ridge;
        sweep.add("ridge", fmt::format("lambda = {} sigma^2", ridge), ridge == 0, affine);
    }
}

void add_fit_pixels(Sweep& sweep) {
    for (const FitPixels pixels : {FitPixels::all, FitPixels::specimen}) {
        for (const AffineFamily family : kFamilies) {
            AffineOptions affine = paper_affine(family);
            affine.pixels = pixels;
            const bool all = pixels == FitPixels::all;
            sweep.add("fit-pixels",
                      fmt::format("{}, fitted to {}", family_setting(family),
                                  all ? "all pixels" : "the specimen"),
                      all && family == AffineFamily::full, affine);
        }
    }
}

}  // namespace

AffineOptions paper_affine(AffineFamily family, int order) {
    return {family, order, 0, FitPixels::all, false};
}

Characterization characterize(const EvaluationProtocol& protocol,
                              std::span<const Observation> observations,
                              const CharacterizeOptions& options, const Progress& progress) {
    EvaluationProtocol usual = protocol;
    usual.max_windows = options.windows;
    usual.delta_e = usual.out_of_gamut = false;
    Characterization out;

    EvaluationProtocol other = usual;
    other.hash_frames = false;  // once is enough
    for (const int n : options.contexts) {
        if (n == protocol.context) continue;
        other.context = n;
        Sweep sweep(other);
        sweep.add("context", fmt::format("n = {}", n), false, paper_affine());
        sweep.run(observations, progress, out.rows);
    }
    Sweep main(usual);
    add_usual_context(main, protocol, options);
    const Evaluation evaluation = main.run(observations, progress, out.rows);
    for (const Direction& d : evaluation.directions) out.directions.push_back(d.label());
    out.notes = evaluation.notes;

    other.context = protocol.context;
    other.area = EvaluatedArea::specimen;
    Sweep pixels(other);
    add_fit_pixels(pixels);
    pixels.run(observations, progress, out.rows);

    // Blocks together, in the order of the paper's table; contexts by length.
    const auto rank = [](const CharacterizationRow& r) {
        constexpr const char* kBlocks[] = {"context", "family", "order", "fit-pixels", "ridge"};
        return std::ranges::find(kBlocks, r.block) - std::begin(kBlocks);
    };
    std::ranges::stable_sort(out.rows, {}, rank);
    const auto contexts = std::ranges::count(out.rows, "context", &CharacterizationRow::block);
    std::ranges::stable_sort(out.rows.begin(), out.rows.begin() + contexts,
                             // shorter numbers first: 3, 5, 7, 10
                             [](const CharacterizationRow& a, const CharacterizationRow& b) {
                                 return std::pair(a.setting.size(), a.setting) <
                                        std::pair(b.setting.size(), b.setting);
                             });
    return out;
}

int longest_horizon(const EvaluationProtocol& protocol, int samples) {
    const int usable = samples - protocol.trim_lead - protocol.trim_tail;
    return std::max(0, (usable - 1) / protocol.stride + 1 - protocol.context);
}

Evaluation long_horizons(const EvaluationProtocol& protocol,
                         std::span<const Observation> observations, int horizon,
                         const std::vector<Entrant>& others, const Progress& progress) {
    if (horizon < 1) throw Error(ErrorCode::usage, "a horizon must be 1 unit or more");
    EvaluationProtocol far = protocol;
    far.horizons = horizon;
    for (const Observation& o : observations) {
        if (!o.store) continue;  // evaluate() says so
        far.horizons =
            std::max(1, std::min(far.horizons, longest_horizon(protocol, o.store->count())));
    }
    far.out_of_gamut = true;
    if (far.horizons > protocol.horizons) {
        // A window is nearly the recording: nothing is left to train on, and nothing is trained.
        far.train_fraction = far.validation_fraction = 0;
        far.embargo = 0;
    }
    std::vector<Entrant> entrants;
    for (const bool clamp : {true, false}) {
        AffineOptions affine = paper_affine();
        affine.clamp = clamp;
        entrants.push_back(training_free(affinergb(affine)));
        entrants.back().name = clamp ? "affinergb clamped" : "affinergb unclamped";
    }
    entrants.insert(entrants.end(), others.begin(), others.end());
    return evaluate(far, observations, entrants, progress);
}

}  // namespace verdigris
