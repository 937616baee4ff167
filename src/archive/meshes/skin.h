// One smooth surface over the axes of a plant: saddles between limbs (Bloomenthal 1985), and roots as the surface at a
// distance from their skeleton curves.
#pragma once

#include "espalier/archive/mesh_options.h"

#include "archive/meshes/axis_lines.h"

#include <span>
#include <vector>

namespace espalier::archive {

/// The voxel that `skin` asks for. If it asks for none, a quarter of the thinnest radius, but no smaller than a
/// fortieth of the thickest, nor than what gives a surface of 300,000 triangles. Throws UserError if there would be
/// more than 16 million.
double skin_voxel(std::span<const AxisLine> lines, const AxisSkin& skin);

/// A patch for each line: the part of its plant's surface that is nearest to it, textured as a tube is, and a tube of
/// `sides` for what is thinner than 1.5 voxels. Patches of one plant meet in the same points: together they are closed,
/// and so is each tube. Lines that stand free are flat at their base. Throws UserError for wrong settings of bark.
std::vector<Tube> skin_of(std::span<const AxisLine> lines, std::span<const int> sides, const AxisSkin& skin);

}  // namespace espalier::archive
