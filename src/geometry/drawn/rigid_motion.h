// Turning and moving what is drawn of a plant, part by part.
#pragma once

#include "espalier/geometry/plant_geometry.h"

#include <glm/gtc/quaternion.hpp>

#include <functional>

namespace espalier::geometry {

/// A turn by an angle in radians, counter-clockwise about an axis of length 1.
glm::dquat turn_about(const glm::dvec3& axis, double angle);

/// A turn about the point `from`, which comes to lie at `to`.
struct RigidMotion {
    glm::dquat turn{1, 0, 0, 0};
    glm::dvec3 from{0, 0, 0}, to{0, 0, 0};

    glm::dvec3 point(const glm::dvec3& p) const { return to + turn * (p - from); }
    glm::dvec3 direction(const glm::dvec3& v) const { return turn * v; }
};

/// How what a module draws at a place moves; null: it stays.
using MotionOfModule = std::function<const RigidMotion*(std::uint32_t module, const glm::dvec3& place)>;

/// Moves all but the internodes. A polygon moves as its opening brace does, a vertex that pieces of a mesh share as the
/// first of these.
void move_organs(PlantGeometry& geometry, const MotionOfModule& motion_of);

}  // namespace espalier::geometry
