// A plant as a card: two triangles that turn to the eye and wear its picture (a billboard).
#pragma once

#include "archive/meshes/surface_mesh.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace espalier::archive {

/// What a card covers around the middle of a plant, in the plane across the line of sight: right and up, metres.
struct CardFrame {
    glm::dvec3 middle{0};  ///< in the plant's own space
    glm::dvec2 lower{0}, upper{0};
};

/// The rotation that turns +z from a place to the eye and keeps +y as upright as it can be.
glm::dquat towards_eye(const glm::dvec3& place, const glm::dvec3& eye);

/// Two triangles across z around the middle of the plant; u runs to the right, v up, from 0 to 1.
FrameMesh card_mesh(const CardFrame& frame, const std::string& texture);

}  // namespace espalier::archive
