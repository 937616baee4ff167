#include "simulation/scene/measured_table.h"

#include "language/measured/units.h"

namespace espalier::simulation {
namespace {

std::vector<std::string> or_none(std::vector<std::string> words) {
    words.insert(words.begin(), "");
    return words;
}

}  // namespace

MeasuredOptions read_measured_options(const Settings& plant) {
    MeasuredOptions options;
    options.unit = plant.choice_or("unit", "", or_none(language::measured::length_units()));
    options.up = plant.choice_or("up", "", or_none(language::measured::upward_axes()));
    if (plant.has("pixel")) options.pixel = 0.001 * plant.number("pixel", Range::positive());
    if (plant.has("plants")) {
        options.separate = plant.choice_or("plants", "separate", {"separate", "together"}) == "separate";
    }
    if (options.pixel && !options.unit.empty()) {
        throw UserError(plant.place("pixel"), "give either 'pixel' or 'unit': the width of a pixel is in millimetres");
    }
    return options;
}

glm::dvec3 read_measured_shift(const Settings& plant, const MeasuredPlants& plants) {
    const bool moves = plant.choice_or("begin", "file", {"file", "position"}) == "position";
    return moves ? plants.plants.front().base : glm::dvec3(0);
}

}  // namespace espalier::simulation
