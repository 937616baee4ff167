// free-form: a box of space that bends and takes the plant along.
// Sederberg & Parry 1986: a lattice of points spans the box, and Bernstein polynomials carry their displacements
// inside.
#include "espalier/geometry/geometry_stage.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace espalier::geometry {
namespace {

/// The Bernstein polynomials of a degree at t.
std::vector<double> bernstein(std::size_t degree, double t) {
    std::vector<double> values{1};
    for (std::size_t k = 1; k <= degree; ++k) {
        values.push_back(0);
        for (std::size_t i = k; i > 0; --i) values[i] = (1 - t) * values[i] + t * values[i - 1];
        values[0] *= 1 - t;
    }
    return values;
}

class FreeForm final : public GeometryStage {
public:
    explicit FreeForm(Settings& settings)
        : lower_(settings.vector("lower")),
          upper_(settings.vector("upper")),
          leaves_(settings.choice_or("leaves", "carried", {"bent", "carried", "left"})) {
        for (int axis = 0; axis < 3; ++axis) {
            if (upper_[axis] > lower_[axis]) continue;
            throw UserError(settings.place("upper"), "'upper' must be greater than 'lower' along x, y and z");
        }
        const std::vector<double> counts = settings.numbers_or("lattice", {2, 2, 2});
        const auto fits = [](double count) { return count >= 2 && count <= 16 && count == std::floor(count); };
        if (counts.size() != 3 || !std::all_of(counts.begin(), counts.end(), fits)) {
            throw UserError(settings.place("lattice"), "'lattice' must be three whole numbers from 2 to 16");
        }
        for (std::size_t axis = 0; axis < 3; ++axis) counts_[axis] = static_cast<std::size_t>(counts[axis]);
        moves_ = settings.vectors("moves");
        const std::size_t points = counts_[0] * counts_[1] * counts_[2];
        if (moves_.size() == points) return;
        throw UserError(settings.place("moves"), fmt::format("'moves' must have a vector for each of the {} points of "
                                                             "the lattice, not {}",
                                                             points, moves_.size()));
    }

    void apply(StagedPlant& plant) const override {
        PlantGeometry& geometry = plant.geometry;
        for (Internode& internode : geometry.internodes) {
            internode.base = moved(internode.base);
            internode.tip = moved(internode.tip);
        }
        for (SurfaceVertex& vertex : geometry.mesh.vertices) {
            vertex.normal = turned(vertex.position, vertex.normal);
            vertex.position = moved(vertex.position);
        }
        for (Label& label : geometry.labels) label.position = moved(label.position);
        if (leaves_ == "left") return;
        for (Organ& organ : geometry.organs) organ.pose.position = moved(organ.pose.position);
        if (leaves_ == "bent") {
            for (glm::dvec3& vertex : geometry.vertices) vertex = moved(vertex);
        } else {
            carry_polygons(geometry);
        }
    }

private:
    /// Points outside the box move as the nearest point of it.
    glm::dvec3 displacement(const glm::dvec3& point) const {
        const glm::dvec3 part = glm::clamp((point - lower_) / (upper_ - lower_), 0.0, 1.0);
        const std::vector<double> x = bernstein(counts_[0] - 1, part.x), y = bernstein(counts_[1] - 1, part.y),
                                  z = bernstein(counts_[2] - 1, part.z);
        glm::dvec3 sum(0);
        std::size_t at = 0;
        for (const double wz : z) {
            for (const double wy : y) {
                for (const double wx : x) sum += wx * wy * wz * moves_[at++];
            }
        }
        return sum;
    }

    glm::dvec3 moved(const glm::dvec3& point) const { return point + displacement(point); }

    /// A normal, which turns with the surface: by the cofactors of the derivative.
    glm::dvec3 turned(const glm::dvec3& point, const glm::dvec3& normal) const {
        glm::dmat3 derivative;
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 step(0);
            step[axis] = 1e-6 * (upper_[axis] - lower_[axis]);
            derivative[axis] = (moved(point + step) - moved(point - step)) / (2 * step[axis]);
        }
        if (std::abs(glm::determinant(derivative)) < 1e-12) return normal;
        const glm::dvec3 result = glm::transpose(glm::inverse(derivative)) * normal;
        const double length = glm::length(result);
        return length > 0 ? result / length : normal;
    }

    /// The polygons of a module keep their shape and move as their first vertex does.
    void carry_polygons(PlantGeometry& geometry) const {
        std::map<std::uint32_t, glm::dvec3> carried;
        for (const Polygon& polygon : geometry.polygons) {
            const auto [found, is_new] = carried.try_emplace(polygon.module);
            if (is_new) found->second = displacement(geometry.vertices[polygon.first]);
            for (std::uint32_t k = 0; k < polygon.count; ++k) geometry.vertices[polygon.first + k] += found->second;
        }
    }

    glm::dvec3 lower_, upper_;
    std::array<std::size_t, 3> counts_{};
    std::vector<glm::dvec3> moves_;
    std::string leaves_;
};

const Registered<GeometryStageType> entry{
    {"free-form", "a box of space that bends and takes the plant along (Sederberg & Parry 1986)",
     R"(lower    needed; m, the corner of the box with the least x, y, z
upper    needed; m, the opposite corner
lattice  [2, 2, 2]; points along x, y and z, 2 to 16 each
moves    needed; m, how far each point of the lattice moves: [[x, y, z], ...], x first, then y, then z
leaves   "carried"; polygons and organs: "carried" keeps their shapes and moves them with their first vertex, "bent"
         bends polygons too, "left" leaves all of them where they are
What is outside the box moves as the nearest point of the box. Radii do not change.
Source: Sederberg & Parry 1986, Free-form deformation of solid geometric models; as a component of plants, Lintermann &
Deussen 1997.
)",
     construct<FreeForm>}};

}  // namespace
}  // namespace espalier::geometry
