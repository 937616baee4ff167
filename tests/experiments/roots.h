// Shared by the tests of roots: a scene grown with its water watched, and the root systems it made.
#pragma once

#include "espalier/geometry/openvdb_grid.h"

#include "experiments/growth.h"

#include <glm/geometric.hpp>
#include <openvdb/tools/Interpolation.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace espalier {

/// Contents of the soil at one step.
class Soil {
public:
    explicit Soil(const World& world) : grid_(world.environment().fields().need("water").grid->grid->deepCopy()) {}

    double content(const glm::dvec3& point) const {
        openvdb::Vec3d index = grid_->worldToIndex({point.x, point.y, point.z});
        if (grid_->evalActiveVoxelDim().z() == 1) index.z() = 0;  // in the plane z does not matter
        return openvdb::tools::BoxSampler::sample(grid_->tree(), index);
    }
    /// Mean along a line.
    double content(const glm::dvec3& from, const glm::dvec3& to) const {
        const int points = 20;
        double sum = 0;
        for (int i = 0; i <= points; ++i) sum += content(from + (to - from) * (double(i) / points));
        return sum / (points + 1);
    }

private:
    openvdb::FloatGrid::Ptr grid_;
};

struct Rootlet {
    glm::dvec3 base{0}, heading{0, -1, 0};  ///< where it begins and which way
    double length = 0;
};

struct RootSystem {
    std::vector<glm::dvec3> main;  ///< nodes of the main root, from the soil's surface down
    std::vector<Rootlet> rootlets;
    int unfinished = 0;  ///< rootlets that were still growing
};

inline RootSystem root_system(const World& world, std::size_t plant = 0) {
    RootSystem system;
    std::map<std::uint32_t, Rootlet> axes;
    for (const Internode& internode : world.interpretation(plant).geometry.internodes) {
        if (internode.order == 0) {
            if (system.main.empty()) system.main.push_back(internode.base);
            system.main.push_back(internode.tip);
            continue;
        }
        Rootlet& rootlet = axes[internode.axis];
        if (rootlet.length == 0) {
            rootlet.base = internode.base;
            rootlet.heading = glm::normalize(internode.tip - internode.base);
        }
        rootlet.length += glm::length(internode.tip - internode.base);
    }
    for (const auto& [axis, rootlet] : axes) system.rootlets.push_back(rootlet);
    // A rootlet that dried up at once has its mark at a node of the main root.
    for (const Organ& organ : world.interpretation(plant).geometry.organs) {
        if (std::find(system.main.begin(), system.main.end(), organ.pose.position) == system.main.end()) continue;
        system.rootlets.push_back({organ.pose.position, organ.pose.heading, 0});
    }
    for (LetterId letter : world.string(plant).letters) {
        if (world.model(plant).alphabet.name(letter) == "S") ++system.unfinished;
    }
    return system;
}

/// Where the main root crosses the depth `y`, for the first time.
inline glm::dvec3 main_root_at(const RootSystem& system, double y) {
    for (std::size_t i = 1; i < system.main.size(); ++i) {
        const glm::dvec3 &upper = system.main[i - 1], &lower = system.main[i];
        if (lower.y <= y) return upper + (lower - upper) * ((upper.y - y) / (upper.y - lower.y));
    }
    throw RunError("the main root does not reach that depth");
}

struct Grown {
    Soil prepared;  ///< before anyone drank
    std::unique_ptr<World> world;
    double worst_balance = 0, least_content = 1e300, drunk = 0;  ///< over all steps
};

inline double quantity(const World& world, const std::string& name, std::uint32_t plant = 0) {
    for (const Quantity& quantity : world.environment().statistics(plant)) {
        if (quantity.name == name) return quantity.value;
    }
    throw RunError("no quantity " + name);
}

inline Grown grow_watched(const std::string& file, const SceneOptions& options = {}) {
    const Scene scene = read_scene(source_path(file), options);
    auto world = std::make_unique<World>(scene);
    Soil prepared(*world);
    Grown grown{std::move(prepared), std::move(world)};
    const auto watch = [&] {
        grown.worst_balance = std::max(grown.worst_balance, std::abs(quantity(*grown.world, "water.balance")));
        grown.least_content = std::min(grown.least_content, quantity(*grown.world, "water.minimum"));
        grown.drunk = quantity(*grown.world, "water.drunk");
    };
    grown.world->start();
    watch();
    while (!grown.world->at_end()) {
        grown.world->step();
        watch();
    }
    return grown;
}

inline SceneOptions with_seed(std::uint64_t seed) {
    SceneOptions options;
    options.seed = seed;
    return options;
}

}  // namespace espalier
