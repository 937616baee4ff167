// Which rank holds which plants of a world: the ground is cut into blocks, and each rank has some.
#pragma once

#include "espalier/simulation/scene.h"

#include <cstddef>
#include <vector>

namespace espalier::simulation {

/// The block of each plant: its place in a grid of rectangles over the places of all plants, along x and z. The grid is
/// the scene's, or has about as many blocks as plants, but 32 x 32 at most. Blocks are numbered row by row, every other
/// row backwards, so that blocks that follow each other touch.
std::vector<std::size_t> blocks_of(const Scene& scene);

/// The rank of each plant. Each rank has blocks that follow each other, of about the same weight; `weights` are those
/// of the plants, none negative. The same on every machine. Throws UserError if there are more ranks than blocks with a
/// plant.
std::vector<int> ranks_of(const std::vector<std::size_t>& blocks, const std::vector<double>& weights, int ranks);

}  // namespace espalier::simulation
