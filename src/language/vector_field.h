// A vector for every place, by three expressions in x, y and z.
#pragma once

#include "espalier/lsystem/expression.h"

#include <glm/vec3.hpp>

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::language {

class VectorField {
public:
    /// "-z, 0, x". Throws UserError without a place.
    static VectorField parse(std::string_view text);
    /// The names that a field reads.
    static const std::vector<std::string>& coordinates();

    /// Nothing where an expression has no finite value.
    std::optional<glm::dvec3> at(const glm::dvec3& position) const;

private:
    std::array<Expression, 3> components_;
};

}  // namespace espalier::language

namespace espalier {

using language::VectorField;

}  // namespace espalier
