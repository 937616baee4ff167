// What parallel light meets first, at once for many rays: triangles drawn as the light sees them (Catmull 1974, A
// subdivision algorithm for computer display of curved surfaces: the z-buffer).
#pragma once

#include "environment/light/rays/lit_triangles.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace espalier::environment {

class LightProjection {
public:
    struct View {
        glm::dvec3 towards;         ///< unit vector to the light, upwards
        glm::dvec2 shift;           ///< of the points, in shares of their distance
        double ground;              ///< height of the soil, which ends all rays
        std::optional<Box> period;  ///< that repeats along x and z
    };

    /// One ray to about each of so many points, evenly spread over the level ground that the triangles shade.
    void look(const LitTriangles& triangles, const View& view, double points);

    /// How many rays meet each triangle first.
    std::span<const std::uint32_t> counts() const { return counts_; }
    /// m2 of level ground for each ray.
    double area() const { return cell_.x * cell_.y; }
    /// Calls visit(triangle, place) for each `stride`th of the rays that meet a triangle which `counts`, from the
    /// number `first` on.
    template <class Counts, class Visit>
    void for_points(std::size_t first, std::size_t stride, const Counts& counts, const Visit& visit) const;

private:
    /// Where a corner lies: in points of the grid, and its height.
    struct Corner {
        double x, z, height;
    };
    struct Pixel {
        float height;
        std::uint32_t triangle;
    };

    void lay_grid(const LitTriangles& triangles, const View& view, double points);
    Corner seen(const glm::vec3& corner) const;
    void draw(std::uint32_t triangle, const std::array<Corner, 3>& corners, bool repeats);

    static constexpr std::uint32_t nothing = 0xFFFFFFFF;

    glm::dvec2 lower_{0, 0}, cell_{1, 1}, lean_{0, 0};
    std::int64_t columns_ = 0, rows_ = 0;
    std::vector<Pixel> pixels_;
    std::vector<std::uint32_t> counts_;
};

template <class Counts, class Visit>
void LightProjection::for_points(std::size_t first, std::size_t stride, const Counts& counts,
                                 const Visit& visit) const {
    std::size_t left = first;
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        const auto& [height, triangle] = pixels_[i];
        if (triangle == nothing || !counts(triangle) || left-- > 0) continue;
        left = stride - 1;
        const auto row = static_cast<double>(i / static_cast<std::size_t>(columns_)),
                   column = static_cast<double>(i % static_cast<std::size_t>(columns_));
        const glm::dvec2 at = lower_ + glm::dvec2(column, row) * cell_ + double{height} * lean_;
        visit(triangle, glm::dvec3(at.x, height, at.y));
    }
}

}  // namespace espalier::environment
