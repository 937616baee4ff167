#include "environment/light/shade/sphere_tree.h"

#include <algorithm>
#include <tuple>

namespace espalier::environment {
namespace {

constexpr std::uint32_t leaf_size = 4;

std::tuple<double, double, double, double> rank(const SphereTree::Sphere& sphere, int axis) {
    const glm::dvec3& c = sphere.centre;
    return {c[axis], c[(axis + 1) % 3], c[(axis + 2) % 3], sphere.radius};
}

}  // namespace

SphereTree::SphereTree(std::vector<Sphere> spheres) : spheres_(std::move(spheres)) {
    if (spheres_.empty()) return;
    nodes_.emplace_back();
    split(0, 0, static_cast<std::uint32_t>(spheres_.size()));
}

void SphereTree::split(std::uint32_t node, std::uint32_t begin, std::uint32_t end) {
    Box box, centres;
    for (std::uint32_t i = begin; i < end; ++i) {
        box.add(spheres_[i].centre - spheres_[i].radius);
        box.add(spheres_[i].centre + spheres_[i].radius);
        centres.add(spheres_[i].centre);
    }
    nodes_[node].box = box;
    const glm::dvec3 side = centres.upper - centres.lower;
    const int axis = side.x >= side.y && side.x >= side.z ? 0 : side.y >= side.z ? 1 : 2;
    std::sort(spheres_.begin() + begin, spheres_.begin() + end,
              [axis](const Sphere& a, const Sphere& b) { return rank(a, axis) < rank(b, axis); });
    if (end - begin <= leaf_size) {
        nodes_[node].first = begin;
        nodes_[node].count = end - begin;
        return;
    }
    const auto children = static_cast<std::uint32_t>(nodes_.size());
    nodes_[node].first = children;
    nodes_.resize(nodes_.size() + 2);
    const std::uint32_t middle = begin + (end - begin) / 2;
    split(children, begin, middle);
    split(children + 1, middle, end);
}

// Slabs (Kay & Kajiya 1986), a little widened against rounding.
bool SphereTree::may_meet(const Ray& ray, const Box& box) {
    double near = 0, far = ray.length + ray.margin;
    for (int axis = 0; axis < 3; ++axis) {
        const double origin = ray.origin[axis];
        const double slope = std::abs(ray.direction[axis]) < 1e-300 ? 1e-300 : ray.direction[axis];
        const double slack = ray.margin + 1e-12 * (std::abs(origin) + std::abs(box.upper[axis] - box.lower[axis]));
        const double lower = box.lower[axis] - slack - origin, upper = box.upper[axis] + slack - origin;
        const double one = lower / slope, other = upper / slope;
        near = std::max(near, std::min(one, other));
        far = std::min(far, std::max(one, other));
    }
    return near <= far * (1 + 1e-12);
}

}  // namespace espalier::environment
