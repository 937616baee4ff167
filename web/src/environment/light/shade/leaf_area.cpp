#include "environment/light/shade/leaf_area.h"

#include "espalier/geometry/openvdb_grid.h"

#include "environment/exchange/covering.h"
#include "geometry/drawn/faces.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <limits>

namespace espalier::environment {
namespace {

constexpr double never = std::numeric_limits<double>::max();

/// The share of a line, in lengths of its direction, that lies in a box.
struct Span {
    double from = 0, to = never;

    bool clip(const glm::dvec3& eye, const glm::dvec3& per_direction, const glm::dvec3& lower,
              const glm::dvec3& upper) {
        for (int axis = 0; axis < 3; ++axis) {
            double in = (lower[axis] - eye[axis]) * per_direction[axis];
            double out = (upper[axis] - eye[axis]) * per_direction[axis];
            if (in > out) std::swap(in, out);
            if (in > from) from = in;
            if (out < to) to = out;
            if (from > to) return false;
        }
        return true;
    }
};

/// The voxels along a line, in turn (Amanatides & Woo 1987).
class VoxelWalk {
public:
    VoxelWalk(const glm::dvec3& eye, const glm::dvec3& direction, const glm::dvec3& per_direction, const Span& span)
        : at_(span.from), end_(span.to) {
        const glm::dvec3 place = eye + direction * at_;
        voxel_ = openvdb::Coord::floor({place.x, place.y, place.z});
        for (int axis = 0; axis < 3; ++axis) {
            if (direction[axis] == 0) continue;
            const bool ahead = per_direction[axis] > 0;
            step_[axis] = ahead ? 1 : -1;
            next_[axis] = at_ + (voxel_[axis] + (ahead ? 1 : 0) - place[axis]) * per_direction[axis];
            apart_[axis] = step_[axis] * per_direction[axis];
        }
    }

    const openvdb::Coord& voxel() const { return voxel_; }
    double time() const { return at_; }
    double next() const { return std::min(end_, std::min(next_.x, std::min(next_.y, next_.z))); }
    /// False at the end of the line.
    bool step() {
        const int axis = next_.x < next_.y && next_.x < next_.z ? 0 : next_.y < next_.z ? 1 : 2;
        at_ = next_[axis];
        next_[axis] += apart_[axis];
        voxel_[axis] += step_[axis];
        return at_ <= end_;
    }

private:
    double at_, end_;
    openvdb::Coord voxel_;
    glm::ivec3 step_{0};
    glm::dvec3 next_{never}, apart_{never};
};

}  // namespace

struct LeafArea::Voxels {
    openvdb::FloatGrid::Ptr areas = openvdb::FloatGrid::create(0);  ///< m^2
    openvdb::CoordBBox box;
};

LeafArea::LeafArea(double voxel) : voxel_(voxel), voxels_(std::make_unique<Voxels>()) {}

LeafArea::~LeafArea() = default;

void LeafArea::collect(std::span<const PlantView> plants) {
    voxels_->areas->clear();
    voxels_->box.reset();
    total_ = 0;
    DrawnFaces leaves;
    for (const PlantView& plant : plants) {
        leaves.clear();
        leaves.add_leaves(plant.plant, plant.drawn());
        for (std::size_t i = 0; i < leaves.size(); ++i) add(leaves[i].middle(), glm::length(leaves[i].area()));
    }
}

void LeafArea::add(const glm::dvec3& middle, double area) {
    const glm::ivec3 at = voxel_at(middle, voxel_);
    const openvdb::Coord voxel(at.x, at.y, at.z);
    openvdb::FloatTree& areas = voxels_->areas->tree();
    areas.setValue(voxel, areas.getValue(voxel) + static_cast<float>(area));
    voxels_->box.expand(voxel);
    total_ += area;
}

double LeafArea::crossed(const glm::dvec3& from, const glm::dvec3& direction) const {
    const openvdb::CoordBBox& box = voxels_->box;
    if (box.empty()) return 0;
    const glm::dvec3 eye = from / voxel_, per_direction = 1.0 / direction;
    const openvdb::Vec3d least = box.min().asVec3d(), most = box.max().asVec3d();
    Span span;
    if (!span.clip(eye, per_direction, {least.x(), least.y(), least.z()}, {most.x() + 1, most.y() + 1, most.z() + 1})) {
        return 0;
    }
    const auto areas = voxels_->areas->getConstAccessor();
    VoxelWalk voxels(eye, direction, per_direction, span);
    double sum = 0;
    do {
        const double area = areas.getValue(voxels.voxel());
        if (area > 0) sum += area * (std::min(voxels.next(), span.to) - voxels.time());
    } while (voxels.step());
    return sum / (voxel_ * voxel_);
}

}  // namespace espalier::environment
