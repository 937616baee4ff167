#include "espalier/turtle/turtle.h"

#include "espalier/base/math.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace espalier::turtle {
namespace {

/// Rodrigues' rotation formula; `axis` is a unit vector.
glm::dvec3 rotated(const glm::dvec3& vector, const glm::dvec3& axis, Rotation by) {
    return vector * by.cosine + glm::cross(axis, vector) * by.sine + axis * (glm::dot(axis, vector) * (1 - by.cosine));
}

/// Rounds off what a general rotation leaves of non-orthogonality.
void straighten(Pose& pose) {
    pose.heading = glm::normalize(pose.heading);
    pose.left = glm::normalize(pose.left - pose.heading * glm::dot(pose.left, pose.heading));
    pose.up = glm::cross(pose.left, pose.heading);
}

/// Rotates the whole frame, so that the heading turns with the least twist.
void rotate_frame(Pose& pose, const glm::dvec3& axis, Rotation by) {
    pose.heading = rotated(pose.heading, axis, by);
    pose.left = rotated(pose.left, axis, by);
    straighten(pose);
}

/// The direction one tropism pulls to: its own, or the one at `angle` from it on the heading's side. A heading along
/// the tropism, which has no side, is bent about the turtle's left, as in cpfg.
glm::dvec3 pull(const Tropism& tropism, const Pose& pose) {
    constexpr double least_sine = 1e-7;
    const glm::dvec3& T = tropism.direction;
    if (tropism.angle == 0) return T;
    const glm::dvec3 across = glm::cross(pose.heading, T);
    const double sine = glm::length(across);
    const glm::dvec3 along = T * math::cos(tropism.angle);
    if (sine < least_sine) return along + glm::cross(T, pose.left) * math::sin(tropism.angle);
    return along + glm::cross(T, across) * (math::sin(tropism.angle) / sine);
}

}  // namespace

Rotation::Rotation(double angle) {
    const math::SineAndCosine of_angle = math::sine_and_cosine(angle);
    cosine = of_angle.cosine;
    sine = of_angle.sine;
    // pi/2 and its like cannot be written in binary; what is left of 0 is an artefact.
    constexpr double artefact = 4e-16;
    if (std::abs(cosine) < artefact) {
        cosine = 0;
        sine = std::copysign(1.0, sine);
    }
    if (std::abs(sine) < artefact) {
        sine = 0;
        cosine = std::copysign(1.0, cosine);
    }
}

Rotation rotation_of_degrees(double degrees) {
    return Rotation(degrees * (std::numbers::pi / 180));
}

void level(Pose& pose) {
    const glm::dvec3 left = glm::cross(glm::dvec3(0, 1, 0), pose.heading);
    const double length = glm::length(left);
    if (length < 1e-9) return;
    pose.left = left / length;
    pose.up = glm::cross(pose.left, pose.heading);
}

void head_towards(Pose& pose, const glm::dvec3& heading) {
    const double length = glm::length(heading);
    const glm::dvec3 target = length > 0 ? heading / length : glm::dvec3(0, 1, 0);
    const glm::dvec3 across = glm::cross(pose.heading, target);
    const double sine = glm::length(across);
    if (sine > 1e-12) {
        Rotation by;
        by.cosine = glm::dot(pose.heading, target);
        by.sine = sine;
        rotate_frame(pose, across / sine, by);
    } else if (glm::dot(pose.heading, target) < 0) {
        pose.left = -pose.left;  // straight back: turn in the plane of heading and left, as | does
    }
    pose.heading = target;
    straighten(pose);
}

void apply_tropisms(Pose& pose, std::span<const Tropism> tropisms, std::span<const double> elasticities) {
    bend_by_tropisms(pose, tropisms, elasticities);
    roll_by_torques(pose, tropisms, elasticities);
}

bool bend_by_tropisms(Pose& pose, std::span<const Tropism> tropisms, std::span<const double> elasticities) {
    glm::dvec3 bend(0);
    for (std::size_t i = 0; i < tropisms.size(); ++i) {
        if (elasticities[i] == 0 || tropisms[i].torque) continue;
        bend += pull(tropisms[i], pose) * elasticities[i];
    }
    // Prusinkiewicz & Lindenmayer 1990, section 2.3: alpha = e |H x T|, about the axis H x T.
    const glm::dvec3 axis = glm::cross(pose.heading, bend);
    const double torque = glm::length(axis);
    if (torque == 0) return false;
    rotate_frame(pose, axis / torque, std::min(torque, 1.0));
    return true;
}

void roll_by_torques(Pose& pose, std::span<const Tropism> tropisms, std::span<const double> elasticities) {
    glm::dvec3 twist(0);
    for (std::size_t i = 0; i < tropisms.size(); ++i) {
        if (tropisms[i].torque) twist += tropisms[i].direction * elasticities[i];
    }
    // As for the heading, about the heading: only the part of the twist across it counts.
    const double roll = std::clamp(glm::dot(glm::cross(pose.up, twist), pose.heading), -1.0, 1.0);
    if (roll != 0) roll_left(pose, Rotation(-roll));
}

void apply_older_tropism(Pose& pose, const glm::dvec3& direction, double elasticity) {
    const auto bend = [&](glm::dvec3& side) {
        Rotation by;
        by.sine = std::clamp(elasticity * glm::dot(direction, side), -1.0, 1.0);
        by.cosine = std::sqrt(1 - by.sine * by.sine);
        rotate_pair(pose.heading, side, by);
    };
    bend(pose.up);
    bend(pose.left);
}

}  // namespace espalier::turtle
