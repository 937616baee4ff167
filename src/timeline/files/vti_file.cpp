#include "timeline/files/vti_file.h"

#include "base/text.h"
#include "base/xml_text.h"
#include "geometry/grid_operations.h"
#include "timeline/files/vtk_file.h"

#include <fmt/format.h>

namespace espalier::timeline {

namespace {

std::string numbers(const glm::dvec3& vector) {
    return fmt::format("{} {} {}", format_exact(vector.x), format_exact(vector.y), format_exact(vector.z));
}

}  // namespace

void write_vti(const std::filesystem::path& path, const Field& field, double time, int step, Compression compression) {
    const DenseField dense = grid_operations().dense(field);
    const glm::ivec3& size = dense.size;
    const std::string extent = fmt::format("0 {} 0 {} 0 {}", size.x - 1, size.y - 1, size.z - 1);
    VtkFile file(compression);
    file.begin("ImageData");
    file.open("ImageData", fmt::format(R"(WholeExtent="{}" Origin="{}" Spacing="{}" Direction="1 0 0 0 1 0 0 0 1")",
                                       extent, numbers(dense.origin), numbers(dense.spacing)));
    file.open("FieldData");
    file.add_time(time, step);
    file.add_texts("unit", {field.unit});
    file.add_texts("meaning", {field.meaning});
    file.close();
    file.open("Piece", fmt::format(R"(Extent="{}")", extent));
    file.open("PointData", fmt::format(R"(Scalars="{}")", xml_text(field.name)));
    file.add(data_array<float>(field.name, dense.values));
    file.write(path);
}

}  // namespace espalier::timeline
