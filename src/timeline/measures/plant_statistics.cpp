#include "timeline/measures/plant_statistics.h"

#include "base/bytes.h"
#include "timeline/measures/highest_point.h"

#include <cmath>
#include <optional>
#include <utility>

namespace espalier::timeline {
namespace {

double height(const PlantGeometry& geometry) {
    const std::optional<double> top = highest_point(geometry);
    if (!top) return 0;
    const double base = geometry.internodes.empty() ? geometry.bounds.lower.y : geometry.internodes.front().base.y;
    return *top - base;
}

// Modules whose life began after `step`.
std::size_t born_after(const ModuleString& string, int step) {
    std::size_t born = 0;
    for (std::size_t module = 0; module < string.births.size(); ++module) {
        born += static_cast<std::int64_t>(string.step_of_birth(module)) > step;
    }
    return born;
}

}  // namespace

std::vector<std::string> quantity_names(const PlantFrame& plant) {
    std::vector<std::string> names;
    for (const Quantity& quantity : plant.quantities) names.push_back(quantity.name);
    return names;
}

std::vector<std::string> PlantStatistics::columns(const std::vector<std::string>& quantities) const {
    std::vector<std::string> columns{"modules", "queries", "internodes", "organs", "length",
                                     "height",  "volume",  "born",       "died"};
    columns.insert(columns.end(), quantities.begin(), quantities.end());
    for (std::string& name : own_.names()) columns.push_back(std::move(name));
    return columns;
}

// Every module was here one step ago or is born since; those that were and are not have died.
std::vector<double> PlantStatistics::of(const PlantFrame& plant) {
    const PlantGeometry& geometry = plant.interpretation->geometry;
    const auto count = [](std::size_t number) { return static_cast<double>(number); };
    const std::size_t now = plant.string->size();
    const std::size_t before = std::exchange(modules_[plant.plant], now);
    const bool has_lives = plant.string->has_lineage() || now == 0;
    const double born = has_lives ? count(born_after(*plant.string, previous_step_)) : std::nan("");
    std::vector<double> values{count(now),
                               count(plant.interpretation->queries.size() + plant.interpretation->answers.size()),
                               count(geometry.internodes.size()),
                               count(geometry.organs.size() + geometry.polygons.size()),
                               total_length(geometry),
                               height(geometry),
                               total_volume(geometry),
                               born,
                               count(before) + born - count(now)};
    for (const Quantity& quantity : plant.quantities) values.push_back(quantity.value);
    for (const double value : own_.of(plant)) values.push_back(value);
    return values;
}

void PlantStatistics::save(std::ostream& out) const {
    put(out, static_cast<std::uint64_t>(modules_.size()));
    for (const auto& [plant, modules] : modules_) {
        put(out, plant);
        put(out, static_cast<std::uint64_t>(modules));
    }
}

void PlantStatistics::restore(std::istream& in, int previous_step) {
    previous_step_ = previous_step;
    for (auto plants = get<std::uint64_t>(in); plants > 0; --plants) {
        const auto plant = get<std::uint32_t>(in);
        modules_[plant] = get<std::uint64_t>(in);
    }
}

}  // namespace espalier::timeline
