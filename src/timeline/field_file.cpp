#include "timeline/field_file.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"
#include "espalier/environment/openvdb_grid.h"

#include "timeline/vtk_file.h"

#include <fmt/format.h>
#include <openvdb/io/Archive.h>
#include <openvdb/tools/Dense.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <sstream>
#include <string_view>

namespace espalier {
namespace {

// OpenVDB draws a new UUID for every file; this stands in its place, so that equal fields are equal bytes.
constexpr std::string_view uuid = "e5ba11e2-0000-4000-8000-000000000000";
constexpr std::size_t uuid_at = 21;  // magic number, file version, library version, flag for grid offsets

// OpenVDB's own File does not notice a full disk; this archive is written to memory.
class MemoryArchive final : public openvdb::io::Archive {
public:
    std::string text(const openvdb::GridBase::ConstPtr& grid) const {
        std::ostringstream out(std::ios::binary);
        Archive::write(out, openvdb::GridCPtrVec{grid}, /*seekable=*/true);
        std::string bytes = std::move(out).str();
        bytes.replace(uuid_at, uuid.size(), uuid);
        return bytes;
    }
};

const FieldGrid& grid_of(const Field& field) {
    if (!field.grid || !field.grid->grid) {
        throw RunError(fmt::format("field '{}' has no grid to be recorded", field.name));
    }
    return *field.grid;
}

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
        if (voxels > most_vti_voxels) return true;
    }
    return false;
}

}  // namespace

void write_vdb(const std::filesystem::path& path, const Field& field) {
    initialize_openvdb();
    const openvdb::FloatGrid& grid = *grid_of(field).grid;
    openvdb::MetaMap metadata(grid);
    metadata.insertMeta(openvdb::GridBase::META_GRID_NAME, openvdb::StringMetadata(field.name));
    metadata.insertMeta("unit", openvdb::StringMetadata(field.unit));
    metadata.insertMeta("meaning", openvdb::StringMetadata(field.meaning));
    MemoryArchive archive;
    archive.setCompression(openvdb::io::COMPRESS_BLOSC | openvdb::io::COMPRESS_ACTIVE_MASK);
    std::string bytes;
    try {
        bytes = archive.text(grid.copyGridReplacingMetadata(metadata));
    } catch (const openvdb::Exception& error) {
        throw RunError(fmt::format("cannot write {}: {}", path.string(), error.what()));
    }
    write_text(path, bytes);
}

void write_vti(const std::filesystem::path& path, const Field& field, double time, int step) {
    const FieldGrid& source = grid_of(field);
    const openvdb::CoordBBox box = box_of(source);
    const openvdb::Coord size = box.dim();
    if (too_large(size)) {
        throw RunError(
            fmt::format("field '{}' spans {} x {} x {} voxels, more than the {} a .vti may hold; record it "
                        "as field_files = [\"vdb\"] only",
                        field.name, size.x(), size.y(), size.z(), most_vti_voxels));
    }
    vtkNew<vtkFloatArray> values;
    values->SetName(field.name.c_str());
    values->SetNumberOfTuples(static_cast<vtkIdType>(box.volume()));
    openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ> dense(box, values->GetPointer(0));
    openvdb::tools::copyToDense(*source.grid, dense);

    vtkNew<vtkImageData> image;
    const openvdb::Vec3d origin = source.grid->indexToWorld(box.min());
    const openvdb::Vec3d spacing = source.grid->voxelSize();
    image->SetDimensions(size.x(), size.y(), size.z());
    image->SetOrigin(origin.x(), origin.y(), origin.z());
    image->SetSpacing(spacing.x(), spacing.y(), spacing.z());
    image->GetPointData()->SetScalars(values);
    add_time(*image->GetFieldData(), time, step);
    add_texts(*image->GetFieldData(), "unit", {field.unit});
    add_texts(*image->GetFieldData(), "meaning", {field.meaning});
    write_vtk(path, *image);
}

}  // namespace espalier
