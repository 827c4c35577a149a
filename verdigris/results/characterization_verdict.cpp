// SPDX-License-Identifier: MIT
#include "verdigris/results/characterization_verdict.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace verdigris {
namespace {

/// The rows of a block, in one direction.
class BlockView {
  public:
    BlockView(const Characterization& table, const std::string& block, std::size_t direction)
        : direction_(direction) {
        for (const CharacterizationRow& row : table.rows)
            if (row.block == block) rows_.push_back(&row);
    }
    bool empty() const { return rows_.empty(); }
    const std::vector<const CharacterizationRow*>& rows() const { return rows_; }
    const CharacterizationCell& cell(const CharacterizationRow* row) const {
        return row->cells[direction_];
    }
    /// The row of the highest gain among those that hold.
    template <class Holds>
    const CharacterizationRow* best(Holds holds) const {
        const CharacterizationRow* best = nullptr;
        for (const CharacterizationRow* row : rows_)
            if (holds(*row) && (!best || cell(row).gain > cell(best).gain)) best = row;
        return best;
    }
    const CharacterizationRow* best() const {
        return best([](const CharacterizationRow&) { return true; });
    }

  private:
    std::vector<const CharacterizationRow*> rows_;
    std::size_t direction_;
};

bool holds(const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
}

std::string against_still(double gain) {
    if (gain < -1) return fmt::format("with {:.3g} times the error of holding still", 1 - gain);
    return printed_sign(gain) > 0   ? fmt::format("{:.1f} % better than holding still", 100 * gain)
           : printed_sign(gain) < 0 ? fmt::format("{:.1f} % worse than holding still", -100 * gain)
                                    : "no better and no worse than holding still";
}

std::string context_sentence(const BlockView& view) {
    const CharacterizationRow* best = view.best();
    std::vector<std::string> all;
    bool rises = true, falls = true;
    for (std::size_t i = 0; i < view.rows().size(); ++i) {
        const double gain = view.cell(view.rows()[i]).gain;
        all.push_back(fmt::format("{} {}", signed_percent(gain), view.rows()[i]->setting));
        if (i == 0) continue;
        // Of what is printed: two gains that read the same neither rise nor fall.
        const double more =
            std::nearbyint(1000 * gain) - std::nearbyint(1000 * view.cell(view.rows()[i - 1]).gain);
        rises = rises && more > 0;
        falls = falls && more < 0;
    }
    const bool order = view.rows().size() > 2;
    std::string text = fmt::format("of the contexts tried {} is best, {} ({})", best->setting,
                                   against_still(view.cell(best).gain), fmt::join(all, ", "));
    if (order && rises) text += "; the gain rises with every frame more that was tried";
    if (order && falls) text += "; the gain falls with every frame more that was tried";
    return text + ".";
}

std::string family_sentence(const BlockView& view, const char* fitted,
                            const BootstrapOptions& options) {
    const auto full = [&](const CharacterizationRow& r) {
        return holds(r.setting, fitted) && holds(r.setting, "full");
    };
    const CharacterizationRow* whole = view.best(full);
    const CharacterizationRow* rest = view.best([&](const CharacterizationRow& r) {
        return holds(r.setting, fitted) && !holds(r.setting, "full");
    });
    if (!whole || !rest) return "";
    const Resolved difference =
        resolved(paired_difference(view.cell(whole).ratios, view.cell(rest).ratios), options);
    const int sign = printed_sign(difference.value);
    const bool specimen = holds(fitted, "the specimen");
    return fmt::format("{}, the full matrix {} ({} against {} of the {}{}; of the difference {}).",
                       specimen ? "fitted to the specimen's pixels only" : "fitted to all pixels",
                       sign > 0   ? "wins"
                       : sign < 0 ? "does not win"
                                  : "does as well",
                       signed_percent(view.cell(whole).gain), signed_percent(view.cell(rest).gain),
                       rest->setting.substr(0, rest->setting.find(" (")),
                       view.cell(whole).gain < 0 && view.cell(rest).gain < 0
                           ? ", both worse than holding still"
                           : "",
                       how_sure(difference));
}

std::string order_sentence(const BlockView& view, const BootstrapOptions& options) {
    const auto of = [&](const char* word) {
        return view.best([&](const CharacterizationRow& r) { return holds(r.setting, word); });
    };
    const CharacterizationRow *first = of("1st"), *second = of("2nd");
    if (!first || !second) return "";
    const double ratio = view.cell(second).error / view.cell(first).error;
    const Resolved difference =
        resolved(paired_difference(view.cell(second).ratios, view.cell(first).ratios), options);
    const std::string times = fmt::format("{:.3g}", ratio);  // what reads as 1 is no difference
    return fmt::format(
        "order 2 {} (its error is {} times that of order 1; of the difference in gain {}).",
        times == "1" ? "makes no difference"
        : ratio < 1  ? "pays"
                     : "does not pay",
        times, how_sure(difference));
}

std::string ridge_sentence(const BlockView& view, const BootstrapOptions& options) {
    const CharacterizationRow* best = view.best();
    const CharacterizationRow* none =
        view.best([](const CharacterizationRow& r) { return r.usual; });
    if (!none || view.rows().size() < 2) return "";
    if (best == none) return "no ridge that was tried improves on none.";
    const Resolved difference =
        resolved(paired_difference(view.cell(best).ratios, view.cell(none).ratios), options);
    if (printed_sign(difference.value) == 0) return "no ridge that was tried improves on none.";
    return fmt::format(
        "of the ridges tried {} is best ({} against {} without; of the difference "
        "{}).",
        best->setting, signed_percent(view.cell(best).gain), signed_percent(view.cell(none).gain),
        how_sure(difference));
}

std::string far_sentence(const LongVerdict& v) {
    if (v.unclamped.empty()) return "no window reaches far enough for long horizons.";
    const bool better = v.unclamped.front() < v.persistence.front();
    const double last = gain_over(v.unclamped.back(), v.persistence.back());
    std::string text = fmt::format("out to t+{} ({} windows, at most {} of them independent) ",
                                   v.horizons, v.windows, std::max(1, v.independent));
    if (v.crossings.empty()) {
        text += better ? "the unclamped forecast stays better than holding still"
                       : "the unclamped forecast is never better than holding still";
    } else {
        text += fmt::format(
            "the unclamped forecast is {} than holding still up to t+{} and {} "
            "from t+{} on",
            better ? "better" : "worse", v.crossings.front() - 1, better ? "worse" : "better",
            v.crossings.front());
        if (v.crossings.size() > 1)
            text += fmt::format(", crossing back at t+{}",
                                fmt::join(v.crossings.begin() + 1, v.crossings.end(), ", t+"));
    }
    text += fmt::format(" ({} at t+{})", against_still(last), v.horizons);
    if (!v.outside.empty())
        text += fmt::format(
            "; {:.1f} % of its pixels are then outside [0, 1], {:.1f} % by more "
            "than an 8-bit step",
            100 * v.outside.back(), 100 * v.outside_by_a_step.back());
    const double clamp = gain_over(v.clamped.back(), v.unclamped.back());
    // chosen: a thousandth is not worth a word.
    if (std::fabs(clamp) < 1e-3) return text + ", and clamping makes no difference.";
    return text + fmt::format(", and clamping makes its error {:.1f} % {}.", 100 * std::fabs(clamp),
                              clamp > 0 ? "smaller" : "larger");
}

LongVerdict long_verdict(const Direction& d) {
    LongVerdict v;
    v.direction = d.label();
    v.windows = int(d.starts.size());
    v.independent = d.plan.independent;
    v.horizons = d.persistence().foreground.horizons;
    if (d.starts.empty()) return v;
    const EntrantScores& unclamped = d.entrant("affinergb unclamped");
    v.persistence = horizon_means(d.persistence().foreground);
    v.clamped = horizon_means(d.entrant("affinergb clamped").foreground);
    v.unclamped = horizon_means(unclamped.foreground);
    v.moved = horizon_means(d.persistence().absolute);
    if (!unclamped.outside.empty()) {
        v.outside = horizon_means(unclamped.outside);
        v.outside_by_a_step = horizon_means(unclamped.outside_by_a_step);
    }
    const auto better = [&](std::size_t k) { return v.unclamped[k] < v.persistence[k]; };
    for (std::size_t k = 1; k < v.unclamped.size(); ++k)
        if (better(k) != better(k - 1)) v.crossings.push_back(int(k) + 1);
    return v;
}

}  // namespace

CharacterizationVerdict characterization_verdict(const EvaluationProtocol& protocol,
                                                 const Characterization& table,
                                                 const Evaluation& far) {
    CharacterizationVerdict verdict;
    const auto options_for = [&](int context) {
        EvaluationProtocol p = protocol;
        p.context = context;
        return bootstrap_options(p);
    };
    for (const CharacterizationRow& row : table.rows) {
        std::vector<Resolved> gains;
        for (const CharacterizationCell& cell : row.cells)
            gains.push_back(resolved(cell.ratios, options_for(row.context)));
        verdict.gains.push_back(std::move(gains));
    }
    for (const Direction& d : far.directions) verdict.far.push_back(long_verdict(d));
    const BootstrapOptions options = options_for(protocol.context);
    for (std::size_t i = 0; i < table.directions.size(); ++i) {
        const auto say = [&](const std::string& sentence) {
            if (!sentence.empty())
                verdict.sentences.push_back(fmt::format("{}: {}", table.directions[i], sentence));
        };
        const BlockView contexts(table, "context", i), pixels(table, "fit-pixels", i),
            orders(table, "order", i), ridges(table, "ridge", i), families(table, "family", i);
        if (!contexts.empty()) say(context_sentence(contexts));
        say(family_sentence(families, "", options));
        say(family_sentence(pixels, "the specimen", options));
        say(order_sentence(orders, options));
        say(ridge_sentence(ridges, options));
        if (i < verdict.far.size()) say(far_sentence(verdict.far[i]));
    }
    return verdict;
}

}  // namespace verdigris
