// Colour indices, front and back, which stay within their colour map of 256; and the texture.
#include "espalier/turtle/symbol.h"

#include <cmath>

namespace espalier::turtle {
namespace {

constexpr int map_size = 256;

int wrapped(double index) {
    if (index >= 0 && index < map_size) return int(index);
    return int(std::fmod(std::fmod(index, map_size) + map_size, map_size));
}

void change_colour(Walk& walk, int& colour, std::span<const double> parameters, int increment) {
    const double index = parameters.empty() ? double(colour) + increment : std::trunc(parameters[0]);
    if (!std::isfinite(index)) walk.fail("a colour index that is not a number");
    colour = colour - wrapped(colour) + wrapped(index);
}

/// The back has no colour of its own until it is set; cpfg counts from 128 then.
void change_back(Walk& walk, std::span<const double> parameters, int increment) {
    int back = walk.turtle().back_colour < 0 ? 128 : walk.turtle().back_colour;
    change_colour(walk, back, parameters, increment);
    walk.turtle().back_colour = back;
}

const Registered<Symbol> next{{";",
                               {},
                               ";(index): set the colour index; without parameter, add the increment",
                               [](Walk& walk, std::span<const double> parameters) {
                                   change_colour(walk, walk.turtle().colour, parameters,
                                                 walk.settings().colour_increment);
                               }}};

const Registered<Symbol> previous{{",",
                                   {},
                                   ",(index): set the colour index; without parameter, subtract the increment",
                                   [](Walk& walk, std::span<const double> parameters) {
                                       change_colour(walk, walk.turtle().colour, parameters,
                                                     -walk.settings().colour_increment);
                                   }}};

const Registered<Symbol> next_back{
    {"@;", {}, "@;(index): as ; for the back of surfaces", [](Walk& walk, std::span<const double> parameters) {
         change_back(walk, parameters, walk.settings().back_colour_increment);
     }}};

const Registered<Symbol> previous_back{
    {"@,", {}, "@,(index): as , for the back of surfaces", [](Walk& walk, std::span<const double> parameters) {
         change_back(walk, parameters, -walk.settings().back_colour_increment);
     }}};

const Registered<Symbol> texture{{"@Tx",
                                  {1},
                                  "@Tx(number): the texture of surfaces and cylinders from here on; 0 is none",
                                  [](Walk& walk, std::span<const double> parameters) {
                                      const bool possible = parameters[0] >= 0 && parameters[0] < 65536;
                                      walk.turtle().texture = possible ? std::uint16_t(parameters[0]) : 0;
                                  }}};

const Registered<SymbolGroup> colour_group{
    {"colour",
     "colours and textures",
     {";", ",", "@;", "@,", "@Tx"},
     "A colour is an index into the colour map or the materials of the plant; it wraps within its map of "
     "256.",
     "axiom: !(0.3) ;(40) F(1) ;(120) F(1) ;(200) F(1)"}};

}  // namespace
}  // namespace espalier::turtle
