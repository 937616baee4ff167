// The ground of a landscape: heights over a rectangle, straight between the places where they are known.
#pragma once

#include "archive/meshes/surface_mesh.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <filesystem>
#include <functional>
#include <vector>

namespace espalier::archive {

/// One colour, or a mixture of two.
struct GroundColour {
    Rgb colour{112, 116, 74};
    Rgb second = colour;
    std::function<double(double x, double z)> share = {};  ///< of the second colour, 0 to 1
};

class Terrain {
public:
    /// Columns along x and rows along z of places where the height is known, two of each at least.
    struct Grid {
        std::size_t columns, rows;
    };
    static constexpr std::size_t most_places = std::size_t{1} << 24;

    /// `height` of x and z, metres. Throws UserError where it is not finite, or for more than `most_places`.
    Terrain(const glm::dvec2& lower, const glm::dvec2& upper, const Grid& grid,
            const std::function<double(double x, double z)>& height);

    const glm::dvec2& lower() const { return lower_; }
    const glm::dvec2& upper() const { return upper_; }
    bool holds(double x, double z) const;
    /// Returns the height at the nearest place of the terrain.
    double height(double x, double z) const;
    /// Two triangles between four neighbouring places, in one of a few shades each.
    FrameMesh mesh(const GroundColour& ground) const;

private:
    double& at(std::size_t column, std::size_t row) { return heights_[row * grid_.columns + column]; }
    double at(std::size_t column, std::size_t row) const { return heights_[row * grid_.columns + column]; }
    glm::dvec2 place(std::size_t column, std::size_t row) const;
    void add_shades(FrameMesh& mesh, const GroundColour& ground) const;

    glm::dvec2 lower_, upper_;
    Grid grid_;
    std::vector<double> heights_;
};

/// Heights from a picture that lies over a rectangle, its lowest row along the upper z: black is `low`, white `high`,
/// straight between the middles of its pixels. Throws UserError if it is no picture.
std::function<double(double x, double z)> heights_of_picture(const std::filesystem::path& file, const glm::dvec2& lower,
                                                             const glm::dvec2& upper, double low, double high);

}  // namespace espalier::archive
