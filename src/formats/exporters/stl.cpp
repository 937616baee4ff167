// Binary STL: the triangles alone. Tubes are closed; leaves are as thin as they were recorded.
#include "espalier/base/error.h"
#include "espalier/formats/exporter.h"

#include "archive/meshes/surface_mesh.h"
#include "formats/bytes.h"
#include "formats/mesh_files.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <limits>

namespace espalier::formats {
namespace {

constexpr std::size_t header_size = 80, triangle_size = 50;

std::string stl(const FrameMesh& mesh) {
    if (mesh.triangles.size() > std::numeric_limits<std::uint32_t>::max()) {
        throw RunError(
            "an STL holds no more than 2^32 triangles; fewer --sides or a larger --simplify make it smaller");
    }
    std::string bytes = "made by espalier; metres";
    bytes.reserve(header_size + 4 + triangle_size * mesh.triangles.size());
    bytes.resize(header_size, ' ');
    append_bytes(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
    for (const auto& [a, b, c] : mesh.triangles) {
        const glm::vec3 &p = mesh.points[a], &q = mesh.points[b], &r = mesh.points[c];
        const glm::vec3 across = glm::cross(q - p, r - p);
        const float length = glm::length(across);
        append_bytes(bytes, length > 0 ? across / length : glm::vec3(0));
        for (const glm::vec3& corner : {p, q, r}) append_bytes(bytes, corner);
        append_bytes(bytes, std::uint16_t{0});
    }
    return bytes;
}

class Stl final : public Exporter {
public:
    std::string extension() const override { return "stl"; }

    void write(const ExportJob& job) const override { write_meshes(job, extension(), false, stl); }
};

const Registered<ExporterType> entry{
    {"stl", "binary STL, a file per frame: for printing and meshing",
     "Triangles alone; tubes are closed and may be printed, leaves have no thickness.\n"
     "Lost: everything but the shape; which plant and organ a triangle belongs to",
     construct<Stl>}};

}  // namespace
}  // namespace espalier::formats
