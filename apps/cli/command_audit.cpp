// SPDX-License-Identifier: MIT
// Did anything leak? And do the tables follow from the errors they were made of?
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <system_error>
#include <vector>

#include "commands.h"
#include "json_of.h"
#include "judged.h"
#include "verdigris/evaluate/audit.h"
#include "verdigris/evaluate/bootstrap.h"
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

/// Foreground errors of one forecaster on one held-out recording: start -> horizon -> error.
using Errors = std::map<int, std::map<int, double>>;

template <class Number>
Number number_in(const std::string& text, const fs::path& path, int line) {
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
        throw Error(ErrorCode::bad_input, fmt::format("'{}' is no number", text.substr(0, 40)),
                    fmt::format("{}, line {}", path.string(), line));
    return value;
}

/// direction -> forecaster -> errors.
std::map<std::string, std::map<std::string, Errors>> read_errors(const fs::path& path,
                                                                 Statuses& findings) {
    const CsvTable table = read_csv(path);
    std::array<std::size_t, 5> at{};
    const std::array<const char*, 5> names{"direction", "forecaster", "start", "horizon",
                                           "foreground"};
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (table.column(names[i]) < 0)
            throw Error(ErrorCode::bad_input, fmt::format("lacks the column {}", names[i]),
                        path.string());
        at[i] = std::size_t(table.column(names[i]));
    }
    std::map<std::string, std::map<std::string, Errors>> errors;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const auto& row = table.rows[i];
        const int start = number_in<int>(row[at[2]], path, table.lines[i]);
        const int horizon = number_in<int>(row[at[3]], path, table.lines[i]);
        const double error = number_in<double>(row[at[4]], path, table.lines[i]);
        auto& place = errors[row[at[0]]][row[at[1]]][start];
        if (!place.emplace(horizon, error).second)
            findings.push_back({"error_twice", Severity::refusal,
                                fmt::format("{}, line {}: a window's error stands there a second "
                                            "time",
                                            path.string(), table.lines[i])});
    }
    return errors;
}

/// Everything of evaluation.json that follows from the errors alone, made again and compared.
class Recount {
  public:
    Recount(const EvaluationRecord& record, Statuses& findings)
        : record_(record), findings_(findings) {}
    int compared() const { return compared_; }

    void direction(const Json& d, const std::map<std::string, Errors>& errors) {
        label_ = d.at("label").get<std::string>();
        const std::string held_out = d.at("held_out");
        const std::string base = d.at("forecasters").begin().key();
        if (errors.count(base) == 0 || errors.size() != d.at("forecasters").size())
            return complain("other forecasters than evaluation.json");
        std::set<int> recorded;
        for (const DirectionRecord& r : record_.directions) {
            if (r.held_out != held_out) continue;
            for (const SampleUse& use : r.uses) {
                if (use.role == SampleRole::test && use.recording == held_out)
                    recorded.insert(use.starts.begin(), use.starts.end());
            }
        }
        const Errors& still = errors.at(base);
        std::set<int> starts;
        for (const auto& [start, row] : still) starts.insert(start);
        if (starts != recorded) complain("other windows than record.json");
        if (int(starts.size()) != d.at("windows").get<int>())
            complain("another number of windows than evaluation.json");
        for (const auto& [name, scores] : d.at("forecasters").items()) {
            if (errors.count(name) == 0) {
                complain("no errors of " + name);
                continue;
            }
            forecaster(name, scores, errors.at(name), still);
        }
    }

  private:
    void complain(const std::string& what) {
        findings_.push_back({"does_not_follow", Severity::refusal,
                             fmt::format("{}: windows_all.csv has {}", label_, what)});
    }
    void compare(const std::string& name, const char* what, const Json& said, double made) {
        ++compared_;
        const bool missing = said.is_null() || !said.is_number();
        if (missing ? !std::isfinite(made)
                    : std::abs(said.get<double>() - made) <= 1e-9 * (std::abs(made) + 1e-12))
            return;
        findings_.push_back(
            {"does_not_follow", Severity::refusal,
             fmt::format("{}, {}: evaluation.json says {} is {}, the errors give {:.6g}", label_,
                         name, what,
                         missing ? "nothing" : fmt::format("{:.6g}", said.get<double>()), made)});
    }
    void forecaster(const std::string& name, const Json& scores, const Errors& errors,
                    const Errors& still) {
        WindowRatios ratios;
        std::map<int, double> by_horizon;
        for (const auto& [start, row] : errors) {
            const auto other = still.find(start);
            if (other == still.end() || other->second.size() != row.size())
                return complain("not the same windows of " + name + " as of the first");
            double model = 0, held = 0;
            for (const auto& [horizon, error] : row) by_horizon[horizon] += error, model += error;
            for (const auto& [horizon, error] : other->second) held += error;
            const double n = double(row.size());
            ratios.starts.push_back(start);
            ratios.over.push_back((held - model) / n);
            ratios.under.push_back(held / n);
        }
        if (errors.size() != still.size())
            return complain("not the same windows of " + name + " as of the first");
        double mean = 0;
        const Json& per_horizon = scores.at("error").at("per_horizon");
        std::size_t k = 0;
        for (const auto& [horizon, sum] : by_horizon) {
            const double of_horizon = sum / double(errors.size());
            compare(name, "the error of a horizon",
                    k < per_horizon.size() ? per_horizon[k] : Json(), of_horizon);
            mean += of_horizon / double(by_horizon.size());
            ++k;
        }
        compare(name, "the mean error", scores.at("error").at("mean"), mean);
        if (!scores.contains("gain")) return;
        compare(name, "the gain", scores.at("gain"), ratio(ratios));
        const auto blocks = block_gains(ratios, record_.span);
        const Json& said = scores.at("blocks");
        if (said.size() != blocks.size()) return complain("other blocks of " + name);
        for (std::size_t i = 0; i < blocks.size(); ++i)
            compare(name, "a block's gain", said[i].at("gain"), blocks[i].value);
        BootstrapOptions options;
        options.block = record_.span;
        // Enumerated, not drawn, up to twelve blocks: then it has no seed.
        if (blocks.size() > 12) return;
        const auto interval = bootstrap(ratios, BootstrapKind::block, options);
        const Json& said_interval = scores.at("intervals").at("block");
        compare(name, "the low end of the block interval",
                said_interval.is_array() ? said_interval[0] : Json(),
                interval ? interval->low : std::nan(""));
        compare(name, "the high end of the block interval",
                said_interval.is_array() ? said_interval[1] : Json(),
                interval ? interval->high : std::nan(""));
    }

    const EvaluationRecord& record_;
    Statuses& findings_;
    std::string label_;
    int compared_ = 0;
};

int recount(const fs::path& folder, const EvaluationRecord& record, Statuses& findings) {
    const auto errors = read_errors(folder / "tables" / "windows_all.csv", findings);
    const Json evaluation = read_json(folder / kEvaluationFile);
    Recount count(record, findings);
    try {
        std::set<std::string> held_out;
        for (const Json& d : evaluation.at("directions")) {
            held_out.insert(d.at("held_out").get<std::string>());
            const auto found = errors.find(d.at("label").get<std::string>());
            if (found != errors.end()) {
                count.direction(d, found->second);
            } else if (d.at("windows").get<int>() > 0) {
                findings.push_back({"does_not_follow", Severity::refusal,
                                    fmt::format("windows_all.csv has nothing of {}",
                                                d.at("label").get<std::string>())});
            }
        }
        std::set<std::string> recorded, judged;
        for (const DirectionRecord& d : record.directions) recorded.insert(d.held_out);
        for (const RecordingRecord& r : record.recordings) judged.insert(r.name);
        if (recorded != held_out || judged != held_out)
            findings.push_back({"does_not_follow", Severity::refusal,
                                "record.json and evaluation.json do not name the same recordings"});
    } catch (const nlohmann::json::exception&) {
        throw Error(ErrorCode::bad_input, "is not what `evaluate` writes",
                    (folder / kEvaluationFile).string());
    }
    return count.compared();
}

/// The record against the protocol beside it: span, embargo, and the windows that it names.
void check_protocol_of(const fs::path& folder, const EvaluationRecord& record, Statuses& findings) {
    const auto differs = [&](const std::string& what) {
        findings.push_back({"record_differs_from_protocol", Severity::refusal,
                            fmt::format("record.json has {} than protocol.toml", what)});
    };
    const EvaluationProtocol protocol = read_protocol(folder / kProtocolFile);
    if (record.span != protocol.span()) differs("another span of a window");
    if (record.embargo != protocol.embargo_samples()) differs("another embargo");
    if (record.single != protocol.single) differs("another say on what is held out");
    for (const RecordingRecord& r : record.recordings) {
        const WindowPlan plan = plan_windows(protocol, r.samples, r.name);
        if (r.usable != plan.usable) differs(fmt::format("other usable samples of {}", r.name));
        const std::set<int> named(plan.starts.begin(), plan.starts.end());
        for (const DirectionRecord& d : record.directions) {
            for (const SampleUse& use : d.uses) {
                if (use.role != SampleRole::test || use.recording != r.name) continue;
                const bool all = std::ranges::all_of(
                    use.starts, [&](int start) { return named.contains(start); });
                if (!all || use.planned != int(named.size()))
                    differs(fmt::format("other windows of {}", r.name));
            }
        }
    }
}

/// The pair of recordings that comes nearest to being one.
void tell_likeness(Session& session, const EvaluationRecord& record) {
    double most = -1;
    std::string pair;
    for (std::size_t i = 0; i < record.recordings.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const RecordingRecord &a = record.recordings[j], &b = record.recordings[i];
            const double likeness = surface_likeness(a.surface, b.surface);
            if (likeness <= most) continue;
            most = likeness;
            pair = fmt::format("{} and {}", a.name, b.name);
        }
    }
    if (!pair.empty())
        session.say(
            fmt::format("surfaces  most alike are {}: {:.2f} (from {:.2f} on they would "
                        "count as one recording)",
                        pair, most, kNearCopy));
}

void run(Session& session, const std::string& results) {
    const fs::path folder = results;
    std::error_code error;
    if (fs::is_regular_file(folder / kMaterialsFile, error))
        throw Error(
            ErrorCode::bad_input,
            "is a result of `judge-materials`, which audit does not take; evaluate the same "
            "forecasters for one that it does",
            folder.string());
    const EvaluationRecord record =
        record_from(read_json(folder / kRecordFile), (folder / kRecordFile).string());
    Statuses findings =
        check_file_list(folder, {"report.html", kEvaluationFile, kRecordFile, kProtocolFile,
                                 "tables/errors.csv", "tables/windows_all.csv"});
    const Statuses leaked = audit(record);
    findings.insert(findings.end(), leaked.begin(), leaked.end());
    check_protocol_of(folder, record, findings);
    const int compared = recount(folder, record, findings);
    std::size_t leaks = 0;
    for (const Status& s : findings) {
        leaks += s.severity == Severity::refusal;
        session.tell(s);
    }
    session.say(
        fmt::format("audited   {} recordings, {} directions; {} numbers made again from "
                    "their windows",
                    record.recordings.size(), record.directions.size(), compared));
    tell_likeness(session, record);
    if (leaks == 0)
        session.say(
            "verdict   nothing leaked; errors, gains and block intervals follow from the windows, "
            "and "
            "the files are those that were delivered");
    session.result({{"clean", leaks == 0}, {"findings", json_of(findings)}});
    if (leaks > 0) {
        session.json = false;  // the one object has been printed; the sentence goes to stderr
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
