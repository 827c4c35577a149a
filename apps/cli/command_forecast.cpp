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
    ForecastArguments forecast;
};

void run(Session& session, const Arguments& a) {
    const std::filesystem::path output = a.folder;
    require_stage(output, kObservedFolder, "observe");
    const Observation observation = read_observation(output / kObservedFolder);
    const SavedForecast saved = run_forecast(session, observation, a.forecast);
    StagedFolder staged(output);
    write_forecast(saved, staged.path() / kForecastFolder);
    write_options(
        staged.path() / kForecastFolder,
        {{"options", json_of(a.forecast)}, {"observe", read_options(output / kObservedFolder)}});
    staged.commit();
    session.say(fmt::format("forecast  {}", saved.forecast.explanation));
    for (const Status& s : saved.forecast.guards) session.tell(s);
    session.say(fmt::format("Look at   {}", (output / kForecastFolder).string()));
    session.say(fmt::format("Try next  verdigris materialize {}", a.folder));
    session.result(json_of(saved.forecast));
}

}  // namespace

void add_forecast(CLI::App& app, Session& session) {
    auto a = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("forecast", "Stage 2: the future frames of a result");
    command->add_option("OUT", a->folder, "A result folder that `observe` made")->required();
    a->forecast.add(*command);
    command->add_flag("--force", session.force, "Go on where a guard would refuse");
    session.add_options(*command);
    command->callback([a, &session] { session.action = [a](Session& s) { run(s, *a); }; });
}

}  // namespace verdigris::cli
