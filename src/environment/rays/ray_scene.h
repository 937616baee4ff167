// Triangles that rays meet. The seam to Embree (Wald et al. 2014): nothing else includes it.
#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

namespace espalier::environment {

class RayScene {
public:
    struct Hit {
        std::uint32_t triangle;
        float distance;  ///< in lengths of the direction
    };

    /// Throws RunError if there is no memory for it.
    RayScene();
    ~RayScene();
    RayScene(const RayScene&) = delete;
    RayScene& operator=(const RayScene&) = delete;

    /// Replaces all triangles by these, three corners each. Throws RunError if there is no memory for them.
    void set_triangles(std::span<const glm::vec3> corners);

    /// The nearest triangle from `from` to `to` along the ray, both in lengths of `direction`. Several threads may ask.
    /// The same on any processor.
    std::optional<Hit> first_hit(const glm::vec3& origin, const glm::vec3& direction, float from, float to) const;

private:
    struct Embree;
    std::unique_ptr<Embree> embree_;
};

}  // namespace espalier::environment
