// Wavefront OBJ as its polygons.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::geometry {

struct ObjMesh {
    /// Indices from 0 into the columns below.
    struct Corner {
        std::size_t position;
        std::optional<std::size_t> uv, normal;
    };

    std::vector<glm::dvec3> positions, normals;
    std::vector<glm::dvec2> uvs;
    std::vector<Corner> corners;    ///< corners of all faces, one after another
    std::vector<std::size_t> ends;  ///< where in `corners` each face ends
};

/// Reads v, vt, vn and f, and ignores everything else. Faces name what stands above them. Throws UserError with file,
/// line and column. `name` is the file's.
ObjMesh read_obj_mesh(std::string_view text, const std::string& name);

}  // namespace espalier::geometry
