#include "geometry/magnetic_cut.h"

#include "espalier/base/math.h"

#include "base/monotone_curve.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <numbers>

namespace espalier::geometry {
namespace {

constexpr double pi = std::numbers::pi;

glm::dvec3 outline(const MagneticCut& cut, double angle) {
    const double place = angle / (2 * pi) * double(cut.strengths.size());
    const double radius = std::max(0.0, 1 + monotone_curve(cut.strengths, place, true));
    return {cut.thickness * radius * math::cos(angle), radius * math::sin(angle), 0};
}

glm::dvec3 position(const MagneticCut& cut, int k, int sides) {
    if (!cut.flat) return outline(cut, 2 * pi * k / sides);
    const double angle = math::asin(std::clamp(2.0 * k / sides - 1, -1.0, 1.0));
    return (outline(cut, angle) + outline(cut, pi - angle)) / 2.0;
}

}  // namespace

std::vector<Contour::Vertex> MagneticCut::sample(int sides) const {
    std::vector<Contour::Vertex> vertices;
    for (int k = 0; k <= sides; ++k) vertices.push_back({position(*this, k, sides), {1, 0, 0}});
    if (!flat) vertices.back().position = vertices.front().position;
    const auto count = std::size_t(sides);
    for (std::size_t k = 0; k <= count; ++k) {
        const std::size_t before = k > 0 ? k - 1 : flat ? 0 : count - 1;
        const std::size_t after = k < count ? k + 1 : flat ? count : 1;
        const glm::dvec3 chord = vertices[after].position - vertices[before].position;
        const double length = glm::length(chord);
        if (length > 1e-12) vertices[k].normal = glm::dvec3(chord.y, -chord.x, 0) / length;
    }
    return vertices;
}

}  // namespace espalier::geometry
