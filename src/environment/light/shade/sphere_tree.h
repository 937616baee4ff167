// Spheres by place: which of them a ray may meet, without asking all.
#pragma once

#include "espalier/geometry/plant_geometry.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace espalier::environment {

struct Ray {
    glm::dvec3 origin, direction;  ///< the direction has length 1
    double length = std::numeric_limits<double>::infinity();
    double margin = 0;  ///< how far from the ray a sphere may still matter
};

/// A tree of boxes, split at the median. It depends on where the spheres are, not on their order.
class SphereTree {
public:
    struct Sphere {
        glm::dvec3 centre;
        double radius;
        std::uint32_t number;  ///< passed to visitors
    };

    explicit SphereTree(std::vector<Sphere> spheres);

    /// Calls visit(sphere) for every sphere whose surface the ray comes nearer to than its margin, and for some others,
    /// always in the same order.
    template <class Visit>
    void visit_along(const Ray& ray, const Visit& visit) const {
        if (nodes_.empty()) return;
        std::array<std::uint32_t, 64> waiting;
        std::size_t depth = 0;
        waiting[depth++] = 0;
        while (depth > 0) {
            const Node& node = nodes_[waiting[--depth]];
            if (!may_meet(ray, node.box)) continue;
            if (node.count > 0) {
                for (const Sphere& sphere : std::span(spheres_).subspan(node.first, node.count)) visit(sphere);
            } else {
                waiting[depth++] = node.first + 1;
                waiting[depth++] = node.first;
            }
        }
    }

private:
    /// A leaf has `count` spheres from `first`, an inner node two children at `first`.
    struct Node {
        Box box;
        std::uint32_t first = 0, count = 0;
    };

    void split(std::uint32_t node, std::uint32_t begin, std::uint32_t end);
    static bool may_meet(const Ray& ray, const Box& box);

    std::vector<Sphere> spheres_;
    std::vector<Node> nodes_;
};

}  // namespace espalier::environment
