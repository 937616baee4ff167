#include "espalier/base/map_origin.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace espalier {
namespace {

constexpr double rounded_to = 100;  ///< m
constexpr double decimals = 1e7;

thread_local MapOrigin* current_origin = nullptr;

bool is_far(double lower, double upper) {
    return std::abs(lower) > MapOrigin::far_away || std::abs(upper) > MapOrigin::far_away;
}

}  // namespace

glm::dvec3 MapOrigin::of(const glm::dvec3& lower, const glm::dvec3& upper, const Place& file) {
    if (is_given_) return *value_;
    glm::dvec3 near(0);
    bool is_of_map = false;
    for (int axis = 0; axis < 3; ++axis) {
        if (!is_far(lower[axis], upper[axis])) continue;
        is_of_map = true;
        near[axis] = rounded_to * std::round(0.5 * (lower[axis] + upper[axis]) / rounded_to);
    }
    if (!is_of_map) return glm::dvec3(0);
    if (value_) return *value_;
    value_ = near;
    Diagnostic& warning = warnings_.emplace_back();
    warning.severity = Diagnostic::Severity::warning;
    warning.place = file;
    warning.message = fmt::format(
        "places of this file are far from 0: [{}, {}, {}] m is taken as the origin of the "
        "scene, and subtracted from those of files; 'origin' of [simulation] says another",
        near.x, near.y, near.z);
    return near;
}

glm::dvec3 MapOrigin::shifted(const glm::dvec3& place, const glm::dvec3& subtracted) {
    if (subtracted == glm::dvec3(0)) return place;
    glm::dvec3 shifted = place - subtracted;
    for (int axis = 0; axis < 3; ++axis) {
        if (subtracted[axis] != 0) shifted[axis] = std::round(shifted[axis] * decimals) / decimals;
    }
    return shifted;
}

MapOrigin* MapOrigin::current() {
    return current_origin;
}

MapOrigin::Scope::Scope(MapOrigin* origin) : before_(std::exchange(current_origin, origin)) {}

MapOrigin::Scope::~Scope() {
    current_origin = before_;
}

std::vector<Diagnostic> MapOrigin::take_warnings() {
    return std::exchange(warnings_, {});
}

}  // namespace espalier
