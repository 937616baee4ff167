#include "simulation/object/animation_file.h"

#include "espalier/base/file.h"

#include "base/text.h"
#include "simulation/object/plain_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace espalier::simulation {
namespace {

constexpr int most_frames = 1000000000;

constexpr std::array windows_settings{
    "double buffer",         "clear between frames",   "scale between frames", "new view between frames",
    "center between frames", "hcenter between frames", "swap interval"};

class AnimationReader {
public:
    Animation read(const std::string& text, const std::string& name) {
        for (const PlainLine& line : plain_lines(text, name)) read_line(line);
        // Intervals that give no step of their own have the file's, wherever that stands.
        for (const std::size_t interval : without_step_) {
            animation_.frames.intervals[interval].step = animation_.frames.step;
        }
        return std::move(animation_);
    }

private:
    void read_line(const PlainLine& line) {
        const std::size_t colon = line.text.find(':');
        if (colon == std::string::npos) return;
        const std::string keyword = line.text.substr(0, colon);
        const std::string value = line.text.substr(colon + 1);
        if (std::find(windows_settings.begin(), windows_settings.end(), keyword) != windows_settings.end()) {
            animation_.unused.push_back(keyword);
            return;
        }
        if (keyword == "frame intervals") return read_intervals(value, line);
        if (keyword != "first frame" && keyword != "last frame" && keyword != "step") return;
        const std::vector<std::string> words = words_of(value, " ,\t:");
        const std::optional<int> number = words.empty() ? std::nullopt : leading_integer(words[0]);
        if (!number) return complain(line, fmt::format("'{}' needs a whole number", keyword));
        if (keyword == "first frame") animation_.frames.first = std::max(0, *number);
        if (keyword == "step") animation_.frames.step = std::max(1, *number);
        if (keyword == "last frame") set_last(*number);
    }

    void set_last(int frame) {
        animation_.last.reset();
        if (frame >= 0) animation_.last = std::max(frame, animation_.frames.first);
    }

    // The first and the last frame are those of the intervals, from this line on.
    void read_intervals(const std::string& value, const PlainLine& line) {
        std::vector<FrameSelection::Interval>& intervals = animation_.frames.intervals;
        intervals.clear();
        without_step_.clear();
        for (const std::string& item : words_of(value, ",")) read_interval(words_of(item, " \t"), line);
        if (intervals.empty()) return complain(line, "'frame intervals' needs at least one frame");
        animation_.frames.first = intervals.front().begin;
        animation_.last = std::max(intervals.front().begin, intervals.back().end);
    }

    void read_interval(const std::vector<std::string>& words, const PlainLine& line) {
        if (words.empty()) return;
        FrameSelection::Interval interval;
        std::size_t next = 0;
        if (!read_bounds(words, next, interval)) {
            return complain(line, fmt::format("'{}' is no frame and no interval such as 3-7", words[0]));
        }
        bool has_step = false;
        while (next < words.size()) {
            const std::string& word = words[next];
            if (word == "step" && next + 1 < words.size() && leading_integer(words[next + 1])) {
                interval.step = std::clamp(*leading_integer(words[next + 1]), 0, most_frames);
                has_step = true;
                next += 2;
            } else if ((word == "rotate" || word == "scale") && next + 3 < words.size()) {
                animation_.unused.push_back("frame intervals: " + word);
                next += 4;
            } else {
                complain(line, fmt::format("'{}' means nothing in an interval; it may have 'step s', 'rotate x y z', "
                                           "'scale x y z'",
                                           word));
                break;
            }
        }
        if (!has_step) without_step_.push_back(animation_.frames.intervals.size());
        animation_.frames.intervals.push_back(interval);
    }

    // `a`, `a-b`, or `a- b`.
    static bool read_bounds(const std::vector<std::string>& words, std::size_t& next,
                            FrameSelection::Interval& interval) {
        const std::string& first = words[next++];
        const std::size_t minus = first.find('-');
        const std::optional<int> begin = leading_integer(first.substr(0, minus));
        if (!begin) return false;
        interval.begin = interval.end = std::max(0, *begin);
        if (minus == std::string::npos) return true;
        std::string last = first.substr(minus + 1);
        if (last.empty() && next < words.size()) last = words[next++];
        const std::optional<int> end = leading_integer(last);
        if (!end) return false;
        interval.end = std::max(interval.begin, *end);
        return true;
    }

    void complain(const PlainLine& line, const std::string& message) {
        animation_.diagnostics.push_back({Diagnostic::Severity::error, line.place, message, line.text});
    }

    Animation animation_;
    std::vector<std::size_t> without_step_;
};

}  // namespace

Animation read_animation_text(const std::string& text, const std::string& name) {
    return AnimationReader().read(text, name);
}

Animation read_animation_file(const std::filesystem::path& path) {
    return read_animation_text(read_text(path), path.string());
}

}  // namespace espalier::simulation
