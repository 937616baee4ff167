#include "timeline/measures/highest_point.h"

#include "geometry/drawn/organ_mesh.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace espalier::timeline {
namespace {

constexpr double nowhere = -std::numeric_limits<double>::infinity();

/// How far a disc of radius 1 across `normal`, a unit vector, reaches above its centre.
double rise(const glm::dvec3& normal) {
    return std::sqrt(std::max(0.0, 1 - normal.y * normal.y));
}

/// The farthest that a surface reaches from where it stands, unstretched.
double reach(const Surface& surface) {
    double farthest = 0;
    const auto add = [&](const glm::dvec3& point) { farthest = std::max(farthest, glm::length(point)); };
    for (const BicubicPatch& patch : surface.patches) {
        for (const auto& row : patch.points) std::for_each(row.begin(), row.end(), add);
    }
    for (const auto& triangle : surface.triangles) {
        for (const SurfaceVertex& vertex : triangle) add(vertex.position);
    }
    return farthest;
}

class Top {
public:
    explicit Top(const Shapes* shapes) : shapes_(shapes) {}

    void add(double y) { top_ = std::max(top_, y); }
    void add(const Internode& internode) {
        const double highest =
            std::max(internode.base.y + internode.base_radius, internode.tip.y + internode.tip_radius);
        if (highest <= top_) return;
        const glm::dvec3 axis = internode.tip - internode.base;
        const double length = glm::length(axis);
        const double side = length > 0 ? rise(axis / length) : 0;
        add(internode.base.y + side * internode.base_radius);
        add(internode.tip.y + side * internode.tip_radius);
    }
    void add(const Organ& organ) {
        const double y = organ.pose.position.y, radius = std::abs(organ.size.x) / 2;
        if (organ.shape == Organ::Shape::surface)
            add_surface(organ);
        else
            add(y + radius * (organ.shape == Organ::Shape::sphere ? 1 : rise(organ.pose.up)));
    }
    std::optional<double> value() const { return top_ == nowhere ? std::nullopt : std::optional(top_); }

private:
    void add_surface(const Organ& organ) {
        const Surface* const surface = find(organ.surface);
        const double largest = std::max({std::abs(organ.size.x), std::abs(organ.size.y), std::abs(organ.size.z)});
        if (organ.pose.position.y + largest * (surface ? reach_.at(organ.surface) : 1) <= top_) return;
        if (!surface) {
            for (const glm::dvec3& corner : rhombus_of(organ)) add(corner.y);
            return;
        }
        const auto add_point = [&](const glm::dvec3& point) { add(placed({point, {}, {}}, organ).position.y); };
        for (const BicubicPatch& patch : surface->patches) {
            for (const auto& row : patch.points) std::for_each(row.begin(), row.end(), add_point);
        }
        for (const auto& triangle : surface->triangles) {
            for (const SurfaceVertex& vertex : triangle) add_point(vertex.position);
        }
    }
    const Surface* find(std::uint32_t id) {
        if (!shapes_) return nullptr;
        const auto found = shapes_->surfaces.find(id);
        if (found == shapes_->surfaces.end()) return nullptr;
        if (!reach_.contains(id)) reach_[id] = reach(found->second);
        return &found->second;
    }

    const Shapes* shapes_;
    std::map<std::uint32_t, double> reach_;  ///< reach of surfaces, by their ids
    double top_ = nowhere;
};

}  // namespace

std::optional<double> highest_point(const PlantGeometry& geometry) {
    Top top(geometry.shapes.get());
    for (const Internode& internode : geometry.internodes) top.add(internode);
    for (const glm::dvec3& vertex : geometry.vertices) top.add(vertex.y);
    for (const SurfaceVertex& vertex : geometry.mesh.vertices) top.add(vertex.position.y);
    for (const Label& label : geometry.labels) top.add(label.position.y);
    for (const Organ& organ : geometry.organs) top.add(organ);
    return top.value();
}

}  // namespace espalier::timeline
