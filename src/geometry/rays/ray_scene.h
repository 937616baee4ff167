// Triangles that rays meet: the seam to Embree (Wald et al. 2014).
#pragma once

#include <glm/mat4x3.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace espalier::geometry {

/// A place that is not turned.
glm::mat4x3 moved_by(const glm::vec3& shift);

/// Parts, each a mesh of its own that may stand in several places. A part that has not changed is not built again.
class RayScene {
public:
    struct Hit {
        std::uint32_t part, triangle;  ///< the triangle counts from the part's first
        float distance;                ///< in lengths of the direction
        float u = 0, v = 0;            ///< weights of the triangle's second and third corner
        std::uint32_t place = 0;       ///< of the part's
    };
    struct Part {
        std::span<const glm::vec3> corners;  ///< three a triangle
        std::vector<glm::mat4x3> places;     ///< where it stands: columns of a turn and scale, and a shift
    };

    /// Throws RunError if there is no memory for it.
    RayScene();
    ~RayScene();
    RayScene(RayScene&&) noexcept;
    RayScene& operator=(RayScene&&) noexcept;
    RayScene(const RayScene&) = delete;
    RayScene& operator=(const RayScene&) = delete;

    /// Memory for a triangle of a part, about: its corners and Embree's boxes.
    static constexpr std::size_t bytes_per_triangle = 200;

    /// Replaces everything; part k is compared with part k of before. Returns how many parts were built. Throws
    /// RunError if there is no memory for them.
    std::size_t set_parts(std::span<const Part> parts);

    /// The nearest triangle from `from` to `to` along the ray, both in lengths of `direction`. Several threads may ask.
    /// The same on any processor.
    std::optional<Hit> first_hit(const glm::vec3& origin, const glm::vec3& direction, float from, float to) const;
    /// The same of four rays beside each other, quicker; from their origins on.
    using FourHits = std::array<std::optional<Hit>, 4>;
    FourHits first_hits(std::span<const glm::vec3, 4> origins, std::span<const glm::vec3, 4> directions,
                        float to) const;
    /// Whether there is one; quicker.
    bool is_blocked(const glm::vec3& origin, const glm::vec3& direction, float from, float to) const;

private:
    Hit hit_of(std::uint32_t instance, std::uint32_t triangle, float distance, float u, float v) const;

    struct Embree;
    std::unique_ptr<Embree> embree_;
};

}  // namespace espalier::geometry
