// Runs of this very program as processes of their own.
#pragma once

#include "base/platform.h"

#include <filesystem>
#include <string>
#include <vector>

namespace espalier::app {

/// While it lives, the signals that end programs are counted instead of ending the program, so that it can pass them
/// on.
class SignalCounter {
public:
    SignalCounter();

    int count() const;

private:
    platform::EndSignals signals_;
};

/// Starts `espalier run` with arguments, in a folder, with its standard output and error going to `log` (made anew;
/// empty: to where this program's go). Ctrl-C of a terminal does not reach it; it ends with this program, however that
/// ends. Returns its process number. Throws RunError.
int start_run(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
              const std::filesystem::path& log);

/// What tells a run that start_run() started it. It then calls end_with_parent().
inline constexpr const char* child_flag = "--end-with-parent";
/// From now on this program ends at once when the one that started it is gone: what a kill -9 of that one would leave
/// behind would go on writing.
void end_with_parent();

/// Waits for it and passes signals on to it. Its exit code, or 128 + the signal that ended it.
int wait_for_program(int child, const SignalCounter& signals);

/// A word as a shell reads it back.
std::string quoted(const std::string& word);

}  // namespace espalier::app
