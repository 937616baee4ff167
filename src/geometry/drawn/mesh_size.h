// How large a plant's mesh will be, computed before it is made.
#pragma once

#include "espalier/geometry/plant_geometry.h"

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>

namespace espalier::geometry {

/// The size of a PlantMesh or a part of it, or a little more: polygons count as if all were cut into triangles.
struct MeshSize {
    std::size_t points = 0;
    std::size_t corners = 0;  ///< corners of all cells: the points that they name
    std::size_t cells = 0;
    std::size_t point_runs = 0, cell_runs = 0;  ///< runs of one owner

    void add(const MeshSize& other, std::size_t times = 1);
};

/// Sizes of the surfaces that view files describe. Each is meshed once; thread safe.
class SurfaceSizes {
public:
    /// Returns the sizes of all surfaces of a view file, by their ids; stays where it is.
    const std::map<std::uint32_t, MeshSize>& of(const std::shared_ptr<const Shapes>& shapes);

private:
    std::mutex mutex_;
    std::map<std::shared_ptr<const Shapes>, std::map<std::uint32_t, MeshSize>> known_;
};

/// About how many points the mesh will have: by this number frames are cut into files.
std::size_t points_foreseen(const PlantGeometry& geometry);

/// With so many `vertices` besides what is drawn.
MeshSize mesh_size(const PlantGeometry& geometry, SurfaceSizes& surfaces, std::size_t vertices = 0);

}  // namespace espalier::geometry
