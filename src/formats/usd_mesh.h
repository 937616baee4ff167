// A mesh that does not change, as a prim of USD.
#pragma once

#include "formats/usd_materials.h"

#include <array>
#include <map>
#include <string>
#include <vector>

namespace espalier::formats::usd {

struct StillMesh {
    const std::vector<std::array<std::uint32_t, 3>>& triangles;
    const std::vector<glm::vec3>&points, &normals;
    const std::vector<glm::vec2>& uvs;
    const std::vector<Rgb>& rgb;                            ///< colours of triangles
    std::map<std::string, std::vector<std::size_t>> faces;  ///< triangles that wear each material
};

/// Appends `def Mesh "name"`, indented by so many blanks.
void append_mesh(std::string& text, const std::string& name, const StillMesh& mesh, std::size_t indent);

}  // namespace espalier::formats::usd
