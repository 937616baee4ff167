#include "espalier/geometry/field_values.h"

#include "espalier/geometry/openvdb_grid.h"

#include "base/bytes.h"
#include "geometry/grid_file.h"

#include <openvdb/tools/Interpolation.h>

namespace espalier::geometry {
namespace {

/// By the tree itself: an accessor of its own for each look would cost more than it saves, and one for all threads is
/// not safe.
double sampled(const openvdb::FloatGrid& grid, const openvdb::Vec3d& place) {
    return openvdb::tools::BoxSampler::sample(grid.tree(), grid.worldToIndex(place));
}

}  // namespace

void FieldValues::take(const Fields& fields, const std::vector<std::string>& names) {
    forget();
    for (const std::string& name : names) {
        const Field* field = fields.find(name);
        if (field && field->grid && field->grid->grid) grids_[name] = field->grid;
    }
}

const FieldGrid* FieldValues::find(const std::string& name) const {
    const auto found = grids_.find(name);
    return found == grids_.end() ? nullptr : found->second.get();
}

double FieldValues::value(const std::string& name, const glm::dvec3& position) const {
    const FieldGrid* field = find(name);
    return field ? sampled(*field->grid, {position.x, position.y, position.z}) : 0;
}

glm::dvec3 FieldValues::gradient(const std::string& name, const glm::dvec3& position) const {
    glm::dvec3 slope(0);
    const FieldGrid* field = find(name);
    if (!field) return slope;
    const openvdb::Vec3d voxel = field->grid->voxelSize();
    for (int axis = 0; axis < 3; ++axis) {
        openvdb::Vec3d behind(position.x, position.y, position.z), ahead = behind;
        behind[axis] -= voxel[axis];
        ahead[axis] += voxel[axis];
        slope[axis] = (sampled(*field->grid, ahead) - sampled(*field->grid, behind)) / (2 * voxel[axis]);
    }
    return slope;
}

void FieldValues::save(std::ostream& out) const {
    put(out, static_cast<std::uint64_t>(grids_.size()));
    for (const auto& [name, field] : grids_) {
        put_text(out, name);
        put_text(out, bytes_of(*field));
    }
}

void FieldValues::restore(std::istream& in) {
    constexpr std::uint64_t longest_name = 1 << 16, largest_grid = std::uint64_t{1} << 36;
    forget();
    for (auto left = get<std::uint64_t>(in); left > 0; --left) {
        const std::string name = get_text(in, longest_name);
        grids_[name] = grid_from_bytes(get_text(in, largest_grid));
    }
}

}  // namespace espalier::geometry
