// A lesson: a text beside a plant that grows, with sliders, questions, and goals that the page checks. Its file is
// Markdown that begins with a table in TOML between two lines of `+++`.
#pragma once

#include "espalier/base/error.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace espalier::studio {

/// A column of statistics.csv at the last step is to lie between bounds: the mean over all plants, or over those of one
/// name.
struct Goal {
    std::string text, column, plant;  ///< `plant` empty: all
    std::optional<double> least, most;
    Place place;

    bool is_reached(double value) const { return !(least && !(value >= *least)) && !(most && !(value <= *most)); }
};

/// One of several answers is right.
struct Question {
    std::string text, why;
    std::vector<std::string> choices;
    std::size_t right = 0;  ///< from 0 on
};

struct Lesson {
    std::filesystem::path file;
    std::string title, html;
    std::filesystem::path grows;  ///< a model or a scene, absolute
    std::optional<std::uint64_t> seed;
    std::optional<int> steps;
    std::string texts;  ///< "hidden", "locked" or "free": what the page does with those of the model
    std::vector<std::string> sliders, charts;
    std::vector<Goal> goals;
    std::vector<Question> questions;
    std::map<std::string, std::string> answer;  ///< settings that reach the goals
    std::filesystem::path next;                 ///< the lesson that follows; empty: none
    std::map<std::string, Place> places;        ///< of `sliders` and the keys of `answer`
    std::vector<Diagnostic> warnings;           ///< what the text holds and the page does not show
};

/// Throws UserError.
Lesson read_lesson(const std::filesystem::path& file);

/// What studio/source/lesson.ts reads.
std::string json_of_lesson(const Lesson& lesson);

}  // namespace espalier::studio
