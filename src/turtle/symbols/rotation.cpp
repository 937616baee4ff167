// Turning: about up, left and heading, by degrees or by the model's angle; level; absolute heading.
#include "espalier/turtle/symbol.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

namespace espalier::turtle {
namespace {

void set_heading(Walk& walk, std::span<const double> parameters) {
    for (const double parameter : parameters) {
        if (!std::isfinite(parameter)) walk.fail("a heading that is not a number");
    }
    const glm::dvec3 heading(parameters[0], parameters[1], parameters.size() > 2 ? parameters[2] : 0);
    walk.set_heading(heading);
    if (parameters.size() < 4) return;
    if (parameters.size() < 6) return walk.ignore(Ignored::up_vector);
    // An up vector counts only if it is perpendicular to the heading, as in cpfg. One of zeros is none.
    const glm::dvec3 up(parameters[3], parameters[4], parameters[5]);
    const double length = glm::length(up);
    Pose& pose = walk.turtle().pose;
    if (length == 0) return;
    if (std::abs(glm::dot(up / length, pose.heading)) > 1e-9) return walk.ignore(Ignored::up_vector);
    pose.up = up / length;
    pose.left = glm::cross(pose.heading, pose.up);
}

const Registered<Symbol> left{
    {"+",
     {},
     "+(angle): turn left, about up. Degrees",
     [](Walk& walk, std::span<const double> parameters) { turn_left(walk.turtle().pose, walk.rotation(parameters)); },
     Symbol::Effect::other,
     Symbol::Step::left}};

const Registered<Symbol> right{{"-",
                                {},
                                "-(angle): turn right, about up. Degrees",
                                [](Walk& walk, std::span<const double> parameters) {
                                    turn_left(walk.turtle().pose, walk.rotation(parameters).inverse());
                                },
                                Symbol::Effect::other,
                                Symbol::Step::right}};

const Registered<Symbol> down{
    {"&",
     {},
     "&(angle): pitch the heading towards up, about left. Degrees",
     [](Walk& walk, std::span<const double> parameters) { pitch_down(walk.turtle().pose, walk.rotation(parameters)); },
     Symbol::Effect::other,
     Symbol::Step::down}};

const Registered<Symbol> up{{"^",
                             {},
                             "^(angle): pitch the heading away from up, about left. Degrees",
                             [](Walk& walk, std::span<const double> parameters) {
                                 pitch_down(walk.turtle().pose, walk.rotation(parameters).inverse());
                             },
                             Symbol::Effect::other,
                             Symbol::Step::up}};

const Registered<Symbol> roll{
    {"/",
     {},
     "/(angle): roll left towards up, about the heading. Degrees",
     [](Walk& walk, std::span<const double> parameters) { roll_left(walk.turtle().pose, walk.rotation(parameters)); },
     Symbol::Effect::other,
     Symbol::Step::roll}};

const Registered<Symbol> roll_back{{"\\",
                                    {},
                                    "\\(angle): roll left away from up, about the heading. Degrees",
                                    [](Walk& walk, std::span<const double> parameters) {
                                        roll_left(walk.turtle().pose, walk.rotation(parameters).inverse());
                                    },
                                    Symbol::Effect::other,
                                    Symbol::Step::roll_back}};

const Registered<Symbol> turn_around{{"|", {0}, "|: turn around, about up", [](Walk& walk, std::span<const double>) {
                                          turn_left(walk.turtle().pose, Rotation(std::numbers::pi));
                                      }}};

const Registered<Symbol> horizontal{{"@v",
                                     {0},
                                     "@v: roll until left is horizontal; no effect if the heading is vertical",
                                     [](Walk& walk, std::span<const double>) { level(walk.turtle().pose); }}};

const Registered<Symbol> absolute{{"@R",
                                   {2, 3, 4, 5, 6},
                                   "@R(x, y, z, ux, uy, uz): head to (x, y, z), up (ux, uy, uz) if perpendicular",
                                   set_heading}};

const Registered<SymbolGroup> rotation_group{
    {"rotation",
     "turns the turtle",
     {"+", "-", "&", "^", "/", "\\", "|", "@v", "@R"},
     "Angles are in degrees; without parameter the turtle turns by the default angle, 45 unless the scene "
     "or the view file says otherwise.\n"
     "Heading, left and up are H = (0, 1, 0), L = (-1, 0, 0) and U = (0, 0, -1) at the beginning, so that "
     "U = L x H.\n"
     "@R leaves z out as 0; a zero vector means straight up. Up is set only if it is perpendicular to the "
     "heading, within 1e-9; otherwise the turtle twists least, and a warning says so.",
     "axiom: !(0.06) F(1) [+(30) F(1)] [-(30) F(1)] /(90) [&(50) F(1)] [^(50) F(1)] \\(45) F(1) @R(1, 0, 0) F(1)"}};

}  // namespace
}  // namespace espalier::turtle
