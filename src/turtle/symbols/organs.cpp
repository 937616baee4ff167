// Discs, spheres, outlines and surfaces where the turtle is.
#include "espalier/turtle/symbol.h"

#include "geometry/surface_id.h"

namespace espalier::turtle {
namespace {

/// Towards the reader of a front view, along z.
Pose facing_the_screen(const Walk& walk) {
    Pose pose;
    pose.position = walk.turtle().pose.position;
    return pose;
}

double diameter(const Walk& walk, std::span<const double> parameters) {
    return parameters.empty() ? walk.turtle().width : parameters[0] * walk.turtle().scale;
}

void place_surface(Walk& walk, std::span<const double> parameters) {
    glm::dvec3 factors(parameters.empty() ? 1 : parameters[0]);
    if (parameters.size() >= 3) factors = {parameters[0], parameters[1], parameters[2]};
    walk.place_surface(surface_id(walk.symbol()), factors);
}

const Registered<Symbol> screen_disc{{"@o",
                                      {},
                                      "@o(diameter): a disc that faces the screen, in the plane of x and y",
                                      [](Walk& walk, std::span<const double> parameters) {
                                          walk.place(Organ::Shape::disc, facing_the_screen(walk),
                                                     diameter(walk, parameters));
                                      }}};

const Registered<Symbol> disc{{"@c",
                               {},
                               "@c(diameter): a disc in the plane of heading and left",
                               [](Walk& walk, std::span<const double> parameters) {
                                   walk.place(Organ::Shape::disc, walk.turtle().pose, diameter(walk, parameters));
                               }}};

const Registered<Symbol> sphere{
    {"@O", {}, "@O(diameter): a sphere", [](Walk& walk, std::span<const double> parameters) {
         walk.place(Organ::Shape::sphere, walk.turtle().pose, diameter(walk, parameters));
     }}};

const Registered<Symbol> screen_circle{
    {"@bo", {}, "@bo(diameter): the outline of @o", [](Walk& walk, std::span<const double> parameters) {
         walk.place(Organ::Shape::circle, facing_the_screen(walk), diameter(walk, parameters));
     }}};

const Registered<Symbol> circle{
    {"@bc", {}, "@bc(diameter): the outline of @c", [](Walk& walk, std::span<const double> parameters) {
         walk.place(Organ::Shape::circle, walk.turtle().pose, diameter(walk, parameters));
     }}};

const Registered<Symbol> surface{
    {"~*",
     {},
     "~x(scale) or ~x(sx, sy, sz): draw the surface x, scaled along left, heading and up; then move to its end point",
     place_surface}};

const Registered<SymbolGroup> organs_group{
    {"organs",
     "discs, spheres and surfaces",
     {"@o", "@c", "@O", "@bo", "@bc", "~*"},
     "Diameters are in metres, times the scale; without parameter the line width.\n"
     "A surface x is described by the view file, or is a rhombus without one. ~x(sx, sy, sz) scales it "
     "along left, heading and up; the turtle moves to its end point.",
     "axiom: !(0.04) F(1) [-(90) @c(0.4)] F(1) [-(90) f(0.4) @O(0.4)] F(1) ~l(0.7)"}};

}  // namespace
}  // namespace espalier::turtle
