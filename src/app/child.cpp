#include "child.h"

#include "espalier/base/error.h"

#include "command.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <fcntl.h>
#include <spawn.h>
#include <string_view>
#include <sys/wait.h>
#include <system_error>
#include <thread>
#include <unistd.h>

extern char** environ;

namespace espalier::app {
namespace {

std::atomic<int> signals{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

// A terminal that is closed may say so twice.
void count_signal(int signal) {
    if (signal != SIGHUP || signals == 0) ++signals;
}

/// The end to read from of a pipe that nobody writes to. The other end is this program's alone and closes with it.
int lifeline() {
    static const int end = [] {
        int ends[2];
        if (::pipe(ends) != 0) throw RunError("cannot make a pipe: " + std::generic_category().message(errno));
        for (const int descriptor : ends) ::fcntl(descriptor, F_SETFD, FD_CLOEXEC);
        return ends[0];
    }();
    return end;
}

/// A process group of its own: a terminal sends Ctrl-C to its whole group, and with what is passed on that would be
/// two.
class SpawnAttributes {
public:
    SpawnAttributes() {
        posix_spawnattr_init(&attributes_);
        posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP);
        posix_spawnattr_setpgroup(&attributes_, 0);
    }
    ~SpawnAttributes() { posix_spawnattr_destroy(&attributes_); }
    SpawnAttributes(const SpawnAttributes&) = delete;
    SpawnAttributes& operator=(const SpawnAttributes&) = delete;

    const posix_spawnattr_t* get() const { return &attributes_; }

private:
    posix_spawnattr_t attributes_;
};

/// What posix_spawn does before the program begins.
class SpawnActions {
public:
    SpawnActions() { posix_spawn_file_actions_init(&actions_); }
    ~SpawnActions() { posix_spawn_file_actions_destroy(&actions_); }
    SpawnActions(const SpawnActions&) = delete;
    SpawnActions& operator=(const SpawnActions&) = delete;

    void change_folder(const std::filesystem::path& folder) {
        posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str());
    }
    void read_from(int descriptor) { posix_spawn_file_actions_adddup2(&actions_, descriptor, STDIN_FILENO); }
    void write_to(const std::filesystem::path& log) {
        posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
        posix_spawn_file_actions_adddup2(&actions_, STDOUT_FILENO, STDERR_FILENO);
    }
    const posix_spawn_file_actions_t* get() const { return &actions_; }

private:
    posix_spawn_file_actions_t actions_;
};

int code_of(int status) {
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

SignalCounter::SignalCounter() : signals_((signals = 0, count_signal), /*only_once=*/false) {}

int SignalCounter::count() const {
    return signals;
}

int start_run(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
              const std::filesystem::path& log) {
    const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
    std::vector<std::string> command{program, "run"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    command.emplace_back(child_flag);
    std::vector<char*> words;
    for (std::string& word : command) words.push_back(word.data());
    words.push_back(nullptr);
    const SpawnAttributes attributes;
    SpawnActions actions;
    actions.read_from(lifeline());
    if (!log.empty()) actions.write_to(log);
    actions.change_folder(folder);
    pid_t child = 0;
    const int error = posix_spawn(&child, program.c_str(), actions.get(), attributes.get(), words.data(), environ);
    if (error != 0) {
        throw RunError(fmt::format("cannot start {}: {}", program, std::generic_category().message(error)));
    }
    return child;
}

void end_with_parent() {
    std::thread([] {
        char byte = 0;
        while (::read(STDIN_FILENO, &byte, 1) < 0 && errno == EINTR) {
        }
        _exit(exit_code::interrupted);
    }).detach();
}

int wait_for_program(int child, const SignalCounter& signals_so_far) {
    int status = 0, passed_on = 0;
    pid_t ended = 0;
    while (ended == 0 || (ended < 0 && errno == EINTR)) {
        for (; passed_on < signals_so_far.count(); ++passed_on) ::kill(child, SIGTERM);
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        ended = waitpid(child, &status, WNOHANG);
    }
    if (ended < 0) throw RunError("cannot wait for a program: " + std::generic_category().message(errno));
    return code_of(status);
}

bool poll_program(int& child, int& code) {
    int status = 0;
    child = waitpid(-1, &status, WNOHANG);
    if (child <= 0) return false;
    code = code_of(status);
    return true;
}

std::string quoted(const std::string& word) {
    const auto plain = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) ||
               std::string_view("-_./=:,+@%").find(c) != std::string::npos;
    };
    if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

}  // namespace espalier::app
