#include "child.h"

#include "espalier/base/error.h"

#include "base/child_program.h"
#include "command.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <string_view>
#include <system_error>
#include <thread>
#include <unistd.h>

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

/// A descriptor that closes itself.
class LogFile {
public:
    explicit LogFile(const std::filesystem::path& path)
        : descriptor_(path.empty() ? -1 : ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
        if (!path.empty() && descriptor_ < 0) {
            throw RunError(fmt::format("cannot write {}: {}", path.string(), std::generic_category().message(errno)));
        }
    }
    ~LogFile() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }
    LogFile(const LogFile&) = delete;
    LogFile& operator=(const LogFile&) = delete;

    int descriptor() const { return descriptor_; }

private:
    int descriptor_;
};

}  // namespace

SignalCounter::SignalCounter() : signals_((signals = 0, count_signal), /*only_once=*/false) {}

int SignalCounter::count() const {
    return signals;
}

int start_run(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
              const std::filesystem::path& log) {
    const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
    const LogFile log_file(log);
    ChildProgram run{{program, "run"}, folder, lifeline(), log_file.descriptor()};
    run.words.insert(run.words.end(), arguments.begin(), arguments.end());
    run.words.emplace_back(child_flag);
    try {
        return start(run);
    } catch (const std::system_error& error) {
        throw RunError(fmt::format("cannot start {}: {}", program, error.code().message()));
    }
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
    int code = 0;
    for (int passed_on = 0; poll(child, code) == 0;) {
        for (; passed_on < signals_so_far.count(); ++passed_on) ::kill(child, SIGTERM);
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return code;
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
