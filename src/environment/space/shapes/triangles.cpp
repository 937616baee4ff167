#include "environment/space/shapes/triangles.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <numeric>

namespace espalier::environment {
namespace {

constexpr std::uint32_t leaf_size = 4;

/// The nearest point of a triangle by the regions of its corners, edges and face (Ericson 2005, section 5.1.5).
glm::dvec3 nearest_on_triangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
    if (d1 <= 0 && d2 <= 0) return a;
    const double d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
    if (d3 >= 0 && d4 <= d3) return b;
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 / (d1 - d3));
    const double d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d6 >= 0 && d5 <= d6) return c;
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 / (d2 - d6));
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 >= d3 && d5 >= d6) return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    return a + (ab * vb + ac * vc) / (va + vb + vc);
}

double square_distance(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::dot(a - b, a - b);
}

double square_distance(const glm::dvec3& point, const Box& box) {
    return square_distance(point, glm::clamp(point, box.lower, box.upper));
}

}  // namespace

Box TriangleMesh::bounds() const {
    Box box;
    for (const glm::dvec3& point : points) box.add(point);
    return box;
}

glm::dvec3 TriangleMesh::normal(std::size_t triangle) const {
    const auto& [a, b, c] = triangles[triangle];
    const glm::dvec3 across = glm::cross(points[b] - points[a], points[c] - points[a]);
    const double length = glm::length(across);
    return length > 0 ? across / length : glm::dvec3(0);
}

TriangleTree::TriangleTree(TriangleMesh mesh) : mesh_(std::move(mesh)), order_(mesh_.triangles.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    nodes_.reserve(2 * order_.size() / leaf_size + 1);
    build(0, static_cast<std::uint32_t>(order_.size()));
}

std::uint32_t TriangleTree::build(std::uint32_t begin, std::uint32_t end) {
    const auto center = [&](std::uint32_t triangle) {
        const auto& [a, b, c] = mesh_.triangles[triangle];
        return mesh_.points[a] + mesh_.points[b] + mesh_.points[c];
    };
    const auto at = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    Box box, centers;
    for (std::uint32_t i = begin; i < end; ++i) {
        for (std::uint32_t corner : mesh_.triangles[order_[i]]) box.add(mesh_.points[corner]);
        centers.add(center(order_[i]));
    }
    nodes_[at].box = box;
    if (end - begin <= leaf_size) {
        nodes_[at].first = begin;
        nodes_[at].count = end - begin;
        return at;
    }
    const glm::dvec3 extent = centers.upper - centers.lower;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) { return center(a)[axis] < center(b)[axis]; });
    build(begin, middle);
    nodes_[at].second = build(middle, end);
    return at;
}

TriangleTree::Nearest TriangleTree::nearest(const glm::dvec3& point) const {
    Nearest best{mesh_.points[mesh_.triangles[0][0]], 0};
    double best_square = square_distance(point, best.point);
    std::uint32_t stack[64];  // halving 2^32 triangles needs 32 levels, two nodes each
    int height = 0;
    stack[height++] = 0;
    while (height > 0) {
        const std::uint32_t at = stack[--height];
        const Node& node = nodes_[at];
        if (square_distance(point, node.box) > best_square) continue;
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            const auto& [a, b, c] = mesh_.triangles[order_[i]];
            const glm::dvec3 found = nearest_on_triangle(point, mesh_.points[a], mesh_.points[b], mesh_.points[c]);
            const double square = square_distance(point, found);
            if (square < best_square) {
                best_square = square;
                best = {found, order_[i]};
            }
        }
        if (node.count > 0) continue;
        const bool first_is_nearer =
            square_distance(point, nodes_[at + 1].box) <= square_distance(point, nodes_[node.second].box);
        stack[height++] = first_is_nearer ? node.second : at + 1;
        stack[height++] = first_is_nearer ? at + 1 : node.second;
    }
    return best;
}

}  // namespace espalier::environment
