#include "environment/soil/roots/said_of_roots.h"

#include "turtle/internode_bearers.h"

#include <fmt/format.h>

#include <cmath>

namespace espalier::environment {
namespace {

constexpr std::size_t of_age = 5, of_conductances = 6;  // parameters; the last of them are what is said

bool says_something(const PlantView& plant, const Query& query, const std::string& process) {
    if (query.process < 0 || query.parameters.size() < of_age) return false;
    return plant.model->processes[static_cast<std::size_t>(query.process)] == process;
}

void refuse_impossible_conductances(const PlantView& plant, double radial, double axial) {
    if (radial >= 0 && std::isfinite(radial) && axial > 0 && std::isfinite(axial)) return;
    throw RunError(
        fmt::format("plant {} has a root of radial conductance {:g} 1/d and axial conductance {:g} cm3/d: the "
                    "first must not be below 0, the second must be above 0",
                    plant.plant, radial, axial));
}

void refuse_impossible_age(const PlantView& plant, double age) {
    if (age >= 0 && std::isfinite(age)) return;
    throw RunError(fmt::format("plant {} has a root {:g} days old: an age must not be below 0", plant.plant, age));
}

/// A column by internode, made when something is known of one of them.
void set(std::vector<double>& column, std::size_t internodes, std::size_t internode, double value) {
    if (column.empty()) column.assign(internodes, std::nan(""));
    column[internode] = value;
}

}  // namespace

SaidOfRoots SaidOfRoots::of(const PlantView& plant, const std::string& process) {
    SaidOfRoots said;
    const PlantGeometry& geometry = plant.interpretation->geometry;
    const std::size_t count = geometry.internodes.size();
    std::optional<turtle::OrganBearers> bearers;
    for (const Query& query : plant.interpretation->queries) {
        if (!says_something(plant, query, process)) continue;
        if (!bearers) bearers.emplace(geometry, *plant.string);
        const std::span<const double> told = query.parameters.subspan(of_age - 1);
        const bool is_age = query.parameters.size() < of_conductances;
        is_age ? refuse_impossible_age(plant, told[0]) : refuse_impossible_conductances(plant, told[0], told[1]);
        const std::uint32_t internode = bearers->of(query.module, query.pose.position);
        if (internode == turtle::no_bearer) continue;
        if (is_age) {
            set(said.ages, count, internode, told[0]);
        } else {
            set(said.radial, count, internode, told[0]);
            set(said.axial, count, internode, told[1]);
        }
    }
    return said;
}

}  // namespace espalier::environment
