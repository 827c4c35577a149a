// SPDX-License-Identifier: MIT
#include "verdigris/appearance/material_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "verdigris/results/evaluation_report.h"

namespace verdigris {

Report material_report(const MaterialJudgment& judgment,
                       const std::vector<MaterialDirectionVerdict>& list) {
    const EvaluationProtocol& p = judgment.evaluation.protocol;
    const MaterialJudgeOptions& o = judgment.options;
    Report report;
    report.title = "Materials, judged by what they look like";
    report.subtitle = fmt::format(
        "{} observed frames, {} samples per unit; a {} of {} x {} pixels in the studio light. "
        "Units "
        "are fractions of the observed recording, not calendar time.",
        p.context, p.stride, to_string(o.view.scene), o.view.size, o.view.size);

    ReportSection verdict{"verdict", "Verdict", {}};
    BulletList sentences;
    for (const MaterialDirectionVerdict& v : list)
        sentences.items.insert(sentences.items.end(), v.sentences.begin(), v.sentences.end());
    verdict.blocks.emplace_back(std::move(sentences));
    if (p.single)
        verdict.blocks.emplace_back(
            Paragraph{"Within-recording: nothing was held out. What was chosen while looking at "
                      "this recording is not judged by it."});
    verdict.blocks.emplace_back(
        Paragraph{"Windows overlap, and the further the horizon, the fewer are independent: of the "
                  "paper's recordings one at +50. Where blocks are few the gains of the blocks are "
                  "all the evidence there is."});
    report.sections.push_back(std::move(verdict));

    ReportSection leaks{"audit", "Leakage audit", {}};
    const bool leaked = std::ranges::any_of(judgment.evaluation.notes, [](const Status& s) {
        return s.severity == Severity::refusal && s.id != "windows_skipped";
    });
    if (!leaked)
        leaks.blocks.emplace_back(
            Paragraph{p.single ? "Nothing was held out, so nothing could leak into it."
                               : "Nothing leaked: no held-out recording had a part in training or "
                                 "selection, and no identical frame is used twice."});
    for (const Status& s : judgment.evaluation.notes) leaks.blocks.emplace_back(s);
    for (const Status& s : judgment.evaluation.recording_notes) leaks.blocks.emplace_back(s);
    report.sections.push_back(std::move(leaks));

    report.sections.push_back({"by-forecaster",
                               "Materials",
                               {material_table(judgment, list), material_flip_figure(judgment),
                                Paragraph{"renders/ has one window to look at: forecast, truth and "
                                          "FLIP's map, a sheet for each horizon."}}});
    ReportSection why{"movement", "Movement and gamut", {material_measure_table(judgment, list)}};
    if (std::ranges::any_of(list, [](const auto& v) { return !v.fixes.empty(); }))
        why.blocks.emplace_back(material_fix_table(judgment, list));
    report.sections.push_back(std::move(why));
    report.sections.push_back(
        {"how-sure",
         "How sure",
         {material_gain_figure(judgment, list), material_block_table(judgment, list)}});

    ReportSection how{"how", "How it was done", {window_count_table(judgment.evaluation)}};
    how.blocks.emplace_back(Paragraph{fmt::format(
        "Forecast and true frame go through one recipe per window: clean state is the median of "
        "the context, {}. {} is put on the shape. Every picture has {} rays of the camera per "
        "pixel, the same ones, so that noise cancels; the rules are in docs/PROTOCOL.md.",
        o.scale == CoverageScale::truth
            ? "and full patina what the true frame reaches two context lengths ahead"
            : "but full patina what each frame reaches by itself",
        o.whole ? "The whole frame" : "The largest rectangle of specimen", o.view.samples)});
    for (const MaterialDirection& d : judgment.directions)
        how.blocks.emplace_back(Paragraph{fmt::format(
            "{}: two pictures of one material whose rays differ have a FLIP of {:.4f}; pictures "
            "compared here share their rays and differ less by noise.",
            d.label, d.noise_flip)});
    report.sections.push_back(std::move(how));
    return report;
}

}  // namespace verdigris
