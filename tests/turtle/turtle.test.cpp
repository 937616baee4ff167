#include "espalier/base/random.h"

#include "catch.h"
#include "turtle/drawing.h"

#include <cmath>
#include <numbers>

using namespace espalier;
using namespace espalier::turtle;

namespace {

constexpr double quarter = std::numbers::pi / 2;
const glm::dvec3 X(1, 0, 0), Y(0, 1, 0), Z(0, 0, 1);

void check_frame(const Pose& pose, const glm::dvec3& heading, const glm::dvec3& left, const glm::dvec3& up) {
    CHECK(glm::length(pose.heading - heading) < 1e-15);
    CHECK(glm::length(pose.left - left) < 1e-15);
    CHECK(glm::length(pose.up - up) < 1e-15);
}

Pose some_pose() {
    return pose_after("+(20)&(35)/(50)F(2)");
}

}  // namespace

TEST_CASE("the turtle starts upright with up = left x heading", "[turtle]") {
    const Pose pose;
    check_frame(pose, Y, -X, -Z);
    CHECK(frame_error(pose) == 0);
    // ABOP's H x L = U is the opposite vector; cpfg's signs of & ^ / \ go with its own.
    CHECK(glm::cross(pose.heading, pose.left) == -pose.up);
}

TEST_CASE("quarter turns move the frame as in cpfg, exactly", "[turtle]") {
    check_frame(pose_after("+(90)"), -X, -Y, -Z);
    check_frame(pose_after("-(90)"), X, Y, -Z);
    check_frame(pose_after("&(90)"), -Z, -X, -Y);
    check_frame(pose_after("^(90)"), Z, -X, Y);
    check_frame(pose_after("/(90)"), Y, -Z, X);
    check_frame(pose_after("\\(90)"), Y, Z, -X);
    check_frame(pose_after("|"), -Y, X, -Z);
    CHECK(pose_after("+(90)").heading.y == 0);
}

TEST_CASE("a small turn goes towards left, up, and left to up", "[turtle]") {
    const double a = 0.1;
    Pose pose;
    turn_left(pose, a);
    CHECK(glm::dot(pose.heading, -X) == Approx(std::sin(a)));
    pose = Pose{};
    pitch_down(pose, a);
    CHECK(glm::dot(pose.heading, -Z) == Approx(std::sin(a)));
    pose = Pose{};
    roll_left(pose, a);
    CHECK(glm::dot(pose.left, -Z) == Approx(std::sin(a)));
}

TEST_CASE("a turn and its opposite leave the frame as it was", "[turtle]") {
    for (const char* pair : {"+(37)-(37)", "&(37)^(37)", "/(37)\\(37)", "+(90)+(-90)", "||", "-&/\\^+"}) {
        const Pose pose = pose_after(pair);
        INFO(pair);
        CHECK(glm::length(pose.heading - Y) < 1e-15);
        CHECK(glm::length(pose.left + X) < 1e-15);
        CHECK(glm::length(pose.up + Z) < 1e-15);
    }
}

TEST_CASE("a million random commands keep the frame orthonormal", "[turtle]") {
    RandomSamples samples(RandomKey(1, 0, Stream::placement), 0, 0);
    TurtleState state;
    const std::vector<Tropism> tropisms{{{0, -1, 0}, 0.3, 0.2, 0, false}, {{1, 0, 0}, 0, 0.1, 0, true}};
    const std::vector<double> elasticities{0.2, 0.1};
    for (int i = 0; i < 1'000'000; ++i) {
        const double angle = 2 * std::numbers::pi * samples.uniform();
        switch (int(samples.uniform() * 5)) {
            case 0:
                turn_left(state.pose, angle);
                break;
            case 1:
                pitch_down(state.pose, angle);
                break;
            case 2:
                roll_left(state.pose, angle);
                break;
            case 3:
                turn_left(state.pose, Rotation(std::numbers::pi));
                break;
            default:
                apply_tropisms(state.pose, tropisms, elasticities);
        }
    }
    CHECK(frame_error(state.pose) < 1e-9);

    Pose rotated_only;
    for (int i = 0; i < 1'000'000; ++i) {
        const double angle = 2 * std::numbers::pi * samples.uniform();
        i % 3 == 0   ? turn_left(rotated_only, angle)
        : i % 3 == 1 ? pitch_down(rotated_only, angle)
                     : roll_left(rotated_only, angle);
    }
    CHECK(frame_error(rotated_only) < 1e-9);
}

TEST_CASE("@v brings left into the horizontal and spares a vertical heading", "[turtle]") {
    Drawing drawing("+(20)&(35)/(50)@v");
    const Pose before = pose_after("+(20)&(35)/(50)"), after = drawing.pose();
    CHECK(after.heading == before.heading);
    CHECK(std::abs(after.left.y) < 1e-15);
    CHECK(frame_error(after) < 1e-15);
    CHECK(glm::dot(after.left, glm::cross(Y, after.heading)) > 0);
    check_frame(pose_after("/(30)@v"), Y, pose_after("/(30)").left, pose_after("/(30)").up);
}

TEST_CASE("@R sets the heading, a zero vector meaning straight up", "[turtle]") {
    CHECK(glm::length(pose_after("&(70)@R(0,0,0)").heading - Y) < 1e-15);
    CHECK(glm::length(pose_after("@R(3,0)").heading - X) < 1e-15);
    const Pose pose = pose_after("+(20)@R(1,2,-2)");
    CHECK(glm::length(pose.heading - glm::dvec3(1, 2, -2) / 3.0) < 1e-15);
    CHECK(frame_error(pose) < 1e-15);
}

TEST_CASE("@R turns with the least twist", "[turtle]") {
    const Pose before = some_pose();
    Pose after = before;
    head_towards(after, {1, 2, 3});
    // The axis of the least turn stays where it was.
    const glm::dvec3 axis = glm::normalize(glm::cross(before.heading, after.heading));
    CHECK(glm::dot(axis, before.left) == Approx(glm::dot(axis, after.left)).margin(1e-14));
    CHECK(glm::dot(axis, before.up) == Approx(glm::dot(axis, after.up)).margin(1e-14));
    head_towards(after, -after.heading);
    CHECK(frame_error(after) < 1e-14);
}

TEST_CASE("@R takes an up vector only if it is perpendicular", "[turtle]") {
    check_frame(pose_after("@R(1,0,0,0,0,2)"), X, glm::cross(X, Z), Z);
    const Pose twisted = pose_after("@R(1,0,0,1,0,1)"), plain = pose_after("@R(1,0,0)");
    CHECK(twisted.up == plain.up);
}

TEST_CASE("elasticity 0.5 towards the ground turns a horizontal segment by 0.5 radians", "[turtle]") {
    Drawing drawing("+(90)F");
    drawing.settings.tropisms = {{{0, -1, 0}, 0, 0.5, 0, false}};
    const Pose pose = drawing.pose();
    CHECK(angle_between(pose.heading, -X) == Approx(0.5));
    CHECK(pose.heading.y == Approx(-std::sin(0.5)));
    CHECK(glm::length(pose.position - pose.heading) < 1e-15);  // it acts before the step
}

TEST_CASE("@Tv turns along the vector that a field has where the turtle is, the more, the longer it is", "[turtle]") {
    const auto after = [](const std::string& text, const std::string& field) {
        Drawing drawing(text);
        drawing.model.texts = {field};
        return drawing.pose();
    };
    const Pose turned = after("f(2)@Tv(0,0.1)", "0, 0, y");
    CHECK(angle_between(turned.heading, glm::dvec3(0, 1, 0)) == Approx(0.2));
    CHECK(turned.heading.z == Approx(std::sin(0.2)));
    CHECK(after("+(50)@Tv(0,0.3)", "0, -1, 0").heading == pose_after("+(50)@Th(0,-1,0,0.3)").heading);
    CHECK(after("f(1)@Tv(0,5)", "x, 0, z").heading == glm::dvec3(0, 1, 0));
    CHECK_THROWS_WITH(after("@Tv(0,1)", "1 / x, 0, 0"), Catch::Contains("the field 1 / x, 0, 0 has no value here"));
    CHECK_THROWS_WITH(pose_after("@Tv(0,1)"), Catch::Contains("the name of a field"));
}

TEST_CASE("@Th turns towards a direction at once, by the strength times the sine of the angle between", "[turtle]") {
    CHECK(angle_between(pose_after("+(90)@Th(0,-3,0,0.5)").heading, -X) == Approx(0.5));
    CHECK(angle_between(pose_after("+(30)@Th(0,-1,0,0.4)").heading, pose_after("+(30)").heading) == Approx(0.2));
    CHECK(pose_after("+(90)@Th(0,1,0,-0.5)").heading.y == Approx(-std::sin(0.5)));
    CHECK(pose_after("+(30)@Th(0,0,0,1)").heading == pose_after("+(30)").heading);
    CHECK(frame_error(pose_after("+(20)&(50)@Th(1,2,3,0.7)")) < 1e-12);
}

TEST_CASE("without elasticity a tropism changes nothing, bit for bit", "[turtle]") {
    const std::string text = "F+(20)F&(30)F/(40)f+(50)F";
    Drawing plain(text), still(text);
    still.settings.tropisms = {{{1, -1, 0.5}, 0.4, 0, 0.1, false}, {{1, 0, 0}, 0, 0, 0.1, true}};
    CHECK(plain.pose().position == still.pose().position);
    CHECK(plain.pose().up == still.pose().up);
}

TEST_CASE("as in cpfg, a tropism takes up from the frame at the last drawn segment", "[turtle]") {
    const auto up = [](const std::string& text, bool as_cpfg) {
        Drawing drawing(text);
        drawing.settings.tropisms = {{{0, 0, 1}, 0, 0.3, 0, false}};
        if (as_cpfg) drawing.model.arithmetic = Arithmetic::cpfg;
        return drawing.pose().up;
    };
    CHECK(glm::length(up("/(40)F(1)", true) - glm::dvec3(0, 0.2955, -0.9553)) < 1e-4);
    CHECK(glm::length(up("/(40)F(1)", false) - glm::dvec3(0.6428, 0.2264, -0.7318)) < 1e-4);
    CHECK(up("/(40)F(1)/(50)F(1)", true) == up("F(1)F(1)", true));
    CHECK(glm::length(up("/(40)[/(50)F(1)]F(1)", true) - up("F(1)", true)) < 1e-12);  // branches keep their frames
    // @Tf keeps the roll, as a drawn segment does where nothing bends.
    CHECK(glm::length(up("/(40)@TfF(1)", true) - up("/(40)F(1)", false)) < 1e-12);
}

TEST_CASE("as in cpfg, @R and @Tp lose what was rolled since the last drawn segment", "[turtle]") {
    const auto pose = [](const std::string& text, bool as_cpfg) {
        Drawing drawing(text);
        if (as_cpfg) drawing.model.arithmetic = Arithmetic::cpfg;
        return drawing.pose();
    };
    const Pose turned = pose("+(30)/(20)@R(.6,.2,.5)", true);
    CHECK(turned.up == pose("@R(.6,.2,.5)", false).up);
    CHECK(turned.up != pose("+(30)/(20)@R(.6,.2,.5)", false).up);
    CHECK(glm::length(pose("/(20)F/(30)@Tp", true).up - pose("/(20)", true).up) < 1e-12);
    CHECK(glm::length(pose("/(20)F/(30)@Tp", false).up - pose("/(50)", false).up) < 1e-12);
    CHECK(glm::length(pose("/(20)[F]/(30)@Tp", true).up - glm::dvec3(0, 0, -1)) < 1e-12);
    CHECK(pose("/(20)F/(30)", true).up == pose("/(20)F/(30)", false).up);
}

TEST_CASE("many segments align the heading with the tropism", "[turtle]") {
    Pose pose = some_pose();
    const std::vector<Tropism> gravity{{{0, -1, 0}, 0, 0, 0, false}};
    for (int i = 0; i < 200; ++i) apply_tropisms(pose, gravity, std::vector{0.3});
    CHECK(angle_between(pose.heading, -Y) < 1e-12);
    CHECK(frame_error(pose) < 1e-14);
}

TEST_CASE("a negative elasticity turns away", "[turtle]") {
    Pose pose = pose_after("+(80)");
    for (int i = 0; i < 200; ++i) apply_tropisms(pose, std::vector<Tropism>{{}}, std::vector{-0.3});
    CHECK(angle_between(pose.heading, Y) < 1e-12);
}

TEST_CASE("a tropism with an angle settles at that angle from its direction", "[turtle]") {
    Pose pose = pose_after("+(20)");
    const std::vector<Tropism> plagiotropism{{{0, -1, 0}, 1.2, 0, 0, false}};
    for (int i = 0; i < 400; ++i) apply_tropisms(pose, plagiotropism, std::vector{0.2});
    CHECK(angle_between(pose.heading, -Y) == Approx(1.2));
}

TEST_CASE("a tropism with an angle bends a segment along it about the turtle's left, as cpfg does", "[turtle]") {
    const auto bent = [](const glm::dvec3& direction, double degrees, double elasticity, Pose pose = {}) {
        const Tropism tropism{direction, degrees * quarter / 90, 0, 0, false};
        apply_tropisms(pose, std::span(&tropism, 1), std::span(&elasticity, 1));
        return pose;
    };
    const glm::dvec3 along = bent(Y, 90, 0.8).heading;
    CHECK(glm::length(along - glm::dvec3(0, 0.696707, 0.717356)) < 1e-6);
    const glm::dvec3 against = bent(-Y, 30, 0.8).heading;
    CHECK(glm::length(against - glm::dvec3(0, 0.921061, -0.389418)) < 1e-6);
    // The turtle turns about its left, whatever that is, and nearly along is along.
    Pose rolled;
    roll_left(rolled, 0.7);
    const glm::dvec3 left = rolled.left;
    CHECK(glm::length(bent(Y, 90, 0.8, rolled).left - left) < 1e-15);
    Pose slanted;
    turn_left(slanted, 1e-8);
    CHECK(glm::length(bent(Y, 90, 0.8, slanted).heading - along) < 1e-7);
    // Without an angle there is nothing to turn to.
    CHECK(bent(Y, 0, 0.8).heading == Y);
}

TEST_CASE("a strong tropism turns by one radian at most", "[turtle]") {
    Pose pose = pose_after("+(90)");
    apply_tropisms(pose, std::vector<Tropism>{{}}, std::vector{50.0});
    CHECK(angle_between(pose.heading, -X) == Approx(1));
}

TEST_CASE("a torque rolls up towards its direction and leaves the heading alone", "[turtle]") {
    Pose pose = pose_after("+(40)/(70)");
    const glm::dvec3 heading = pose.heading;
    const std::vector<Tropism> torque{{{0, 1, 0}, 0, 0, 0, true}};
    for (int i = 0; i < 400; ++i) apply_tropisms(pose, torque, std::vector{0.3});
    CHECK(glm::length(pose.heading - heading) < 1e-12);
    const glm::dvec3 across = glm::normalize(Y - heading * glm::dot(Y, heading));
    CHECK(angle_between(pose.up, across) < 1e-10);
}

TEST_CASE("a torque along the heading does nothing", "[turtle]") {
    const Pose before = pose_after("/(70)");
    Pose pose = before;
    apply_tropisms(pose, std::vector<Tropism>{{{0, 1, 0}, 0, 0, 0, true}}, std::vector{0.9});
    CHECK(glm::length(pose.up - before.up) < 1e-15);
}

TEST_CASE("elasticities are set, changed by a step or an amount, and restored after a branch", "[turtle]") {
    const auto bend = [](const std::string& text) {
        Drawing drawing(text + "@M(0,0)+(90)F");
        drawing.settings.tropisms = {{{0, 0, 1}, 0, 0, 0, false}, {{0, -1, 0}, 0, 0.1, 0.05, false}};
        return angle_between(drawing.pose().heading, -X);
    };
    CHECK(bend("") == Approx(0.1));
    CHECK(bend("@Ts(2,0.4)") == Approx(0.4));
    CHECK(bend("@Ti(2)") == Approx(0.15));
    CHECK(bend("@Ti(2,0.3)") == Approx(0.4));
    CHECK(bend("@T(2,0.3)") == Approx(0.4));
    CHECK(bend("@Td(2)@Td(2)") == Approx(0).margin(1e-12));
    CHECK(bend("@Td(2,0.2)") == Approx(0.1));
    CHECK(bend("[@Ts(2,0.4)]") == Approx(0.1));
    CHECK(bend("@Ts(3,0.4)@Ts(0,0.4)@Ti(-1)@Ti") == Approx(0.1));
}

TEST_CASE("the older tropism bends after each step as cpfg does", "[turtle]") {
    // Numbers printed by cpfg 6.6 for this string.
    Drawing drawing("+(70)/(25)F(2)F_f_(0.5)Gg");
    drawing.settings.tropism_direction = {0.2, 1, -0.4};
    drawing.settings.initial_elasticity = 0.3;
    drawing.settings.elasticity_increment = -0.1;
    const Pose pose = drawing.pose();
    CHECK(glm::length(pose.heading - glm::dvec3(-0.00909, 0.938693, -0.344634)) < 5e-6);
    CHECK(glm::length(pose.position - glm::dvec3(-3.98917, 3.79516, -0.853556)) < 1e-5);
    CHECK(frame_error(pose) < 1e-14);
}

TEST_CASE("a branch gives the older elasticity back", "[turtle]") {
    Drawing drawing("+(90)[_(0.4)F]?E(1)F?E(1)");
    const QueryColumn& queries = drawing.draw().queries;
    CHECK(queries.at(0).pose.heading == queries.at(1).pose.heading);
}
