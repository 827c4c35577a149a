// SPDX-License-Identifier: MIT
#include "judged.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "arguments.h"
#include "learned.h"
#include "stages.h"
#include "verdigris/appearance/material_report.h"
#include "verdigris/evaluate/characterize.h"
#include "verdigris/forecast/choose.h"
#include "verdigris/forecast/observed_range.h"
#include "verdigris/results/protocol_file.h"
#include "verdigris/results/result_files.h"

namespace verdigris::cli {
namespace fs = std::filesystem;
namespace {

/// A file loses its ending; two recordings of one name are told apart.
std::string judged_name(const fs::path& input, std::set<std::string>& taken) {
    const std::string whole = input_name(input);
    std::error_code error;
    std::string stem = fs::is_directory(input, error) ? whole : fs::path(whole).stem().string();
    // The name goes into tables, pages and JSON: what is no UTF-8 or no character is replaced here,
    // once. A sheet would take a first "=" for a formula.
    stem = Json::parse(Json(stem).dump(-1, ' ', false, Json::error_handler_t::replace))
               .get<std::string>();
    for (char& c : stem)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '_';
    if (!stem.empty() && std::string_view("=+-@").find(stem.front()) != std::string_view::npos)
        stem.insert(0, "_");
    std::string name = stem;
    for (int i = 2; !taken.insert(name).second; ++i) name = fmt::format("{} ({})", stem, i);
    return name;
}

/// At commas; empty names stay, to be complained about.
std::vector<std::string> split(const std::string& names) {
    std::vector<std::string> list;
    for (std::size_t start = 0; start <= names.size();) {
        const std::size_t end = std::min(names.find(',', start), names.size());
        list.push_back(names.substr(start, end - start));
        start = end + 1;
    }
    return list;
}

}  // namespace

void JudgeArguments::add(CLI::App& command, bool several) {
    CLI::Option* inputs = command.add_option(
        "RECORDING", recordings, "Videos, or folders of photographs; each is held out in turn");
    inputs->required();
    if (!several) inputs->expected(1);
    add_rules(command);
    command.add_flag("--single", single,
                     "One recording by itself: nothing is held out, and the results say so");
}

void JudgeArguments::add_rules(CLI::App& command) {
    command.add_option("-o,--out", output, "Result folder")->required();
    command.add_option("--protocol", protocol, "TOML file with the rules (docs/PROTOCOL.md)")
        ->check(CLI::ExistingFile);
    command.add_option("--size", size, "Side of the samples in pixels (128, as the paper)")
        ->check(CLI::Range(16, 1024));
    command.add_option("--crop", crop, "auto, none, or x,y,w,h: of every recording");
    command.add_option("--stride", stride, "Samples per unit, of recordings too short for a grid")
        ->check(CLI::Range(1, 1000));
    command.add_option("--context", context, "Observed frames n (5)")->check(CLI::Range(1, 1000));
    command.add_option("--horizons", horizons, "Forecast frames K (10)")
        ->check(CLI::Range(1, 1000));
    // "all" is 0 to the protocol.
    command
        .add_option("--windows", windows,
                    "At most so many windows per recording, evenly spaced; or all")
        ->type_name("N|all")
        ->check(CLI::Range(0, 1000000))
        ->transform(CLI::Validator(
            [](std::string& text) {
                if (text == "all") text = "0";
                return std::string();
            },
            ""));
    command.add_option("--area", area, "frame (all pixels, as the paper) or specimen")
        ->check(CLI::IsMember({"frame", "specimen"}));
    command.add_option("--tau", tau, "Foreground threshold (default: 2.40 times the noise)")
        ->check(CLI::Range(1e-6, 1.0))
        ->check(CLI::Validator(
            [](std::string& text) {  // no comparison holds for it, so no range refuses it
                return text.find("nan") == std::string::npos ? "" : "nan is no threshold";
            },
            ""));
}

std::vector<Observation> observe_all(Session& session, const JudgeArguments& a) {
    ObserveArguments observe_arguments;
    observe_arguments.crop = a.crop;
    ObserveOptions options = observe_arguments.options();
    options.size = a.size;
    options.keep = Keep::every_sample;
    std::vector<Observation> observations;
    std::set<std::string> taken;
    // What is wrong with the last of them, or with the rules, is said before hours go into the
    // first.
    if (!a.protocol.empty()) read_protocol(a.protocol);
    for (const std::string& input : a.recordings) open_recording(input);
    for (const std::string& input : a.recordings) {
        const Recording recording = open_recording(input);
        Observation observation = observe(recording, options, session.progress());
        observation.source_name = judged_name(input, taken);
        observation.source_sha256 = recording.sha256(session.progress());
        session.say(fmt::format("observed  {}: {} samples, {} per unit, noise {:.3f} %",
                                observation.source_name, observation.store->count(),
                                observation.axis.samples_per_unit, 100 * observation.noise.sigma));
        observations.push_back(std::move(observation));
    }
    return observations;
}

void tell_recordings(Session& session, const std::vector<Observation>& observations) {
    for (const Observation& o : observations)
        for (const Status& s : o.notes)
            if (s.severity != Severity::info)
                session.tell(
                    {s.id, Severity::caution, fmt::format("{}: {}", o.source_name, s.sentence)});
}

EvaluationProtocol protocol_for(Session& session, const JudgeArguments& a,
                                const std::vector<Observation>& observations) {
    // A stride is samples per unit: of two recordings it means the same only on one axis.
    for (const Observation& o : observations) {
        const int first = observations.front().axis.samples_per_unit;
        if (o.axis.samples_per_unit == first) continue;
        throw Error(
            ErrorCode::refused,
            fmt::format("{} has {} samples per unit and {} has {}: their windows would span "
                        "different units; judge recordings of like length together",
                        observations.front().source_name, first, o.source_name,
                        o.axis.samples_per_unit));
    }
    EvaluationProtocol protocol;
    if (!a.protocol.empty()) {
        protocol = read_protocol(a.protocol);
    } else {
        int per_unit = kMaxSamplesPerUnit;
        bool whole = true;
        for (const Observation& o : observations) {
            per_unit = std::min(per_unit, o.axis.samples_per_unit);
            whole = whole && o.store->count() == protocol.grid;
        }
        if (!whole || a.stride) {
            protocol = short_recording_protocol(a.stride.value_or(per_unit));
            session.say(
                fmt::format("protocol  short recordings: nothing trimmed, {} samples per "
                            "unit",
                            protocol.stride));
        } else {
            session.say("protocol  the paper's: 984 samples, of which 950 count, 10 per unit");
        }
    }
    if (a.stride) protocol.stride = *a.stride;
    if (a.context) protocol.context = *a.context;
    if (a.horizons) protocol.horizons = *a.horizons;
    if (a.windows) protocol.max_windows = *a.windows;
    if (a.area == "specimen") protocol.area = EvaluatedArea::specimen;
    if (a.area == "frame") protocol.area = EvaluatedArea::frame;
    if (a.tau > 0) protocol.tau = a.tau;
    protocol.single = protocol.single || a.single;
    if (!a.hold_out.empty()) protocol.hold_out = a.hold_out;
    check_protocol(protocol);
    return protocol;
}

std::vector<Entrant> entrants_from(const std::string& names, int furthest) {
    std::vector<Entrant> entrants;
    for (const std::string& name : split(names)) {
        if (name == "persistence" || is_checkpoint(name)) continue;  // the first is always there
        std::string base = name;
        const auto ends = [&](std::string_view suffix) {
            if (!base.ends_with(suffix)) return false;
            base.resize(base.size() - suffix.size());
            return true;
        };
        const bool in_range = furthest > 0 && ends(kInRangeSuffix);
        const bool product = name == "auto" || ends("-ridge");
        ChooseOptions options;
        if (!product) {
            options.ridge_k = 0;  // the paper's
            options.clamp = ends(kClampedSuffix);
        }
        Forecaster forecaster = forecaster_by_name(base, options);
        if (in_range) {
            std::vector<double> units;
            for (int k = 1; k <= furthest; ++k) units.push_back(k);
            forecaster = within_observed_range(std::move(forecaster), std::move(units));
        }
        Entrant entrant = training_free(std::move(forecaster));
        entrant.name = name;
        entrants.push_back(std::move(entrant));
    }
    return entrants;
}

std::vector<std::string> checkpoints_among(const std::string& names) {
    std::vector<std::string> paths;
    for (const std::string& name : split(names))
        if (is_checkpoint(name)) paths.push_back(name);
    return paths;
}

void check_results_folder(const fs::path& output, const char* mark, bool force) {
    std::error_code error;
    if (!fs::exists(output, error)) return;
    if (!fs::is_directory(output, error))
        throw Error(ErrorCode::failed, "is a file, not a folder; choose another with -o",
                    output.string());
    const bool ours = fs::is_regular_file(output / mark, error);
    for (const auto& [other, command] :
         {std::pair(kEvaluationFile, "evaluate"), std::pair(kCharacterizationFile, "characterize"),
          std::pair(kDriftFile, "drift"), std::pair(kMaterialsFile, "judge-materials"),
          std::pair(kReproductionFile, "reproduce")}) {
        if (other == std::string_view(mark) || !fs::is_regular_file(output / other, error))
            continue;
        // Not even --force: of two results in one folder neither would be whole.
        throw Error(ErrorCode::refused,
                    fmt::format("holds a result of `{}`; choose another folder with -o", command),
                    output.string());
    }
    const FileList list = ours ? read_file_list(output) : FileList();
    for (const fs::directory_entry& entry : fs::directory_iterator(output, error)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with(".partial-")) continue;
        // Not even --force replaces what is not ours: these would go as whole folders.
        const bool in_the_way =
            name == "tables" || name == "figures" || name == "report.html" ||
            (mark == std::string_view(kMaterialsFile) && name == kRendersFolder);
        if (ours && !in_the_way) continue;
        const std::string own = ours ? unlisted_file(output, name, list) : name;
        if (own.empty()) continue;
        if (in_the_way || !force)
            throw Error(ErrorCode::refused,
                        fmt::format("holds '{}', which is not a result of ours; choose an empty "
                                    "folder{}",
                                    own, in_the_way ? "" : " or use --force"),
                        output.string());
    }
}

void deliver_results(Session& session, const fs::path& output, const Report& report,
                     const std::vector<Table>& data,
                     const std::function<void(const fs::path&)>& more) {
    StagedFolder staged(output);
    const WrittenResults written = write_results(report, staged.path(), data, session.progress());
    if (more) more(staged.path());
    write_file_list(staged.path());
    const FileList before = read_file_list(output);
    staged.commit(kFileList);
    remove_left_over(output, before);
    for (const Status& s : written.statuses) session.tell(s);
    session.say("");
    session.say(fmt::format("Read      {}", (output / "report.html").string()));
    session.say(fmt::format("Tables    {}/   (CSV, JSON, LaTeX)", (output / "tables").string()));
}

}  // namespace verdigris::cli
