// What a tube's outline loses when nodes of it go: areas as seen from the side.
#pragma once

#include "archive/meshes/tubes.h"

#include <utility>
#include <vector>

namespace espalier::archive {

/// The area of a tube seen from its side, square metres.
double outline_area(const TubeLine& line);

/// The inner nodes in the order in which they go, each with the area that leaves its place when it goes after those
/// before it; areas never fall. A piece that moves by its own width or more changes twice its area: where it was, and
/// where it is. `borne`: the area of what stands on the tube, which hangs in the air where the tube leaves its place by
/// more than its radius. `organs`: the area of organs on all that, of which the share counts by which a piece moves of
/// its own length: what bears a crown does not lean. A node where the colour changes counts as if it moved by its
/// radius at least.
std::vector<std::pair<double, std::size_t>> leaving_nodes(const TubeLine& line, const FrameAttributes& of_points,
                                                          double borne, double organs);

}  // namespace espalier::archive
