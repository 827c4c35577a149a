// SPDX-License-Identifier: MIT
#include "verdigris/results/drift_verdict.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "verdigris/error.h"

namespace verdigris {
namespace {

constexpr DriftCorrection kCorrections[] = {DriftCorrection::gain, DriftCorrection::offset,
                                            DriftCorrection::both};
// chosen: what an 8-bit camera cannot show is no drift. The paper calls a chamber flat whose
// reference moved by 0.0012, and corrects an open-air recording whose reference moved by 0.026.
constexpr double kStill = 1.0 / 255;
// chosen: so far from 0 is a common movement worth a word; the paper's open air has -0.79.
constexpr double kCorrelated = 0.5;

std::string share(double v) {
    return fmt::format("{:.2g} %", 100 * v);
}

std::string movement_sentence(const DriftSeries& s) {
    const bool still = s.reference_movement < kStill;
    std::string text =
        fmt::format("the reference {} by {} of full scale over the recording, the specimen by {}",
                    still ? "stands still to within an 8-bit step: it moves" : "moves",
                    share(s.reference_movement), share(s.specimen_movement));
    if (s.ratio) text += fmt::format(", {:.3g} times as far", *s.ratio);
    return text +
           (still ? "; the camera is not drifting." : "; the camera or the light is drifting.");
}

std::string correlation_sentence(const DriftSeries& s) {
    const auto& r = s.smooth_luma_correlation;
    // Of a reference that stands still the correlation is one of noise.
    if (!r || s.reference_movement < kStill) return "";
    const char* meaning = *r <= -kCorrelated
                              ? "as of an exposure loop that makes up for the specimen"
                          : *r >= kCorrelated ? "as of a light that both share"
                                              : "so neither leads the other";
    return fmt::format("the lightness of reference and specimen go {} (correlation {:+.2f}), {}.",
                       *r <= -kCorrelated  ? "against each other"
                       : *r >= kCorrelated ? "together"
                                           : "their own ways",
                       *r, meaning);
}

std::string gain_text(const DriftGain& g) {
    return std::isfinite(g.gain.value)
               ? fmt::format("by {} {}", to_string(g.correction), signed_percent(g.gain.value))
               : fmt::format("by {} no window is left that changes", to_string(g.correction));
}

std::string result_sentence(const RecordingDrift& drift, const std::string& forecaster) {
    const DriftGain& raw = drift.gain_of(forecaster, std::nullopt);
    if (!std::isfinite(raw.gain.value))
        return fmt::format("{} cannot be judged, since no window changes.", forecaster);
    const int as_recorded = printed_sign(raw.gain.value);
    std::string text =
        as_recorded == 0
            ? fmt::format("{} equals holding still as recorded", forecaster)
            : fmt::format("{} is {:.1f} % {} than holding still as recorded", forecaster,
                          100 * std::fabs(raw.gain.value), as_recorded > 0 ? "better" : "worse");
    if (drift.maps.empty())
        return text + fmt::format(
                          " ({}); without a reference it stays open how much of that is the "
                          "camera's.",
                          how_sure(raw.gain));
    std::vector<std::string> parts;
    double least = std::numeric_limits<double>::infinity();
    int better = 0, settled = 0, gone = 0;
    for (const DriftCorrection c : kCorrections) {
        const DriftGain& g = drift.gain_of(forecaster, c);
        parts.push_back(gain_text(g));
        if (!std::isfinite(g.gain.value)) {
            ++gone;
            continue;
        }
        least = std::min(least, g.gain.value);
        better += printed_sign(g.gain.value) > 0;
        settled += sign_is_settled(g.gain) && g.gain.value > 0;
    }
    text += fmt::format("; after correction {}: ", fmt::join(parts, ", "));
    if (gone == 3) return text + "what changed was the light, and nothing of the result survives.";
    const std::string sure =
        fmt::format(" (the blocks settle that it is better in {} of 3)", settled);
    if (as_recorded <= 0)
        return text + (better == 0 ? "there is no advantage to survive."
                                   : fmt::format("no advantage as recorded, one after {} of 3 "
                                                 "corrections{}.",
                                                 better, sure));
    if (better < 3)
        return text + fmt::format("the result does not survive {} of 3 corrections.", 3 - better);
    // chosen: where less than half is left the larger part was on the camera.
    if (least < 0.5 * raw.gain.value)
        return text + fmt::format("of the result less than half survives{}.", sure);
    // What was never settled cannot survive; it can only stay.
    if (!sign_is_settled(raw.gain))
        return text +
               fmt::format("the gain stays, but its sign was not settled as recorded either{}.",
                           sure);
    return text + fmt::format("the result survives{}.", sure);
}

void score(const EvaluationProtocol& protocol, const Observation& observation,
           const std::vector<Entrant>& entrants, std::optional<DriftCorrection> correction,
           const Progress& progress, RecordingDrift& out) {
    const Evaluation evaluation =
        evaluate(protocol, std::span(&observation, 1), entrants, progress);
    const Direction& d = evaluation.directions.front();
    // A corrected recording is the same one: what is to be noted of it was noted.
    if (!correction) out.notes = evaluation.notes;
    for (std::size_t i = 1; i < d.entrants.size(); ++i) {
        DriftGain g;
        g.forecaster = d.entrants[i].name;
        g.correction = correction;
        g.error = g.persistence = std::numeric_limits<double>::quiet_NaN();
        if (!d.starts.empty()) {
            g.error = overall_mean(d.entrants[i].foreground);
            g.persistence = overall_mean(d.persistence().foreground);
            g.ratios = gain_ratios(d, d.entrants[i]);
        }
        g.gain = resolved(g.ratios, bootstrap_options(protocol));
        out.gains.push_back(std::move(g));
    }
}

}  // namespace

std::string to_string(std::optional<DriftCorrection> correction) {
    return correction ? to_string(*correction) : "none";
}

const DriftGain& RecordingDrift::gain_of(const std::string& forecaster,
                                         std::optional<DriftCorrection> correction) const {
    for (const DriftGain& g : gains)
        if (g.forecaster == forecaster && g.correction == correction) return g;
    throw Error(ErrorCode::usage,
                fmt::format("there is no gain of {} after {}", forecaster, to_string(correction)));
}

std::vector<std::string> drift_sentences(const RecordingDrift& drift) {
    std::vector<std::string> sentences;
    const auto say = [&](const std::string& sentence) {
        if (!sentence.empty()) sentences.push_back(fmt::format("{}: {}", drift.name, sentence));
    };
    std::string found = drift.region.sentence;
    if (drift.region.found() && drift.region.margin < 1)
        found += "; with more of the frame observed (--crop none) it could keep its distance";
    say(found + ".");
    if (drift.series) {
        say(movement_sentence(*drift.series));
        say(correlation_sentence(*drift.series));
    } else {
        say("whether the camera drifts cannot be said.");
    }
    std::set<std::string> said;
    for (const DriftGain& g : drift.gains)
        if (said.insert(g.forecaster).second) say(result_sentence(drift, g.forecaster));
    return sentences;
}

RecordingDrift measure_recording_drift(const EvaluationProtocol& protocol,
                                       const Observation& observation,
                                       const std::vector<Entrant>& entrants,
                                       const Mask& not_backdrop, const Progress& progress) {
    if (!observation.store)
        throw Error(ErrorCode::bad_input, "was observed without keeping every sample",
                    observation.source_name);
    EvaluationProtocol within = protocol;
    within.single = true;
    within.delta_e = within.out_of_gamut = false;
    RecordingDrift drift;
    drift.name = observation.source_name;
    drift.stride = protocol.stride;
    drift.region = find_reference_region(
        *observation.store, not_backdrop.empty() ? observation.specimen : not_backdrop);
    score(within, observation, entrants, std::nullopt, progress, drift);
    if (drift.region.found()) {
        DriftSeriesOptions options;
        options.smoothing = std::max(1, options.smoothing / 10 * protocol.stride) | 1;
        // Averaged over a unit for the spread, as at 10 per unit.
        options.spread_over = std::clamp(protocol.stride | 1, 1, options.spread_over);
        drift.series = measure_drift_series(*observation.store, observation.specimen, drift.region,
                                            options, progress);
        within.hash_frames = false;  // once is enough
        for (const DriftCorrection c : kCorrections) {
            drift.maps.emplace_back(c, correction_maps(*drift.series, c, observation.noise.sigma));
            score(within, corrected_observation(observation, *drift.series, c), entrants, c,
                  progress, drift);
        }
    }
    drift.sentences = drift_sentences(drift);
    return drift;
}

}  // namespace verdigris
