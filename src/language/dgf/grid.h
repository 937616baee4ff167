// A file of Dune's grid format that holds a network of segments.
#pragma once

#include "language/measured/notes.h"

#include <glm/vec3.hpp>

#include <optional>
#include <string>
#include <vector>

namespace espalier::language::dgf {

/// What is known of a segment beside its nodes. NaN: not known.
struct Segment {
    std::size_t from = 0, to = 0;  ///< vertices
    double order, branch, surface, length, radius, birth, organ;
    int line = 0;
};

struct Grid {
    std::vector<glm::dvec3> vertices;
    std::vector<Segment> segments;
    /// The unit in brackets behind the name of a column: "cm", "cm2"; "" where it says none.
    std::string radius_unit, surface_unit, birth_unit;
};

/// Notes columns and blocks that are not used. Throws UserError with the line of a mistake.
Grid read_grid(const std::string& text, const std::string& name, measured::Notes& notes);

}  // namespace espalier::language::dgf
