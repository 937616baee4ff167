#include "geometry/drawn/mesh_size.h"

#include "base/parallel.h"
#include "geometry/drawn/organ_mesh.h"

#include <tbb/blocked_range.h>

#include <algorithm>

namespace espalier::geometry {
namespace {

MeshSize size_of(const OrganMesh& mesh) {
    return {mesh.vertices.size(), mesh.faces.indices.size() + mesh.outlines.indices.size(),
            mesh.faces.counts.size() + mesh.outlines.counts.size(), 1, 1};
}

// Patches may have colours of their own.
MeshSize size_of(const Surface& surface) {
    const SurfaceMesh mesh = mesh_of(surface);
    const std::size_t runs = std::max<std::size_t>(surface.patches.size(), 1);
    return {mesh.vertices.size(), mesh.indices.size(), mesh.faces.size(), runs, runs};
}

/// Adds up organs; neighbours are mostly of one kind.
class OrganSum {
public:
    explicit OrganSum(const std::map<std::uint32_t, MeshSize>* surfaces) : surfaces_(surfaces) {}

    void add(const Organ& organ) {
        if (!last_ || organ.shape != last_->shape || organ.sides != last_->sides || organ.surface != last_->surface) {
            close();
            last_ = &organ;
        }
        ++count_;
    }
    MeshSize sum() {
        close();
        return sum_;
    }

private:
    void close() {
        if (last_) sum_.add(find(*last_), count_);
        count_ = 0;
    }
    MeshSize find(const Organ& organ) {
        if (organ.shape == Organ::Shape::surface && surfaces_) {
            const auto found = surfaces_->find(organ.surface);
            if (found != surfaces_->end()) return found->second;
        }
        const auto [known, is_new] = plain_sizes_.try_emplace({organ.shape, organ.sides});
        if (is_new) known->second = size_of(meshes_.of(organ));
        return known->second;
    }

    const std::map<std::uint32_t, MeshSize>* surfaces_;
    OrganMeshes meshes_;
    std::map<std::pair<Organ::Shape, std::uint16_t>, MeshSize> plain_sizes_;
    const Organ* last_ = nullptr;
    std::size_t count_ = 0;
    MeshSize sum_;
};

MeshSize size_of_organs(const std::vector<Organ>& organs, const std::map<std::uint32_t, MeshSize>* surfaces) {
    constexpr std::size_t worth_sharing = std::size_t{1} << 14;
    if (organs.empty()) return {};
    const auto sum_of = [&](const tbb::blocked_range<std::size_t>& range, MeshSize sum) {
        OrganSum some(surfaces);
        for (std::size_t i = range.begin(); i < range.end(); ++i) some.add(organs[i]);
        sum.add(some.sum());
        return sum;
    };
    const auto join = [](MeshSize a, const MeshSize& b) {
        a.add(b);
        return a;
    };
    if (organs.size() < 2 * worth_sharing) return sum_of({0, organs.size()}, {});
    return reduce_in_parallel(tbb::blocked_range<std::size_t>(0, organs.size(), worth_sharing), MeshSize(), sum_of,
                              join);
}

}  // namespace

void MeshSize::add(const MeshSize& other, std::size_t times) {
    points += other.points * times;
    corners += other.corners * times;
    cells += other.cells * times;
    point_runs += other.point_runs * times;
    cell_runs += other.cell_runs * times;
}

const std::map<std::uint32_t, MeshSize>& SurfaceSizes::of(const std::shared_ptr<const Shapes>& shapes) {
    const std::lock_guard lock(mutex_);
    const auto [known, is_new] = known_.try_emplace(shapes);
    if (is_new) {
        for (const auto& [id, surface] : shapes->surfaces) known->second[id] = size_of(surface);
    }
    return known->second;
}

// Most organs are rhombi.
std::size_t points_foreseen(const PlantGeometry& geometry) {
    return 2 * geometry.internodes.size() + 4 * geometry.organs.size() + geometry.vertices.size();
}

MeshSize mesh_size(const PlantGeometry& geometry, SurfaceSizes& surfaces, std::size_t vertices) {
    const std::size_t internodes = geometry.internodes.size(), polygons = geometry.polygons.size(),
                      corners = geometry.vertices.size(), pieces = geometry.mesh.pieces.size(),
                      triangles = geometry.mesh.triangles.size() / 3;
    const std::size_t axes = std::min<std::size_t>(geometry.axes, internodes);
    MeshSize size{internodes + axes, internodes + axes, axes, internodes, axes};
    size.add({corners, 3 * corners, corners, polygons, polygons});
    size.add({geometry.mesh.vertices.size(), 3 * triangles, triangles, pieces, pieces});
    size.add({1, 1, 1, 1, 1}, geometry.labels.size() + vertices);
    size.add(size_of_organs(geometry.organs, geometry.shapes ? &surfaces.of(geometry.shapes) : nullptr));
    return size;
}

}  // namespace espalier::geometry
