// What water cannot enter: obstacles, and everything outside a container.
#pragma once

#include "environment/soil/grid/grid.h"
#include "environment/soil/grid/parameters.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace espalier::environment {

class WaterSolids {
public:
    explicit WaterSolids(const SoilSpace& space);

    /// Takes up the distance fields as they are now; true if one of them is another than before.
    /// Throws UserError if there is none of that name.
    bool look(const Fields& fields);

    bool any() const { return !obstacles_.empty() || obstacle_field_ || container_field_; }
    /// Distance from `point` to the nearest solid, not positive inside one.
    double clearance(const glm::dvec3& point) const;
    /// Distance from `point` to the nearest wall: a solid, a side of the grid that is not joined to the one across, or
    /// its floor; negative beyond one. The surface is no wall.
    double distance_to_wall(const glm::dvec3& point, const WaterGrid& grid, bool joined_x, bool joined_z) const;
    /// True if a solid lies on the segment; steps of at least `resolution` follow the distances (sphere tracing, Hart
    /// 1996). `direction` is a unit vector.
    bool blocks(const glm::dvec3& from, const glm::dvec3& direction, double length, double resolution) const;
    /// One flag per voxel, x fastest: its centre is in no solid.
    std::vector<std::uint8_t> free_voxels(const WaterGrid& grid) const;

private:
    std::vector<std::shared_ptr<const Shape>> obstacles_;
    std::string obstacle_name_, container_name_;
    std::shared_ptr<const FieldGrid> obstacle_field_, container_field_;
};

}  // namespace espalier::environment
