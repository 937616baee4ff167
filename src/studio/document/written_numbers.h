// The numbers of models and scenes that users may slide, and where they are written.
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace espalier::studio {

/// A documented #define of a model, or a number or a switch of a scene file.
struct WrittenNumber {
    std::string name;   ///< "HEIGHT", "environment.light.voxel"
    std::string label;  ///< what it is, for people
    std::string group = {}, unit = {};
    std::string text;  ///< as it is written: "6", "-0.25", "true"
    bool is_switch = false, whole = false;
    double value = 0;
    double lowest = -std::numeric_limits<double>::infinity();
    double highest = std::numeric_limits<double>::infinity();
    std::size_t offset = 0;  ///< in the text of the file
};

/// Those of one file, in its order; none of a file with mistakes, or in a language that has no such numbers.
std::vector<WrittenNumber> written_numbers(const std::filesystem::path& file, const std::string& text);

/// The text with another value for one of its numbers.
std::string with_number(const std::string& text, const WrittenNumber& number, const std::string& value);

}  // namespace espalier::studio
