// The flat parts of a drawn plant: what leaves are to light.
#pragma once

#include "espalier/geometry/plant_geometry.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace espalier::environment {

/// A polygon, a triangle of a patch, a face of a surface, or a disc as a square of its area.
struct DrawnLeaf {
    std::uint32_t module;  ///< index of the module in the plant's string
    std::uint16_t colour;  ///< of its front
    std::span<const glm::dvec3> corners;
};

/// The corners of all flat parts, one part after the other.
class DrawnLeaves {
public:
    /// Replaces what was there by the plant's polygons, patches, surfaces and discs, in this order of kinds.
    void collect(const PlantGeometry& geometry);

    std::size_t size() const { return modules_.size(); }
    DrawnLeaf operator[](std::size_t i) const {
        return {modules_[i], colours_[i], std::span(corners_).subspan(ends_[i], ends_[i + 1] - ends_[i])};
    }

private:
    void add(std::uint32_t module, std::uint16_t colour, std::span<const glm::dvec3> corners);
    void add_patches(const DrawnMesh& mesh);
    void add_organs(const PlantGeometry& geometry);
    void add_surface(const Organ& organ, const SurfaceMesh& mesh);
    void add_disc(const Organ& organ);

    std::vector<std::uint32_t> modules_;
    std::vector<std::uint16_t> colours_;
    std::vector<std::size_t> ends_{0};
    std::vector<glm::dvec3> corners_;
};

/// Newell's normal, as long as the area.
glm::dvec3 area_vector(std::span<const glm::dvec3> corners);

glm::dvec3 middle_of(std::span<const glm::dvec3> corners);

}  // namespace espalier::environment
