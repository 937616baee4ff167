#include "archive/chosen_frames.h"

#include "espalier/base/error.h"

#include "base/number.h"

#include <fmt/format.h>

#include <limits>
#include <optional>

namespace espalier::archive {
namespace {

std::optional<int> whole_number(const std::string& text) {
    const std::optional<int> value = whole_text_as<int>(text);
    return value && *value >= 0 ? value : std::nullopt;
}

struct Steps {
    int from = 0, to = std::numeric_limits<int>::max(), every = 1;
};

[[noreturn]] void reject(const std::string& text) {
    throw UserError(fmt::format("--step {}: expected a step, first, last, all, or FROM:TO[:EVERY]", text));
}

Steps steps_of(const std::string& text) {
    Steps steps;
    if (text == "all") return steps;
    std::vector<std::string> parts(1);
    for (const char character : text) {
        if (character == ':')
            parts.emplace_back();
        else
            parts.back() += character;
    }
    if (parts.size() < 2 || parts.size() > 3) reject(text);
    int* const numbers[] = {&steps.from, &steps.to, &steps.every};
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (parts[i].empty() && i < 2) continue;
        const std::optional<int> number = whole_number(parts[i]);
        if (!number || (i == 2 && *number == 0)) reject(text);
        *numbers[i] = *number;
    }
    return steps;
}

}  // namespace

void require_frame_option(const std::string& text) {
    if (text != "first" && text != "last" && !whole_number(text)) (void)steps_of(text);
}

std::vector<const RecordedFrame*> chosen_frames(const RecordedRun& run, const std::string& text) {
    std::vector<const RecordedFrame*> recorded;
    for (const RecordedFrame& frame : run.frames()) recorded.push_back(&frame);
    if (recorded.empty()) throw UserError(fmt::format("{} contains no frames", run.folder().string()));
    if (text == "first") return {recorded.front()};
    if (text == "last") return {recorded.back()};
    if (const std::optional<int> step = whole_number(text)) return {&run.frame(*step)};
    const Steps steps = steps_of(text);
    std::vector<const RecordedFrame*> chosen;
    for (const RecordedFrame* frame : recorded) {
        const bool inside = frame->step >= steps.from && frame->step <= steps.to;
        if (inside && (frame->step - steps.from) % steps.every == 0) chosen.push_back(frame);
    }
    if (chosen.empty()) {
        throw UserError(fmt::format("--step {}: {} has no such frame; its frames are from step {} to {}", text,
                                    run.folder().string(), recorded.front()->step, recorded.back()->step));
    }
    return chosen;
}

}  // namespace espalier::archive
