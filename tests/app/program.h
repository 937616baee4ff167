// The real program, run from outside: its exit code, its words, and signals sent to it.
#pragma once

#include "temporary_folder.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

struct Outcome {
    int code = -1;    ///< exit code, or -signal
    std::string out;  ///< standard output
    std::string err;  ///< standard error
};

inline int code_of(int status) {
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

/// A folder with models and scenes in it, where the program runs.
class Workplace {
public:
    std::filesystem::path path() const { return folder_.path(); }
    std::filesystem::path write(const std::string& name, const std::string& text) const {
        return folder_.write(name, text);
    }

    /// Runs `espalier <arguments>` through the shell; `before` is put in front, as "ulimit -f 8;".
    Outcome run(const std::string& arguments, const std::string& before = "") const {
        const std::string command = "cd '" + path().string() + "' && { " + before + " '" + ESPALIER_PROGRAM + "' " +
                                    arguments + "; } >.out 2>.err";
        const int status = std::system(command.c_str());
        return {code_of(status), text_of(path() / ".out"), text_of(path() / ".err")};
    }

    /// Starts the program, waits until `ready` and until it answers Ctrl-C itself, and calls `act` with its process id;
    /// returns how it ended.
    enum class Group { of_the_tests, own };
    Outcome run_until(const std::vector<std::string>& arguments, const std::function<bool()>& ready,
                      const std::function<void(pid_t)>& act, Group group = Group::of_the_tests) const {
        const pid_t child = fork();
        if (child == 0 && group == Group::own) setpgid(0, 0);
        if (child == 0) become_program(arguments);
        const auto is_ready = [&] { return answers_interrupts(child) && ready(); };
        for (int i = 0; i < 2000 && !is_ready(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
        act(child);
        int status = 0;
        for (int i = 0; i < 2000 && waitpid(child, &status, WNOHANG) == 0; ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
            if (i == 1999) kill(child, SIGKILL), waitpid(child, &status, 0);
        }
        return {code_of(status), text_of(path() / ".out"), text_of(path() / ".err")};
    }

private:
    /// True where processes do not say which signals they catch, and of one that has ended.
    static bool answers_interrupts(pid_t process) {
        namespace fs = std::filesystem;
        const fs::path about = fs::path("/proc") / std::to_string(process);
        std::error_code unreadable;
        const fs::path program = fs::read_symlink(about / "exe", unreadable);
        if (!unreadable && program != fs::canonical(ESPALIER_PROGRAM)) return false;  // still that of the tests
        std::ifstream status(about / "status");
        for (std::string word; status >> word;) {
            if (word == "SigCgt:" && status >> word) return (std::stoull(word, nullptr, 16) >> (SIGINT - 1) & 1) != 0;
            if (word == "(zombie)") return true;
        }
        return true;
    }
    [[noreturn]] void become_program(const std::vector<std::string>& arguments) const {
        if (chdir(path().c_str()) != 0 || !freopen(".out", "w", stdout) || !freopen(".err", "w", stderr)) _exit(127);
        std::vector<char*> argv{const_cast<char*>(ESPALIER_PROGRAM)};
        for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
        argv.push_back(nullptr);
        execv(ESPALIER_PROGRAM, argv.data());
        _exit(127);
    }

    TemporaryFolder folder_;
};

namespace models {

inline const char* const bush = "lsystem: 1\nderivation length: 5\naxiom: A\nA --> F(1)[+A][-A]F(1)A\nendlsystem\n";
inline const char* const doubling = "lsystem: 1\nderivation length: 100\naxiom: F\nF --> FF\nendlsystem\n";
inline const char* const zero_by_zero =
    "lsystem: 1\nderivation length: 4\naxiom: A(2)\nA(n) --> F(1)A(n - 1 + 0 * ((n - 1) / (n - 1)))\nendlsystem\n";
/// Keeps its size for as many steps as anyone may want.
inline const char* const patient =
    "lsystem: 1\nderivation length: 1000000\naxiom: F(1)A\nF(x) --> F(x+0.001)\nendlsystem\n";

}  // namespace models
