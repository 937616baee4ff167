#include "language/parser/vector_field.h"

#include "base/characters.h"
#include "language/parser/expressions.h"
#include "language/parser/names.h"
#include "language/parser/scanner.h"
#include "lsystem/programs/constant.h"

#include <algorithm>
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

/// The two ways to read fields of processes, each with a name in parentheses.
constexpr std::string_view gradient = "gradient", components = "vector";

std::size_t skip_blanks(std::string_view text, std::size_t k) {
    while (k < text.size() && is_blank(text[k])) ++k;
    return k;
}

/// What would end the name, begin a comment or could not be shown is no part of it.
bool is_in_field_names(char c) {
    return static_cast<unsigned char>(c) >= ' ' && c != '\x7f' &&
           std::string_view("/\\\";#").find(c) == std::string_view::npos;
}

/// The word before the parentheses, and the name between them; nothing if the text does not begin like this.
struct Reading {
    std::string_view word, name;
    std::size_t length;
};

std::optional<Reading> reading_at(std::string_view text) {
    for (const std::string_view word : {gradient, components}) {
        const std::size_t open = text.starts_with(word) ? skip_blanks(text, word.size()) : text.size();
        if (open >= text.size() || text[open] != '(') continue;
        const std::size_t begin = skip_blanks(text, open + 1), close = text.find_first_of("()\n", begin);
        if (close == text.npos || text[close] != ')') continue;
        std::size_t end = close;
        while (end > begin && is_blank(text[end - 1])) --end;
        const std::string_view name = text.substr(begin, end - begin);
        if (!name.empty() && std::all_of(name.begin(), name.end(), is_in_field_names)) {
            return Reading{word, name, close + 1};
        }
    }
    return std::nullopt;
}

}  // namespace

std::size_t VectorField::length_of_reading(std::string_view text) {
    const std::optional<Reading> reading = reading_at(text);
    return reading ? reading->length : 0;
}

const std::vector<std::string>& VectorField::coordinates() {
    static const std::vector<std::string> names{"x", "y", "z"};
    return names;
}

VectorField VectorField::parse(std::string_view text) {
    VectorField field;
    const std::optional<Reading> reading = reading_at(text);
    if (reading && skip_blanks(text, reading->length) == text.size()) {
        const std::string name(reading->name);
        field.kind_ = reading->word == gradient ? Kind::gradient : Kind::components;
        field.fields_ = field.kind_ == Kind::gradient ? std::vector<std::string>{name}
                                                      : std::vector<std::string>{name + ".x", name + ".y", name + ".z"};
        return field;
    }
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
