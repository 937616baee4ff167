// How strongly each tropism acts from here on. Tropisms are counted from 1; another number changes nothing.
#include "espalier/turtle/symbol.h"

namespace espalier::turtle {
namespace {

void increase(Walk& walk, std::span<const double> parameters, double sign) {
    double* elasticity = walk.elasticity(parameters[0]);
    if (!elasticity) return;
    const auto index = std::size_t(elasticity - walk.elasticities.data());
    *elasticity += sign * (parameters.size() > 1 ? parameters[1] : walk.settings().tropisms[index].elasticity_step);
}

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
