// SPDX-License-Identifier: MIT
#include "session.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <csignal>
#include <cstdio>

namespace verdigris::cli {
namespace {

volatile std::sig_atomic_t g_interrupted = 0;

void on_signal(int signal) {
    // The second Ctrl-C means it: fall back to the default action, which ends the process.
    g_interrupted = 1;
    std::signal(signal, SIG_DFL);
}

std::string eta(double seconds) {
    const int s = int(seconds + 0.5);
    if (s >= 3600) return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
    return fmt::format("{}:{:02}", s / 60, s % 60);
}

}  // namespace

void catch_interrupts() {
    std::signal(SIGINT, on_signal);
    std::signal(SIGTERM, on_signal);
    std::signal(SIGHUP, on_signal);  // a closed terminal
}
bool interrupted() {
    return g_interrupted != 0;
}

ProgressPrinter::ProgressPrinter(bool silent)
    : silent_(silent),
      terminal_(isatty(STDERR_FILENO) == 1),
      start_(Clock::now()),
      last_print_(start_) {}

bool ProgressPrinter::operator()(std::string_view stage, std::int64_t done, std::int64_t total) {
    if (interrupted()) {
        clear();
        return false;
    }
    if (silent_) return true;
    const auto now = Clock::now();
    const auto left =
        stages_.remaining(stage, done, total, std::chrono::duration<double>(now - start_).count());
    const auto pause = terminal_ ? std::chrono::milliseconds(100) : std::chrono::seconds(10);
    if (now - last_print_ < pause) return true;
    last_print_ = now;
    std::string line = fmt::format("{:<12}", stage);
    if (total > 0) {
        const double share = std::clamp(double(done) / double(total), 0.0, 1.0);
        if (terminal_) {
            const int filled = int(share * 30);
            line += fmt::format("[{:#<{}}{:.<{}}]", "", filled, "", 30 - filled);
        }
        line += fmt::format(" {:3.0f} %  {}/{}", share * 100, done, total);
        if (left) line += fmt::format("  ETA {}", eta(*left));
    } else {
        line += fmt::format(" {} done", done);
    }
    if (terminal_) {
        std::fprintf(stderr, "\r\033[K%s", line.c_str());
        drawn_ = true;
    } else {
        std::fprintf(stderr, "%s\n", line.c_str());
    }
    std::fflush(stderr);
    return true;
}

void ProgressPrinter::clear() {
    if (drawn_) std::fprintf(stderr, "\r\033[K");
    drawn_ = false;
}

void Session::add_options(CLI::App& command) {
    command.add_flag("--json", json, "One JSON object on stdout instead of sentences");
    command.add_flag("-q,--quiet", quiet, "Only errors");
    command.add_option("--threads", threads, "Threads to use (0: all). The result is the same")
        ->check(CLI::Range(0, 4096));
}

Progress Session::progress() {
    if (!printer_) printer_ = std::make_shared<ProgressPrinter>(quiet);
    return [printer = printer_](std::string_view stage, std::int64_t done, std::int64_t total) {
        return (*printer)(stage, done, total);
    };
}

std::string as_sentence(const std::string& note) {
    std::string sentence = note;
    // A first word with a dot or a digit in it is a file name, and stays as it is.
    const std::string first = sentence.substr(0, sentence.find(' '));
    if (first.find_first_of("._/0123456789") == std::string::npos && !sentence.empty()) {
        sentence[0] = char(std::toupper(static_cast<unsigned char>(sentence[0])));
    }
    if (!sentence.empty() && sentence.back() != '.') sentence += '.';
    return sentence;
}

void Session::say(const std::string& line) {
    if (printer_) printer_->clear();
    if (!json && !quiet) std::printf("%s\n", line.c_str());
}

void Session::tell(const Status& status) {
    if (printer_) printer_->clear();
    if (quiet || (json && status.severity == Severity::info)) return;
    std::fprintf(stderr, "  %s: %s\n", status.severity == Severity::info ? "note" : "caution",
                 as_sentence(status.sentence).c_str());
}

void Session::result(const Json& object) {
    if (printer_) printer_->clear();
    // Paths come from the file system and need not be UTF-8; a replacement character beats a crash.
    if (json) {
        std::printf("%s\n", object.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
    }
}

}  // namespace verdigris::cli
