// STL and PLY as polygons.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace espalier::environment {

struct PolygonMesh {
    std::vector<glm::dvec3> points;
    std::vector<std::int64_t> corners;  ///< corners of all polygons, one after another, counted from 0; not checked
    std::vector<std::size_t> ends;      ///< where in `corners` each polygon ends
};

/// What is wrong with the bytes, for a message that names the file.
class MeshFormatError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

PolygonMesh parse_stl(std::string_view bytes);
PolygonMesh parse_ply(std::string_view bytes);

}  // namespace espalier::environment
