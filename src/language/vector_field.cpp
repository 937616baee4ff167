#include "language/vector_field.h"

#include "language/parser/expressions.h"
#include "language/parser/names.h"
#include "language/parser/scanner.h"
#include "lsystem/programs/constant.h"

#include <cmath>

namespace espalier::language {
namespace {

std::array<Expression, 3> read_components(std::string_view text) {
    const std::set<std::string> no_macros;
    Sources sources;
    sources.add("", "");
    Mistakes mistakes(sources);
    LSystem system;
    Names names(sources, mistakes, no_macros);
    names.begin(system);
    names.set_constants_only(true);
    names.set_formals(&VectorField::coordinates());
    MappedText mapped;
    mapped.append_at(text, {});
    Scanner in(mapped);
    ExpressionParser parser(in, names, mistakes, Arithmetic::double_precision);
    std::array<Expression, 3> components;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (axis > 0) in.expect(",", "between the components of a field: x, y, z");
        components[axis] = parser.expression();
    }
    if (!in.at_end()) in.expected("the end of the field");
    if (!mistakes.none()) throw SyntaxError{{}, mistakes.errors().front().message};
    return components;
}

}  // namespace

const std::vector<std::string>& VectorField::coordinates() {
    static const std::vector<std::string> names{"x", "y", "z"};
    return names;
}

VectorField VectorField::parse(std::string_view text) {
    VectorField field;
    try {
        field.components_ = read_components(text);
    } catch (const SyntaxError& mistake) {
        throw UserError(mistake.message);
    }
    // What has a value nowhere, as a random number has none, is told now.
    for (const glm::dvec3& place : {glm::dvec3(0.3, 0.5, 0.7), glm::dvec3(-3, 2, -5), glm::dvec3(40, 70, 90)}) {
        if (field.at(place)) return field;
    }
    throw UserError("its components must be functions of x, y and z alone");
}

std::optional<glm::dvec3> VectorField::at(const glm::dvec3& position) const {
    const std::array<double, 3> formals{position.x, position.y, position.z};
    glm::dvec3 vector;
    for (int axis = 0; axis < 3; ++axis) {
        const std::optional<double> value =
            lsystem::constant_value(components_[static_cast<std::size_t>(axis)], Arithmetic::double_precision, formals);
        if (!value || !std::isfinite(*value)) return std::nullopt;
        vector[axis] = *value;
    }
    return vector;
}

}  // namespace espalier::language
