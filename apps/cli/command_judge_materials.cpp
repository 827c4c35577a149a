// SPDX-License-Identifier: MIT
// Forecasters judged by how their materials look beside the true ones: the paper's Table 3.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "commands.h"
#include "judged.h"
#include "learned.h"
#include "verdigris/appearance/appearance.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/files/png.h"
#include "verdigris/report/table_formats.h"
#include "verdigris/results/results.h"

namespace verdigris::cli {
namespace fs = std::filesystem;
namespace {

// chosen: a window costs a dozen seconds, and more of them than this overlap ever more.
constexpr int kUsualWindows = 12;

struct Arguments {
    JudgeArguments judge;
    std::string forecasters = "affinergb,affinergb-clamped,auto", scene = "sphere", scale = "truth",
                lpips_weights;
    std::vector<int> horizons{5, 10, 20, 50};
    MaterialJudgeOptions options;
};

std::vector<int> sorted(std::vector<int> horizons) {
    std::ranges::sort(horizons);
    horizons.erase(std::unique(horizons.begin(), horizons.end()), horizons.end());
    return horizons;
}

/// All are drawn before the first file is written.
std::vector<std::pair<std::string, Image<SrgbU8>>> contacts(const MaterialJudgment& judgment) {
    std::vector<std::pair<std::string, Image<SrgbU8>>> sheets;
    for (std::size_t h = 0; h < judgment.options.horizons.size(); ++h)
        sheets.emplace_back(fmt::format("u{:03}.png", judgment.options.horizons[h]),
                            draw_material_contact(judgment, h));
    for (std::size_t d = 0; d < judgment.directions.size(); ++d)
        sheets.emplace_back(fmt::format("frames-{}.png", d + 1), draw_frame_sheet(judgment, d));
    return sheets;
}

void run(Session& session, Arguments a) {
    check_results_folder(a.judge.output, kMaterialsFile, session.force);
    MaterialJudgeOptions& options = a.options;
    if (!std::isfinite(options.pixels_per_degree))  // "nan" passes every range
        throw Error(ErrorCode::usage, "--ppd: pixels per degree are a number");
    options.horizons = sorted(a.horizons);
    options.view.scene = *scene_kind_from(a.scene);
    options.scale = a.scale == "frame" ? CoverageScale::frame : CoverageScale::truth;
    std::vector<Entrant> entrants = entrants_from(a.forecasters, options.horizons.back());
    const std::vector<std::string> checkpoints = checkpoints_among(a.forecasters);
    check_checkpoints(checkpoints);
    LpipsMeasure lpips = lpips_measure(a.lpips_weights, options.view.size, options.view.size);
    options.lpips = std::move(lpips.distance);
    options.no_lpips = std::move(lpips.why_not);

    const std::vector<Observation> observations = observe_all(session, a.judge);
    if (!a.judge.windows && a.judge.protocol.empty()) a.judge.windows = kUsualWindows;
    const EvaluationProtocol protocol = protocol_for(session, a.judge, observations);
    for (Entrant& learned :
         learned_entrants(checkpoints, material_protocol(protocol, options.horizons)))
        entrants.push_back(std::move(learned));
    const MaterialJudgment judgment =
        judge_materials(protocol, observations, entrants, options, session.progress());
    if (judgment.directions.empty()) {
        const Direction& d = judgment.evaluation.directions.front();
        throw Error(ErrorCode::refused,
                    fmt::format("leaves no window to judge, and no other recording does: {}",
                                d.skipped.empty() ? "none fits" : d.skipped.front().why),
                    d.held_out);
    }
    const std::vector<MaterialDirectionVerdict> list = material_verdicts(judgment);
    Report report = material_report(judgment, list);
    report.footer = fmt::format("verdigris {}", VERDIGRIS_VERSION);
    const Json json = json_of(judgment, list);
    const auto sheets = contacts(judgment);
    deliver_results(
        session, a.judge.output, report, {material_windows(judgment)}, [&](const fs::path& folder) {
            fs::create_directories(folder / kRendersFolder);
            for (const auto& [name, sheet] : sheets)
                write_png(folder / kRendersFolder / name, sheet);
            write_file(folder / kMaterialsFile, json.dump(2) + "\n");
            write_file(folder / kRecordFile, json_of(judgment.evaluation.record).dump() + "\n");
            write_file(folder / kProtocolFile, protocol_text(judgment.evaluation.protocol));
        });
    session.say(fmt::format("Look at   {}", (fs::path(a.judge.output) / kRendersFolder).string()));
    session.say("");
    session.say(table_plain(material_table(judgment, list)));
    for (const MaterialDirectionVerdict& v : list)
        for (const std::string& sentence : v.sentences) session.say(sentence);
    if (!options.no_lpips.empty())
        session.tell({"no_lpips", Severity::info, "LPIPS is n/a: " + options.no_lpips});
    for (const Status& s : judgment.evaluation.notes) session.tell(s);
    tell_recordings(session, observations);
    session.result(json);
}

void add_options(CLI::App& command, Arguments& a) {
    a.judge.add(command, true);
    // Of `evaluate` it is how many; here which.
    command.remove_option(command.get_option("--horizons"));
    command.add_option("--horizons", a.horizons, "Units ahead, with commas between (the paper's)")
        ->delimiter(',')
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    command
        .add_option("--forecasters", a.forecasters,
                    "Names with commas between, as in evaluate; behind any of them -in-range: kept "
                    "in the colors observed. The static control is always there")
        ->capture_default_str();
    command.add_option("--hold-out", a.judge.hold_out,
                       "Hold out this recording only (its name in the results): for checkpoints "
                       "that learned from the others");
    command.add_option("--scene", a.scene, "What the material is put on: sphere, plate or drape")
        ->check(CLI::IsMember({"sphere", "plate", "drape"}))
        ->capture_default_str();
    command.add_option("--picture", a.options.view.size, "Side of the pictures in pixels")
        ->check(CLI::Range(32, 2048))
        ->capture_default_str();
    command.add_option("--samples", a.options.view.samples, "Rays per pixel, a power of two")
        ->check(CLI::IsMember({8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096}))
        ->capture_default_str();
    command
        .add_option("--ppd", a.options.pixels_per_degree,
                    "Pixels in a degree of the field of view, for FLIP")
        ->check(CLI::Range(kFlipSmallestPpd, kFlipLargestPpd));
    command
        .add_option("--coverage-scale", a.scale,
                    "What counts as full patina: truth (what the true frame reaches two contexts "
                    "ahead), or frame (each frame its own largest change)")
        ->check(CLI::IsMember({"truth", "frame"}))
        ->capture_default_str();
    command.add_flag("--whole", a.options.whole, "The backdrop around the specimen as well");
    command.add_option("--lpips-weights", a.lpips_weights,
                       "Weights of LPIPS (docs/models/metrics.md says how to make the file)");
}

}  // namespace

void add_judge_materials(CLI::App& app, Session& session) {
    auto a = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand(
        "judge-materials", "Do the materials of a forecast look like those of the true future?");
    add_options(*command, *a);
    command->add_flag("--force", session.force, "Write into a folder with other files");
    session.add_options(*command);
    command->callback([a, &session] { session.action = [a](Session& s) { run(s, *a); }; });
}

}  // namespace verdigris::cli
