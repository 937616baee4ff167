// swc: trees of points with radii, the form of neurons (Cannon et al. 1998).
#include "espalier/language/notation.h"

#include "language/swc/points.h"

#include <utility>

namespace espalier::language {
namespace {

const Registered<NotationType> entry{
    {"swc", ".swc", "measured trees of points, the form of neurons (SWC, Cannon et al. 1998)",
     R"(Points with radii, of which each names the one before it, become the axiom of a model. An axis goes on to its farthest tip.

  row     n type x y z radius parent: a point; -1 is the parent of the first one of a plant; the type is not used
  unit    um, with a warning; in a comment line, "# unit: cm": um, mm, cm, dm, m or inch
  up      z, with a warning; in a comment line, "# up: y": z, y, x, -z, -y or -x

Each axis ends with a module Tip(order), where a model made by `espalier translate` can go on to grow.
R. C. Cannon, D. A. Turner, G. K. Pyapali, H. V. Wheal: An on-line archive of reconstructed hippocampal neurons. Journal of
Neuroscience Methods 84, 1998.)",
     nullptr, [](std::string text, const std::filesystem::path& path, const MeasuredOptions& options) {
         return swc::read(std::move(text), path.string(), options);
     }}};

}  // namespace
}  // namespace espalier::language
