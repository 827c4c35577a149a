// SPDX-License-Identifier: MIT
#include "verdigris/reproduce/compare.h"

#include <fmt/format.h>

#include <cmath>

namespace verdigris {

std::string signs_in_words(double paper, double ours) {
    const int a = printed_sign(paper), b = printed_sign(ours);
    if (a == 0 || b == 0)
        return a == b ? "both zero as printed" : "one of the two is zero as printed";
    return a == b ? "same sign" : "opposite signs";
}

std::string compare_gain(const std::string& what, double paper, const Resolved& ours) {
    if (!std::isfinite(ours.value))
        return fmt::format("{}: {} in the paper, no number here.", what, signed_percent(paper));
    std::string text =
        fmt::format("{}: {} in the paper, {} here: {}; ", what, signed_percent(paper),
                    signed_percent(ours.value), signs_in_words(paper, ours.value));
    if (ours.blocks.size() < kFewBlocks || !ours.block) return text + how_sure(ours) + ".";
    // As printed, so that nobody reads the two ends and finds the sentence wrong.
    const auto tenths = [](double v) { return std::nearbyint(1000 * v); };
    const bool inside =
        tenths(paper) >= tenths(ours.block->low) && tenths(paper) <= tenths(ours.block->high);
    return text + fmt::format("the paper's value lies {} our block interval {} to {}, which {}.",
                              inside ? "within" : "outside", signed_percent(ours.block->low),
                              signed_percent(ours.block->high),
                              sign_is_settled(ours) ? "excludes zero"
                                                    : "includes zero: our sign is not settled");
}

std::string compare_error(const std::string& what, double paper, double ours) {
    if (!std::isfinite(ours))
        return fmt::format("{}: {:.2e} in the paper, no number here.", what, paper);
    if (!(paper > 0))
        return fmt::format("{}: {:.2e} in the paper, {:.2e} here.", what, paper, ours);
    return fmt::format("{}: {:.2e} in the paper, {:.2e} here, {:.2g} times as much.", what, paper,
                       ours, ours / paper);
}

std::string compare_correlation(const std::string& what, double paper, double ours, double error) {
    if (!std::isfinite(ours))
        return fmt::format("{}: {:+.2f} in the paper, no number here.", what, paper);
    if (!std::isfinite(error))
        return fmt::format("{}: {:+.2f} in the paper, {:+.2f} here; too few windows for an error.",
                           what, paper, ours);
    return fmt::format(
        "{}: {:+.2f} in the paper, {:+.2f} ± {:.2f} here: {} two of our standard "
        "errors of it.",
        what, paper, ours, error, std::abs(paper - ours) <= 2 * error ? "within" : "not within");
}

std::string in_a_row(const std::vector<std::string>& names) {
    if (names.empty()) return "none";
    std::string text = names.front();
    for (std::size_t i = 1; i < names.size(); ++i)
        text += (i + 1 == names.size() ? " and " : ", ") + names[i];
    return text;
}

std::string compare_winners(const std::string& where, const std::vector<NamedGain>& paper,
                            const std::vector<NamedGain>& ours) {
    const auto better = [](const std::vector<NamedGain>& list, std::vector<std::string>& settled) {
        std::vector<std::string> names;
        for (const NamedGain& g : list) {
            if (!std::isfinite(g.gain) || printed_sign(g.gain) <= 0) continue;
            names.push_back(g.name);
            if (g.settled.value_or(false)) settled.push_back(g.name);
        }
        return names;
    };
    std::vector<std::string> unused, settled;
    const auto printed = better(paper, unused), found = better(ours, settled);
    std::size_t scored = 0;
    for (const NamedGain& g : ours) scored += std::isfinite(g.gain);
    if (scored == 0)
        return fmt::format("{}: better than holding still in the paper: {}; here none was judged.",
                           where, in_a_row(printed));
    std::string text =
        fmt::format("{}: better than holding still in the paper: {}; here, of {} judged: {}", where,
                    in_a_row(printed), scored, in_a_row(found));
    if (!found.empty())
        text += settled.size() == found.size()
                    ? "; our blocks settle that sign for each of them"
                    : fmt::format("; our blocks settle that sign for {}", in_a_row(settled));
    return text + ".";
}

std::string least(const std::vector<std::pair<std::string, double>>& errors) {
    std::string name;
    double low = 0;
    for (const auto& [candidate, error] : errors) {
        if (!std::isfinite(error) || (!name.empty() && error >= low)) continue;
        name = candidate;
        low = error;
    }
    return name;
}

}  // namespace verdigris
