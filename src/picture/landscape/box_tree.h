// A hierarchy of boxes that a ray goes through: what it may hit, the nearest first.
#pragma once

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace espalier::picture {

struct Ray {
    glm::vec3 origin, direction;  ///< the direction in metres a unit of distance
    float nearest = 0, furthest = std::numeric_limits<float>::max();
};

struct RayBox {
    glm::vec3 lower{std::numeric_limits<float>::max()}, upper{-std::numeric_limits<float>::max()};

    void add(const glm::vec3& point) {
        lower = glm::min(lower, point);
        upper = glm::max(upper, point);
    }
    void add(const RayBox& box) {
        lower = glm::min(lower, box.lower);
        upper = glm::max(upper, box.upper);
    }
    /// Half of its surface.
    float area() const {
        const glm::vec3 size = glm::max(upper - lower, glm::vec3(0));
        return size.x * size.y + size.y * size.z + size.z * size.x;
    }
};

class BoxTree {
public:
    /// Splits where the surface heuristic of MacDonald & Booth 1990 is least, among 16 places along the longest axis.
    explicit BoxTree(std::span<const RayBox> boxes);

    /// Calls `visit` with the numbers of boxes that the ray may meet, until it returns true; returns whether it did.
    /// `visit` may shorten the ray.
    template <class Visit>
    bool visit(Ray& ray, const Visit& visit) const;

    std::size_t bytes() const { return nodes_.size() * sizeof(Node) + items_.size() * sizeof(std::uint32_t); }
    RayBox bounds() const { return nodes_.empty() ? RayBox() : nodes_.front().box; }

private:
    struct Node {
        RayBox box;
        std::uint32_t first;  ///< its first item; of an inner node the second child, the first being the next node
        std::uint32_t count;  ///< number of items; 0: an inner node
    };
    struct Part {
        std::size_t first, last;
        std::size_t node;  ///< whose second child it is; none for first children
    };

    static constexpr std::size_t most_of_leaf = 4;
    static constexpr std::size_t deepest = 168;  ///< for 2^32 items, with an eighth on the smaller side of each split

    std::size_t split(std::span<const RayBox> boxes, std::size_t first, std::size_t last, const RayBox& centres);

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> items_;
};

template <class Visit>
bool BoxTree::visit(Ray& ray, const Visit& visit) const {
    if (nodes_.empty()) return false;
    const glm::vec3 inverse = 1.0F / ray.direction;
    const auto entry = [&](const RayBox& box) {
        const glm::vec3 a = (box.lower - ray.origin) * inverse, b = (box.upper - ray.origin) * inverse;
        const glm::vec3 in = glm::min(a, b), out = glm::max(a, b);
        const float enters = std::max(std::max(in.x, in.y), std::max(in.z, ray.nearest));
        const float leaves = std::min(std::min(out.x, out.y), std::min(out.z, ray.furthest));
        return enters <= leaves ? enters : std::numeric_limits<float>::infinity();
    };
    std::array<std::pair<std::uint32_t, float>, deepest + 2> stack;
    std::size_t waiting = 0;
    const float at_root = entry(nodes_.front().box);
    if (at_root <= ray.furthest) stack[waiting++] = {0, at_root};
    while (waiting > 0) {
        const auto [number, distance] = stack[--waiting];
        if (distance > ray.furthest) continue;
        const Node& node = nodes_[number];
        if (node.count > 0) {
            for (std::uint32_t i = 0; i < node.count; ++i) {
                if (visit(items_[node.first + i])) return true;
            }
            continue;
        }
        std::pair<std::uint32_t, float> near{number + 1, entry(nodes_[number + 1].box)},
            far{node.first, entry(nodes_[node.first].box)};
        if (far.second < near.second) std::swap(near, far);
        if (far.second <= ray.furthest) stack[waiting++] = far;
        if (near.second <= ray.furthest) stack[waiting++] = near;
    }
    return false;
}

}  // namespace espalier::picture
