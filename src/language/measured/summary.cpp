#include "espalier/language/measured_plants.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <cmath>
#include <numbers>

namespace espalier::language {
namespace {

void add_link(MeasuredSummary& summary, double length) {
    constexpr double rounding = 1e-9;  // m; what is shorter is not drawn
    if (length > rounding) summary.link_length += length;
}

/// The piece up to a node of an axis, which is not the first.
void add_piece(MeasuredSummary& summary, const std::vector<MeasuredNode>& nodes, std::size_t number) {
    const MeasuredNode& to = nodes[number];
    const double length = glm::distance(nodes[number - 1].at, to.at);
    if (to.linked) return add_link(summary, length);
    // A node's diameter is that of the piece below it.
    const double radius = to.diameter / 2;
    summary.length += length;
    summary.surface += 2 * std::numbers::pi * radius * length;
    summary.volume += std::numbers::pi * radius * radius * length;
    // A turtle begins an axis, and goes on behind a gap, with the width of what it draws next.
    const bool continues = number > 1 && !nodes[number - 1].linked;
    const double below = continues ? nodes[number - 1].diameter / 2 : radius;
    summary.drawn_surface += std::numbers::pi * (below + radius) * glm::length(glm::dvec2(length, below - radius));
    summary.drawn_volume += std::numbers::pi / 3 * (below * below + below * radius + radius * radius) * length;
}

/// Of a polygon, one side; Newell's normal.
double area_of(const std::vector<glm::dvec3>& points, const std::vector<std::uint32_t>& face) {
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < face.size(); ++i) {
        sum += glm::cross(points[face[i]] - points[face[0]], points[face[(i + 1) % face.size()]] - points[face[0]]);
    }
    return glm::length(sum) / 2;
}

void add_organ(MeasuredSummary& summary, const MeasuredMesh& mesh, const MeasuredOrgan& organ) {
    const std::vector<glm::dvec3> points = points_of(mesh, organ);
    ++summary.organs;
    for (const std::vector<std::uint32_t>& face : mesh.faces) summary.organ_area += area_of(points, face);
    for (const glm::dvec3& point : points) {
        summary.extent[0] = glm::min(summary.extent[0], point);
        summary.extent[1] = glm::max(summary.extent[1], point);
    }
}

}  // namespace

std::vector<glm::dvec3> points_of(const MeasuredMesh& mesh, const MeasuredOrgan& organ) {
    std::vector<glm::dvec3> points;
    for (const glm::dvec3& point : mesh.points) {
        const double share = mesh.highest > mesh.lowest ? (point.x - mesh.lowest) / (mesh.highest - mesh.lowest) : 0;
        const double across = organ.below + share * (organ.above - organ.below);
        points.push_back(organ.place * glm::dvec4(point.x, across * point.y, across * point.z, 1));
    }
    return points;
}

MeasuredSummary summary_of(const MeasuredPlants& plants) {
    MeasuredSummary summary;
    summary.plants = plants.plants.size();
    summary.axes = plants.axes.size();
    summary.extent = {glm::dvec3(INFINITY), glm::dvec3(-INFINITY)};
    for (const MeasuredAxis& axis : plants.axes) {
        const auto order = static_cast<std::size_t>(axis.order);
        if (summary.axes_of_order.size() <= order) summary.axes_of_order.resize(order + 1);
        ++summary.axes_of_order[order];
        summary.nodes += axis.nodes.size();
        if (axis.bearer) {
            add_link(summary, glm::distance(plants.axes[*axis.bearer].nodes[axis.on_node].at, axis.nodes.front().at));
        }
        for (std::size_t i = 0; i < axis.nodes.size(); ++i) {
            summary.extent[0] = glm::min(summary.extent[0], axis.nodes[i].at);
            summary.extent[1] = glm::max(summary.extent[1], axis.nodes[i].at);
            if (i > 0) add_piece(summary, axis.nodes, i);
        }
        for (const MeasuredOrgan& organ : axis.organs) add_organ(summary, plants.meshes[organ.mesh], organ);
    }
    return summary;
}

}  // namespace espalier::language
