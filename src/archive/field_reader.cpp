#include "archive/field_reader.h"

#include "espalier/base/file.h"
#include "espalier/geometry/openvdb_grid.h"

#include "archive/vtk_xml.h"
#include "geometry/grids/grid_file.h"
#include "geometry/grids/vdb_file.h"

#include <openvdb/tools/Dense.h>

#include <cmath>
#include <fstream>
#include <sstream>

namespace espalier::archive {
namespace {

/// Exactly `count` numbers between blanks.
std::vector<double> numbers(const VtkXmlFile& file, const XmlElement& element, std::string_view attribute,
                            std::size_t count) {
    std::istringstream in(element.attribute(attribute));
    std::vector<double> result;
    for (double value = 0; in >> value;) result.push_back(value);
    const auto bad = [](double value) { return !std::isfinite(value) || std::abs(value) > 1e15; };
    if (result.size() != count || std::any_of(result.begin(), result.end(), bad)) {
        file.fail(fmt::format("'{}' is not {} numbers", attribute, count));
    }
    return result;
}

std::string text_or_none(const VtkXmlFile& file, std::string_view name) {
    const std::vector<std::string> texts = file.texts(name);
    return texts.empty() ? "" : texts.front();
}

RecordedField read_vti(const std::filesystem::path& path, const std::string& name) {
    const VtkXmlFile file(path, "ImageData");
    const XmlElement& image = file.data_set();
    const std::vector<double> extent = numbers(file, image, "WholeExtent", 6);
    const std::vector<double> origin = numbers(file, image, "Origin", 3);
    const std::vector<double> spacing = numbers(file, image, "Spacing", 3);
    RecordedField field{name, text_or_none(file, "unit"), text_or_none(file, "meaning"), {}, {}, {}, {}};
    double voxels = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const auto k = static_cast<std::size_t>(axis);
        const double size = extent[2 * k + 1] - extent[2 * k] + 1;
        voxels *= size;
        if (size < 1 || spacing[k] <= 0 || voxels > double(most_dense_voxels)) file.fail("its extent cannot be right");
        field.size[axis] = static_cast<int>(size);
        field.voxel[axis] = spacing[k];
        field.origin[axis] = origin[k] + extent[2 * k] * spacing[k];
    }
    field.values = file.values<float>(file.child(file.piece(), "PointData"), name, static_cast<std::size_t>(voxels));
    return field;
}

std::string metadata(const openvdb::GridBase& grid, const char* name) {
    const auto text = grid.getMetadata<openvdb::StringMetadata>(name);
    return text ? text->value() : "";
}

openvdb::FloatGrid::Ptr open_grid(const std::filesystem::path& path, const std::string& name) {
    require_readable(path);
    try {
        std::ifstream in(path, std::ios::binary);
        geometry::VdbFile file(in, geometry::memory_for_grids());
        if (auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(file.read(name))) return grid;
    } catch (const geometry::VdbError& error) {
        throw UserError(fmt::format("{} is damaged: {}", path.string(), error.what()));
    } catch (const openvdb::Exception& error) {
        throw UserError(fmt::format("{} is damaged: {}", path.string(), error.what()));
    }
    throw UserError(fmt::format("{} is damaged: grid '{}' is not of floats", path.string(), name));
}

RecordedField read_vdb(const std::filesystem::path& path, const std::string& name) {
    const openvdb::FloatGrid::Ptr grid = open_grid(path, name);
    openvdb::CoordBBox box = grid->evalActiveVoxelBoundingBox();
    if (box.empty()) box = {openvdb::Coord(0), openvdb::Coord(0)};
    const openvdb::Coord size = box.dim();
    if (double(size.x()) * size.y() * size.z() > double(most_dense_voxels)) {
        throw UserError(fmt::format("the active voxels of {} span {} x {} x {}, too many to be read at once",
                                    path.string(), size.x(), size.y(), size.z()));
    }
    const openvdb::Vec3d origin = grid->indexToWorld(box.min()), voxel = grid->voxelSize();
    RecordedField field{name,
                        metadata(*grid, "unit"),
                        metadata(*grid, "meaning"),
                        {size.x(), size.y(), size.z()},
                        {origin.x(), origin.y(), origin.z()},
                        {voxel.x(), voxel.y(), voxel.z()},
                        {}};
    field.values.resize(box.volume());
    openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ> dense(box, field.values.data());
    openvdb::tools::copyToDense(*grid, dense);
    return field;
}

}  // namespace

Field read_grid(const std::filesystem::path& path, const std::string& name) {
    auto held = std::make_shared<FieldGrid>();
    if (path.extension() == ".vdb") {
        held->grid = open_grid(path, name);
        held->box = held->grid->evalActiveVoxelBoundingBox();
        return {name, metadata(*held->grid, "unit"), metadata(*held->grid, "meaning"), held};
    }
    initialize_openvdb();
    RecordedField field = read_vti(path, name);
    held->box = {openvdb::Coord(0), openvdb::Coord(field.size.x - 1, field.size.y - 1, field.size.z - 1)};
    held->grid = openvdb::FloatGrid::create();
    auto transform = openvdb::math::Transform::createLinearTransform();
    transform->postScale({field.voxel.x, field.voxel.y, field.voxel.z});
    transform->postTranslate({field.origin.x, field.origin.y, field.origin.z});
    held->grid->setTransform(transform);
    const openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ> dense(held->box, field.values.data());
    openvdb::tools::copyFromDense(dense, *held->grid, 0.0f);
    return {name, field.unit, field.meaning, held};
}

RecordedField read_field(const std::filesystem::path& path, const std::string& name) {
    return path.extension() == ".vdb" ? read_vdb(path, name) : read_vti(path, name);
}

}  // namespace espalier::archive
