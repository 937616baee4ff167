// Colour indices, front and back. They stay within their colour map of 256.
#include "espalier/turtle/symbol.h"

#include <cmath>

namespace espalier {
namespace {

constexpr int map_size = 256;

int wrapped(double index) {
    return int(std::fmod(std::fmod(index, map_size) + map_size, map_size));
}

void change_colour(Walk& walk, int& colour, std::span<const double> parameters, int increment) {
    const double index = parameters.empty() ? double(colour) + increment : std::trunc(parameters[0]);
    if (!std::isfinite(index)) walk.fail("a colour index that is not a number");
    colour = colour - wrapped(colour) + wrapped(index);
}

const Symbol next{";",
                  {0, 1},
                  ";(index): set the colour index; without parameter, add the increment",
                  [](Walk& walk, std::span<const double> parameters) {
                      change_colour(walk, walk.turtle.colour, parameters, walk.settings.colour_increment);
                  }};

const Symbol previous{",",
                      {0, 1},
                      ",(index): set the colour index; without parameter, subtract the increment",
                      [](Walk& walk, std::span<const double> parameters) {
                          change_colour(walk, walk.turtle.colour, parameters, -walk.settings.colour_increment);
                      }};

const Symbol next_back{
    "@;", {0, 1}, "@;(index): as ; for the back of surfaces", [](Walk& walk, std::span<const double> parameters) {
        change_colour(walk, walk.turtle.back_colour, parameters, walk.settings.back_colour_increment);
    }};

const Symbol previous_back{
    "@,", {0, 1}, "@,(index): as , for the back of surfaces", [](Walk& walk, std::span<const double> parameters) {
        change_colour(walk, walk.turtle.back_colour, parameters, -walk.settings.back_colour_increment);
    }};

}  // namespace
}  // namespace espalier
