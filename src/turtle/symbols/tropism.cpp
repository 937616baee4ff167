// How strongly each tropism acts from here on. Tropisms are counted from 1; another number changes nothing. And one
// turn towards a direction of the model's own.
#include "espalier/turtle/symbol.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace espalier::turtle {
namespace {

void increase(Walk& walk, std::span<const double> parameters, double sign) {
    double* elasticity = walk.elasticity(parameters[0]);
    if (!elasticity) return;
    const auto index = std::size_t(elasticity - walk.elasticities.data());
    *elasticity += sign * (parameters.size() > 1 ? parameters[1] : walk.settings().tropisms[index].elasticity_step);
}

// The turn of Prusinkiewicz & Lindenmayer 1990, section 2.3, once and now.
void turn_towards(Walk& walk, std::span<const double> parameters) {
    Tropism tropism;
    tropism.direction = {parameters[0], parameters[1], parameters[2]};
    const double length = glm::length(tropism.direction);
    if (!std::isfinite(length * parameters[3])) walk.fail("a direction or a strength that is not a number");
    if (length == 0) return;
    tropism.direction /= length;
    bend_by_tropisms(walk.turtle().pose, std::span(&tropism, 1), parameters.subspan(3, 1));
}

const Registered<Symbol> towards{
    {"@Th",
     {4},
     "@Th(x, y, z, strength): turn the heading towards (x, y, z) by strength times the sine of the angle between, in "
     "radians, at most 1",
     turn_towards}};

const Registered<Symbol> set{
    {"@Ts", {2}, "@Ts(tropism, elasticity): set the elasticity", [](Walk& walk, std::span<const double> parameters) {
         if (double* elasticity = walk.elasticity(parameters[0])) *elasticity = parameters[1];
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

}  // namespace
}  // namespace espalier::turtle
