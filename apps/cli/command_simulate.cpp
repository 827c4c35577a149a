// SPDX-License-Identifier: MIT
// A made recording of copper whose truth is known: for whoever has no footage, and for research.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <regex>
#include <system_error>
#include <vector>

#include "commands.h"
#include "stages.h"
#include "verdigris/error.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/observe/unit_axis.h"
#include "verdigris/recording/recording_writer.h"
#include "verdigris/simulate/effort.h"
#include "verdigris/simulate/simulate.h"
#include "verdigris/simulate/spec_file.h"
#include "verdigris/simulate/truth.h"

namespace verdigris::cli {
namespace fs = std::filesystem;
namespace {

/// chosen: the writer's own 12 keeps 41 % of a noise of one code, this keeps 87 %
/// (recording/writer_noise_test.cpp); what forecasts struggle with must be in the footage.
constexpr double kSimulatedCrf = 4;

struct Arguments {
    std::string preset = "chamber", spec, output, truth, size;
    std::optional<std::uint64_t> seed;
    std::optional<int> frames;
    bool full = false, print_spec = false;
};

SimulationSpec spec_of(const Arguments& a) {
    SimulationSpec spec = a.spec.empty() ? preset_spec(a.preset) : read_spec(a.spec, a.preset);
    if (a.full) spec = full_size(spec);
    if (a.seed) spec.seed = *a.seed;
    if (a.frames) spec.frames.count = *a.frames;
    if (!a.size.empty()) {
        static const std::regex kSize("([0-9]{1,5})x([0-9]{1,5})");
        std::smatch match;
        if (!std::regex_match(a.size, match, kSize)) {
            throw Error(ErrorCode::usage, fmt::format("--size is '{}'; give it as WIDTHxHEIGHT, "
                                                      "for example 640x360",
                                                      a.size));
        }
        spec.frames.width = std::stoi(match[1]);
        spec.frames.height = std::stoi(match[2]);
    }
    check_spec(spec);
    return spec;
}

/// specimen.mp4 -> specimen.spec.toml, frames/ -> frames.spec.toml: beside the recording, never in
/// it, where it would be one more file among photographs.
fs::path spec_path(const fs::path& output) {
    fs::path path = output;
    if (!path.has_filename()) path = path.parent_path();
    std::string ending = path.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    const bool video = ending == ".mp4" || ending == ".mkv";
    path.replace_filename((video ? path.stem() : path.filename()).string() + ".spec.toml");
    return path;
}

/// The same folder, or one in the other. Both may not exist yet.
bool overlap(const fs::path& a, const fs::path& b) {
    const fs::path p = fs::weakly_canonical(fs::absolute(a) / "");
    const fs::path q = fs::weakly_canonical(fs::absolute(b) / "");
    const auto parts = [](const fs::path& path) {
        std::vector<fs::path> list;
        for (const fs::path& part : path)
            if (!part.empty()) list.push_back(part);
        return list;
    };
    const auto x = parts(p), y = parts(q);
    return std::mismatch(x.begin(), x.begin() + std::ptrdiff_t(std::min(x.size(), y.size())),
                         y.begin())
               .first == x.begin() + std::ptrdiff_t(std::min(x.size(), y.size()));
}

/// Whether the resolved spec must be written: not if the file there says the same already, in
/// whatever words.
bool spec_is_new(const fs::path& path, const SimulationSpec& spec, bool force) {
    std::error_code error;
    if (!fs::exists(path, error)) return true;
    try {
        if (spec_text(read_spec(path, spec.preset)) == spec_text(spec)) return false;
    } catch (const Error&) {
        // Not a spec at all: somebody's file.
    }
    if (force && !fs::is_directory(path, error)) return true;
    throw Error(ErrorCode::refused,
                "is there already and is another spec than this run's, which would be written "
                "beside the recording under that name; give the recording another name, or use "
                "--force",
                path.string());
}

void check_effort(Session& session, const SimulationSpec& spec) {
    const Effort effort = estimated_effort(spec);
    constexpr double kLongHours = 2, kMuchMemory = 2;  // chosen: --full takes one; a small machine
    if (effort.hours > kLongHours && !session.force) {
        throw Error(ErrorCode::refused,
                    fmt::format("this would take about {:.0f} hours of a core, mostly for {}; "
                                "--force goes on",
                                effort.hours, effort.mostly));
    }
    if (effort.gigabytes > kMuchMemory) {
        session.tell({"much_memory", Severity::info,
                      fmt::format("this takes about {:.0f} GB of memory", effort.gigabytes)});
    }
}

void check_truth_folder(const fs::path& truth, bool force) {
    std::error_code error;
    if (force || !fs::exists(truth, error) || fs::is_empty(truth, error)) return;
    throw Error(ErrorCode::refused, "is there already and holds files; --force writes into it",
                truth.string());
}

Json gains_summary(const SimulationResult& result) {
    double least = 1e9, most = 0;
    for (const FrameGains& g : result.gains) {
        const double mean = (g.linear[0] + g.linear[1] + g.linear[2]) / 3;
        least = std::min(least, mean), most = std::max(most, mean);
    }
    return {{"least", least}, {"most", most}};
}

void run(Session& session, const Arguments& a) {
    const SimulationSpec spec = spec_of(a);
    if (a.print_spec) {
        if (session.json)
            session.result({{"spec", spec_text(spec)}});
        else
            session.say(spec_text(spec));
        return;
    }
    if (a.output.empty()) {
        throw Error(ErrorCode::usage,
                    "give the recording a name: -o specimen.mp4, specimen.mkv (lossless) or a "
                    "folder");
    }
    const fs::path output = a.output, resolved = spec_path(output);
    const bool new_spec = spec_is_new(resolved, spec, session.force);
    if (!a.truth.empty()) {
        check_truth_folder(a.truth, session.force);
        if (overlap(a.truth, output)) {
            throw Error(ErrorCode::usage, fmt::format("the truth ({}) cannot lie in the recording, "
                                                      "nor the recording in the truth",
                                                      a.truth));
        }
    }
    check_effort(session, spec);
    const auto writer = write_recording(output, {.width = spec.frames.width,
                                                 .height = spec.frames.height,
                                                 .fps = spec.frames.fps,
                                                 .bits = spec.camera.bits,
                                                 .replace = session.force,
                                                 .crf = kSimulatedCrf});
    std::optional<TruthWriter> truth;
    if (!a.truth.empty()) truth.emplace(spec, a.truth);

    const SimulationResult result =
        simulate(spec,
                 {.frame8 = [&](int, ImageView<const SrgbU8> frame) { writer->add(frame); },
                  .frame16 = [&](int, ImageView<const SrgbU16> frame) { writer->add(frame); },
                  .state =
                      [&](const Specimen& specimen) {
                          if (truth) truth->add(specimen);
                      }},
                 session.progress());
    // The recording last: whoever sees it sees the rest.
    if (new_spec) write_file(resolved, spec_text(spec));
    if (truth) truth->commit(result, input_name(output));
    writer->commit();

    session.say(fmt::format("simulated {} frames of {}x{}, {:g} units, preset {}, seed {}",
                            spec.frames.count, spec.frames.width, spec.frames.height,
                            spec.frames.units, spec.preset, spec.seed));
    session.say(fmt::format("Look at   {}", output.string()));
    session.say(
        fmt::format("Change    {}   (every number of it; run it with --spec)", resolved.string()));
    if (truth)
        session.say(fmt::format("Truth     {}", (fs::path(a.truth) / "truth.json").string()));
    // What `age` takes the recording to span by itself: see observe/unit_axis.h.
    const double read_as =
        spec.frames.count < kFramesForUnitGrid ? double(spec.frames.count) : kUnitsPerRecording;
    const bool other_units = std::abs(read_as - spec.frames.units) > 1e-9;
    if (other_units) {
        session.tell(
            {"other_units", Severity::info,
             fmt::format("by itself `age` takes {} frames to span {:g} units; --units {:g} "
                         "gives it this recording's own",
                         spec.frames.count, read_as, spec.frames.units)});
    }
    session.say(fmt::format("Try next  verdigris age {}{}", output.string(),
                            other_units ? fmt::format(" --units {:g}", spec.frames.units) : ""));
    session.result({{"simulated", true},
                    {"recording", output.string()},
                    {"spec", resolved.string()},
                    {"truth", a.truth.empty() ? Json(nullptr) : Json(a.truth)},
                    {"preset", spec.preset},
                    {"seed", spec.seed},
                    {"frames", spec.frames.count},
                    {"width", spec.frames.width},
                    {"height", spec.frames.height},
                    {"units", spec.frames.units},
                    {"camera_gain", gains_summary(result)},
                    {"seconds",
                     {{"specimen", result.seconds_specimen},
                      {"camera", result.seconds_camera},
                      {"writing", result.seconds_sinks}}}});
}

}  // namespace

void add_simulate(CLI::App& app, Session& session) {
    auto a = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand(
        "simulate", "Make a recording of copper that corrodes, and the truth about it");
    CLI::Option* preset = command->add_option(
        "--preset", a->preset, fmt::format("{} ({})", fmt::join(preset_names(), ", "), a->preset));
    command->add_option("--spec", a->spec, "A specimen of your own (TOML; start with --print-spec)")
        ->excludes(preset);
    command->add_option("-o,--out", a->output,
                        "specimen.mp4, specimen.mkv (lossless), or a folder of PNGs");
    command->add_option("--truth", a->truth, "Folder for what a recording cannot show");
    command->add_option("--seed", a->seed, "Another specimen on another day (0)")
        ->check(CLI::Range(std::uint64_t(0), std::uint64_t(1) << 53));
    command->add_flag(
        "--full", a->full,
        "As the paper's cameras recorded it: 1080p60 for 601 s; air 720x1280 at 30 for 482 s");
    command->add_option("--size", a->size, "Frames of WIDTHxHEIGHT");
    command->add_option("--frames", a->frames,
                        "Frames in all (984: one per sample; under 148 are read as a unit each)");
    command->add_flag("--print-spec", a->print_spec, "Print every number and stop");
    command->add_flag("--force", session.force, "Replace what is there");
    session.add_options(*command);
    command->callback([a, &session] { session.action = [a](Session& s) { run(s, *a); }; });
}

}  // namespace verdigris::cli
