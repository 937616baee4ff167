#include "environment/light/shade/leaf_area.h"

#include "espalier/geometry/openvdb_grid.h"

#include "environment/exchange/covering.h"
#include "geometry/drawn/faces.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <openvdb/math/DDA.h>
#include <openvdb/math/Ray.h>

namespace espalier::environment {

struct LeafArea::Voxels {
    openvdb::FloatGrid::Ptr areas = openvdb::FloatGrid::create(0);  ///< m^2
    openvdb::CoordBBox box;
};

LeafArea::LeafArea(double voxel) : voxel_(voxel) {
    initialize_openvdb();
    voxels_ = std::make_unique<Voxels>();
}

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
    using VoxelRay = openvdb::math::Ray<double>;
    const glm::dvec3 eye = from / voxel_;
    VoxelRay ray({eye.x, eye.y, eye.z}, {direction.x, direction.y, direction.z}, 0);
    const openvdb::Vec3d lower = box.min().asVec3d(), upper = box.max().asVec3d() + openvdb::Vec3d(1);
    if (!ray.clip(openvdb::math::BBox<openvdb::Vec3d>(lower, upper))) return 0;
    const auto areas = voxels_->areas->getConstAccessor();
    openvdb::math::DDA<VoxelRay> voxels(ray);
    double sum = 0;
    do {
        const double area = areas.getValue(voxels.voxel());
        if (area > 0) sum += area * (std::min(voxels.next(), ray.t1()) - voxels.time());
    } while (voxels.step());
    return sum / (voxel_ * voxel_);
}

}  // namespace espalier::environment
