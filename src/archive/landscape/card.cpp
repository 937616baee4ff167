#include "archive/landscape/card.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <cmath>

namespace espalier::archive {

glm::dquat towards_eye(const glm::dvec3& place, const glm::dvec3& eye) {
    const glm::dvec3 line = eye - place;
    if (glm::length(line) == 0) return {1, 0, 0, 0};
    const glm::dvec3 forward = glm::normalize(line);
    glm::dvec3 right = glm::cross(glm::dvec3(0, 1, 0), forward);
    right = glm::length(right) > 1e-9 ? glm::normalize(right) : glm::dvec3(1, 0, 0);
    return glm::quat_cast(glm::dmat3(right, glm::cross(forward, right), forward));
}

FrameMesh card_mesh(const CardFrame& frame, const std::string& texture) {
    FrameMesh mesh;
    mesh.materials.push_back({{255, 255, 255}, texture});
    for (const glm::vec2 corner : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)}) {
        const glm::dvec2 at = frame.lower + glm::dvec2(corner) * (frame.upper - frame.lower);
        mesh.points.emplace_back(at.x, at.y, 0);
        mesh.normals.emplace_back(0, 0, 1);
        mesh.uvs.push_back(corner);
        mesh.rgb.push_back({255, 255, 255});
    }
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.material_of = {0, 0};
    return mesh;
}

}  // namespace espalier::archive
