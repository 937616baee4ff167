// The kinds of shapes that read_shape knows: each reads its own keys. Also what they have in common.
#pragma once

#include "espalier/environment/shape.h"

#include <vector>

namespace espalier::environment {

using ShapePointer = std::shared_ptr<const Shape>;

// shape_primitives.cpp
ShapePointer read_box(Settings& table);
ShapePointer read_half_space(Settings& table);
ShapePointer read_tube(Settings& table);
// shape_round.cpp
ShapePointer read_sphere(Settings& table);
ShapePointer read_ellipsoid(Settings& table);
ShapePointer read_cylinder(Settings& table);
ShapePointer read_cone(Settings& table);
// shape_surfaces.cpp
ShapePointer read_mesh(Settings& table);
ShapePointer read_height_field(Settings& table);
// shape_combinations.cpp
ShapePointer read_union(Settings& table);
ShapePointer read_intersection(Settings& table);
ShapePointer read_difference(Settings& table);
/// The key `scale`, which every shape has.
double scale_of(const Settings& table);
/// Applies the keys every shape has: scale, rotate, translate, offset. `is_scaled`: the shape has its scale already.
ShapePointer place(ShapePointer shape, Settings& table, bool is_scaled);

/// The sample at `point` whose nearest point of the surface is known. `surface_normal` serves where the two coincide.
Shape::Sample sample_of(const glm::dvec3& point, const glm::dvec3& nearest, bool inside,
                        const glm::dvec3& surface_normal);

/// Any unit vector at right angles to `unit`.
glm::dvec3 perpendicular(const glm::dvec3& unit);

/// Two points that must differ, read as keys `first` and `second`. Throws UserError.
void require_apart(const Settings& table, const char* key, const glm::dvec3& first, const glm::dvec3& second);

}  // namespace espalier::environment
