// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "arguments.h"
#include "commands.h"
#include "json_of.h"
#include "verdigris/forecast/capture_advice.h"

namespace verdigris::cli {
namespace {

struct Arguments {
    std::string input, assume_matrix, assume_range;
};

Json json_of(const CaptureOutlook& o) {
    return {{"more_units", o.units}, {"more_frames", o.frames}, {"expected_error", o.error}};
}

Json json_of(const CaptureAdvice& a) {
    Json outlooks = Json::array();
    for (const CaptureOutlook& o : a.outlooks) outlooks.push_back(json_of(o));
    return {{"id", a.id},
            {"sentence", a.sentence},
            {"expected_error", a.outlooks.empty() ? Json(nullptr) : Json(a.error)},
            {"noise_share", a.noise_share},
            {"light_share", a.light_share},
            {"unforeseen_share", a.unforeseen_share},
            {"backdrop", a.backdrop},
            {"halved", a.halved ? json_of(*a.halved) : Json(nullptr)},
            {"outlooks", outlooks}};
}

void run(Session& session, const Arguments& a) {
    RecordingOptions options;
    options.assume_matrix = a.assume_matrix;
    options.assume_range = a.assume_range;
    const Recording recording = open_recording(a.input, options);
    RecentUnits recent;
    const Inspection i = inspect(recording, recent, session.progress());
    const CaptureAdvice advice = capture_advice(recent);
    const RecordingInfo& info = recording.info();
    const auto line = [&](const char* name, const std::string& text) {
        session.say(fmt::format("{:<11}{}", name, text));
    };
    line("recording",
         fmt::format("{}, {} ({})", info.path.filename().string(),
                     info.kind == RecordingKind::video ? "video" : "photographs", info.codec));
    line("frames", fmt::format("{} of {}x{}, {}", i.frames, info.width, info.height,
                               info.variable_rate ? "variable rate" : "constant rate"));
    line("times", fmt::format("from {}: {:.3f} s in all, step {:.3f} s, longest {:.3f} s",
                              to_string(info.time_source), i.duration_seconds,
                              i.median_step_seconds, i.longest_step_seconds));
    line("color", info.color_description);
    if (!info.camera.empty()) line("camera", info.camera);
    line("units", fmt::format("{:.1f} accelerated units, {} sample{} each", i.units,
                              i.samples_per_unit, i.samples_per_unit == 1 ? "" : "s"));
    line("specimen", as_sentence(i.crop_sentence));
    line("change", fmt::format("{:.2f} % of full scale from first to last; noise of one frame "
                               "{:.2f} %",
                               i.specimen_change * 100, i.noise_sigma * 100));
    line("exposure", i.drift_known
                         ? fmt::format("drifts by {:.2f} %, white balance by {:.2f} %",
                                       i.exposure_drift * 100, i.white_balance_drift * 100)
                         : "drift unknown: there is no backdrop to measure it on");
    line("clipped", fmt::format("{:.2f} % of the specimen", i.clipped_share * 100));
    for (const Status& s : i.findings) session.tell(s);
    for (const Status& s : info.notes) {
        const bool told = std::any_of(i.findings.begin(), i.findings.end(),
                                      [&](const Status& f) { return f.sentence == s.sentence; });
        if (!told) session.tell(s);
    }
    line("verdict", as_sentence(i.verdict_sentence));
    line("advice", as_sentence(advice.sentence));
    session.result({{"recording", cli::json_of(info)},
                    {"inspection", cli::json_of(i)},
                    {"advice", json_of(advice)}});
}

}  // namespace

void add_inspect(CLI::App& app, Session& session) {
    auto a = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("inspect", "What is this recording, and is it fit?");
    command->add_option("INPUT", a->input, "A video, or a folder of photographs")->required();
    command->add_option("--assume-matrix", a->assume_matrix, "As in `age`");
    command->add_option("--assume-range", a->assume_range, "As in `age`");
    session.add_options(*command);
    command->callback([a, &session] { session.action = [a](Session& s) { run(s, *a); }; });
}

}  // namespace verdigris::cli
