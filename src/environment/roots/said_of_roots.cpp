#include "environment/roots/said_conductances.h"

#include "turtle/internode_bearers.h"

#include <fmt/format.h>

#include <cmath>

namespace espalier::environment {
namespace {

constexpr std::size_t radial_at = 4, axial_at = 5;  // among the parameters

bool says_conductances(const PlantView& plant, const Query& query, const std::string& process) {
    if (query.process < 0 || query.parameters.size() <= axial_at) return false;
    return plant.model->processes[static_cast<std::size_t>(query.process)] == process;
}

void refuse_impossible(const PlantView& plant, double radial, double axial) {
    if (radial >= 0 && std::isfinite(radial) && axial > 0 && std::isfinite(axial)) return;
    throw RunError(
        fmt::format("plant {} has a root of radial conductance {:g} 1/d and axial conductance {:g} cm3/d: the "
                    "first must not be below 0, the second must be above 0",
                    plant.plant, radial, axial));
}

}  // namespace

SaidConductances SaidConductances::of(const PlantView& plant, const std::string& process) {
    SaidConductances said;
    const PlantGeometry& geometry = plant.interpretation->geometry;
    std::optional<turtle::OrganBearers> bearers;
    for (const Query& query : plant.interpretation->queries) {
        if (!says_conductances(plant, query, process)) continue;
        if (!bearers) {
            bearers.emplace(geometry, *plant.string);
            said.radial.assign(geometry.internodes.size(), std::nan(""));
            said.axial = said.radial;
        }
        refuse_impossible(plant, query.parameters[radial_at], query.parameters[axial_at]);
        const std::uint32_t internode = bearers->of(query.module, query.pose.position);
        if (internode == turtle::no_bearer) continue;
        said.radial[internode] = query.parameters[radial_at];
        said.axial[internode] = query.parameters[axial_at];
    }
    return said;
}

}  // namespace espalier::environment
