// The fields as OpenVDB files.
#include "espalier/base/error.h"
#include "espalier/formats/exporter.h"
#include "espalier/geometry/openvdb_grid.h"

#include "archive/field_reader.h"
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
                write(job, *frame, name, file);
                ++written;
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
    static void write(const ExportJob& job, const RecordedFrame& frame, const std::string& name,
                      const std::filesystem::path& file) {
        Field field = read_grid(file, name);
        openvdb::FloatGrid& grid = *field.grid->grid;
        if (job.options.up == 'z') grid.transform().postRotate(std::numbers::pi / 2, openvdb::math::X_AXIS);
        const auto path = job.path(frame, name + ".vdb");
        write_vdb(path, field);
        job.report({path, 0, 0, static_cast<std::size_t>(grid.activeVoxelCount()), "active voxels"});
    }
};

const Registered<ExporterType> entry{
    {"vdb", "the recorded fields as OpenVDB grids, a file per frame and field",
     "The grid bears the field's name, with unit and meaning; equal fields give equal bytes.\n"
     "Blender and Houdini open it beside a mesh of the same frame",
     construct<Vdb>, /*of_fields=*/true}};

}  // namespace
}  // namespace espalier::formats
