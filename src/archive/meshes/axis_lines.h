// The axes of a frame as lines that are ready to be swept or to be covered by a skin.
#pragma once

#include "archive/meshes/axis_tree.h"
#include "archive/meshes/tubes.h"

#include <span>
#include <string>
#include <vector>

namespace espalier::archive {

struct AxisLine {
    TubeLine line;  ///< two nodes at least
    std::uint32_t plant;
    std::size_t row;           ///< row of `of_cells` of the axis it begins with
    std::string texture = {};  ///< the file that it wears; "": none
};

/// Whether branches share the rings of forks, as tubes do.
enum class Forks { rings, none };

/// As `tube_line` makes them, with as many pictures of their textures around as fit the thickest axis of their plant.
std::vector<AxisLine> axis_lines(const FrameGeometry& geometry, std::span<const AxisPath> paths, double tolerance,
                                 float thinnest, Forks forks);

/// Puts a texture on all axes that wear none.
void apply_bark(FrameGeometry& geometry, const std::string& texture);

}  // namespace espalier::archive
