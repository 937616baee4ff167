// Runs of this very program as processes of their own.
#pragma once

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

namespace espalier {

/// While it lives, SIGINT, SIGTERM and SIGHUP are counted instead of ending the program, so that it can pass them on.
class SignalCounter {
public:
    SignalCounter();
    ~SignalCounter();
    SignalCounter(const SignalCounter&) = delete;
    SignalCounter& operator=(const SignalCounter&) = delete;

    int count() const;

private:
    static constexpr int signals_[] = {SIGINT, SIGTERM, SIGHUP};
    struct sigaction before_[3] = {};
};

/// Starts this program with arguments, in a folder, with its standard output and error going to `log` (made anew;
/// empty: to where this program's go). Ctrl-C of a terminal does not reach it. Returns its process number. Throws
/// RunError.
int start_program(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                  const std::filesystem::path& log);

/// Waits for it and passes signals on to it. Its exit code, or 128 + the signal that ended it.
int wait_for_program(int child, const SignalCounter& signals);

/// True if one has ended: which, and its code as above.
bool poll_program(int& child, int& code);

/// A word as a shell reads it back.
std::string quoted(const std::string& word);

}  // namespace espalier
