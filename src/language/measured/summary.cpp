#include "espalier/language/measured_plants.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

namespace espalier::language {
namespace {

void add_piece(MeasuredSummary& summary, const MeasuredNode& from, const MeasuredNode& to) {
    const double length = glm::distance(from.at, to.at);
    if (to.linked) {
        summary.link_length += length;
        return;
    }
    // A node's diameter is that of the piece below it.
    const double radius = to.diameter / 2;
    summary.length += length;
    summary.surface += 2 * std::numbers::pi * radius * length;
    summary.volume += std::numbers::pi * radius * radius * length;
}

}  // namespace

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
            summary.link_length +=
                glm::distance(plants.axes[*axis.bearer].nodes[axis.on_node].at, axis.nodes.front().at);
        }
        for (std::size_t i = 0; i < axis.nodes.size(); ++i) {
            summary.extent[0] = glm::min(summary.extent[0], axis.nodes[i].at);
            summary.extent[1] = glm::max(summary.extent[1], axis.nodes[i].at);
            if (i > 0) add_piece(summary, axis.nodes[i - 1], axis.nodes[i]);
        }
    }
    return summary;
}

}  // namespace espalier::language
