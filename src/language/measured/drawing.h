// The string of modules that draws measured plants.
#pragma once

#include "espalier/language/measured_plants.h"
#include "espalier/lsystem/module_string.h"

#include <optional>
#include <string>

namespace espalier::language::measured {

/// The letters that stand in the string, in one alphabet.
struct DrawingLetters {
    explicit DrawingLetters(lsystem::Alphabet& alphabet);

    lsystem::LetterId at, width, heading, forward, move, axis_begin, axis, tip, node;  ///< of @R and @Ax the parts
    lsystem::LetterId open_polygon, vertex, close_polygon;
    lsystem::LetterId forward_behind, node_behind;  ///< of a piece that begins behind a gap of its axis
};

/// One plant, which begins where the turtle stands, or all at their places.
lsystem::ModuleString drawing_of(const MeasuredPlants& plants, std::optional<std::size_t> plant,
                                 const DrawingLetters& letters);
/// A line for each axis, with ten digits: the eleventh of a measured length is noise of its unit.
std::string text_of(const lsystem::ModuleString& string, const lsystem::Alphabet& alphabet);
/// One of each module that may stand in the string, as an axiom.
std::string sample_axiom(bool has_times);

}  // namespace espalier::language::measured
