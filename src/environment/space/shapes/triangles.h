// A bounding-volume tree over triangles: the nearest point of a surface, exactly.
#pragma once

#include "espalier/geometry/plant_geometry.h"

#include <array>
#include <vector>

namespace espalier::environment {

struct TriangleMesh {
    std::vector<glm::dvec3> points;
    std::vector<std::array<std::uint32_t, 3>> triangles;

    Box bounds() const;
    /// Unit, by the right-hand rule; zero for a triangle without area.
    glm::dvec3 normal(std::size_t triangle) const;
};

class TriangleTree {
public:
    /// `mesh` has one triangle or more.
    explicit TriangleTree(TriangleMesh mesh);

    struct Nearest {
        glm::dvec3 point;
        std::uint32_t triangle = 0;
    };
    Nearest nearest(const glm::dvec3& point) const;

    const TriangleMesh& mesh() const { return mesh_; }

private:
    /// Inner nodes: the first child follows its parent, `second` is the other. Leaves: `count` triangles from `first`.
    struct Node {
        Box box;
        std::uint32_t second = 0;
        std::uint32_t first = 0, count = 0;
    };

    std::uint32_t build(std::uint32_t begin, std::uint32_t end);

    TriangleMesh mesh_;
    std::vector<std::uint32_t> order_;  ///< triangles in the order of the leaves
    std::vector<Node> nodes_;
};

}  // namespace espalier::environment
