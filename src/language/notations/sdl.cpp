// sdl: the skeleton description language of L. Szemla (1999).
#include "espalier/language/notation.h"

#include "language/sdl/skeleton.h"
#include "language/sdl/translation.h"

namespace espalier::language {
namespace {

const Registered<NotationType> entry{
    {"sdl", ".sdl", "skeletons of components that inherit from their masters, and the fibres they become (Szemla 1999)",
     R"(define{ name[beginning, length, vertical, horizontal]; ... }
  Features relative to those of the master: beginning 0 to 1 of the master's length; length in metres (the master's
  plus this, at least 0); angles in degrees (the master's plus this). The horizontal angle leads away from the vertical,
  the vertical angle around it. `middle:deviation` is drawn for every component. name[NULL] has no curve; its slaves
  hang on its master. #const_ver name, #const_hor name: that angle is not relative to the master.
rules{ master -> (slave slave(slave) slave*3); ... }
  The left side of the first rule is the start. One right side, or several with weights: (a) : 0.7 | (b c) : 0.3
fibres{ wooden{ ... } leaf a, b{ ... } }   optional
  flat; solid; cut[width, thickness] in metres; ring[strengths of magnets, -1 or more]; contour[degrees];
  correction[amplitude 0 to 1, bumps]; quality[rings 6, magnets 8]; material[colour, texture];
generations 5;   optional; --define GENERATIONS=n replaces it
L. Szemla: 3D models generator simulating a grow of natural objects for virtual reality. Brno 1999. See docs/sdl.md.
)",
     [](const std::string& text, const std::filesystem::path& path) {
         return sdl::model_of(sdl::parse(text, path.string()), path.string());
     }}};

}  // namespace
}  // namespace espalier::language
