// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "commands.h"
#include "json_of.h"
#include "stages.h"
#include "verdigris/material/material_io.h"
#include "verdigris/observe/observation_io.h"

namespace verdigris::cli {
namespace {

void run(Session& session, const std::filesystem::path& output) {
    require_stage(output, kObservedFolder, "observe");
    require_stage(output, kForecastFolder, "forecast");
    require_stage(output, kMaterialFolder, "materialize");
    const Observation observation = read_observation(output / kObservedFolder);
    SavedForecast saved = read_forecast(output / kForecastFolder);
    const MaterialRecipe recipe = read_recipe(output / kMaterialFolder);
    const bool same_size = recipe.canvas.same_size(observation.width(), observation.height()) &&
                           !saved.context.frames.empty() &&
                           recipe.canvas.same_size(saved.context.frames[0]);
    const bool same_chain = read_options(output / kForecastFolder)["observe"] ==
                                read_options(output / kObservedFolder) &&
                            read_options(output / kMaterialFolder)["forecast"] ==
                                read_options(output / kForecastFolder);
    if (saved.source_sha256 != observation.source_sha256 || !same_size || !same_chain) {
        throw Error(ErrorCode::bad_input,
                    "the stages in it do not belong together; run `verdigris forecast` and "
                    "`verdigris materialize` again",
                    output.string());
    }
    const Json options = {{"observe", read_options(output / kObservedFolder)["observe"]},
                          {"forecast", read_options(output / kForecastFolder)["options"]},
                          {"material", read_options(output / kMaterialFolder)["options"]}};
    saved.context.frames.clear();  // as in `age`
    StagedFolder staged(output);
    const Json manifest = run_deliver(session, observation, saved, recipe, options, staged);
    staged.commit(kManifestFile);
    session.say(fmt::format("Look at   {}", (output / kSheetFile).string()));
    session.say(fmt::format("Try next  verdigris view {}", output.string()));
    session.result(manifest);
}

}  // namespace

void add_deliver(CLI::App& app, Session& session) {
    auto folder = std::make_shared<std::string>();
    CLI::App* command =
        app.add_subcommand("deliver", "Textures, GLB, viewer, contact sheet and manifest");
    command->add_option("OUT", *folder, "A result folder that `materialize` filled")->required();
    session.add_options(*command);
    command->callback(
        [folder, &session] { session.action = [folder](Session& s) { run(s, *folder); }; });
}

}  // namespace verdigris::cli
