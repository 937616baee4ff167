#include "environment/soil/grid/parameters.h"

#include "base/text.h"
#include "environment/exchange/covering.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace espalier::environment {
namespace {

Box read_domain(const Settings& settings, const EnvironmentContext& context) {
    if (!settings.has("domain")) {
        if (context.domain) return *context.domain;
        throw UserError(settings.place(),
                        fmt::format("'{}' needs a domain = {{ lower = [x, y, z], upper = [x, y, z] }}, its own or the "
                                    "scene's",
                                    context.name));
    }
    const Settings domain = settings.table("domain");
    const Box box{domain.vector("lower"), domain.vector("upper")};
    for (int axis = 0; axis < 3; ++axis) {
        if (box.lower[axis] > box.upper[axis] || (axis < 2 && box.lower[axis] == box.upper[axis])) {
            throw UserError(domain.place("upper"), "the domain's upper corner must lie above its lower corner");
        }
    }
    return box;
}

bool read_flatness(const Settings& settings, const Box& domain, double voxel) {
    const bool thin = domain.upper.z - domain.lower.z <= voxel * (1 + 1e-9);
    if (!settings.has("dimensions")) return thin;
    return settings.integer("dimensions", Range::between(2, 3)) == 2;
}

}  // namespace

SoilSpace SoilSpace::read(const Settings& settings, const EnvironmentContext& context) {
    SoilSpace space;
    space.place = settings.place();
    space.voxel_place = settings.place("voxel");
    space.domain = read_domain(settings, context);
    space.voxel = read_voxel(settings);
    space.flat = read_flatness(settings, space.domain, space.voxel);
    for (Settings& table : settings.tables("obstacles")) space.obstacles.push_back(read_shape(table));
    space.obstacle_field = settings.text_or("obstacle_field", "");
    space.container_field = settings.text_or("container_field", "");
    return space;
}

WaterGrid SoilSpace::affordable_grid(const EnvironmentContext& context, double bytes_per_voxel) const {
    const double voxels = WaterGrid::voxels_needed(domain, voxel, flat), bytes = voxels * bytes_per_voxel;
    if (voxels <= 2e9 && bytes <= static_cast<double>(context.memory)) return grid();
    throw UserError(voxel_place,
                    fmt::format("'{}' would have {} voxels and take {} GB: use larger voxels, a smaller domain or more "
                                "memory",
                                context.name, format_general(voxels), format_general(bytes / 1e9)));
}

SoilQuerying SoilQuerying::read(const Settings& settings, double voxel, bool depletion) {
    SoilQuerying querying;
    querying.depletion = settings.flag_or("depletion", depletion);
    if (settings.choice_or("amount", "content", {"content", "volume"}) == "volume") {
        querying.amount = voxel * voxel * voxel;
    }
    querying.amount_place = settings.place("amount");
    querying.range = settings.number_or("range", 1, Range::positive());
    querying.gradient_length = settings.number_or("gradient_length", voxel, Range::positive());
    return querying;
}

LayerHeights LayerHeights::read(const Settings& table, double bottom, double top) {
    const LayerHeights heights{table.number_or("bottom", bottom), table.number_or("top", top)};
    if (heights.bottom < heights.top) return heights;
    throw UserError(table.place("top"), "a layer's 'top' must be higher than its 'bottom' (y points up)");
}

std::vector<std::size_t> cells_of_source(const WaterGrid& grid, const Shape& shape, const Place& place) {
    glm::ivec3 first{0}, last = grid.size() - 1;
    if (const std::optional<Box> bounds = shape.bounds()) {
        for (int axis = 0; axis < 3; ++axis) {
            const auto voxel_at = [&](double x) {
                return std::clamp((x - grid.lower()[axis]) / grid.voxel(), -2.0, grid.size()[axis] + 2.0);
            };
            first[axis] = std::max(first[axis], static_cast<int>(std::floor(voxel_at(bounds->lower[axis]))) - 1);
            last[axis] = std::min(last[axis], static_cast<int>(std::ceil(voxel_at(bounds->upper[axis]))) + 1);
        }
    }
    std::vector<std::size_t> cells;
    for (int z = first.z; z <= last.z; ++z) {
        for (int y = first.y; y <= last.y; ++y) {
            for (int x = first.x; x <= last.x; ++x) {
                if (shape.inside(grid.centre({x, y, z}))) cells.push_back(grid.cell({x, y, z}));
            }
        }
    }
    if (cells.empty()) throw UserError(place, "this source holds no voxel's centre: make it larger or move it");
    return cells;
}

}  // namespace espalier::environment
