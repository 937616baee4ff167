// Runs of this very program as processes of their own.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace espalier {

/// Starts this program with arguments, in a folder, with its standard output and error going to `log` (made anew;
/// empty: to where this program's go). Returns its process number. Throws RunError.
int start_program(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                  const std::filesystem::path& log);

/// Waits for it. Its exit code, or 128 + the signal that ended it.
int wait_for_program(int child);

/// True if one has ended: which, and its code as above.
bool poll_program(int& child, int& code);

/// A word as a shell reads it back.
std::string quoted(const std::string& word);

}  // namespace espalier
