// A vector for every place: by three expressions in x, y and z, or from the fields of an environment.
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
    enum class Kind {
        expressions,  ///< "-z, 0, x"
        gradient,     ///< "gradient(light)"
        components,   ///< "vector(wind)", of the fields wind.x, wind.y and wind.z
    };

    /// Throws UserError without a place.
    static VectorField parse(std::string_view text);
    /// Length of "gradient(light)" or "vector(wind)" at the beginning of a text, 0 if none stands there.
    static std::size_t length_of_reading(std::string_view text);
    /// The names that a field reads.
    static const std::vector<std::string>& coordinates();

    Kind kind() const { return kind_; }
    /// The fields of processes that are read: one for a gradient, three for components.
    const std::vector<std::string>& fields() const { return fields_; }

    /// Returns the vector of expressions at a place; nothing where an expression has no finite value.
    std::optional<glm::dvec3> at(const glm::dvec3& position) const;

private:
    Kind kind_ = Kind::expressions;
    std::array<Expression, 3> components_;
    std::vector<std::string> fields_;
};

}  // namespace espalier::language
