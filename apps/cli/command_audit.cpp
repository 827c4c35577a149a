// SPDX-License-Identifier: MIT
// Did anything leak? And do the tables follow from the errors they were made of?
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <system_error>
#include <vector>

#include "commands.h"
#include "json_of.h"
#include "judged.h"
#include "verdigris/evaluate/audit.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/files/csv.h"
#include "verdigris/results/results.h"

namespace verdigris::cli {
namespace fs = std::filesystem;
namespace {

Json read_json(const fs::path& path) {
    std::error_code error;
    if (!fs::is_regular_file(path, error))
        throw Error(ErrorCode::bad_input, "is not there; is this a folder that `evaluate` made?",
                    path.string());
    const Json json = Json::parse(read_text(path, std::size_t(1) << 30), nullptr, false);
    if (json.is_discarded()) throw Error(ErrorCode::bad_input, "is not JSON", path.string());
    return json;
}

struct Sum {
    double foreground = 0;
    int rows = 0;
};

/// Means computed again from the errors of each window, against what evaluation.json says.
Statuses recomputed(const fs::path& folder, int& compared) {
    const fs::path path = folder / "tables" / "windows_all.csv";
    const CsvTable table = read_csv(path);
    const int direction = table.column("direction"), forecaster = table.column("forecaster"),
              error = table.column("foreground"), start = table.column("start");
    if (direction < 0 || forecaster < 0 || error < 0 || start < 0)
        throw Error(ErrorCode::bad_input, "lacks a column", path.string());
    std::map<std::pair<std::string, std::string>, Sum> sums;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const auto& row = table.rows[i];
        Sum& sum = sums[{row[std::size_t(direction)], row[std::size_t(forecaster)]}];
        try {
            sum.foreground += std::stod(row[std::size_t(error)]);
        } catch (const std::exception&) {
            throw Error(ErrorCode::bad_input, "has an error that is no number",
                        fmt::format("{}, line {}", path.string(), table.lines[i]));
        }
        ++sum.rows;
    }
    Statuses findings;
    const Json evaluation = read_json(folder / kEvaluationFile);
    try {
        for (const Json& d : evaluation.at("directions")) {
            for (const auto& [name, scores] : d.at("forecasters").items()) {
                const Json& said = scores.at("error").at("mean");
                const auto sum = sums.find({d.at("label").get<std::string>(), name});
                if (said.is_null()) continue;
                const double mean =
                    sum == sums.end() ? std::nan("") : sum->second.foreground / sum->second.rows;
                ++compared;
                if (std::abs(mean - said.get<double>()) <= 1e-9 * std::abs(said.get<double>()))
                    continue;
                findings.push_back(
                    {"mean_does_not_follow", Severity::refusal,
                     fmt::format("{}, {}: evaluation.json says a mean error of {:.6g}, the errors "
                                 "of its windows give {:.6g}",
                                 d.at("label").get<std::string>(), name, said.get<double>(),
                                 mean)});
            }
        }
    } catch (const nlohmann::json::exception&) {
        throw Error(ErrorCode::bad_input, "is not what `evaluate` writes",
                    (folder / kEvaluationFile).string());
    }
    return findings;
}

void run(Session& session, const std::string& results) {
    const fs::path folder = results;
    const EvaluationRecord record =
        record_from(read_json(folder / kRecordFile), (folder / kRecordFile).string());
    Statuses findings = audit(record);
    int compared = 0;
    for (Status& s : recomputed(folder, compared)) findings.push_back(std::move(s));
    std::size_t leaks = 0;
    for (const Status& s : findings) {
        leaks += s.severity == Severity::refusal;
        session.tell(s);
    }
    session.say(
        fmt::format("audited   {} recordings, {} directions; {} means computed again from "
                    "their windows",
                    record.recordings.size(), record.directions.size(), compared));
    if (leaks == 0) session.say("verdict   nothing leaked, and the numbers follow from the errors");
    session.result({{"clean", leaks == 0}, {"findings", json_of(findings)}});
    if (leaks > 0) {
        throw Error(ErrorCode::refused,
                    fmt::format("{} finding{} that spoil{} this result", leaks,
                                leaks == 1 ? "" : "s", leaks == 1 ? "s" : ""),
                    folder.string());
    }
}

}  // namespace

void add_audit(CLI::App& app, Session& session) {
    auto results = std::make_shared<std::string>();
    CLI::App* command =
        app.add_subcommand("audit", "Did anything leak into a result, and do its numbers follow?");
    command->add_option("RESULTS", *results, "A folder that `evaluate` made")->required();
    session.add_options(*command);
    command->callback(
        [results, &session] { session.action = [results](Session& s) { run(s, *results); }; });
}

}  // namespace verdigris::cli
