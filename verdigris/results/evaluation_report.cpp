// SPDX-License-Identifier: MIT
#include "verdigris/results/evaluation_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "verdigris/error.h"
#include "verdigris/results/resolved.h"

namespace verdigris {
namespace {

// Better or worse is said only as far as the evidence goes.
std::string sentence_of(const Direction& d, const EntrantVerdict& v, const EntrantScores& scores) {
    const auto error = [](double e) { return fmt::format("{:.3g}", e); };
    if (!std::isfinite(v.gain))
        return fmt::format("{}: {} cannot be judged, since nothing changed.", d.label(), v.name);
    // chosen: what rounds to 0.0 % is neither better nor worse.
    if (printed_sign(v.gain) == 0)
        return fmt::format("{}: {} equals holding still (foreground MSE {} against {}).", d.label(),
                           v.name, error(v.error), error(v.persistence));
    std::string text =
        fmt::format("{}: {} is {:.1f} % {} than holding still (foreground MSE {} against {}).",
                    d.label(), v.name, 100 * std::fabs(v.gain), v.gain >= 0 ? "better" : "worse",
                    error(v.error), error(v.persistence));
    if (v.blocks.size() >= 2) {
        const Resolved r{v.gain, int(d.starts.size()), v.block, v.blocks};
        text += fmt::format(" It is better in {}; {}.", blocks_better(v.blocks), how_sure(r));
    } else {
        text += " There is one block only, so nothing can be said about how sure that is.";
    }
    if (!scores.delta_e.empty()) {
        const double model = overall_mean(scores.delta_e),
                     still = overall_mean(d.persistence().delta_e);
        // chosen: a tenth of CIEDE2000 in the mean is under what anybody sees.
        const double difference = still - model;
        text += fmt::format(" CIEDE2000 over the specimen: {:.2f} against {:.2f}{}", model, still,
                            std::fabs(difference) < 0.1 ? ", no visible difference."
                            : difference > 0            ? ", closer."
                                                        : ", farther off.");
    }
    return text;
}

std::vector<EntrantVerdict::Named> named_gains(const Evaluation& e, const Direction& d,
                                               const WindowRatios& ratios,
                                               const std::vector<NamedBlock>& blocks) {
    std::vector<EntrantVerdict::Named> result;
    for (const NamedBlock& block : blocks) {
        if (block.recording != d.held_out) continue;
        double over = 0, under = 0;
        int windows = 0;
        for (std::size_t i = 0; i < ratios.starts.size(); ++i) {
            const double unit = double(ratios.starts[i]) / e.protocol.stride;
            if (unit < block.begin || unit >= block.end) continue;
            over += ratios.over[i], under += ratios.under[i];
            ++windows;
        }
        result.push_back(
            {block, windows, under > 0 ? over / under : std::numeric_limits<double>::quiet_NaN()});
    }
    return result;
}

std::vector<PairVerdict> pairs_of(const Direction& d, const BootstrapOptions& options) {
    // chosen: beyond six there are more pairs than anybody reads, each with two bootstraps.
    constexpr std::size_t kMost = 6;
    std::vector<PairVerdict> pairs;
    if (d.starts.empty() || d.entrants.size() > kMost + 1) return pairs;
    for (std::size_t i = 1; i < d.entrants.size(); ++i) {
        for (std::size_t j = i + 1; j < d.entrants.size(); ++j) {
            const WindowRatios ratios = difference_ratios(d, d.entrants[i], d.entrants[j]);
            pairs.push_back({d.entrants[i].name, d.entrants[j].name, ratio(ratios),
                             bootstrap(ratios, BootstrapKind::block, options),
                             bootstrap(ratios, BootstrapKind::circular_block, options)});
        }
    }
    return pairs;
}

}  // namespace

std::vector<DirectionVerdict> verdicts(const Evaluation& evaluation,
                                       const std::vector<NamedBlock>& blocks) {
    for (const NamedBlock& b : blocks) {
        const bool known =
            std::any_of(evaluation.directions.begin(), evaluation.directions.end(),
                        [&](const Direction& d) { return d.held_out == b.recording; });
        if (!known) {
            std::vector<std::string> names;
            for (const Direction& d : evaluation.directions) names.push_back(d.held_out);
            throw Error(ErrorCode::usage,
                        fmt::format("a block is of recording '{}', which is not evaluated; there "
                                    "are {}",
                                    b.recording, fmt::join(names, ", ")));
        }
    }
    BootstrapOptions options;
    options.draws = evaluation.protocol.bootstrap_draws;
    options.seed = evaluation.protocol.seed;
    options.block = evaluation.protocol.span();
    std::vector<DirectionVerdict> all;
    for (const Direction& d : evaluation.directions) {
        DirectionVerdict verdict;
        verdict.direction = &d;
        for (std::size_t i = 1; i < d.entrants.size(); ++i) {
            const EntrantScores& scores = d.entrants[i];
            EntrantVerdict v;
            v.name = scores.name;
            if (d.starts.empty()) {
                v.sentence = fmt::format("{}: no window could be scored.", d.label());
                v.gain = v.error = v.persistence = std::numeric_limits<double>::quiet_NaN();
                verdict.entrants.push_back(std::move(v));
                continue;
            }
            v.error = overall_mean(scores.foreground);
            v.persistence = overall_mean(d.persistence().foreground);
            v.gain = gain(d, scores);
            const WindowRatios ratios = gain_ratios(d, scores);
            v.naive = bootstrap(ratios, BootstrapKind::naive, options);
            v.block = bootstrap(ratios, BootstrapKind::block, options);
            v.circular_block = bootstrap(ratios, BootstrapKind::circular_block, options);
            v.blocks = block_gains(ratios, options.block);
            v.named = named_gains(evaluation, d, ratios, blocks);
            v.sentence = sentence_of(d, v, scores);
            verdict.entrants.push_back(std::move(v));
        }
        verdict.pairs = pairs_of(d, options);
        all.push_back(std::move(verdict));
    }
    return all;
}

std::vector<std::string> verdict_sentences(const std::vector<DirectionVerdict>& list) {
    std::vector<std::string> sentences;
    for (const DirectionVerdict& v : list) {
        for (const EntrantVerdict& e : v.entrants) sentences.push_back(e.sentence);
        const Direction& d = *v.direction;
        if (!v.entrants.empty()) continue;
        sentences.push_back(
            d.starts.empty()
                ? fmt::format("{}: no window could be scored.", d.label())
                : fmt::format("{}: no forecaster was judged, only holding still: its foreground "
                              "MSE over {} windows is {:.3g}, which is what a forecaster has to "
                              "improve on (evaluate --forecasters affinergb,auto).",
                              d.label(), d.starts.size(),
                              overall_mean(d.persistence().foreground)));
    }
    return sentences;
}

Report evaluation_report(const Evaluation& evaluation, const std::vector<DirectionVerdict>& list) {
    const EvaluationProtocol& p = evaluation.protocol;
    Report report;
    report.title = p.single ? "Forecasters within one recording" : "Forecasters held out";
    report.subtitle = fmt::format(
        "{} observed frames, {} forecast, {} samples per unit. Units are fractions of the observed "
        "recording, not calendar time.",
        p.context, p.horizons, p.stride);

    ReportSection verdict{"verdict", "Verdict", {}};
    verdict.blocks.push_back(BulletList{verdict_sentences(list)});
    const bool any_judged = std::any_of(
        list.begin(), list.end(), [](const DirectionVerdict& d) { return !d.entrants.empty(); });
    if (p.single)
        verdict.blocks.push_back(
            Paragraph{"Within-recording: nothing was held out. What was chosen while looking at "
                      "this recording is not judged by it."});
    if (any_judged)
        verdict.blocks.push_back(Paragraph{
            "Windows overlap, so few blocks are independent. Intervals from so few are wide "
            "and still too narrow: on simulated errors their nominal 95 % covered 58 to 80 % "
            "(docs/PROTOCOL.md). The gains of the blocks are all the evidence there is."});
    report.sections.push_back(std::move(verdict));

    ReportSection leaks{"audit", "Leakage audit", {}};
    const bool leaked =
        std::any_of(evaluation.notes.begin(), evaluation.notes.end(), [](const Status& s) {
            return s.severity == Severity::refusal && s.id != "windows_skipped";
        });
    if (!leaked)
        leaks.blocks.push_back(Paragraph{
            p.single
                ? "Nothing was held out, so nothing could leak into it."
                : "Nothing leaked: no window crosses a split, no identical frame is used twice, "
                  "no held-out recording had a part in training or selection. Copies that were "
                  "turned, mirrored or cropped are not recognized."});
    for (const Status& s : evaluation.notes) leaks.blocks.push_back(s);
    for (const Status& s : evaluation.recording_notes) leaks.blocks.push_back(s);
    report.sections.push_back(std::move(leaks));

    report.sections.push_back({"by-forecaster", "Errors", {error_table(evaluation)}});
    if (Table coverage = coverage_table(evaluation); !coverage.groups.empty())
        report.sections.push_back(
            {"own-intervals", "Intervals of the forecasters", {std::move(coverage)}});
    if (any_judged) {
        ReportSection sure{"how-sure", "How sure", {interval_table(list), gain_figure(list)}};
        const bool any_pair = std::any_of(
            list.begin(), list.end(), [](const DirectionVerdict& d) { return !d.pairs.empty(); });
        if (any_pair) sure.blocks.emplace_back(pair_table(list));
        sure.blocks.emplace_back(block_table(list));
        report.sections.push_back(std::move(sure));
    }
    report.sections.push_back({"by-horizon", "By horizon", {horizon_figure(evaluation)}});
    report.sections.push_back({"counts",
                               "Windows and protocol",
                               {window_count_table(evaluation), Paragraph{"The protocol as it was "
                                                                          "applied is in "
                                                                          "protocol.toml."}}});
    return report;
}

}  // namespace verdigris
