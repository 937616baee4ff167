// Fields as arrays of numpy.
#include "espalier/geometry/openvdb_grid.h"

#include "python/bindings.h"

#include <openvdb/tools/Dense.h>
#include <openvdb/tools/Interpolation.h>

namespace espalier::python {

namespace {

using Points = py::array_t<double, py::array::c_style | py::array::forcecast>;

struct BoundField {
    Field field;
    std::shared_ptr<const FieldGrid> grid;

    std::array<double, 3> voxel() const {
        const openvdb::Vec3d size = grid->grid->voxelSize();
        return {size.x(), size.y(), size.z()};
    }
    std::array<double, 3> origin() const {
        const openvdb::Vec3d corner = grid->grid->indexToWorld(grid->box.min().asVec3d() - openvdb::Vec3d(0.5));
        return {corner.x(), corner.y(), corner.z()};
    }
};

py::array_t<float> values(const BoundField& bound) {
    const openvdb::Coord size = bound.grid->box.dim();
    py::array_t<float> array(std::vector<py::ssize_t>{size.x(), size.y(), size.z()});
    if (bound.grid->box.empty()) return array;
    openvdb::tools::Dense<float> dense(bound.grid->box, array.mutable_data());
    openvdb::tools::copyToDense(*bound.grid->grid, dense);
    return array;
}

py::array_t<double> at(const BoundField& bound, const Points& points) {
    if (points.ndim() != 2 || points.shape(1) != 3) throw UserError("points are an array of shape (n, 3), metres");
    const auto rows = points.unchecked<2>();
    py::array_t<double> sampled(rows.shape(0));
    const openvdb::tools::GridSampler<openvdb::FloatGrid, openvdb::tools::BoxSampler> sampler(*bound.grid->grid);
    for (py::ssize_t i = 0; i < rows.shape(0); ++i) {
        sampled.mutable_at(i) = sampler.wsSample({rows(i, 0), rows(i, 1), rows(i, 2)});
    }
    return sampled;
}

std::string shown(const BoundField& bound) {
    const openvdb::Coord size = bound.grid->box.dim();
    return "Field '" + bound.field.name + "': " + std::to_string(size.x()) + " x " + std::to_string(size.y()) + " x " +
           std::to_string(size.z()) + " voxels, " + (bound.field.unit.empty() ? "1" : bound.field.unit);
}

}  // namespace

py::object field_of(const Fields& fields, const std::string& name) {
    const Field& field = fields.need(name);
    return py::cast(BoundField{field, field.current ? field.current() : field.grid});
}

void bind_field(py::module_& module) {
    py::class_<BoundField>(module, "Field", "A field of one step. It keeps its values when the world goes on.")
        .def_property_readonly(
            "name", [](const BoundField& bound) { return bound.field.name; }, "The name that the scene gives it.")
        .def_property_readonly(
            "unit", [](const BoundField& bound) { return bound.field.unit; }, "The unit of its values; empty: none.")
        .def("__repr__", shown)
        .def_property_readonly("values", values, "Values of the active box, float32 (nx, ny, nz).")
        .def_property_readonly("origin", &BoundField::origin, "Lower corner of the active box, metres.")
        .def_property_readonly("voxel", &BoundField::voxel, "Size of a voxel, metres.")
        .def("at", at, py::arg("points"),
             "Values at points (n, 3) in metres, trilinear between centres of voxels: float64 (n,).");
}

}  // namespace espalier::python
