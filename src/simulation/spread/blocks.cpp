#include "simulation/spread/blocks.h"

#include "espalier/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace espalier::simulation {
namespace {

std::array<int, 2> grid_of(const Scene& scene) {
    if (scene.blocks) return *scene.blocks;
    const auto side = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(scene.plants.size()))));
    return {std::clamp(side, 1, 32), std::clamp(side, 1, 32)};
}

std::size_t along(double at, double lower, double upper, int blocks) {
    if (!(upper > lower)) return 0;
    const double part = (at - lower) / (upper - lower) * blocks;
    return static_cast<std::size_t>(std::clamp(part, 0.0, blocks - 1.0));
}

}  // namespace

std::vector<std::size_t> blocks_of(const Scene& scene) {
    const std::array<int, 2> grid = grid_of(scene);
    Box places;
    for (const Plant& plant : scene.plants) places.add(plant.turtle.pose.position);
    std::vector<std::size_t> blocks;
    blocks.reserve(scene.plants.size());
    const auto columns = static_cast<std::size_t>(grid[0]);
    for (const Plant& plant : scene.plants) {
        const glm::dvec3& at = plant.turtle.pose.position;
        const std::size_t column = along(at.x, places.lower.x, places.upper.x, grid[0]);
        const std::size_t row = along(at.z, places.lower.z, places.upper.z, grid[1]);
        blocks.push_back(row * columns + (row % 2 == 0 ? column : columns - 1 - column));
    }
    return blocks;
}

std::vector<int> ranks_of(const std::vector<std::size_t>& blocks, const std::vector<double>& weights, int ranks) {
    std::map<std::size_t, double> weight_of_block;
    for (std::size_t plant = 0; plant < blocks.size(); ++plant) weight_of_block[blocks[plant]] += weights[plant];
    if (static_cast<std::size_t>(ranks) > weight_of_block.size()) {
        throw UserError(
            fmt::format("there are {} ranks but only {} block{} with plants: start fewer ranks, or set more "
                        "blocks with `blocks = [x, z]` under [simulation]",
                        ranks, weight_of_block.size(), weight_of_block.size() == 1 ? "" : "s"));
    }
    double left = 0;
    for (const auto& block : weight_of_block) left += block.second;
    std::map<std::size_t, int> rank_of_block;
    int rank = 0;
    double held = 0;
    std::size_t blocks_left = weight_of_block.size();
    for (const auto& [block, weight] : weight_of_block) {
        const auto ranks_left = static_cast<std::size_t>(ranks - rank);
        const bool is_enough = held + weight / 2 > left / static_cast<double>(ranks_left);
        const bool are_needed = blocks_left < ranks_left;  // each of the ranks after this one gets one
        if (ranks_left > 1 && rank_of_block.size() > 0 && held > 0 && (is_enough || are_needed)) {
            left -= held;
            held = 0;
            ++rank;
        }
        rank_of_block[block] = rank;
        held += weight;
        --blocks_left;
    }
    std::vector<int> result;
    result.reserve(blocks.size());
    for (const std::size_t block : blocks) result.push_back(rank_of_block[block]);
    return result;
}

}  // namespace espalier::simulation
