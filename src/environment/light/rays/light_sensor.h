// Rectangles that count the light that passes them and take none of it.
#pragma once

#include "espalier/base/settings.h"

#include <glm/vec3.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace espalier::environment {

struct LightSensor {
    std::string name;
    glm::dvec3 middle{0, 0, 0}, normal{0, 1, 0}, x{1, 0, 0}, y{0, 0, 1};  ///< orthonormal
    std::array<double, 2> size{0.1, 0.1};                                 ///< along x and y, m
    std::array<std::size_t, 2> cells{1, 1};

    std::size_t count() const { return cells[0] * cells[1]; }
    double cell_area() const { return size[0] * size[1] / static_cast<double>(count()); }

    struct Crossing {
        std::size_t cell;  ///< those along x first
        bool from_front;   ///< from the side of the normal
    };
    /// Where a ray passes it between two distances, if it does.
    std::optional<Crossing> crossing(const glm::dvec3& origin, const glm::dvec3& direction, double from,
                                     double to) const;
};

/// Reads `[[sensors]]` tables; see `sensors_help`. Throws UserError.
std::vector<LightSensor> read_sensors(const Settings& settings);

const std::string& sensors_help();

}  // namespace espalier::environment
