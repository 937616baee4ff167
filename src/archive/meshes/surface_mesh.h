// A frame as triangles: axes swept into closed tubes, and the surfaces as they were recorded.
#pragma once

#include "espalier/archive/mesh_options.h"
#include "espalier/archive/recorded_run.h"

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace espalier::archive {

using Rgb = std::array<std::uint8_t, 3>;

struct MeshMaterial {
    Rgb rgb{255, 255, 255};
    std::string texture;  ///< a file, or ""

    bool operator==(const MeshMaterial&) const = default;
    bool operator<(const MeshMaterial& other) const {
        return std::tie(rgb, texture) < std::tie(other.rgb, other.texture);
    }
};

/// An axis or an organ: triangles that follow each other, with vertices of their own.
struct MeshPart {
    Kind kind;
    std::uint32_t plant;
    std::uint64_t identity;
    std::string symbol;
    std::size_t first_vertex = 0, vertices = 0;
    std::size_t first_triangle = 0, triangles = 0;
};

struct FrameMesh {
    std::vector<glm::vec3> points, normals;
    std::vector<glm::vec2> uvs;
    std::vector<Rgb> rgb;  ///< colours of vertices
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::uint32_t> material_of;  ///< material of each triangle
    std::vector<MeshMaterial> materials;
    std::vector<MeshPart> parts;  ///< plant after plant
};

/// A vector of the timeline, whose vertical is y, in the axes that were asked for.
inline glm::vec3 upright(const glm::vec3& v, char up) {
    return up == 'z' ? glm::vec3(v.x, -v.z, v.y) : v;
}

/// The colour of a row, as the plant's colour map said; where none did, brown wood and green organs.
Rgb colour_of(const FrameAttributes& attributes, std::size_t row);

/// Tubes or skin, and surfaces, of the plants asked for. Throws RunError beyond 2^31 vertices, UserError as
/// `skin_voxel` does. `triangles` says nothing about a skin.
FrameMesh mesh_of(const FrameGeometry& geometry, const MeshOptions& options);
/// The tubes alone.
FrameMesh tubes_of(const FrameGeometry& geometry, const MeshOptions& options);
/// The surfaces alone.
FrameMesh surfaces_of(const FrameGeometry& geometry, const MeshOptions& options);

/// Each plant's parts with vertices of their own; materials keep their numbers.
std::map<std::uint32_t, FrameMesh> by_plant(const FrameMesh& mesh);

/// The radius given to lines that have none, and half a pixel of those whose widths are given so: a thousandth of the
/// diagonal of the frame.
float thinnest_radius(const FrameGeometry& geometry);

/// "left_axis_12": the plant's name, what it is and a number; letters that formats take for something else become '_'.
std::string part_name(const RecordedRun& run, const MeshPart& part, std::size_t number);

}  // namespace espalier::archive
