// Queries: the turtle answers where it is and how it stands, a process of the scene answers the rest. A query's own
// parameters are its question and, in the next frame, its answer.
#include "espalier/turtle/symbol.h"

namespace espalier {
namespace {

template <QueryKind kind>
void ask(Walk& walk, std::span<const double>) {
    walk.ask(kind);
}

const Symbol position{
    "?P", {2, 3}, "?P(x, y, z): answered with the turtle's position", ask<QueryKind::position>, Symbol::Effect::asks};
const Symbol heading{
    "?H", {2, 3}, "?H(x, y, z): answered with the turtle's heading", ask<QueryKind::heading>, Symbol::Effect::asks};
const Symbol left{
    "?L", {2, 3}, "?L(x, y, z): answered with the turtle's left", ask<QueryKind::left>, Symbol::Effect::asks};
const Symbol up{"?U", {2, 3}, "?U(x, y, z): answered with the turtle's up", ask<QueryKind::up>, Symbol::Effect::asks};
const Symbol orientation{"?Q",
                         {4},
                         "?Q(w, x, y, z): answered with the turtle's orientation, a quaternion",
                         ask<QueryKind::orientation>,
                         Symbol::Effect::asks};
const Symbol old_position{
    "s", {2, 3}, "s(x, y, z): the older name of ?P", ask<QueryKind::position>, Symbol::Effect::asks};
const Symbol communication{"?E",
                           {},
                           "?E(...): asks the scene's default process; ?name(...) asks the process so named",
                           ask<QueryKind::communication>,
                           Symbol::Effect::asks};

}  // namespace
}  // namespace espalier
