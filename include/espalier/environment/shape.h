// A solid described in a scene: signed distance, inside, normal, nearest point. Metres; distance is negative inside.
#pragma once

#include "espalier/base/settings.h"
#include "espalier/base/stations.h"
#include "espalier/geometry/field.h"
#include "espalier/geometry/plant_geometry.h"

#include <memory>
#include <optional>

namespace espalier::environment {

/// Thread safe. Simple solids, unions seen from outside and intersections seen from inside are exact everywhere. In the
/// other cases (deep in a union, outside a difference) `distance` is a lower bound of the distance with the right
/// sign, and `nearest` a point of the surface that need not be the very nearest.
class Shape {
public:
    struct Sample {
        double distance = 0;
        glm::dvec3 normal{0, 1, 0};  ///< unit, outward
        glm::dvec3 nearest{0, 0, 0};
    };

    virtual ~Shape() = default;

    virtual double distance(const glm::dvec3& point) const = 0;
    virtual Sample sample(const glm::dvec3& point) const = 0;
    /// The surface itself is inside.
    virtual bool inside(const glm::dvec3& point) const { return distance(point) <= 0; }
    /// Empty optional for shapes without bounds (half space).
    virtual std::optional<Box> bounds() const = 0;
};

/// Reads a shape from a table: `shape = "sphere", center = [0, 1, 0], radius = 0.5`, a mesh file, or a combination
/// (`shape = "union", of = [ {...}, {...} ]`), with transforms. The help of process `shape` lists them all.
/// Throws UserError for what it cannot read: an open or empty mesh, an unknown kind, a radius that is not positive.
std::shared_ptr<const Shape> read_shape(Settings& table);

/// `shape` grown by `growth` metres (shrunk if negative) and moved.
std::shared_ptr<const Shape> grown_and_moved(std::shared_ptr<const Shape> shape, double growth,
                                             const glm::dvec3& movement);

/// The text that documents shapes in `espalier list`.
const char* shape_help();

}  // namespace espalier::environment
