#include "environment/given/external/companion.h"

#include "espalier/base/error.h"
#include "espalier/base/stop.h"

#include <fmt/format.h>

#include <system_error>
#include <thread>

namespace espalier::environment {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds turn = 50ms;  ///< how often to look whether the work is asked to end
constexpr std::chrono::milliseconds farewell = 500ms;
constexpr std::size_t longest_line = 1 << 16;

}  // namespace

Companion::Companion(const std::vector<std::string>& words, const std::filesystem::path& folder)
    : name_(words.front()) {
    platform::OpenFile theirs;
    if (const std::error_code error = platform::connect(connection_, theirs)) {
        throw RunError(fmt::format("cannot connect to {}: {}", name_, error.message()));
    }
    try {
        child_ = platform::start({words, folder, theirs.number(), theirs.number(), /*keeps_error=*/true});
    } catch (const std::system_error& error) {
        throw RunError(fmt::format("{} cannot be started: {}", name_, error.code().message()));
    }
}

Companion::~Companion() {
    try {
        if (ended_ || (dismissed_ && has_ended_within(farewell))) return;
        platform::end(child_, platform::Ending::at_once);
        platform::wait_for(child_);
    } catch (const std::system_error&) {
        // Another part of the program has waited for it.
    }
}

void Companion::ask(std::string_view text, std::chrono::duration<double> patience,
                    const std::function<bool(std::string_view line)>& take) {
    const Clock::time_point begin = Clock::now();
    while (!hand_over(take)) {
        end_if_asked();
        if (Clock::now() - begin > patience) {
            throw RunError(
                fmt::format("{} has not answered the queries of this step within {} s; `timeout` gives it "
                            "longer",
                            name_, patience.count()));
        }
        if (!platform::converse(connection_, text, incoming_, turn)) {
            if (!hand_over(take)) fail_at_end();
            break;
        }
    }
    if (!text.empty()) throw RunError(fmt::format("{} has answered before it has read all queries", name_));
    if (!incoming_.empty()) throw RunError(fmt::format("{} says more after the end of its answers", name_));
}

// True if the last line was among them.
bool Companion::hand_over(const std::function<bool(std::string_view line)>& take) {
    // By a byte 1 programs of cpfg say that they are there.
    if (!has_spoken_ && incoming_.starts_with('\x01')) incoming_.erase(0, 1);
    has_spoken_ = has_spoken_ || !incoming_.empty();
    std::size_t begin = 0;
    bool is_last = false;
    for (std::size_t end = 0; !is_last && (end = incoming_.find('\n', begin)) != std::string::npos; begin = end + 1) {
        is_last = take(std::string_view(incoming_).substr(begin, end - begin));
    }
    incoming_.erase(0, begin);
    if (!is_last && incoming_.size() > longest_line) {
        throw RunError(fmt::format("{} answers a line of more than {} bytes", name_, longest_line));
    }
    return is_last;
}

void Companion::fail_at_end() {
    if (!has_ended_within(farewell)) {
        throw RunError(fmt::format("{} has closed its standard output before it had answered", name_));
    }
    if (code_ > 128)
        throw RunError(fmt::format("{} was ended by signal {} before it had answered", name_, code_ - 128));
    throw RunError(fmt::format("{} has ended with exit code {} before it had answered", name_, code_));
}

bool Companion::has_ended_within(std::chrono::milliseconds patience) {
    const Clock::time_point begin = Clock::now();
    while (!(ended_ = platform::poll(child_, code_) != 0) && Clock::now() - begin < patience) {
        std::this_thread::sleep_for(2ms);
    }
    return ended_;
}

void Companion::dismiss(std::string_view text) {
    dismissed_ = platform::converse(connection_, text, incoming_, 0ms);
    connection_.close();
}

}  // namespace espalier::environment
