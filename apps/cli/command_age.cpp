// SPDX-License-Identifier: MIT
// The whole path in one screen: footage in, aged materials out.
#include <fmt/format.h>

#include "commands.h"
#include "json_of.h"
#include "stages.h"
#include "verdigris/forecast/forecast_io.h"
#include "verdigris/material/material_io.h"

namespace verdigris::cli {
namespace fs = std::filesystem;
namespace {

struct Arguments {
    std::string input, output;
    ObserveArguments observe;
    ForecastArguments forecast;
    MaterialArguments material;
};

void run(Session& session, const Arguments& a) {
    const fs::path input = a.input;
    // A folder keeps its whole name ("run.2"); a file loses its extension.
    const std::string name = input_name(input);
    const fs::path output =
        a.output.empty()
            ? fs::path((fs::is_directory(input) ? name : fs::path(name).stem().string()) + "-aged")
            : fs::path(a.output);
    a.material.check();
    const Json options = {{"observe", json_of(a.observe)},
                          {"forecast", json_of(a.forecast)},
                          {"material", json_of(a.material)}};
    check_output_folder(output, input, session.force);

    ObservedStage observed = run_observe(session, input, output, a.observe);
    const Observation& observation = observed.observation;
    SavedForecast saved = run_forecast(session, observation, a.forecast);
    // Only now that no guard can refuse any more: a refusal leaves an earlier result whole.
    observed.commit();
    const MaterialRecipe recipe = run_material(session, observation, saved, a.material);

    StagedFolder staged(output);
    write_forecast(saved, staged.path() / kForecastFolder);
    write_material_stage(saved, recipe, staged.path() / kMaterialFolder);
    const Json forecast_options = {{"options", options["forecast"]},
                                   {"observe", read_options(output / kObservedFolder)}};
    write_options(staged.path() / kForecastFolder, forecast_options);
    write_options(staged.path() / kMaterialFolder,
                  {{"options", options["material"]}, {"forecast", forecast_options}});
    saved.context.frames.clear();  // half of the memory, and what is delivered needs none of it
    const Json manifest = run_deliver(session, observation, saved, recipe, options, staged);
    staged.commit(kManifestFile);

    session.say(fmt::format("observed  {} frames, {:.1f} units, {}x{} pixels, noise {:.2f} %",
                            observation.decode.decoded, observation.axis.units, observation.width(),
                            observation.height(), observation.noise.sigma * 100));
    session.say(fmt::format("          {}", as_sentence(observation.crop.sentence)));
    session.say(fmt::format("forecast  {}", saved.forecast.explanation));
    for (const Status& s : observation.notes) {
        if (s.sentence != observation.crop.sentence) session.tell(s);
    }
    for (const Status& s : saved.forecast.guards) session.tell(s);
    session.say("");
    session.say(fmt::format("Look at   {}", (output / kSheetFile).string()));
    if (fs::exists(output / kViewerFile)) {
        session.say(fmt::format("Scrub     {}   (open it in a browser, or: verdigris view {})",
                                (output / kViewerFile).string(), output.string()));
    }
    session.say(fmt::format("Import    {} and {}/", (output / kGltfFile).string(),
                            (output / kTexturesFolder).string()));
    session.say("Try next  other --horizons; the observation is kept");
    session.result(manifest);
}

}  // namespace

void add_age(CLI::App& app, Session& session) {
    auto a = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("age", "The whole job: footage in, aged materials out");
    command->add_option("INPUT", a->input, "A video, or a folder of photographs")->required();
    command->add_option("-o,--out", a->output, "Result folder (default: NAME-aged here)");
    a->observe.add(*command);
    a->forecast.add(*command);
    a->material.add(*command);
    command->add_flag("--force", session.force, "Go on where a guard would refuse");
    session.add_options(*command);
    command->callback([a, &session] { session.action = [a](Session& s) { run(s, *a); }; });
}

}  // namespace verdigris::cli
