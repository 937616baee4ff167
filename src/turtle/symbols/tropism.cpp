// How strongly each tropism acts from here on. Tropisms are counted from 1; another number changes nothing. And turns
// towards a direction or along a field of the model's own.
#include "espalier/turtle/symbol.h"

#include "language/parser/vector_field.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <cmath>
#include <map>
#include <optional>
#include <string>

namespace espalier::turtle {
namespace {

void increase(Walk& walk, std::span<const double> parameters, double sign) {
    double* elasticity = walk.elasticity(parameters[0]);
    if (!elasticity) return walk.ignore(Ignored::tropism);
    const auto index = std::size_t(elasticity - walk.elasticities.data());
    *elasticity += sign * (parameters.size() > 1 ? parameters[1] : walk.settings().tropisms[index].elasticity_step);
}

// The turn of Prusinkiewicz & Lindenmayer 1990, section 2.3, once and now.
void turn_towards(Walk& walk, const glm::dvec3& direction, double strength) {
    Tropism tropism;
    const double length = glm::length(direction);
    if (!std::isfinite(length * strength)) walk.fail("a direction or a strength that is not a number");
    if (length == 0) return;
    tropism.direction = direction / length;
    bend_by_tropisms(walk.turtle().pose, std::span(&tropism, 1), std::span(&strength, 1));
}

/// Fields as each thread has read them, by their text.
const VectorField& field_of(const std::string& text) {
    thread_local std::map<std::string, VectorField> fields;
    const auto known = fields.find(text);
    return known != fields.end() ? known->second : fields.emplace(text, VectorField::parse(text)).first->second;
}

/// Returns the vector of a field that reads those of processes.
glm::dvec3 vector_read(const VectorField& field, const FieldValues& values, const glm::dvec3& place) {
    const std::vector<std::string>& names = field.fields();
    if (field.kind() == VectorField::Kind::gradient) return values.gradient(names[0], place);
    return {values.value(names[0], place), values.value(names[1], place), values.value(names[2], place)};
}

std::optional<glm::dvec3> vector_at(const Walk& walk, const VectorField& field, const glm::dvec3& place) {
    if (field.kind() == VectorField::Kind::expressions) return field.at(place);
    return walk.fields() ? vector_read(field, *walk.fields(), place) : glm::dvec3(0);
}

void turn_along_field(Walk& walk, std::span<const double> parameters) {
    const std::string* text = walk.text(parameters[0]);
    if (!text) walk.fail("the first parameter is the name of a field: 'field NAME = x, y, z;'");
    const std::optional<glm::dvec3> vector = vector_at(walk, field_of(*text), walk.turtle().pose.position);
    if (!vector) walk.fail(fmt::format("the field {} has no value here", *text));
    turn_towards(walk, *vector, parameters[1] * glm::length(*vector));
}

const Registered<Symbol> towards{
    {"@Th",
     {4},
     "@Th(x, y, z, strength): turn the heading towards (x, y, z) by strength times the sine of the angle between, in "
     "radians, at most 1",
     [](Walk& walk, std::span<const double> parameters) {
         turn_towards(walk, {parameters[0], parameters[1], parameters[2]}, parameters[3]);
     }}};

const Registered<Symbol> along_field{
    {"@Tv",
     {2},
     "@Tv(field, strength): the same towards the vector of a field at the turtle, the more, the longer it is",
     turn_along_field}};

const Registered<Symbol> set_elasticity{
    {"@Ts", {2}, "@Ts(tropism, elasticity): set the elasticity", [](Walk& walk, std::span<const double> parameters) {
         double* const elasticity = walk.elasticity(parameters[0]);
         elasticity ? void(*elasticity = parameters[1]) : walk.ignore(Ignored::tropism);
     }}};

const Registered<Symbol> more{{"@Ti",
                               {1, 2},
                               "@Ti(tropism, amount): increase the elasticity; by the tropism's step without amount",
                               [](Walk& walk, std::span<const double> parameters) { increase(walk, parameters, 1); }}};

const Registered<Symbol> less{{"@Td",
                               {1, 2},
                               "@Td(tropism, amount): decrease the elasticity; by the tropism's step without amount",
                               [](Walk& walk, std::span<const double> parameters) { increase(walk, parameters, -1); }}};

const Registered<Symbol> more_shortly{
    {"@T", {2}, "@T(tropism, amount): the same as @Ti", [](Walk& walk, std::span<const double> parameters) {
         increase(walk, parameters, 1);
     }}};

const Registered<Symbol> older{
    {"_",
     {},
     "_(elasticity): set the elasticity of the older tropism; without parameter, add its increment",
     [](Walk& walk, std::span<const double> parameters) {
         double& elasticity = walk.turtle().elasticity;
         elasticity = parameters.empty() ? elasticity + walk.settings().elasticity_increment : parameters[0];
     }}};

const Registered<SymbolGroup> tropism_group{
    {"tropism",
     "bends the turtle",
     {"@Ts", "@Ti", "@Td", "@T", "@Th", "@Tv", "_"},
     "Tropisms are numbered from 1, in the order of the view file or of the scene. Before each drawn "
     "segment the heading turns towards the tropism by its elasticity times the sine of the angle between, "
     "in radians.\n"
     "A negative strength turns away. The older tropism acts after every move.",
     "axiom: !(0.06) +(80) F(1) @Th(0, 1, 0, 0.5) F(1) @Th(0, 1, 0, 0.5) F(1) @Th(0, 1, 0, 0.5) F(1)"}};

}  // namespace
}  // namespace espalier::turtle
