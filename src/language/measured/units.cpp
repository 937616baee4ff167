#include "language/measured/units.h"

#include "espalier/base/error.h"

#include "base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace espalier::language::measured {

const std::vector<std::string>& length_units() {
    static const std::vector<std::string> words{"m", "dm", "cm", "mm", "um", "inch"};
    return words;
}

const std::vector<std::string>& upward_axes() {
    static const std::vector<std::string> words{"x", "y", "z", "-x", "-y", "-z"};
    return words;
}

std::optional<double> metres_of(std::string_view unit) {
    struct Spelling {
        std::string_view word;
        double metres;
    };
    static constexpr std::array<Spelling, 20> spellings{{{"m", 1},
                                                         {"meter", 1},
                                                         {"metre", 1},
                                                         {"meters", 1},
                                                         {"metres", 1},
                                                         {"dm", 0.1},
                                                         {"cm", 0.01},
                                                         {"centimeter", 0.01},
                                                         {"centimetre", 0.01},
                                                         {"centimeters", 0.01},
                                                         {"mm", 0.001},
                                                         {"millimeter", 0.001},
                                                         {"millimetre", 0.001},
                                                         {"millimeters", 0.001},
                                                         {"um", 1e-6},
                                                         {"micrometer", 1e-6},
                                                         {"\xC2\xB5m", 1e-6},
                                                         {"inch", 0.0254},
                                                         {"inches", 0.0254},
                                                         {"in", 0.0254}}};
    const std::string small = in_small_letters(unit);
    const auto* const found =
        std::find_if(spellings.begin(), spellings.end(), [&](const Spelling& each) { return each.word == small; });
    return found == spellings.end() ? std::nullopt : std::optional(found->metres);
}

double metres_of_unit(const std::string& unit) {
    if (const std::optional<double> metres = metres_of(unit)) return *metres;
    throw UserError(fmt::format("the unit '{}' is no length: write m, dm, cm, mm, um or inch", unit));
}

glm::dmat3 upright(const std::string& up) {
    // Columns: where the file's x, y and z go.
    if (up == "y") return glm::dmat3(1);
    if (up == "-y") return {{1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
    if (up == "z") return {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
    if (up == "-z") return {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}};
    if (up == "x") return {{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}};
    if (up == "-x") return {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}};
    throw UserError(fmt::format("what points upwards is x, y, z, -x, -y or -z, not '{}'", up));
}

}  // namespace espalier::language::measured
