#include "environment/space/shapes/level_set.h"

#include "espalier/base/stop.h"
#include "espalier/geometry/openvdb_grid.h"

#include "base/usable_memory.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <openvdb/tools/Dense.h>
#include <openvdb/tools/MeshToVolume.h>

#include <cmath>
#include <optional>

namespace espalier::environment {
namespace {

using DenseGrid = openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ>;

constexpr float band_beside = 3;      // voxels on either side: all that inside and a gradient at the surface need
constexpr double near_enough = 1000;  // m from 0: there 32 bits keep a tenth of a millimetre
constexpr openvdb::Index64 dense_limit = 256 * 256 * 256;

double area(const TriangleMesh& mesh) {
    double sum = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        sum += 0.5 * glm::length(glm::cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a]));
    }
    return sum;
}

void require_room(const TriangleMesh& mesh, double voxel, const std::string& file, const Place& place) {
    // The band's voxels lie in leaves that are part empty, and are made with an index of the nearest triangle each.
    const double band_voxels = area(mesh) / (voxel * voxel) * 2 * band_beside;
    const double bytes = 4 * band_voxels * (sizeof(float) + sizeof(std::int32_t));
    const Box box = mesh.bounds();
    const glm::dvec3 farthest = glm::max(glm::abs(box.lower), glm::abs(box.upper)) / voxel;
    const bool countable = std::max({farthest.x, farthest.y, farthest.z}) < 1e9;
    if (!countable || bytes > 0.5 * static_cast<double>(usable_memory())) {
        throw UserError(place, fmt::format("voxels of {:g} m are too small for {}: its level set would take about "
                                           "{:.3g} GB; the mesh is {:g} x {:g} x {:g} m",
                                           voxel, file, bytes / 1e9, box.upper.x - box.lower.x,
                                           box.upper.y - box.lower.y, box.upper.z - box.lower.z));
    }
}

/// What OpenVDB asks on any thread.
struct Interrupter final : openvdb::util::NullInterrupter {
    const StopRequest* request = StopRequest::current();

    bool wasInterrupted(int) override { return request && request->is_due(); }
};

/// Points of the grid are relative to it: 32 bits do not count the places of a map. Whole voxels, so that those near 0
/// lie as ever.
glm::dvec3 corner_of(const TriangleMesh& mesh, double voxel) {
    const Box box = mesh.bounds();
    const glm::dvec3 farthest = glm::max(glm::abs(box.lower), glm::abs(box.upper));
    if (std::max({farthest.x, farthest.y, farthest.z}) <= near_enough) return glm::dvec3(0);
    return voxel * glm::floor(box.lower / voxel);
}

openvdb::FloatGrid::Ptr to_level_set(const TriangleMesh& mesh, double voxel, const glm::dvec3& corner) {
    initialize_openvdb();
    std::vector<openvdb::Vec3s> points;
    std::vector<openvdb::Vec3I> triangles;
    points.reserve(mesh.points.size());
    triangles.reserve(mesh.triangles.size());
    for (const glm::dvec3& place : mesh.points) {
        const glm::dvec3 point = place - corner;
        points.emplace_back(static_cast<float>(point.x), static_cast<float>(point.y), static_cast<float>(point.z));
    }
    for (const auto& [a, b, c] : mesh.triangles) triangles.emplace_back(a, b, c);
    const auto transform = voxel_transform(voxel);
    Interrupter interrupter;
    openvdb::util::NullInterrupter& asked = interrupter;
    auto grid = openvdb::tools::meshToLevelSet<openvdb::FloatGrid>(asked, *transform, points, triangles, band_beside);
    end_if_asked();
    return grid;
}

bool has_inside(const openvdb::FloatGrid& grid) {
    for (auto value = grid.cbeginValueAll(); value; ++value) {
        if (*value < 0) return true;
    }
    return false;
}

}  // namespace

struct LevelSet::Storage {
    openvdb::FloatGrid::ConstPtr grid;
    std::optional<DenseGrid> dense;  ///< a copy where it is small: 8 to 12 times faster to read
    double voxel;
    float background;
    glm::dvec3 corner{0};  ///< of the mesh, where voxel 0 lies

    /// The eight values around `floor`, x slowest.
    void corners(const openvdb::Coord& floor, float (&values)[8]) const {
        if (dense) {
            if (!dense->bbox().isInside(floor) || !dense->bbox().isInside(floor.offsetBy(1))) {
                std::fill(std::begin(values), std::end(values), background);
                return;
            }
            const float* at = dense->data() + dense->coordToOffset(floor);
            for (int i = 0; i < 8; ++i) {
                values[i] =
                    at[(i >> 2 & 1) * dense->xStride() + (i >> 1 & 1) * dense->yStride() + (i & 1) * dense->zStride()];
            }
            return;
        }
        // Not registered with the tree: an accessor of its own for every reading stays cheap and thread safe.
        openvdb::tree::ValueAccessor<const openvdb::FloatTree, false> accessor(grid->tree());
        for (int i = 0; i < 8; ++i) {
            values[i] = accessor.getValue(floor.offsetBy(i >> 2 & 1, i >> 1 & 1, i & 1));
        }
    }
};

LevelSet::LevelSet(const TriangleMesh& mesh, double voxel, const std::string& file, const Place& place) {
    require_room(mesh, voxel, file, place);
    const glm::dvec3 corner = corner_of(mesh, voxel);
    Storage storage{to_level_set(mesh, voxel, corner), std::nullopt, voxel, 0, corner};
    storage.background = storage.grid->background();
    if (!has_inside(*storage.grid)) {
        throw UserError(
            place, fmt::format("{} encloses nothing at voxels of {:g} m: it is thinner than they are", file, voxel));
    }
    const openvdb::CoordBBox box = storage.grid->evalActiveVoxelBoundingBox();
    if (box.volume() <= dense_limit) {
        storage.dense.emplace(box.expandBy(1), storage.background);
        openvdb::tools::copyToDense(*storage.grid, *storage.dense);
    }
    storage_ = std::make_unique<const Storage>(std::move(storage));
}

LevelSet::LevelSet(LevelSet&&) noexcept = default;
LevelSet::~LevelSet() = default;

LevelSet::Reading LevelSet::read(const glm::dvec3& point) const {
    const glm::dvec3 index = (point - storage_->corner) / storage_->voxel;
    const glm::dvec3 low = glm::floor(index);
    if (!(std::abs(low.x) < 2e9 && std::abs(low.y) < 2e9 && std::abs(low.z) < 2e9)) {
        return {false, storage_->background, {}};  // beyond what a voxel index can count, so far outside
    }
    const openvdb::Coord floor(static_cast<int>(low.x), static_cast<int>(low.y), static_cast<int>(low.z));
    float c[8];
    storage_->corners(floor, c);
    bool near = true;
    for (float corner : c) near &= std::abs(corner) < storage_->background;
    if (!near) return {false, c[0], {}};

    const glm::dvec3 t = index - low;
    const auto lerp = [](double a, double b, double s) { return a + s * (b - a); };
    // Along z, then y, then x; the differences met on the way are the gradient.
    const double z00 = lerp(c[0], c[1], t.z), z01 = lerp(c[2], c[3], t.z);
    const double z10 = lerp(c[4], c[5], t.z), z11 = lerp(c[6], c[7], t.z);
    const double y0 = lerp(z00, z01, t.y), y1 = lerp(z10, z11, t.y);
    const double dz = lerp(lerp(c[1] - c[0], c[3] - c[2], t.y), lerp(c[5] - c[4], c[7] - c[6], t.y), t.x);
    const double dy = lerp(z01 - z00, z11 - z10, t.x);
    return {true, lerp(y0, y1, t.x), glm::dvec3(y1 - y0, dy, dz) / storage_->voxel};
}

}  // namespace espalier::environment
