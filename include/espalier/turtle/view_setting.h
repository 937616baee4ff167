// What the settings of view files mean and take: for help and forms.
#pragma once

#include "espalier/base/stations.h"

#include <limits>
#include <span>
#include <string_view>
#include <vector>

namespace espalier::turtle {

/// What stands behind a setting, or behind a letter of a line of letters.
enum class ViewKind { number, whole, on_off, word, vector, colour, file, flag, letters, other };

/// Values of one kind. A vector has three numbers, a colour three from 0 to 1.
struct ViewValue {
    ViewKind kind = ViewKind::other;
    std::string_view help;           ///< one phrase
    std::string_view standard = {};  ///< what holds without it, as it would be written; "": nothing
    std::string_view unit = {};
    double lowest = -std::numeric_limits<double>::infinity();
    double highest = std::numeric_limits<double>::infinity();
    std::string_view words = {};  ///< words that a value of kind `word` takes, separated by blanks
    char letter = 0;              ///< that stands before it; 0: none
};

struct ViewSetting {
    std::string_view label;   ///< with its colon
    std::string_view values;  ///< what follows it, in words
    std::string_view group;   ///< "growth", "shape", "picture", or "window": without meaning outside one
    ViewValue value;
    std::span<const ViewValue> letters = {};  ///< letters that a line of letters takes
};

/// All, in the order of the manual.
std::vector<ViewSetting> view_settings();

}  // namespace espalier::turtle
