// The plants of a frame as triangles that know which organ they belong to: what the beams of an instrument meet.
#pragma once

#include "espalier/archive/recorded_run.h"

#include "archive/frame_organs.h"
#include "geometry/rays/ray_scene.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace espalier::study {

/// Where a beam meets an organ, or the ground.
struct Touch {
    float distance = 0;                ///< m
    float facing = 0;                  ///< cosine between beam and surface
    std::optional<std::size_t> organ;  ///< its number; none: the ground
};

class ScannedPlants {
public:
    /// Internodes are truncated cones of `sides` corners, closed at their ends; the other surfaces are as they were
    /// drawn, without the holes of their pictures. `ground`: the height of a level ground, m; none: there is none.
    ScannedPlants(const FrameGeometry& geometry, int sides, std::optional<double> ground);

    /// The nearest within `range`, m, along a direction of length 1. Several threads may ask.
    std::optional<Touch> touch(const glm::vec3& origin, const glm::vec3& direction, float range) const;

    /// By number.
    const std::vector<archive::FrameOrgan>& organs() const { return organs_; }
    /// Three corners a triangle, and the organ of each triangle.
    const std::vector<glm::vec3>& corners() const { return corners_; }
    const std::vector<std::uint32_t>& organ_of_triangle() const { return organ_of_triangle_; }
    glm::vec3 lowest() const { return lowest_; }
    glm::vec3 highest() const { return highest_; }

private:
    void add_internodes(const FrameGeometry& geometry, const archive::FrameOrgans& organs, int sides);
    void add_surfaces(const FrameGeometry& geometry, const archive::FrameOrgans& organs);
    void add(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, std::uint32_t organ);

    std::vector<archive::FrameOrgan> organs_;
    std::vector<glm::vec3> corners_;
    std::vector<std::uint32_t> organ_of_triangle_;
    glm::vec3 lowest_{0}, highest_{0};
    std::optional<double> ground_;
    geometry::RayScene rays_;
};

}  // namespace espalier::study
