// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "commands.h"
#include "json_of.h"
#include "stages.h"

namespace verdigris::cli {
namespace {

struct Arguments {
    std::string input, output;
    ObserveArguments observe;
};

void run(Session& session, const Arguments& a) {
    check_output_folder(a.output, a.input, session.force);
    ObservedStage stage = run_observe(session, a.input, a.output, a.observe);
    stage.commit();
    const Observation& o = stage.observation;
    session.say(fmt::format("observed  {} frames, {:.1f} units, {} samples kept at {}x{}",
                            o.decode.decoded, o.axis.units, o.samples.size(), o.width(),
                            o.height()));
    session.say(fmt::format("          {}", as_sentence(o.crop.sentence)));
    session.say(fmt::format("          noise {:.3f} %, dead-zone tau {:.3f} %", o.noise.sigma * 100,
                            o.noise.tau * 100));
    for (const Status& s : o.notes) {
        if (s.sentence != o.crop.sentence) session.tell(s);
    }
    session.say(fmt::format("Try next  verdigris forecast {}", a.output));
    session.result(json_of(o));
}

}  // namespace

void add_observe(CLI::App& app, Session& session) {
    auto a = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("observe", "Stage 1: crop, denoise, time axis, noise");
    command->add_option("INPUT", a->input, "A video, or a folder of photographs")->required();
    command->add_option("-o,--out", a->output, "Result folder")->required();
    a->observe.add(*command);
    command->add_flag("--every-sample", a->observe.every_sample,
                      "Keep up to 10 samples per unit (for evaluation), not one");
    command->add_flag("--force", session.force, "Write into a folder that holds other files");
    session.add_options(*command);
    command->callback([a, &session] { session.action = [a](Session& s) { run(s, *a); }; });
}

}  // namespace verdigris::cli
