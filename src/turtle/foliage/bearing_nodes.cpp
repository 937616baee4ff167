#include "turtle/foliage/bearing_nodes.h"

#include "geometry/vectors.h"
#include "turtle/internode_bearers.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace espalier::turtle {
namespace {

double length_of(const Internode& internode) {
    return glm::distance(internode.base, internode.tip);
}

glm::dvec3 direction_of(const Internode& internode) {
    const double length = length_of(internode);
    return length > 0 ? (internode.tip - internode.base) / length : glm::dvec3(0, 1, 0);
}

/// The part of `reference` across a direction.
glm::dvec3 across(const glm::dvec3& direction, const glm::dvec3& reference) {
    const glm::dvec3 part = reference - direction * glm::dot(reference, direction);
    const double length = glm::length(part);
    return length > 1e-6 ? part / length : any_across(direction);
}

}  // namespace

std::vector<BearingNode> bearing_nodes(const StagedPlant& plant, double thickest) {
    const Column<Internode>& internodes = plant.geometry.internodes;
    const std::vector<std::uint32_t> bearers = internode_bearers(plant.geometry, plant.string);
    std::vector<glm::dvec3> references(internodes.size());
    std::vector<std::uint32_t> numbers(internodes.size());
    std::vector<BearingNode> nodes;
    bool continues = false;
    for (std::uint32_t i = 0; i < internodes.size(); ++i) {
        const std::uint32_t module = internodes[i].module;
        const bool is_borne = bearers[i] != no_bearer, is_new = i == 0 || internodes[i - 1].module != module;
        references[i] = across(direction_of(internodes[i]), is_borne ? references[bearers[i]] : glm::dvec3(1, 0, 0));
        numbers[i] = !is_borne ? 0 : numbers[bearers[i]] + (internodes[bearers[i]].module == module ? 0 : 1);
        const bool bears = internodes[i].tip_radius <= thickest;
        if (bears && continues && !is_new) {
            ++nodes.back().count;
        } else if (bears && (is_new || nodes.empty() || internodes[nodes.back().first].module != module)) {
            const Identity identity = plant.string.has_lineage() ? plant.string.identity(module) : module;
            nodes.push_back({i, 1, numbers[i], identity, references[i]});
        }
        continues = bears;
    }
    return nodes;
}

BearingPlace place_on(const BearingNode& node, const PlantGeometry& geometry, double share) {
    double length = 0;
    for (std::uint32_t i = 0; i < node.count; ++i) length += length_of(geometry.internodes[node.first + i]);
    double left = share * length;
    std::uint32_t at = node.first;
    for (; at + 1 < node.first + node.count && left > length_of(geometry.internodes[at]); ++at) {
        left -= length_of(geometry.internodes[at]);
    }
    const Internode& internode = geometry.internodes[at];
    const double own = length_of(internode), part = own > 0 ? std::min(left / own, 1.0) : 0;
    return {at, internode.base + part * (internode.tip - internode.base), direction_of(internode)};
}

}  // namespace espalier::turtle
