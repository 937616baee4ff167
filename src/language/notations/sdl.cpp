// sdl: the skeleton description language of L. Szemla (1999).
#include "espalier/language/notation.h"

#include "language/sdl/skeleton.h"
#include "language/sdl/translation.h"

namespace espalier::language {
namespace {

const Registered<NotationType> entry{
    {"sdl", ".sdl", "skeletons of components that inherit from their masters, and the fibres they become (Szemla 1999)",
     R"(A file defines components, says by rules how they grow on each other, and gives them fibres:

    define{ name[beginning, length, vertical, horizontal]; ... }
    rules{ master -> (slave slave(slave) slave*3); ... }
    fibres{ wooden{ ... } leaf a, b{ ... } }
    generations 5;

Features are relative to those of the master: beginning 0 to 1 of the master's length; length in metres (the master's plus this,
at least 0); angles in degrees (the master's plus this). The horizontal angle leads away from the vertical, the vertical angle
around it. `middle:deviation` is drawn for every component. name[NULL] has no curve; its slaves hang on its master.
#const_ver name, #const_hor name: that angle is not relative to the master.

The left side of the first rule is the start. A rule has one right side, or several with weights: (a) : 0.7 | (b c) : 0.3

Fibres and the number of generations are optional; --define GENERATIONS=n replaces it. A set of fibres has settings in the form
name[values];

  flat        of leaf; a surface without thickness
  solid       of wooden; a closed body
  cut         5 % of the length, m; [width, thickness]: diameters of the elliptic cut, expressions of length, vertical and
              horizontal; with one value, the cut is a circle
  ring        none; [s1, s2, ...]: strengths of magnets around the cut, -1 or more; several rings stand at equal distances
              from the beginning of the fibre to its end
  contour     none, degrees; [a1, a2, ...]: angles by which equal parts of the fibre bend away from the vertical
  correction  none; [amplitude, bumps]: roughness, 0 to 1 of the half width, and the number of bumps around the fibre
  quality     [6, 8]; rings along the fibre, and magnets in each of them
  material    that of the turtle; [colour, texture]: index of the colour or material, and number of the texture

L. Szemla: 3D models generator simulating a grow of natural objects for virtual reality. Brno 1999. See docs/sdl.md.
)",
     [](const std::string& text, const std::filesystem::path& path) {
         return sdl::model_of(sdl::parse(text, path.string()), path.string());
     }}};

}  // namespace
}  // namespace espalier::language
