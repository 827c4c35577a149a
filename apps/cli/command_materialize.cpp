// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "commands.h"
#include "json_of.h"
#include "stages.h"
#include "verdigris/observe/observation_io.h"

namespace verdigris::cli {
namespace {

struct Arguments {
    std::string folder;
    MaterialArguments material;
};

void run(Session& session, const Arguments& a) {
    const std::filesystem::path output = a.folder;
    a.material.check();
    require_stage(output, kForecastFolder, "forecast");
    require_stage(output, kObservedFolder, "observe");
    const Observation observation = read_observation(output / kObservedFolder);
    const SavedForecast saved = read_forecast(output / kForecastFolder);
    if (saved.context.frames.empty() ||
        !saved.context.frames[0].same_size(observation.width(), observation.height())) {
        throw Error(
            ErrorCode::bad_input,
            "its forecast was made from another observation; run `verdigris forecast` again",
            output.string());
    }
    const MaterialRecipe recipe = run_material(session, observation, saved, a.material);
    StagedFolder staged(output);
    write_material_stage(saved, recipe, staged.path() / kMaterialFolder);
    write_options(
        staged.path() / kMaterialFolder,
        {{"options", json_of(a.material)}, {"forecast", read_options(output / kForecastFolder)}});
    staged.commit();
    session.say(fmt::format("material  full coverage at a change of {:.2f} % beyond the dead-zone",
                            recipe.normalizer * 100));
    session.say(fmt::format("Try next  verdigris deliver {}", a.folder));
    session.result({{"tau", recipe.tau},
                    {"normalizer", recipe.normalizer},
                    {"reference_horizon", recipe.reference_horizon}});
}

}  // namespace

void add_materialize(CLI::App& app, Session& session) {
    auto a = std::make_shared<Arguments>();
    CLI::App* command =
        app.add_subcommand("materialize", "Stage 3: coverage and the recipe of the maps");
    command->add_option("OUT", a->folder, "A result folder that `forecast` filled")->required();
    a->material.add(*command);
    session.add_options(*command);
    command->callback([a, &session] { session.action = [a](Session& s) { run(s, *a); }; });
}

}  // namespace verdigris::cli
