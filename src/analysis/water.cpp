#include "analysis/water.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <string_view>

namespace espalier::analysis {
namespace {

/// The part of the demand that may lack before a plant counts as stressed: solvers are not exact.
constexpr double tolerance = 1e-3;

bool ends_with(std::string_view text, std::string_view end) {
    return text.size() > end.size() && text.substr(text.size() - end.size()) == end;
}

/// Of the first process that recorded one; null without.
const Column<double>* recorded_uptakes(const FrameGeometry& geometry) {
    for (const std::string_view end : {".mean_uptake", ".uptake"}) {
        for (const auto& [name, values] : geometry.parameters) {
            const auto unit = geometry.units.find(name);
            if (ends_with(name, end) && unit != geometry.units.end() && unit->second == "cm3/d") return &values;
        }
    }
    return nullptr;
}

}  // namespace

std::vector<double> uptakes_of(const FrameGeometry& geometry, std::span<const FrameInternode> internodes) {
    const Column<double>* const recorded = recorded_uptakes(geometry);
    if (!recorded) return {};
    std::map<std::uint64_t, double> lengths;  // of modules
    for (const FrameInternode& each : internodes) lengths[each.identity] += glm::distance(each.base, each.tip);
    std::vector<double> uptakes;
    for (const FrameInternode& each : internodes) {
        const double uptake = (*recorded)[each.tip_point.row()], whole = lengths[each.identity];
        const double share = whole > 0 ? glm::distance(each.base, each.tip) / whole : 0;
        uptakes.push_back(std::isfinite(uptake) ? share * uptake : 0);
    }
    return uptakes;
}

std::vector<WaterStress> water_stress(const RecordedTable& statistics, double dt) {
    std::map<std::uint32_t, WaterStress> of_plant;
    const std::size_t plant = statistics.column("plant"), time = statistics.column("time");
    for (std::size_t demand = 0; demand < statistics.columns.size(); ++demand) {
        const std::string& name = statistics.columns[demand];
        if (!ends_with(name, ".demand")) continue;
        const std::string other = name.substr(0, name.size() - 6) + "transpiration";
        const auto found = std::find(statistics.columns.begin(), statistics.columns.end(), other);
        if (found == statistics.columns.end()) continue;
        const auto transpiration = static_cast<std::size_t>(found - statistics.columns.begin());
        for (const std::vector<double>& row : statistics.rows) {
            // The first frame is a moment, not a step.
            if (!(row[time] > 0) || !std::isfinite(row[demand]) || !std::isfinite(row[transpiration])) continue;
            WaterStress& stress = of_plant[static_cast<std::uint32_t>(row[plant])];
            stress.plant = static_cast<std::uint32_t>(row[plant]);
            stress.transpired += row[transpiration] * dt;
            stress.demanded += row[demand] * dt;
            if (!(row[demand] > 0) || row[transpiration] >= (1 - tolerance) * row[demand]) continue;
            stress.time += dt;
            if (std::isnan(stress.first_time)) stress.first_time = row[time];
        }
    }
    std::vector<WaterStress> all;
    for (const auto& [number, stress] : of_plant) all.push_back(stress);
    return all;
}

}  // namespace espalier::analysis
