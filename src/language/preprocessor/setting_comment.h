// What the comment behind a #define says of it: "width of the crown; 0.5..40; m".
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace espalier::language {

struct SettingComment {
    std::string summary = {};
    double lowest = -std::numeric_limits<double>::infinity();
    double highest = std::numeric_limits<double>::infinity();
    bool whole = false;  ///< "1..400 whole"
    std::string unit = {};
};

/// Reads a line as its author wrote it; nothing if it has no comment, or one without a range.
std::optional<SettingComment> setting_comment(std::string_view line);

/// "Crown" of a line that is nothing but a heading: /* --- Crown --- */ or // --- Crown ---; otherwise "".
std::string_view heading_of(std::string_view line);

}  // namespace espalier::language
