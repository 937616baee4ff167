// The fields as OpenVDB files.
#include "espalier/base/error.h"
#include "espalier/formats/exporter.h"
#include "espalier/geometry/openvdb_grid.h"

#include "archive/field_reader.h"
#include "formats/map_place.h"
#include "geometry/grids/grid_file.h"

#include <fmt/format.h>

#include <numbers>

namespace espalier::formats {
namespace {

class Vdb final : public Exporter {
public:
    std::string extension() const override { return "vdb"; }

    void write(const ExportJob& job) const override {
        std::size_t written = 0;
        for (const RecordedFrame* frame : job.frames) {
            for (const auto& [name, file] : frame->fields) {
                const bool lies = written++ == 0 && job.beside_meshes && job.options.up == 'y';
                write(job, *frame, name, file, lies ? lies_in_blender : "");
            }
        }
        if (written == 0) {
            throw UserError(
                fmt::format("{} holds no fields of these frames: fields = [\"all\"] under [timeline] "
                            "records them",
                            job.run.folder().string()));
        }
    }

private:
    static constexpr const char* lies_in_blender =
        "Blender turns the meshes of glTF, OBJ and USD upright, but no volume: for it, write the fields with --format "
        "vdb "
        "--up z --voxel-corners";

    static void write(const ExportJob& job, const RecordedFrame& frame, const std::string& name,
                      const std::filesystem::path& file, const std::string& hint) {
        Field field = read_grid(file, name);
        openvdb::FloatGrid& grid = *field.grid->grid;
        if (job.voxel_corners) grid.transform().preTranslate(openvdb::Vec3d(-0.5));
        if (job.options.up == 'z') grid.transform().postRotate(std::numbers::pi / 2, openvdb::math::X_AXIS);
        if (const std::optional<glm::dvec3> origin = origin_of(job.run, job.options.up)) {
            grid.insertMeta("origin", openvdb::Vec3DMetadata(openvdb::Vec3d(origin->x, origin->y, origin->z)));
        }
        const auto path = job.path(frame, name + ".vdb");
        write_vdb(path, field);
        job.report({path, 0, 0, static_cast<std::size_t>(grid.activeVoxelCount()), "active voxels", hint});
    }
};

const Registered<ExporterType> entry{
    {"vdb", "the recorded fields as OpenVDB grids, a file per frame and field",
     "The grid bears the field's name, with unit and meaning; equal fields give equal bytes. Houdini opens it beside "
     "a\n"
     "mesh of the same frame. So does Blender with --up z, as it turns meshes from y up to z up but no volumes, and "
     "with\n"
     "--voxel-corners, as it draws the value of a voxel half a voxel beyond its centre",
     construct<Vdb>, /*of_fields=*/true}};

}  // namespace
}  // namespace espalier::formats
