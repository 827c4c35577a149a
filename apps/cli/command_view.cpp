// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <system_error>

#include "commands.h"
#include "stages.h"

namespace verdigris::cli {
namespace fs = std::filesystem;
namespace {

/// Hands the page to the desktop's own opener; false where there is none.
bool open_in_browser(const std::string& path) {
    if (!std::getenv("DISPLAY") && !std::getenv("WAYLAND_DISPLAY")) return false;
    std::string program = "xdg-open", argument = path;
    char* const arguments[] = {program.data(), argument.data(), nullptr};
    pid_t child = 0;
    if (posix_spawnp(&child, program.c_str(), nullptr, nullptr, arguments, environ) != 0) {
        return false;
    }
    int status = 0;
    return waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

void run(Session& session, const fs::path& output, bool print_only) {
    std::error_code error;
    const fs::path page = fs::is_directory(output, error) ? output / kViewerFile : output;
    if (!fs::exists(page, error)) {
        throw Error(ErrorCode::bad_input,
                    "there is no viewer; make one with `verdigris age INPUT -o OUT`",
                    page.string());
    }
    const std::string path = fs::canonical(page).string();
    const bool opened = !print_only && open_in_browser(path);
    session.say(opened ? fmt::format("Opened {}", path)
                       : fmt::format("Open this file in any browser: {}", path));
    session.result({{"viewer", path}, {"opened", opened}});
}

}  // namespace

void add_view(CLI::App& app, Session& session) {
    auto folder = std::make_shared<std::string>();
    auto print_only = std::make_shared<bool>(false);
    CLI::App* command = app.add_subcommand("view", "Open a result's viewer in the browser");
    command->add_option("OUT", *folder, "A result folder, or a viewer.html")->required();
    command->add_flag("--print", *print_only, "Only print where it is");
    session.add_options(*command);
    command->callback([folder, print_only, &session] {
        session.action = [folder, print_only](Session& s) { run(s, *folder, *print_only); };
    });
}

}  // namespace verdigris::cli
