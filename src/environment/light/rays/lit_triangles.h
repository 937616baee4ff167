// What rays of light meet: leaves, stems and solids as drawn, triangle by triangle.
#pragma once

#include "espalier/environment/shape.h"
#include "espalier/geometry/plant_geometry.h"

#include "environment/light/optics/optics.h"
#include "geometry/drawn/faces.h"
#include "geometry/rays/ray_scene.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace espalier::environment {

class LitTriangles {
public:
    struct Owner {
        std::uint32_t slot;      ///< counts the modules of all plants
        std::uint16_t material;  ///< of the optics
        LitKind kind;
    };

    /// Forgets all triangles.
    void clear();
    /// Leaves, stems and bodies as `DrawnFaces` has them, a part of their own. `first_slot` is that of the plant's
    /// first module. Throws RunError for leaves without a material.
    void add(const PlantGeometry& geometry, std::uint32_t first_slot, std::uint32_t plant, const Optics& optics);
    using Corners = std::array<glm::dvec3, 3>;
    /// Triangles that a process makes itself, all of one owner each; a part of their own.
    void add(std::span<const Corners> triangles, std::span<const Owner> owners);
    /// The surface of a solid with bounds, from voxels of that length; a part of its own.
    void add(const Shape& solid, double voxel);

    /// All parts, to be met inside a period: each stands wherever it reaches into it. Where they stand so close that a
    /// ray would have to look into many, they are one part. The spans are of this object.
    std::vector<RayScene::Part> parts(const std::optional<Box>& period) const;

    std::size_t size() const { return owners_.size(); }
    /// The number of a triangle. One part of all triangles begins as the first part does.
    std::size_t number(const RayScene::Hit& hit) const { return parts_[hit.part].first + hit.triangle; }
    const Owner& owner(std::size_t triangle) const { return owners_[triangle]; }
    const Owner& owner(const RayScene::Hit& hit) const { return owners_[number(hit)]; }
    /// Unit normal, from where the corners run round counter-clockwise; zero of a triangle without area.
    glm::dvec3 normal(std::size_t triangle) const;
    glm::dvec3 normal(const RayScene::Hit& hit) const { return normal(number(hit)); }
    /// The normal, as long as the area.
    glm::dvec3 area_vector(std::size_t triangle) const;
    std::span<const glm::vec3, 3> corners(std::size_t triangle) const {
        return std::span<const glm::vec3, 3>(&corners_[3 * triangle], 3);
    }
    const Box& bounds() const { return bounds_; }
    /// Calls visit(owner, normal as long as the area) for each triangle.
    template <class Visit>
    void visit_areas(const Visit& visit) const {
        for (std::size_t i = 0; i < owners_.size(); ++i) visit(owners_[i], area_vector(i));
    }

private:
    struct Part {
        std::size_t first;  ///< triangle
        Box bounds;
    };

    std::vector<RayScene::Part> separate_parts(const std::optional<Box>& period) const;
    double crowding(const std::vector<RayScene::Part>& parts, const std::optional<Box>& period) const;
    void add(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, Owner owner);

    std::vector<glm::vec3> corners_;  ///< three a triangle
    std::vector<Owner> owners_;
    std::vector<Part> parts_;
    DrawnFaces faces_;
    Box bounds_;
};

}  // namespace espalier::environment
