// Binary PLY: vertices with normal, texture coordinates and colour; triangles with plant and part.
#include "espalier/formats/exporter.h"

#include "archive/meshes/surface_mesh.h"
#include "formats/bytes.h"
#include "formats/map_place.h"
#include "formats/mesh_files.h"

#include <fmt/format.h>

namespace espalier::formats {
namespace {

std::string header(const FrameMesh& mesh, const ExportJob& job) {
    return fmt::format(
        "ply\nformat binary_little_endian 1.0\ncomment made by espalier; metres\n{}element vertex {}\n"
        "property float x\nproperty float y\nproperty float z\n"
        "property float nx\nproperty float ny\nproperty float nz\n"
        "property float s\nproperty float t\n"
        "property uchar red\nproperty uchar green\nproperty uchar blue\n"
        "element face {}\nproperty list uchar int vertex_indices\nproperty int plant\nproperty int part\nend_header\n",
        origin_line("comment ", job.run, job.options.up), mesh.points.size(), mesh.triangles.size());
}

std::string ply(const FrameMesh& mesh, const ExportJob& job) {
    std::string bytes = header(mesh, job);
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        append_bytes(bytes, mesh.points[i]);
        append_bytes(bytes, mesh.normals[i]);
        append_bytes(bytes, mesh.uvs[i]);
        append_bytes(bytes, mesh.rgb[i]);
    }
    for (std::size_t number = 0; number < mesh.parts.size(); ++number) {
        const MeshPart& part = mesh.parts[number];
        for (std::size_t i = 0; i < part.triangles; ++i) {
            append_bytes(bytes, std::uint8_t{3});
            append_bytes(bytes, mesh.triangles[part.first_triangle + i]);
            append_bytes(bytes, part.plant);
            append_bytes(bytes, static_cast<std::uint32_t>(number));
        }
    }
    return bytes;
}

class Ply final : public Exporter {
public:
    std::string extension() const override { return "ply"; }

    void write(const ExportJob& job) const override {
        write_meshes(job, extension(), true, [&](const FrameMesh& mesh) { return ply(mesh, job); });
    }
};

const Registered<ExporterType> entry{
    {"ply", "binary PLY, a file per frame: for MeshLab, CloudCompare and scripts",
     "Vertices with normal, texture coordinates s, t and colour; triangles with the numbers of their plant and part.\n"
     "Lost: time, identities, parameters, textures",
     construct<Ply>}};

}  // namespace
}  // namespace espalier::formats
