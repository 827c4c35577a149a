// SPDX-License-Identifier: MIT
// verdigris: what will this surface look like later, and can I put that in a scene?
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <string_view>

#include "commands.h"
#include "learned.h"
#include "session.h"
#include "verdigris/error.h"
#include "verdigris/pixels/parallel_rows.h"

namespace {

constexpr const char* kFooter =
    "Examples:\n"
    "  verdigris age plate.mp4 -o out          # the whole job, from footage to materials\n"
    "  verdigris age photos/ -o out --horizons 10,20 --forecaster affinergb\n"
    "  verdigris inspect plate.mp4             # is this recording fit for a forecast?\n"
    "  verdigris simulate -o specimen.mp4      # no footage? a made specimen whose truth is known\n"
    "\n"
    "Exit status: 0 done, 1 failed (disk, permission), 2 usage, 3 bad input, 4 refused (--force\n"
    "overrides), 130 interrupted. Horizons are accelerated units, fractions of the observed\n"
    "trajectory; they are never calendar time.";

int fail(const verdigris::cli::Session& session, int code, const std::string& message) {
    if (session.json) {
        const verdigris::cli::Json object = {{"error", message}, {"exit_status", code}};
        std::printf(
            "%s\n",
            object.dump(2, ' ', false, verdigris::cli::Json::error_handler_t::replace).c_str());
    }
    std::fprintf(stderr, "verdigris: %s\n", message.c_str());
    return code;
}

}  // namespace

int main(int argc, char** argv) {
    using namespace verdigris;
    cli::Session session;
    CLI::App app{"Forecast what a copper surface will look like, as materials for any renderer.",
                 "verdigris"};
    app.set_version_flag("--version", VERDIGRIS_VERSION);
    app.require_subcommand(1);
    app.footer(kFooter);
    cli::add_age(app, session);
    cli::add_inspect(app, session);
    cli::add_observe(app, session);
    cli::add_forecast(app, session);
    cli::add_materialize(app, session);
    cli::add_deliver(app, session);
    cli::add_view(app, session);
    cli::add_render(app, session);
    cli::add_simulate(app, session);
    cli::add_evaluate(app, session);
    cli::add_characterize(app, session);
    cli::add_drift(app, session);
    cli::add_judge_materials(app, session);
    cli::add_audit(app, session);
    cli::add_compare(app, session);
    cli::add_learned_commands(app, session);
    cli::add_reproduce(app, session);
    cli::add_doctor(app, session);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& e) {
        return app.exit(e);  // --help, --version
    } catch (const CLI::ParseError& e) {
        session.json = std::find(argv, argv + argc, std::string_view("--json")) != argv + argc;
        const std::string word = argc > 1 ? argv[1] : "";
        const auto commands =
            app.get_subcommands([&](CLI::App* c) { return c->get_name() == word; });
        const bool unknown = !word.empty() && word[0] != '-' && commands.empty();
        constexpr std::string_view kNotRead = "Could not convert: ";  // CLI11's own words
        std::string what = unknown ? "there is no command '" + word + "'" : e.what();
        if (what.starts_with(kNotRead))
            what = what.substr(kNotRead.size()) + " is not what this option takes";
        const std::string of = commands.empty() ? "" : word + " ";
        return fail(session, int(ErrorCode::usage), what + " (try `verdigris " + of + "--help`)");
    }
    cli::catch_interrupts();
    set_thread_count(session.threads);
    try {
        session.action(session);
        if (std::fflush(stdout) != 0 || std::ferror(stdout)) {
            throw Error(ErrorCode::failed, "cannot be written: the disk is full or the reader gone",
                        "standard output");
        }
        return 0;
    } catch (const Error& e) {
        return fail(session, int(e.code()), e.what());
    } catch (const std::filesystem::filesystem_error& e) {
        return fail(session, int(ErrorCode::failed),
                    e.path1().string() + ": " + e.code().message());
    } catch (const std::bad_alloc&) {
        return fail(session, int(ErrorCode::failed),
                    "not enough memory; try --size 1024 or a smaller --crop");
    } catch (const std::exception& e) {
        return fail(session, int(ErrorCode::failed), std::string("internal error: ") + e.what());
    }
}
