#include "child.h"

#include "espalier/base/error.h"

#include "base/folder.h"
#include "base/platform.h"
#include "command.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <chrono>
#include <cstdlib>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

namespace espalier::app {
namespace {

std::atomic<int> signals{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

void count_signal(int signal) {
    if (!platform::may_repeat(signal) || signals == 0) ++signals;
}

platform::OpenFile log_file(const std::filesystem::path& path) {
    if (path.empty()) return {};
    std::error_code error;
    platform::OpenFile file(path, platform::OpenFile::Mode::create, error);
    if (error) throw RunError(fmt::format("cannot write {}: {}", path.string(), reason_of(error)));
    return file;
}

}  // namespace

SignalCounter::SignalCounter() : signals_((signals = 0, count_signal), /*only_once=*/false) {}

int SignalCounter::count() const {
    return signals;
}

int start_run(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
              const std::filesystem::path& log) {
    const std::string program = platform::program_file().string();
    const platform::OpenFile output = log_file(log);
    std::vector<std::string> words{program, "run"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    words.emplace_back(child_flag);
    try {
        return platform::start({std::move(words), folder, platform::lifeline(), output.number()});
    } catch (const std::system_error& error) {
        throw RunError(fmt::format("cannot start {}: {}", program, error.code().message()));
    }
}

void end_with_parent() {
    std::thread([] {
        platform::wait_for_end_of_input();
        std::_Exit(exit_code::interrupted);
    }).detach();
}

int wait_for_program(int child, const SignalCounter& signals_so_far) {
    int code = 0;
    for (int passed_on = 0; platform::poll(child, code) == 0;) {
        for (; passed_on < signals_so_far.count(); ++passed_on) platform::end(child, platform::Ending::as_kill);
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
