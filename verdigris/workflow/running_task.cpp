// SPDX-License-Identifier: MIT
#include "verdigris/workflow/running_task.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <thread>
#include <utility>

#include "verdigris/error.h"

namespace verdigris {
namespace {

class Descriptor {
  public:
    Descriptor(const std::filesystem::path& path, int flags)
        : value_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {
        if (value_ < 0)
            throw Error(ErrorCode::failed, std::string("cannot be opened: ") + std::strerror(errno),
                        path.string());
    }
    ~Descriptor() { ::close(value_); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int get() const { return value_; }

  private:
    int value_;
};

// Between fork and exec only what POSIX calls async-signal-safe.
[[noreturn]] void become(const char* program, char* const* arguments, const char* folder, int in,
                         int out, int err, pid_t parent) {
    // A parent that is killed must not leave behind a child that writes while the next run begins.
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(127);
    ::setpgid(0, 0);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) ::signal(signal, SIG_DFL);
    if (::dup2(in, STDIN_FILENO) >= 0 && ::dup2(out, STDOUT_FILENO) >= 0 &&
        ::dup2(err, STDERR_FILENO) >= 0 && ::chdir(folder) == 0)
        ::execv(program, arguments);
    ::_exit(127);
}

TaskExit exit_of(int status, const rusage& usage) {
    const auto seconds = [](const timeval& t) {
        return double(t.tv_sec) + 1e-6 * double(t.tv_usec);
    };
    return {WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status),
            seconds(usage.ru_utime) + seconds(usage.ru_stime)};
}

}  // namespace

RunningTask::RunningTask(const std::filesystem::path& program,
                         const std::vector<std::string>& arguments,
                         const std::filesystem::path& folder, const std::filesystem::path& log,
                         const std::filesystem::path& output)
    : start_(std::chrono::steady_clock::now()) {
    const Descriptor in("/dev/null", O_RDONLY);
    const Descriptor err(log, O_WRONLY | O_CREAT | O_TRUNC | O_APPEND);
    std::optional<Descriptor> out;
    if (!output.empty()) out.emplace(output, O_WRONLY | O_CREAT | O_TRUNC);
    std::vector<std::string> texts{program.string()};
    texts.insert(texts.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (std::string& text : texts) pointers.push_back(text.data());
    pointers.push_back(nullptr);
    const std::string where = folder.string();
    const pid_t parent = ::getpid();
    child_ = ::fork();
    if (child_ == 0)
        become(texts[0].c_str(), pointers.data(), where.c_str(), in.get(),
               out ? out->get() : err.get(), err.get(), parent);
    if (child_ < 0)
        throw Error(ErrorCode::failed, std::string("cannot be started: ") + std::strerror(errno),
                    program.string());
}

RunningTask::RunningTask(RunningTask&& other) noexcept
    : child_(std::exchange(other.child_, -1)), start_(other.start_) {}

RunningTask::~RunningTask() {
    if (child_ <= 0) return;
    ::kill(child_, SIGKILL);
    while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
    }
}

std::optional<TaskExit> RunningTask::poll() {
    int status = 0;
    rusage usage{};
    const pid_t ended = ::wait4(child_, &status, WNOHANG, &usage);
    if (ended == 0 || (ended < 0 && errno == EINTR)) return {};
    if (ended < 0) throw Error(ErrorCode::failed, "a task was lost while it ran");
    child_ = -1;
    return exit_of(status, usage);
}

void RunningTask::send(int signal) {
    if (child_ > 0) ::kill(child_, signal);
}

TaskExit RunningTask::stop(std::chrono::milliseconds patience) {
    send(SIGINT);
    const auto deadline = std::chrono::steady_clock::now() + patience;
    bool killed = false;
    for (;;) {
        if (const auto ended = poll()) return *ended;
        if (!killed && std::chrono::steady_clock::now() >= deadline) {
            send(SIGKILL);
            killed = true;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
}

double RunningTask::seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

}  // namespace verdigris
