// The turtle's own answers: where it is and how it stands.
#include "espalier/turtle/interpretation.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>

namespace espalier {
namespace {

void write(const glm::dvec3& vector, Answer answer) {
    const double values[3] = {vector.x, vector.y, vector.z};
    std::copy_n(values, std::min<std::size_t>(3, answer.size()), answer.begin());
}

/// The rotation that takes cpfg's initial frame to the turtle's, as (w, x, y, z) with w >= 0.
void write_orientation(const Pose& pose, Answer answer) {
    glm::dquat rotation = glm::quat_cast(glm::dmat3(-pose.left, pose.heading, -pose.up));
    if (rotation.w < 0) rotation = -rotation;
    const double values[4] = {rotation.w, rotation.x, rotation.y, rotation.z};
    std::copy_n(values, std::min<std::size_t>(4, answer.size()), answer.begin());
}

}  // namespace

void answer_from_turtle(const Query& query, Answer answer) {
    switch (query.kind) {
        case QueryKind::communication:
            return;
        case QueryKind::position:
            return write(query.pose.position, answer);
        case QueryKind::heading:
            return write(query.pose.heading, answer);
        case QueryKind::left:
            return write(query.pose.left, answer);
        case QueryKind::up:
            return write(query.pose.up, answer);
        case QueryKind::orientation:
            return write_orientation(query.pose, answer);
    }
}

}  // namespace espalier
