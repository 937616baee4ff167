// Units of lengths, and axes that point upwards, as files and users write them.
#pragma once

#include <glm/mat3x3.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::language::measured {

/// What users may say: "m", "dm", "cm", "mm", "um", "inch", and "x", "y", "z", "-x", "-y", "-z".
const std::vector<std::string>& length_units();
const std::vector<std::string>& upward_axes();

/// The metres of "m", "dm", "cm", "mm", "um" or "inch", in their usual spellings; nothing for other words.
std::optional<double> metres_of(std::string_view unit);
/// The same. Throws UserError, which names those there are.
double metres_of_unit(const std::string& unit);

/// What turns a file's axes so that `up`, one of "x", "y", "z", "-x", "-y" and "-z", becomes y, without reflection.
/// Throws UserError for other words.
glm::dmat3 upright(const std::string& up);

}  // namespace espalier::language::measured
