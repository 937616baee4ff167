#include "espalier/turtle/view_file.h"

#include "catch.h"
#include "temporary_folder.h"
#include "turtle/drawing.h"

#include <cmath>
#include <numbers>

using namespace espalier;
using namespace espalier::turtle;

namespace {

View view_of(const std::string& text) {
    return read_view_text(text, "a.v");
}

/// The messages, without the lines of text below them.
std::vector<std::string> messages_of(const View& view) {
    std::vector<std::string> messages;
    for (Diagnostic diagnostic : view.diagnostics) {
        diagnostic.source.clear();
        messages.push_back(to_string(diagnostic));
    }
    return messages;
}

using Messages = std::vector<std::string>;

bool near(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::distance(a, b) < 1e-5;
}

constexpr double degree = std::numbers::pi / 180;

}  // namespace

TEST_CASE("an empty view file gives cpfg's defaults", "[turtle]") {
    const View view = view_of("");
    CHECK(view.diagnostics.empty());
    CHECK(view.unused.empty());
    CHECK(view.turtle.angle == Approx(45 * degree));
    CHECK(view.turtle.colour == 128);
    CHECK(view.turtle.colour_increment == 1);
    CHECK(view.turtle.line_width == 1);
    CHECK(view.turtle.line_width_increment == 0);
    CHECK(view.turtle.line_style == LineStyle::pixel);
    CHECK(view.turtle.scale == 1);
    CHECK(view.turtle.past_cut);
    CHECK(view.turtle.contour_sides == 8);
    CHECK(view.turtle.tapered_lines);
    CHECK_FALSE(view.turtle.twist_of_cylinders);
    CHECK(view.turtle.tropisms.empty());
    CHECK_FALSE(view.exchanges_first);
    REQUIRE(view.turtle.shapes);
    REQUIRE(view.resources);
    CHECK(view.resources->z_min == -100000);
    CHECK(view.resources->z_max == 100000);
    CHECK(view.resources->view_scale == 1);
    CHECK_FALSE(view.camera.perspective);
    CHECK_FALSE(view.camera.box);
    CHECK(view.camera.eye == glm::dvec3(0, 0, 1));
    CHECK(view.render_mode == "filled");
}

TEST_CASE("settings of the turtle are read", "[turtle]") {
    const View view = view_of(
        "angle factor: 8\n"
        "initial color: 3 7\n"
        "color increment: 2 -4\n"
        "initial line width: 0.5 style\n"
        "line width increment: 0.25\n"
        "initial scale: 2\n"
        "scale multiplier: 0.5\n"
        "interpretation past %: off\n"
        "environment display: before\n"
        "contour sides: 12\n"
        "tapered lines: off\n"
        "twist of cylinders: on\n"
        "tropism direction: 0,-2,0\n"
        "initial elasticity: 0.5\n"
        "elasticity increment: -0.25\n");
    CHECK(messages_of(view) == Messages{});
    CHECK(view.turtle.angle == Approx(45 * degree));
    CHECK(view.turtle.colour == 3);
    CHECK(view.turtle.back_colour == 7);
    CHECK(view.turtle.colour_increment == 2);
    CHECK(view.turtle.back_colour_increment == -4);
    CHECK(view.turtle.line_width == 0.5);
    CHECK(view.turtle.line_style == LineStyle::cylinder);
    CHECK(view.turtle.line_width_increment == 0.25);
    CHECK(view.turtle.scale == 2);
    CHECK(view.turtle.scale_multiplier == 0.5);
    CHECK_FALSE(view.turtle.past_cut);
    CHECK(view.exchanges_first);
    CHECK(view.turtle.contour_sides == 12);
    CHECK_FALSE(view.turtle.tapered_lines);
    CHECK(view.turtle.twist_of_cylinders);
    CHECK(view.turtle.tropism_direction == glm::dvec3(0, -1, 0));
    CHECK(view.turtle.initial_elasticity == 0.5);
    CHECK(view.turtle.elasticity_increment == -0.25);
}

TEST_CASE("of angle factor and angle increment the last counts", "[turtle]") {
    CHECK(view_of("angle factor: 6\nangle increment: 20\n").turtle.angle == Approx(20 * degree));
    CHECK(view_of("angle increment: 20\nangle factor: 16\n").turtle.angle == Approx(22.5 * degree));
    CHECK(messages_of(view_of("angle factor: 0\n")) == Messages{"a.v:1:1: 'angle factor' must not be 0"});
}

TEST_CASE("an initial line width without style means polygons, and its style stands on the same line", "[turtle]") {
    CHECK(view_of("initial line width: 2").turtle.line_style == LineStyle::polygon);
    CHECK(view_of("initial line width: 2 pixels").turtle.line_style == LineStyle::pixel);
    CHECK(view_of("initial line width: 2 cylinder").turtle.line_style == LineStyle::polygon);
    CHECK(view_of("line style: cylinder\ninitial line width: 2").turtle.line_style == LineStyle::polygon);
    const View tab = view_of("initial line width: 2\t\nline style: cylinder\n");
    CHECK(tab.turtle.line_style == LineStyle::cylinder);
    CHECK(tab.diagnostics.empty());
}

TEST_CASE("a line style is a word or its number", "[turtle]") {
    CHECK(view_of("line style: polygon").turtle.line_style == LineStyle::polygon);
    CHECK(view_of("line style: 3").turtle.line_style == LineStyle::cylinder);
    CHECK(view_of("line style: polygon\nline style: 9").turtle.line_style == LineStyle::polygon);
    CHECK(messages_of(view_of("line style: dotted")) ==
          Messages{"a.v:1:1: warning: 'dotted' is no line style (pixel, polygon, cylinder)"});
}

TEST_CASE("labels are known letter for letter, blanks before them do not count", "[turtle]") {
    CHECK(view_of("   render mode: shaded").render_mode == "shaded");
    for (const char* label : {"\trender mode:", "render mode :", "Render mode:", "render  mode:"}) {
        const View view = view_of(std::string(label) + " shaded\n");
        CHECK(view.render_mode == "filled");
        CHECK(view.diagnostics.size() == 1);
        CHECK(view.diagnostics.at(0).severity == Diagnostic::Severity::error);
    }
    CHECK(messages_of(view_of("Render mode: shaded")) ==
          Messages{"a.v:1:1: view files have no setting 'Render mode' (did you mean 'render mode'?)"});
    CHECK(messages_of(view_of("\trender mode: shaded")) ==
          Messages{"a.v:1:1: 'render mode' is not read because of the tab before it"});
    CHECK(messages_of(view_of("render mode : shaded")) ==
          Messages{"a.v:1:1: 'render mode' is not read because blanks stand before its colon"});
    CHECK(messages_of(view_of("\t\t: 3\nangle increment: 30")) ==
          Messages{"a.v:1:1: there is no setting before this sign"});
}

TEST_CASE("what a setting leaves on its line is taken for the next", "[turtle]") {
    const View view = view_of("scale factor: .3 junk here: 5\nz buffer: on box: x:1,2 y:3,4 z:5,6\nfront distance: 7");
    CHECK(view.camera.scale == Approx(0.3));
    CHECK(messages_of(view) == Messages{"a.v:1:18: view files have no setting 'junk here'"});
    REQUIRE(view.camera.box);
    CHECK(view.camera.box->lower == glm::dvec3(1, 3, 5));
    CHECK(view.camera.box->upper == glm::dvec3(2, 4, 6));
    CHECK(view.camera.front == 7);
}

TEST_CASE("a value that its line lacks is looked for on the next", "[turtle]") {
    const View view = view_of("scale factor:\n\n 2\nrender mode:\nfast\ninitial color: 4 angle factor: 6");
    CHECK(view.diagnostics.empty());
    CHECK(view.camera.scale == 2);
    CHECK(view.render_mode == "fast");
    CHECK(view.turtle.colour == 4);
    CHECK(view.turtle.angle == Approx(60 * degree));
}

TEST_CASE("values may be separated by blanks, commas and tabs in any mixture, and by macros", "[turtle]") {
    for (const char* values : {"1,2,3", "1 , 2 ,3", "1 2 3", "1\t2,\t3,", "ONE,TWO,3", "1 2\n3"}) {
        const View view =
            view_of("#define ONE 1\n#define TWO 2\nviewpoint: " + std::string(values) + "\nscale factor: 5");
        CHECK(view.camera.eye == glm::dvec3(1, 2, 3));
        CHECK(view.camera.scale == 5);
        CHECK(view.diagnostics.empty());
    }
}

TEST_CASE("values that did fit are kept when others are missing", "[turtle]") {
    const View view = view_of("viewpoint: 4, 5, x\nscale factor: 2\nscale factor: big\n");
    CHECK(view.camera.eye == glm::dvec3(4, 5, 1));
    CHECK(view.camera.scale == 2);
    CHECK(messages_of(view) ==
          Messages{"a.v:1:1: 'viewpoint' needs three numbers", "a.v:3:1: 'scale factor' needs a number"});
}

TEST_CASE("comments, conditions and defines work in view files, and defines can be given from outside", "[turtle]") {
    const std::string text =
        "#define ANGLE 30\n/* angle factor: 7 */ angle increment: ANGLE // degrees\n"
        "#if ANGLE > 40\nscale factor: 4\n#endif\n";
    CHECK(view_of(text).turtle.angle == Approx(30 * degree));
    CHECK(view_of(text).camera.scale == 1);
    const View other = read_view_text(text, "a.v", {{"ANGLE", "50"}, {"ELSEWHERE", "1"}});
    CHECK(other.turtle.angle == Approx(50 * degree));
    CHECK(other.camera.scale == 4);
    CHECK(other.diagnostics.empty());
}

TEST_CASE("carriage returns do no harm", "[turtle]") {
    const View view = view_of(
        "angle factor: 6\r\n\r\nline style: polygon\r\nviewpoint: 1,2,3\r\ntropism: T 0,1,0 E 0.5\r\n"
        "initial line width: 2\r\n");
    CHECK(view.diagnostics.empty());
    CHECK(view.turtle.angle == Approx(60 * degree));
    CHECK(view.camera.eye.z == 3);
    CHECK(view.turtle.tropisms.at(0).elasticity == 0.5);
    CHECK(view.turtle.line_style == LineStyle::polygon);
}

TEST_CASE("settings of other programs are passed over in silence", "[turtle]") {
    const View view = view_of(
        "scale: 3\ncorrected rotation: on\nstropism: T 1 0 0\nwindow: 3 4\npanel name: x\n"
        "background: 1 2\ntarget: y\nangle factor: 6");
    CHECK(view.diagnostics.empty());
    CHECK(view.turtle.angle == Approx(60 * degree));
}

TEST_CASE("what is no setting is told once a line", "[turtle]") {
    CHECK(messages_of(view_of("angle factr: 6\n#5 of\nplain words\n")) ==
          Messages{"a.v:1:1: view files have no setting 'angle factr' (did you mean 'angle factor'?)",
                   "a.v:2:1: '#' is no setting: its name ends with a colon",
                   "a.v:3:1: 'plain words' is no setting: its name ends with a colon"});
    std::string many;
    for (int i = 0; i < 1000; ++i) many += "nonsense\n";
    CHECK(view_of(many).diagnostics.size() == 200);
}

TEST_CASE("a tropism's vector has length 1, with an intensity the smaller of its own length and that", "[turtle]") {
    const auto direction = [](const std::string& line) {
        const View view = view_of("tropism: " + line);
        CHECK(messages_of(view) == Messages{});
        return view.turtle.tropisms.at(0).direction;
    };
    CHECK(near(direction("T 0,-2,0"), {0, -1, 0}));
    CHECK(near(direction("T 0,-2,0 I 0.5"), {0, -0.5, 0}));
    CHECK(near(direction("T 0 -2 0 I: 5"), {0, -2, 0}));
    CHECK(near(direction("T: 0.5 0 0 I 5"), {0.5, 0, 0}));
    CHECK(near(direction("T 3 0 4 I -2"), {-1.2, 0, -1.6}));
}

TEST_CASE("tropisms and torques count together, in the order of their lines", "[turtle]") {
    const View view = view_of("tropism: T 0 1 0 A 90 E 0.5 S 0.1\ntorque: E: 0.25 T 1,0,0\ntropism: S 2 T 0 0 1\n");
    REQUIRE(view.turtle.tropisms.size() == 3);
    CHECK(view.turtle.tropisms[0].angle == Approx(90 * degree));
    CHECK(view.turtle.tropisms[0].elasticity == 0.5);
    CHECK(view.turtle.tropisms[0].elasticity_step == Approx(0.1));
    CHECK_FALSE(view.turtle.tropisms[0].torque);
    CHECK(view.turtle.tropisms[1].torque);
    CHECK(view.turtle.tropisms[1].elasticity == 0.25);
    CHECK(view.turtle.tropisms[2].elasticity == 0);
    CHECK(view.turtle.tropisms[2].elasticity_step == 2);
    std::string many;
    for (int i = 0; i < 12; ++i) many += "tropism: T 0 1 0\n";
    const View full = view_of(many);
    CHECK(full.turtle.tropisms.size() == 10);
    CHECK(full.diagnostics.size() == 2);
}

TEST_CASE("a tropism that is not understood takes no number", "[turtle]") {
    const View view = view_of(
        "tropism: T 0 0 0\ntropism: X 1\ntropism: T 0 1 0 E\ntropism: I 1 T 0 1 0\n"
        "tropism: T 0 1 0 I 0\ntropism: E 1\ntropism: T 1 0 0\n");
    CHECK(view.turtle.tropisms.size() == 1);
    CHECK(messages_of(view) ==
          Messages{"a.v:1:10: a tropism's direction must not be 0 0 0; the line is ignored",
                   "a.v:2:10: 'X' is none of T, A, I, E, S; the line is ignored",
                   "a.v:3:18: 'E' needs a number behind it; the line is ignored",
                   "a.v:4:10: the intensity comes after the direction T x y z; the line is ignored",
                   "a.v:5:18: the intensity of a tropism must not be 0; the line is ignored",
                   "a.v:6:1: a tropism needs its direction: T x y z"});
}

TEST_CASE("a view's older tropism bends after each step", "[turtle]") {
    Drawing drawing("+(70)/(25)F(2)F_f_(0.5)Gg");
    drawing.settings =
        view_of("tropism direction: 0.2,1,-0.4\ninitial elasticity: 0.3\nelasticity increment: -0.1").turtle;
    const Pose pose = drawing.pose();
    CHECK(near(pose.heading, {-0.00909, 0.938693, -0.344634}));
    CHECK(near(pose.position, {-3.98917, 3.79516, -0.853556}));
    CHECK(frame_error(pose) < 1e-9);
}

TEST_CASE("lights, the camera and render modes are kept for whoever shows the plant", "[turtle]") {
    const View view = view_of(
        "light: V 1 2 3 A 0.5 0.5 0.5 T 1 0 0.25\nlight: O: 4,5,6 P 0 -1 0 2 30\n"
        "projection: perspective\nviewing angle: 30\nfront distance: -5\nback distance: 50\n"
        "twist: 900\nshade mode: 3\n");
    CHECK(view.diagnostics.empty());
    REQUIRE(view.lights.size() == 2);
    CHECK(view.lights[0].directional);
    CHECK(view.lights[0].vector == glm::dvec3(1, 2, 3));
    CHECK(view.lights[0].ambient == glm::dvec3(0.5));
    CHECK(view.lights[0].attenuation == glm::dvec3(1, 0, 0.25));
    CHECK_FALSE(view.lights[1].directional);
    CHECK(view.lights[1].ambient == glm::dvec3(1));
    CHECK(view.lights[1].spot_direction == glm::dvec3(0, -1, 0));
    CHECK(view.lights[1].spot_cutoff == 30);
    CHECK(view.camera.perspective);
    CHECK(view.camera.angle == 30);
    CHECK(view.camera.twist == Approx(90));
    CHECK(view.camera.front == 0.1);
    CHECK(view.resources->z_min == 0.1);
    CHECK(view.resources->z_max == 50);
    CHECK(view.render_mode == "shaded");
    CHECK(view.unused == Messages{"shade mode"});
}

TEST_CASE("settings of a window alone are read and named", "[turtle]") {
    const View view = view_of(
        "z buffer: on\ncue range: 5\nfont: -adobe-times\nwinfont: \"Times New\" 12 bi\n"
        "PS linecap: 1\nshadow map: size 512 color 0,0,0\nrayshade objects: %d.ray turtle considered\n"
        "background color: 0,0,1\nambient light: 1 1 1\nmin zoom: 1\nz buffer: off\n"
        "light direction: 1,1,1\ndiffuse reflection: 10\nangle factor: 6\n");
    CHECK(view.diagnostics.empty());
    CHECK(view.turtle.angle == Approx(60 * degree));
    CHECK(view.unused == Messages{"z buffer", "cue range", "font", "winfont", "PS linecap", "shadow map",
                                  "rayshade objects", "ambient light", "min zoom", "diffuse reflection"});
    CHECK(view.background_colour == glm::dvec3(0, 0, 1));
    CHECK(glm::length(*view.light_direction - glm::normalize(glm::dvec3(1))) < 1e-12);
    CHECK(view_of("background color: 255,0,51").background_colour == glm::dvec3(1, 0, 0.2));
}

TEST_CASE("where eye and reference point agree, the view is from behind", "[turtle]") {
    const View view = view_of("viewpoint: 1,1,1\nview reference point: 1,1,1");
    CHECK(view.camera.eye == glm::dvec3(0, 0, -1));
    CHECK(view.camera.target == glm::dvec3(0));
}

TEST_CASE("settings outside their range are moved into it, with a word", "[turtle]") {
    const View view = view_of(
        "contour sides: 2\ninitial color: 300\npolygonization level: 2\ninitial scale: 0\n"
        "scale multiplier: 0\nenvironment display: on\n");
    CHECK(view.turtle.contour_sides == 8);  // 2 to the power of 3
    CHECK(view.turtle.colour == 44);
    CHECK(view.turtle.scale == 1);
    CHECK_FALSE(view.exchanges_first);
    CHECK(messages_of(view) ==
          Messages{"a.v:1:1: warning: 2 contour sides are taken as 3: from 3 to 1000",
                   "a.v:2:1: warning: colour 300 is taken as 44: indices go from 0 to 255",
                   "a.v:4:1: warning: 'initial scale' must not be 0; it is 1",
                   "a.v:5:1: warning: 'scale multiplier' must not be 0; it is 1",
                   "a.v:6:1: warning: 'environment display: on' does nothing; the word is 'before'"});
}
