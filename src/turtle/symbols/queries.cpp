// Queries: the turtle answers where it is and how it stands, a process of the scene answers the rest. A query's own
// parameters are its question and, in the next frame, its answer.
#include "espalier/turtle/symbol.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

namespace espalier::turtle {
namespace {

void answer_position(Walk& walk, std::span<const double> parameters) {
    walk.answer(parameters.size());
}

template <glm::dvec3 Pose::*direction>
void answer_direction(Walk& walk, std::span<const double> parameters) {
    const glm::dvec3& vector = walk.turtle().pose.*direction;
    walk.answer_with({vector.x, vector.y, vector.z}, parameters.size());
}

/// The rotation that takes cpfg's initial frame to the turtle's, as (w, x, y, z) with w >= 0.
void answer_orientation(Walk& walk, std::span<const double>) {
    const Pose& pose = walk.turtle().pose;
    glm::dquat rotation = glm::quat_cast(glm::dmat3(-pose.left, pose.heading, -pose.up));
    if (rotation.w < 0) rotation = -rotation;
    walk.answer_with({rotation.w, rotation.x, rotation.y, rotation.z}, 4);
}

void ask(Walk& walk, std::span<const double>) {
    walk.ask();
}

using enum Symbol::Effect;

const Registered<Symbol> asked_position{
    {"?P", {2, 3}, "?P(x, y, z): the turtle answers with its position", answer_position, answers}};
const Registered<Symbol> asked_heading{
    {"?H", {2, 3}, "?H(x, y, z): the turtle answers with its heading", answer_direction<&Pose::heading>, answers}};
const Registered<Symbol> asked_left{
    {"?L", {2, 3}, "?L(x, y, z): the turtle answers with its left direction", answer_direction<&Pose::left>, answers}};
const Registered<Symbol> asked_up{
    {"?U", {2, 3}, "?U(x, y, z): the turtle answers with its up direction", answer_direction<&Pose::up>, answers}};
const Registered<Symbol> asked_orientation{
    {"?Q", {4}, "?Q(w, x, y, z): the turtle answers with its orientation, a quaternion", answer_orientation, answers}};
const Registered<Symbol> old_position{{"s", {2, 3}, "s(x, y, z): the older name of ?P", answer_position, answers}};
const Registered<Symbol> communication{
    {"?E",
     {},
     "?E(...): query the default process of the scene; ?name(...) queries the process with this name",
     ask,
     asks}};

const Registered<SymbolGroup> queries_group{
    {"queries",
     "asks the turtle and the environment",
     {"?P", "?H", "?L", "?U", "?Q", "s", "?E"},
     "The answers are written into the parameters, where the next step finds them. Vectors of two "
     "parameters leave z out.\n"
     "A query in a homomorphism is not sent.",
     "axiom: F(2) ?P(0, 0, 0) +(90) ?H(0, 0, 0)"}};

}  // namespace
}  // namespace espalier::turtle
