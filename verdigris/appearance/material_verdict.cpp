// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "verdigris/appearance/material_report.h"
#include "verdigris/results/cells.h"

namespace verdigris {
namespace {
using Json = nlohmann::ordered_json;

double column_mean(const ErrorTable& table, std::size_t h) {
    return horizon_means(table)[h];
}

/// "+5 (FLIP 0.041 against 0.052, +21.2 %)"
std::string at(int horizon, const MaterialVerdict& v) {
    return fmt::format("+{} (FLIP {:.4f} against {:.4f}, {})", horizon, v.flip, v.control,
                       signed_percent(v.gain.value));
}

std::string looks_sentence(const MaterialJudgment& j, const MaterialDirection& d,
                           const std::string& name, const std::vector<MaterialVerdict>& list) {
    std::vector<std::string> closer, farther, equal;
    for (std::size_t h = 0; h < list.size(); ++h) {
        const double g = list[h].gain.value;
        const int sign = std::isfinite(g) ? printed_sign(g) : 0;
        (sign > 0   ? closer
         : sign < 0 ? farther
                    : equal)
            .push_back(at(j.options.horizons[h], list[h]));
    }
    std::vector<std::string> parts;
    if (!closer.empty()) parts.push_back(fmt::format("closer at {}", fmt::join(closer, ", ")));
    if (!farther.empty())
        parts.push_back(fmt::format("farther off at {}", fmt::join(farther, ", ")));
    if (!equal.empty()) parts.push_back(fmt::format("no different at {}", fmt::join(equal, ", ")));
    return fmt::format("{}: beside the static control's, the materials of {} look {}.", d.label,
                       name, fmt::join(parts, "; "));
}

/// How much of what the control is punished for is color.
std::string finish_sentence(const MaterialJudgment& j, const MaterialDirection& d) {
    const ErrorTable& finish = d.rows[MaterialDirection::kControls - 1].flip;
    std::vector<std::string> parts;
    for (std::size_t h = 0; h < j.options.horizons.size(); ++h)
        parts.push_back(fmt::format("{:.4f} at +{} instead of {:.4f}", column_mean(finish, h),
                                    j.options.horizons[h], column_mean(d.control().flip, h)));
    return fmt::format(
        "{}: with the true frame's roughness, metallic and normals the static control's old color "
        "has a FLIP of {}. The rest of its FLIP is finish, which a forecast gains by moving at "
        "all.",
        d.label, fmt::join(parts, ", "));
}

/// Where the squared error of the frames says the opposite.
std::string frames_sentence(const MaterialJudgment& j, const MaterialDirection& d,
                            const MaterialScores& s, const std::vector<MaterialVerdict>& list) {
    std::vector<std::string> opposed;
    for (std::size_t h = 0; h < list.size(); ++h) {
        const double gain = gain_over(column_mean(s.error, h), column_mean(d.control().error, h));
        if (!std::isfinite(gain) || !std::isfinite(list[h].gain.value) ||
            printed_sign(gain) * printed_sign(list[h].gain.value) >= 0)
            continue;
        opposed.push_back(fmt::format("+{} ({})", j.options.horizons[h], signed_percent(gain)));
    }
    if (opposed.empty()) return {};
    return fmt::format(" The squared error of its frames says the opposite at {}.",
                       fmt::join(opposed, ", "));
}

/// How sure that is at each horizon that has blocks enough, and which have not.
std::string sure_sentence(const MaterialJudgment& j, const std::vector<MaterialVerdict>& list) {
    std::vector<std::string> said, few;
    for (std::size_t h = 0; h < list.size(); ++h) {
        const std::string horizon = fmt::format("+{}", j.options.horizons[h]);
        const Resolved& gain = list[h].gain;
        if (gain.blocks.size() < kFewBlocks || !gain.block) {
            few.push_back(fmt::format("{} ({})", horizon, gain.blocks.size()));
        } else {
            said.push_back(fmt::format("at {} {}", horizon, how_sure(gain)));
        }
    }
    std::string text;
    if (!said.empty()) text += fmt::format(" Blocks: {}.", fmt::join(said, "; "));
    if (!few.empty())
        text += fmt::format(" Too few blocks to say how sure that is: {}.", fmt::join(few, ", "));
    return text;
}

/// The crossover, and what there is to see of its mechanism.
std::string crossover_sentence(const MaterialJudgment& j, const MaterialDirection& d,
                               const MaterialScores& s, const std::vector<MaterialVerdict>& list) {
    const auto sign = [&](std::size_t h) {
        const double g = list[h].gain.value;
        return std::isfinite(g) ? printed_sign(g) : 0;
    };
    for (std::size_t h = 1; h < list.size(); ++h) {
        if (sign(h) >= 0 || sign(h - 1) <= 0) continue;
        const double went = column_mean(s.moved, h) / column_mean(d.truth_moved, h);
        const double outside = column_mean(s.outside_channels, h);
        return fmt::format(
            " It crosses over between +{} and +{}: at +{} its frames have moved {:.2g} times as "
            "far as the true ones, and {} of their channels lie outside [0, 1] before any clamp{}.",
            j.options.horizons[h - 1], j.options.horizons[h], j.options.horizons[h], went,
            number_text(outside, {NumberStyle::percent, 2, false}),
            // chosen: of fewer nobody sees anything in the mean of a picture.
            outside < 1e-3 ? ", so leaving the gamut is not why" : "");
    }
    return {};
}

FixVerdict fix(const MaterialJudgment& j, const MaterialDirection& d, const MaterialScores& free,
               const MaterialScores& limited, std::size_t h) {
    FixVerdict v{
        free.name, limited.name, h, column_mean(free.flip, h), column_mean(limited.flip, h), {}};
    v.difference = resolved(paired_difference(flip_ratios(d, limited, h), flip_ratios(d, free, h)),
                            flip_bootstrap(j, h));
    return v;
}

Json view_json(const MaterialJudgeOptions& o) {
    return {{"scene", std::string(to_string(o.view.scene))},
            {"size", o.view.size},
            {"samples", o.view.samples},
            {"light", "studio"},
            {"whole", o.whole},
            {"coverage_scale", std::string(to_string(o.scale))},
            {"pixels_per_degree", o.pixels_per_degree}};
}

Json row_json(const MaterialJudgment& j, const MaterialScores& s,
              const std::vector<MaterialVerdict>* verdicts) {
    Json out = {{"trained", s.trained}, {"horizons", Json::array()}};
    for (std::size_t h = 0; h < j.options.horizons.size(); ++h) {
        const auto mean = [&](const ErrorTable& t) {
            return t.empty() ? Json(nullptr) : number_json(column_mean(t, h));
        };
        Json at_horizon = {{"horizon", j.options.horizons[h]},
                           {"flip", mean(s.flip)},
                           {"ssim", mean(s.ssim)},
                           {"ciede2000", mean(s.delta_e)},
                           {"lpips", mean(s.lpips)},
                           {"frame_mse", mean(s.error)},
                           {"moved", mean(s.moved)},
                           {"agreement", number_json(mean_where_finite(s.agreement, h))},
                           {"outside_pixels", mean(s.outside_pixels)},
                           {"outside_channels", mean(s.outside_channels)}};
        if (verdicts) at_horizon["gain"] = json_of((*verdicts)[h].gain);
        out["horizons"].push_back(std::move(at_horizon));
    }
    return out;
}

}  // namespace

double mean_where_finite(const ErrorTable& table, std::size_t horizon) {
    double sum = 0;
    int count = 0;
    for (int w = 0; w < table.windows; ++w) {
        const double v = table.at(w, int(horizon));
        if (!std::isfinite(v)) continue;
        sum += v;
        ++count;
    }
    return sum / count;  // 0 / 0 is NaN
}

std::vector<MaterialDirectionVerdict> material_verdicts(const MaterialJudgment& judgment) {
    const std::size_t horizons = judgment.options.horizons.size();
    std::vector<MaterialDirectionVerdict> all;
    for (const MaterialDirection& d : judgment.directions) {
        MaterialDirectionVerdict verdict;
        verdict.direction = &d;
        for (std::size_t i = 1; i < d.rows.size(); ++i) {
            const MaterialScores& s = d.rows[i];
            std::vector<MaterialVerdict> list;
            for (std::size_t h = 0; h < horizons; ++h)
                list.push_back({column_mean(s.flip, h), column_mean(d.control().flip, h),
                                resolved(flip_ratios(d, s, h), flip_bootstrap(judgment, h))});
            if (i >= MaterialDirection::kControls)
                verdict.sentences.push_back(looks_sentence(judgment, d, s.name, list) +
                                            frames_sentence(judgment, d, s, list) +
                                            sure_sentence(judgment, list) +
                                            crossover_sentence(judgment, d, s, list));
            verdict.rows.push_back(std::move(list));
        }
        verdict.sentences.push_back(finish_sentence(judgment, d));
        for (const MaterialScores& limited : d.rows) {
            for (const std::string_view suffix : {kClampedSuffix, kInRangeSuffix}) {
                if (!limited.name.ends_with(suffix)) continue;
                const std::string base =
                    limited.name.substr(0, limited.name.size() - suffix.size());
                const auto free = std::ranges::find(d.rows, base, &MaterialScores::name);
                if (free == d.rows.end()) continue;
                for (std::size_t h = 0; h < horizons; ++h)
                    verdict.fixes.push_back(fix(judgment, d, *free, limited, h));
            }
        }
        all.push_back(std::move(verdict));
    }
    return all;
}

Json json_of(const MaterialJudgment& judgment, const std::vector<MaterialDirectionVerdict>& list) {
    Json out = {{"protocol", protocol_json(judgment.evaluation.protocol)},
                {"horizons", judgment.options.horizons},
                {"view", view_json(judgment.options)},
                {"control", "persistence"},
                {"lpips_unavailable",
                 judgment.options.lpips ? Json(nullptr) : Json(judgment.options.no_lpips)},
                {"directions", Json::array()}};
    for (const MaterialDirectionVerdict& v : list) {
        const MaterialDirection& d = *v.direction;
        Json direction = {{"label", d.label},
                          {"held_out", d.held_out},
                          {"windows", d.starts.size()},
                          {"shown", {d.shown.x, d.shown.y, d.shown.width, d.shown.height}},
                          {"noise_flip", number_json(d.noise_flip)},
                          {"truth_moved", numbers_json(horizon_means(d.truth_moved))},
                          {"forecasters", Json::object()},
                          {"limits", Json::array()},
                          {"verdict", v.sentences}};
        for (std::size_t i = 0; i < d.rows.size(); ++i)
            direction["forecasters"][d.rows[i].name] =
                row_json(judgment, d.rows[i], i == 0 ? nullptr : &v.rows[i - 1]);
        for (const FixVerdict& f : v.fixes)
            direction["limits"].push_back({{"free", f.free},
                                           {"limited", f.limited},
                                           {"horizon", judgment.options.horizons[f.horizon]},
                                           {"flip_free", number_json(f.flip_free)},
                                           {"flip_limited", number_json(f.flip_limited)},
                                           {"difference", json_of(f.difference)}});
        out["directions"].push_back(std::move(direction));
    }
    out["notes"] = notes_json(judgment.evaluation.notes);
    out["recording_notes"] = notes_json(judgment.evaluation.recording_notes);
    return out;
}

}  // namespace verdigris
