// Another program that runs beside this one: texts go into its standard input, lines come from its standard output.
#pragma once

#include "base/platform.h"

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::environment {

class Companion {
public:
    /// `words`: the program and its arguments. Throws RunError if it cannot be started.
    Companion(const std::vector<std::string>& words, const std::filesystem::path& folder);
    /// Ends it with all that it has started. After `dismiss` it has a moment to end by itself.
    ~Companion();
    Companion(const Companion&) = delete;
    Companion& operator=(const Companion&) = delete;

    /// Sends a text and hands over each line of the answer, without its end, until `take` says that it was the last.
    /// Throws RunError if the program ends before, takes longer than `patience` for all of it, or goes on behind it;
    /// Stopped if the work of this thread is asked to end.
    void ask(std::string_view text, std::chrono::duration<double> patience,
             const std::function<bool(std::string_view line)>& take);

    /// Sends a last text, if the program takes it at once, and closes its input.
    void dismiss(std::string_view text);

private:
    bool hand_over(const std::function<bool(std::string_view line)>& take);
    [[noreturn]] void fail_at_end();
    bool has_ended_within(std::chrono::milliseconds patience);

    std::string name_;
    platform::OpenFile connection_;
    int child_ = 0;
    int code_ = 0;  ///< how it ended
    bool ended_ = false, dismissed_ = false;
    bool has_spoken_ = false;
    std::string incoming_;  ///< what it has said and has not been read yet
};

}  // namespace espalier::environment
