// Soils by place: a picture or a table of them in a plane.
#pragma once

#include "espalier/base/settings.h"
#include "espalier/geometry/plant_geometry.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace espalier::environment {

/// Covers the whole domain in a plane, x and y or x and z, and is the same across it.
class TextureMap {
public:
    TextureMap() = default;
    /// Of the table `map` with the keys `file`, `plane` and, for pictures, `colours`; `soils` is how many there are.
    /// Throws UserError, for what is wrong in a file with its line and column, or its pixel.
    TextureMap(const Settings& map, std::size_t soils);

    bool empty() const { return numbers_.empty(); }
    /// Which of the soils lies at a place of the domain.
    std::size_t at(const glm::dvec3& place, const Box& domain) const;

private:
    void read_table(const std::filesystem::path& path, std::size_t soils);
    void read_colours(const std::filesystem::path& path, const Settings& map, std::size_t soils);

    bool is_ground_plan_ = false;  ///< in x and z
    std::size_t width_ = 0, height_ = 0;
    std::vector<std::uint8_t> numbers_;  ///< row by row, the highest, or that of the greatest z, first
};

}  // namespace espalier::environment
