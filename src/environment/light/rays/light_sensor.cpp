#include "environment/light/rays/light_sensor.h"

#include "geometry/vectors.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace espalier::environment {
namespace {

LightSensor read_sensor(const Settings& table) {
    LightSensor sensor;
    sensor.name = table.text("name");
    sensor.middle = table.vector("at");
    sensor.normal = unit_or(table.vector_or("normal", {0, 1, 0}), glm::dvec3(0));
    if (sensor.normal == glm::dvec3(0))
        throw UserError(table.place("normal"), "'normal' must not be the vector of zeros");
    const glm::dvec3 side = table.vector_or("side", any_across(sensor.normal));
    sensor.x = unit_or(side - glm::dot(side, sensor.normal) * sensor.normal, glm::dvec3(0));
    if (sensor.x == glm::dvec3(0)) throw UserError(table.place("side"), "'side' must not lie along 'normal'");
    sensor.y = glm::cross(sensor.x, sensor.normal);
    const std::vector<double> size = table.numbers_or("size", {0.1, 0.1}), cells = table.numbers_or("cells", {1, 1});
    const auto is_count = [](double cell) { return cell >= 1 && cell <= 1000 && cell == std::floor(cell); };
    if (size.size() != 2 || !(size[0] > 0 && size[1] > 0)) {
        throw UserError(table.place("size"), "'size' must be two lengths above 0");
    }
    if (cells.size() != 2 || !is_count(cells[0]) || !is_count(cells[1])) {
        throw UserError(table.place("cells"), "'cells' must be two whole numbers from 1 to 1000");
    }
    sensor.size = {size[0], size[1]};
    sensor.cells = {static_cast<std::size_t>(cells[0]), static_cast<std::size_t>(cells[1])};
    return sensor;
}

}  // namespace

std::optional<LightSensor::Crossing> LightSensor::crossing(const glm::dvec3& origin, const glm::dvec3& direction,
                                                           double from, double to) const {
    const double against = glm::dot(direction, normal);
    if (against == 0) return std::nullopt;
    const double at = glm::dot(middle - origin, normal) / against;
    if (!(at >= from && at < to)) return std::nullopt;
    const glm::dvec3 place = origin + at * direction - middle;
    const double u = glm::dot(place, x) / size[0] + 0.5, v = glm::dot(place, y) / size[1] + 0.5;
    if (!(u >= 0 && u < 1 && v >= 0 && v < 1)) return std::nullopt;
    const auto column = std::min(cells[0] - 1, static_cast<std::size_t>(u * static_cast<double>(cells[0])));
    const auto row = std::min(cells[1] - 1, static_cast<std::size_t>(v * static_cast<double>(cells[1])));
    return Crossing{row * cells[0] + column, against < 0};
}

std::vector<LightSensor> read_sensors(const Settings& settings) {
    std::vector<LightSensor> sensors;
    for (const Settings& table : settings.tables("sensors")) {
        sensors.push_back(read_sensor(table));
        const auto has_name = [&](const LightSensor& sensor) { return sensor.name == sensors.back().name; };
        if (std::count_if(sensors.begin(), sensors.end(), has_name) > 1) {
            throw UserError(table.place("name"), "two sensors have this name");
        }
    }
    return sensors;
}

const std::string& sensors_help() {
    static const std::string text =
        R"(sensors       [[sensors]] tables: rectangles that count the light through them and take none of it
  name        its quantity in the statistics: sensor.NAME is what falls on its front per m2 in the step
  at          [x, y, z] m: its middle;  normal  [0, 1, 0]: its front;  side  the direction of its first side
  size        [0.1, 0.1] m: a point is a small one
  cells       [1, 1]: a level one of n x n cells is a field of the timeline, name.NAME
)";
    return text;
}

}  // namespace espalier::environment
