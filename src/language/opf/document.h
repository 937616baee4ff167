// The Open Plant Format of the AMAP programs (Griffon & de Coligny 2014): a plant as nested elements with meshes.
#pragma once

#include "espalier/base/error.h"
#include "espalier/language/measured_plants.h"

#include <glm/mat4x3.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace espalier::language::measured {
class Notes;
}

namespace espalier::language::opf {

constexpr std::uint32_t none = 0xFFFFFFFF;

struct Mesh {
    MeasuredMesh shape;
    glm::dvec3 lower{0}, upper{0};
    bool is_scaled = false;  ///< dUp and dDwn multiply it across

    /// As thick one way as the other, about the x axis, along which it runs: a piece of an axis.
    bool is_tube() const;
};

struct Entity {
    std::string label;            ///< class and number
    char relation = '/';          ///< / is a part of, < follows, + is borne by what it stands in
    std::uint32_t inside = none;  ///< the entity it stands in
    int scale = 0;
    std::optional<std::uint32_t> mesh;
    glm::dmat4x3 place{1};        ///< of its mesh, in the file's unit
    double upper = 1, lower = 1;  ///< factors across, at its end and at its beginning
    Place at;
};

struct Document {
    std::vector<Mesh> meshes;
    std::vector<Entity> entities;  ///< each after the one it stands in
};

/// Throws UserError with the place of a mistake.
Document read(std::string text, const std::string& name, measured::Notes& notes);

}  // namespace espalier::language::opf
