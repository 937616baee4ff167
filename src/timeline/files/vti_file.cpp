#include "timeline/files/vti_file.h"

#include "espalier/base/column.h"
#include "espalier/base/error.h"
#include "espalier/geometry/openvdb_grid.h"

#include "base/text.h"
#include "base/xml_text.h"
#include "geometry/grid_file.h"
#include "timeline/files/vtk_file.h"

#include <fmt/format.h>
#include <openvdb/tools/Dense.h>

#include <algorithm>

namespace espalier::timeline {
namespace {

openvdb::CoordBBox box_of(const FieldGrid& field) {
    // Nothing active yet: one voxel, so that the file opens and has the array.
    if (field.box.empty()) return {openvdb::Coord(0), openvdb::Coord(0)};
    return field.box;
}

// Without overflow: each extent is below 2^32.
bool too_large(const openvdb::Coord& size) {
    std::uint64_t voxels = 1;
    for (int axis = 0; axis < 3; ++axis) {
        voxels *= static_cast<std::uint32_t>(size[axis]);
        if (voxels > most_dense_voxels) return true;
    }
    return false;
}

std::string numbers(const openvdb::Vec3d& vector) {
    return fmt::format("{} {} {}", format_exact(vector.x()), format_exact(vector.y()), format_exact(vector.z()));
}

// Leaf by leaf where there is nothing else: OpenVDB looks at every node, on all threads.
Column<float> values_in(const FieldGrid& field, const openvdb::CoordBBox& box) {
    using Leaf = openvdb::FloatTree::LeafNodeType;
    Column<float> values(box.volume());
    if (!field.only_leaves) {
        openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ> dense(box, values.data());
        openvdb::tools::copyToDense(*field.grid, dense);
        return values;
    }
    std::fill(values.begin(), values.end(), field.grid->background());
    const openvdb::Coord size = box.dim();
    const auto rows = static_cast<std::size_t>(size.y()), row = static_cast<std::size_t>(size.x());
    for (auto leaf = field.grid->tree().cbeginLeaf(); leaf; ++leaf) {
        openvdb::CoordBBox part = leaf->getNodeBoundingBox();
        if (!part.hasOverlap(box)) continue;
        part.intersect(box);
        const float* const of_leaf = leaf->buffer().data();
        openvdb::Coord at;
        for (at.z() = part.min().z(); at.z() <= part.max().z(); ++at.z()) {
            for (at.y() = part.min().y(); at.y() <= part.max().y(); ++at.y()) {
                at.x() = part.min().x();
                const openvdb::Coord from_corner = at - box.min();
                const auto place = [&](int axis) { return static_cast<std::size_t>(from_corner[axis]); };
                float* value = &values[(place(2) * rows + place(1)) * row + place(0)];
                for (; at.x() <= part.max().x(); ++at.x()) *value++ = of_leaf[Leaf::coordToOffset(at)];
            }
        }
    }
    return values;
}

}  // namespace

void write_vti(const std::filesystem::path& path, const Field& field, double time, int step) {
    const FieldGrid& source = grid_of(field);
    const openvdb::CoordBBox box = box_of(source);
    const openvdb::Coord size = box.dim();
    if (too_large(size)) {
        throw RunError(
            fmt::format("field '{}' spans {} x {} x {} voxels, more than the {} a .vti may hold; record it "
                        "as field_files = [\"vdb\"] only",
                        field.name, size.x(), size.y(), size.z(), most_dense_voxels));
    }
    const Column<float> values = values_in(source, box);

    const openvdb::Vec3d origin = source.grid->indexToWorld(box.min());
    const openvdb::Vec3d spacing = source.grid->voxelSize();
    const std::string extent = fmt::format("0 {} 0 {} 0 {}", size.x() - 1, size.y() - 1, size.z() - 1);
    VtkFile file;
    file.begin("ImageData");
    file.open("ImageData", fmt::format(R"(WholeExtent="{}" Origin="{}" Spacing="{}" Direction="1 0 0 0 1 0 0 0 1")",
                                       extent, numbers(origin), numbers(spacing)));
    file.open("FieldData");
    file.add_time(time, step);
    file.add_texts("unit", {field.unit});
    file.add_texts("meaning", {field.meaning});
    file.close();
    file.open("Piece", fmt::format(R"(Extent="{}")", extent));
    file.open("PointData", fmt::format(R"(Scalars="{}")", xml_text(field.name)));
    file.add(data_array<float>(field.name, values));
    file.write(path);
}

}  // namespace espalier::timeline
