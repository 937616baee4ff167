// What rays of light meet: leaves and stems as drawn, triangle by triangle.
#pragma once

#include "espalier/geometry/plant_geometry.h"

#include "geometry/drawn/faces.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace espalier::environment {

enum class LitKind : std::uint8_t { leaf, stem };

class LitTriangles {
public:
    struct Owner {
        std::uint32_t slot;  ///< counts the modules of all plants
        LitKind kind;
    };

    /// Forgets all triangles; those to come belong to so many modules.
    void clear(std::size_t slots);
    /// Leaves and stems as `DrawnFaces` has them. `first_slot` is that of the plant's first module.
    void add(const PlantGeometry& geometry, std::uint32_t first_slot);
    /// Copies of all that reaches beyond the sides of a period, so that no triangle is missing inside; what lies wholly
    /// outside comes in.
    void repeat(const Box& period);

    std::size_t size() const { return owners_.size(); }
    std::span<const glm::vec3> corners() const { return corners_; }  ///< three a triangle
    const Owner& owner(std::size_t triangle) const { return owners_[triangle]; }
    /// Unit normal; zero of a triangle without area.
    glm::dvec3 normal(std::size_t triangle) const;
    const Box& bounds() const { return bounds_; }
    /// One side of the leaves of each slot as drawn, m2.
    std::span<const double> leaf_areas() const { return leaf_areas_; }

private:
    void add(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, Owner owner);

    std::vector<glm::vec3> corners_;
    std::vector<Owner> owners_;
    std::vector<double> leaf_areas_;
    DrawnFaces faces_;
    Box bounds_;
};

}  // namespace espalier::environment
