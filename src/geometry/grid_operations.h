// What is done with the grids of fields, for everything that does without OpenVDB itself. OpenVDB takes 30 ms to load:
// the library that needs it is opened when it is first asked for.
#pragma once

#include "espalier/base/column.h"
#include "espalier/geometry/field.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace espalier::geometry {

/// A value at every voxel's centre, x fastest, in a box.
struct DenseField {
    glm::ivec3 size;
    glm::dvec3 origin;   ///< the centre of the first voxel, metres
    glm::dvec3 spacing;  ///< metres
    Column<float> values;
};

struct GridOperations {
    bool (*has_values)(const FieldGrid&);
    /// Linear between the centres of voxels.
    double (*value)(const FieldGrid&, const glm::dvec3& position);
    /// Per metre, by differences over two voxels.
    glm::dvec3 (*gradient)(const FieldGrid&, const glm::dvec3& position);
    /// Over the field's box. Throws RunError if it has more than `most_dense_voxels`.
    DenseField (*dense)(const Field&);
    // As in geometry/grids/grid_file.h.
    bool (*same)(const FieldGrid&, const FieldGrid&);
    std::uint64_t (*digest)(const FieldGrid&);
    std::string (*bytes)(const FieldGrid&);
    std::shared_ptr<const FieldGrid> (*from_bytes)(const std::string&);
    void (*write_vdb)(const std::filesystem::path&, const Field&);
};

/// Opens the library of grids and of the processes that make them, unless it is open: processes are registered then.
/// Throws RunError if it is not beside the library that this is part of.
void open_grid_library();

/// Opens it, too.
const GridOperations& grid_operations();

/// Tells the program what the library of grids can do.
struct GridLibrary {
    explicit GridLibrary(const GridOperations& operations);
};

}  // namespace espalier::geometry
