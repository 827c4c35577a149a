// SPDX-License-Identifier: MIT
#include "verdigris/results/evaluation_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "verdigris/error.h"
#include "verdigris/results/cells.h"

namespace verdigris {
namespace {
using Json = nlohmann::ordered_json;

constexpr const char* kRecordFormat = "verdigris-evaluation-record/2";

Json range(SampleRange r) {
    return Json{r.begin, r.end};
}
SampleRange range_from(const Json& json) {
    return {json.at(0).get<int>(), json.at(1).get<int>()};
}
Json surface(const SurfacePrint& print) {
    return {{"place", print.place}, {"cells", print.cells}};
}
SurfacePrint surface_from(const Json& json, const std::string& where) {
    SurfacePrint print{json.at("place"), json.at("cells")};
    // A print of another size would be read beyond its end.
    constexpr std::size_t kCells =
        std::size_t(SurfacePrint::kMoments) * SurfacePrint::kSide * SurfacePrint::kSide;
    if (!print.empty() && print.cells.size() != kCells)
        throw Error(ErrorCode::bad_input, "has the print of a surface in another size", where);
    return print;
}
double mean_of(const std::vector<double>& values) {
    double sum = 0;
    for (const double v : values) sum += v;
    return sum / double(values.size());
}
double mean(const ErrorTable& t) {
    return t.empty() || t.windows == 0 ? std::nan("") : overall_mean(t);
}

Json scores_json(const Direction& d, const EntrantScores& s, const EntrantVerdict* v) {
    const bool any = !d.starts.empty();
    Json out = {{"trained", s.trained},
                {"error",
                 {{"mean", number_json(mean(s.foreground))},
                  {"per_horizon", any ? numbers_json(horizon_means(s.foreground)) : Json()}}},
                {"specimen_error", number_json(mean(s.specimen))},
                {"delta_e", number_json(mean(s.delta_e))},
                {"bias",
                 {number_json(mean(s.bias[0])), number_json(mean(s.bias[1])),
                  number_json(mean(s.bias[2]))}}};
    if (std::isfinite(mean_of(known_means(s.pixels80))))
        out["coverage"] = {{"pixels_80", numbers_json(known_means(s.pixels80))},
                           {"pixels_95", numbers_json(known_means(s.pixels95))},
                           {"mean_80", numbers_json(known_means(s.mean80))},
                           {"mean_95", numbers_json(known_means(s.mean95))}};
    if (!v) return out;
    out["gain"] = number_json(v->gain);
    out["gain_per_horizon"] = any ? numbers_json(horizon_gains(d, s)) : Json();
    out["intervals"] = {{"block", interval_json(v->block)},
                        {"circular_block", interval_json(v->circular_block)},
                        {"naive", interval_json(v->naive)}};
    out["blocks"] = blocks_json(v->blocks);
    for (const EntrantVerdict::Named& n : v->named)
        out["named_blocks"][n.block.name] = {{"units", {n.block.begin, n.block.end}},
                                             {"windows", n.windows},
                                             {"gain", number_json(n.gain)}};
    out["verdict"] = v->sentence;
    return out;
}

}  // namespace

Json json_of(const Evaluation& evaluation, const std::vector<DirectionVerdict>& list) {
    Json out = {{"protocol", protocol_json(evaluation.protocol)}, {"directions", Json::array()}};
    for (const DirectionVerdict& verdict : list) {
        const Direction& d = *verdict.direction;
        Json direction = {{"label", d.label()},
                          {"held_out", d.held_out},
                          {"sources", d.sources},
                          {"windows", d.starts.size()},
                          {"windows_skipped", d.skipped.size()},
                          {"windows_independent", d.plan.independent},
                          {"noise", number_json(d.sigma)},
                          {"tau", number_json(d.tau)},
                          {"forecasters", Json::object()}};
        direction["forecasters"][d.persistence().name] = scores_json(d, d.persistence(), nullptr);
        for (std::size_t i = 1; i < d.entrants.size(); ++i)
            direction["forecasters"][d.entrants[i].name] =
                scores_json(d, d.entrants[i], &verdict.entrants[i - 1]);
        direction["pairs"] = Json::array();
        for (const PairVerdict& pair : verdict.pairs)
            direction["pairs"].push_back({{"first", pair.first},
                                          {"second", pair.second},
                                          {"difference", number_json(pair.difference)},
                                          {"block", interval_json(pair.block)},
                                          {"circular_block", interval_json(pair.circular_block)}});
        out["directions"].push_back(std::move(direction));
    }
    out["notes"] = notes_json(evaluation.notes);
    out["recording_notes"] = notes_json(evaluation.recording_notes);
    return out;
}

Json json_of(const EvaluationRecord& record) {
    Json out = {{"format", kRecordFormat},     {"span", record.span},
                {"embargo", record.embargo},   {"single", record.single},
                {"recordings", Json::array()}, {"directions", Json::array()}};
    for (const RecordingRecord& r : record.recordings)
        out["recordings"].push_back({{"name", r.name},
                                     {"sha256", r.sha256},
                                     {"samples", r.samples},
                                     {"usable", range(r.usable)},
                                     {"frame_hashes", r.frame_hashes},
                                     {"surface", surface(r.surface)}});
    for (const DirectionRecord& d : record.directions) {
        Json uses = Json::array();
        for (const SampleUse& u : d.uses)
            uses.push_back({{"role", to_string(u.role)},
                            {"recording", u.recording},
                            {"allowed", range(u.allowed)},
                            {"starts", u.starts},
                            {"samples", u.samples},
                            {"planned", u.planned},
                            {"skipped", u.skipped}});
        out["directions"].push_back(
            {{"held_out", d.held_out}, {"trained", d.trained}, {"uses", std::move(uses)}});
    }
    return out;
}

EvaluationRecord record_from(const Json& json, const std::string& where) {
    try {
        if (json.at("format") != kRecordFormat)
            throw Error(ErrorCode::bad_input, "is a record of another version", where);
        EvaluationRecord record;
        record.span = json.at("span");
        record.embargo = json.at("embargo");
        record.single = json.at("single");
        for (const Json& r : json.at("recordings"))
            record.recordings.push_back({r.at("name"), r.at("sha256"), r.at("samples"),
                                         range_from(r.at("usable")), r.at("frame_hashes"),
                                         surface_from(r.at("surface"), where)});
        for (const Json& d : json.at("directions")) {
            DirectionRecord direction{d.at("held_out"), d.at("trained"), {}};
            for (const Json& u : d.at("uses")) {
                const std::string role = u.at("role");
                SampleUse use;
                use.role = role == "train"        ? SampleRole::train
                           : role == "validation" ? SampleRole::validation
                                                  : SampleRole::test;
                if (to_string(use.role) != role)
                    throw Error(ErrorCode::bad_input, "has a use with no role we know", where);
                use.recording = u.at("recording");
                use.allowed = range_from(u.at("allowed"));
                use.starts = u.at("starts").get<std::vector<int>>();
                use.samples = u.at("samples").get<std::vector<int>>();
                use.planned = u.at("planned");
                use.skipped = u.at("skipped");
                direction.uses.push_back(std::move(use));
            }
            record.directions.push_back(std::move(direction));
        }
        return record;
    } catch (const nlohmann::json::exception&) {
        throw Error(ErrorCode::bad_input, "is not a record of an evaluation", where);
    }
}

}  // namespace verdigris
