// How much of a face its picture leaves opaque: cards of leaves are mostly holes.
#pragma once

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

namespace espalier::geometry {

/// The opacity of a picture, which repeats beyond its borders.
class Opacity {
public:
    /// Of a file, kept until it changes. Null where all is opaque: also of what is no picture, or no PNG. Thread safe.
    static std::shared_ptr<const Opacity> of(const std::filesystem::path& file);

    /// Rows of pixels from the lowest up, 0 to 255.
    Opacity(std::size_t width, std::size_t height, const std::vector<std::uint8_t>& pixels);

    /// The mean over a polygon of texture coordinates, 0 to 1: exact over rectangles along the borders, as the faces of
    /// cards and patches are, else by a thousand places; over a polygon without area, that of the whole picture.
    double over(std::span<const glm::dvec2> corners) const;

private:
    double over_box(const glm::dvec2& lower, const glm::dvec2& upper) const;
    double over_triangle(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) const;
    /// The sum of all pixels left of u and below v, which lie in [0, 1].
    double sum_to(double u, double v) const;
    double at(const glm::dvec2& place) const;

    std::size_t width_, height_;
    std::vector<double> sums_;  ///< of all pixels before a column and below a row: (width + 1) x (height + 1)
};

}  // namespace espalier::geometry
