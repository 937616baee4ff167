// What a colour index of the turtle looks like: colour maps and materials.
#pragma once

#include "espalier/base/stations.h"

#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>

namespace espalier::geometry {

/// Red, green, blue and opacity in [0, 1].
struct Material {
    glm::dvec4 ambient{0, 0, 0, 1}, diffuse{1, 1, 1, 1}, specular{0, 0, 0, 1}, emissive{0, 0, 0, 1};
    double shininess = 0;
};

/// Index 256 * set + value; the turtle's indices are those of set 1, written without it.
struct Palette {
    std::map<int, Material> entries;
    bool of_materials = false;  ///< not of colour maps: colours of patches do not count then, as in cpfg

    /// The entry a turtle's colour index stands for; grey if its set was not given, white if only the entry was not.
    Material material(int colour) const;
};

/// What is seen of it in even light: what it reflects and emits, red, green and blue.
std::array<std::uint8_t, 3> shown_colour(const Material& material);

/// Adds a colour map (256 x 3 bytes) or a material file (15 bytes an entry) as set `set` (1 is the turtle's).
/// Throws UserError if the file is missing or is neither.
void read_colour_map(const std::filesystem::path& path, int set, Palette& palette);
void read_materials(const std::filesystem::path& path, int set, Palette& palette);

}  // namespace espalier::geometry
