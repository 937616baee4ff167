#include "progress.h"

#include "base/platform.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>

namespace espalier::app {
namespace {

// Progress that cannot be shown any more must not end a run: what cannot be written is let go.
void say(const std::string& text) {
    std::fputs(text.c_str(), stderr);
    std::fflush(stderr);
}

}  // namespace

std::string duration_text(double seconds) {
    const auto whole = static_cast<long>(std::ceil(seconds));
    if (seconds < 1) return fmt::format("{:.2f} s", seconds);
    if (seconds < 10) return fmt::format("{:.1f} s", seconds);
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
    return fmt::format("{} h {} min", whole / 3600, whole / 60 % 60);
}

std::string grouped(std::size_t number) {
    std::string digits = std::to_string(number);
    for (std::size_t at = digits.size(); at > 3;) {
        at -= 3;
        digits.insert(at, 1, ',');
    }
    return digits;
}

ProgressReport::ProgressReport(bool quiet) : quiet_(quiet), terminal_(platform::has_terminal()) {}

ProgressReport::~ProgressReport() {
    if (drawn_) say("\n");
}

void ProgressReport::operator()(const Progress& progress) {
    if (quiet_) return;
    const double latest = progress.seconds - last_seconds_;
    last_seconds_ = progress.seconds;
    step_seconds_ = progress.step <= 1 ? latest : 0.7 * step_seconds_ + 0.3 * latest;
    if (terminal_) {
        redraw(progress);
    } else {
        print_line(progress);
    }
}

void ProgressReport::redraw(const Progress& progress) {
    const bool last = progress.step == progress.steps;
    if (!last && drawn_ && progress.seconds - drawn_seconds_ < 0.1) return;
    drawn_ = true;
    drawn_seconds_ = progress.seconds;
    const int left = progress.steps - progress.step;
    // The line is erased to its end, because it may become shorter.
    say(fmt::format("\rstep {}/{}  {} modules  {:.3g} steps/s  {}\033[K", progress.step, progress.steps,
                    grouped(progress.modules), step_seconds_ > 0 ? 1 / step_seconds_ : 0.0,
                    last ? duration_text(progress.seconds) : duration_text(left * step_seconds_) + " left"));
}

void ProgressReport::print_line(const Progress& progress) {
    if (!logged_.take(progress)) return;
    say(fmt::format("step {}/{}  {} modules  {}\n", progress.step, progress.steps, grouped(progress.modules),
                    duration_text(progress.seconds)));
}

}  // namespace espalier::app
