// Other programs as children of this one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace espalier {

struct ChildProgram {
    std::vector<std::string> words;  ///< the program, looked for in PATH if it has no slash, and its arguments
    std::filesystem::path folder{};  ///< where it starts; empty: where this program is
    int input = -1;                  ///< the descriptor that becomes its standard input; -1: this program's
    int output = -1;                 ///< the same for its standard output and error
};

/// Starts it in a process group of its own, so that Ctrl-C in a terminal reaches this program alone. Returns its
/// process number. Throws std::system_error saying why it cannot be started.
int start(const ChildProgram& program);

/// Waits until it ends. Returns its exit code, or 128 + the signal that ended it. Throws std::system_error.
int wait_for(int child);

/// Looks without waiting whether it has ended (-1: any child). Returns the process number of one that has, with its
/// code as above, or 0. Throws std::system_error, but for -1 when there is no child.
int poll(int child, int& code);

}  // namespace espalier
