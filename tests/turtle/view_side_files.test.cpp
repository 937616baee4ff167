#include "espalier/turtle/view_file.h"

#include "catch.h"
#include "temporary_folder.h"
#include "turtle/drawing.h"

#include <fmt/format.h>

#include <cmath>

using namespace espalier;
using namespace espalier::turtle;

namespace {

const std::string hill = "fver 1 1\nname: hill\nsamples: 5\nflip: off\npoints: 4\n0 0\n0.333 1\n0.667 1\n1 0\n";
const std::string diamond =
    "cver 1 3\nname: d\npoints: 4 4\ntype: cr\nsamples: 9\n1 0 0 1\n0 2 0 1\n-1 0 0 1\n0 -2 0 1\n";
const std::string triangles = "triangle\n0 0 0\n0 1 0\n0 0 1\n";

std::string surface(const std::string& heading = "X: 0 Y: 1 Z: 0", const std::string& up = "X: 0 Y: 0 Z: -1") {
    std::string text = "0 1 0 1 0 1\nCONTACT POINT X: 1 Y: 2 Z: 3\nEND POINT X: 2 Y: 5 Z: 7\nHEADING " + heading +
                       "\nUP " + up +
                       "\nSIZE: 4\np\nTOP COLOR: 0 DIFFUSE: 0 BOTTOM COLOR: 0 DIFFUSE: 0\n"
                       "AL: ~ A: ~ AR: ~\nL: ~ R: ~\nBL: ~ B: ~ BR: ~\n";
    for (int i = 0; i < 16; ++i) text += fmt::format("{} {} 0\n", i % 4, i / 4);
    return text;
}

struct Folder : TemporaryFolder {
    View read(const std::string& text, const std::string& name = "a.v") const {
        return read_view_file(write(name, text));
    }
    std::string complaint(const std::string& text) const {
        try {
            read(text);
        } catch (const UserError& error) {
            return without_folder(error.what());
        }
        return "";
    }
    std::vector<std::string> messages(const View& view) const {
        std::vector<std::string> messages;
        for (Diagnostic diagnostic : view.diagnostics) {
            diagnostic.source.clear();
            messages.push_back(without_folder(to_string(diagnostic)));
        }
        return messages;
    }
    std::string without_folder(std::string text) const {
        const std::string folder = path().string();
        for (std::size_t at; (at = text.find(folder)) != std::string::npos;)
            text = text.substr(0, at).append(1, 'F') + text.substr(at + folder.size());
        return text;
    }
};

using Messages = std::vector<std::string>;

bool beside(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::distance(a, b) < 1e-5;
}

}  // namespace

TEST_CASE("a surface moves the turtle to its end point, as far as its first factor says", "[turtle]") {
    const Folder folder;
    folder.write("a.s", surface());
    folder.write("b.s", surface("X: 1 Y: 0 Z: 0"));
    folder.write("c.s", surface("X: 0 Y: 1 Z: 1", "X: 0 Y: 1 Z: -1"));
    const View view = folder.read("surface: a a.s 2\nsurface: b b.s 2\nsurface: c c.s 2\ninitial scale: 3\n");
    CHECK(folder.messages(view) == Messages{});
    const auto end = [&](const std::string& text) {
        Drawing drawing(text);
        drawing.settings = view.turtle;
        return drawing.pose().position;
    };
    CHECK(beside(end("~a"), {1.5, 4.5, 6}));
    CHECK(beside(end("~a(2)"), {3, 9, 12}));
    CHECK(beside(end("~a(2,3,5)"), {3, 9, 12}));
    CHECK(beside(end("~b"), {-4.5, 1.5, 6}));
    CHECK(beside(end("~c"), {1.5, 7.42462, 1.06066}));
}

TEST_CASE("of the numbers behind a surface's size one is a texture, two a precision, three both", "[turtle]") {
    const Folder folder;
    folder.write("a.s", surface());
    const View view = folder.read(
        "surface: a a.s 1\nsurface: b a.s 1 2\nsurface: c a.s 1 3 4\nsurface: d a.s 1 0 20 5\n"
        "surface: e a.s 1 -1\nsurface: a a.s 9\nsurface: f a.s -3\n");
    const auto& surfaces = view.turtle.shapes->surfaces;
    REQUIRE(surfaces.size() == 6);
    CHECK(surfaces.at('a').precision_s == 5);
    CHECK_FALSE(surfaces.at('a').texture);
    CHECK(surfaces.at('b').texture == 2);
    CHECK(surfaces.at('b').precision_s == 5);
    CHECK(surfaces.at('c').precision_s == 3);
    CHECK(surfaces.at('c').precision_t == 4);
    CHECK_FALSE(surfaces.at('c').texture);
    CHECK(surfaces.at('d').precision_s == 5);
    CHECK(surfaces.at('d').precision_t == 10);
    CHECK(surfaces.at('d').texture == 5);
    CHECK_FALSE(surfaces.at('e').texture);
    CHECK(beside(surfaces.at('f').end, surfaces.at('a').end));  // a size that is none is 1
    CHECK(folder.messages(view) == Messages{"F/a.v:4:1: warning: precision 20 is taken as 10: it goes from 1 to 10",
                                            "F/a.v:6:1: warning: surface 'a' is there already; this one is ignored"});
}

TEST_CASE("ids are single characters, of any script, shared by all surfaces", "[turtle]") {
    const Folder folder;
    folder.write("a.s", surface());
    folder.write("t.ray", triangles);
    const View view = folder.read(
        "line: ~ a.s 1\nsurface: \xC3\xA9 a.s 1\ntsurface: t t.ray 2\nline: ~ a.s 1\n"
        "surface: ab a.s 1\ntsurface: t t.ray 3\n");
    const auto& surfaces = view.turtle.shapes->surfaces;
    CHECK(surfaces.size() == 3);
    CHECK(surfaces.contains('~'));
    CHECK(surfaces.contains(0xE9));
    CHECK(surfaces.at('t').triangles.at(0)[1].position == glm::dvec3(0, 2, 0));
    CHECK(folder.messages(view) == Messages{"F/a.v:4:1: warning: the surface of lines must be the first; it is ignored",
                                            "F/a.v:5:1: 'ab' is no id: the id of a surface is one character",
                                            "F/a.v:6:1: warning: surface 't' is there already; this one is ignored"});
}

TEST_CASE("files are looked for beside the file that names them, then in the folder of the run", "[turtle]") {
    const Folder folder, other;
    other.write("a.s", surface());
    std::filesystem::create_directories(folder.path() / "sub");
    folder.write("sub/b.s", surface());
    folder.write("sub/more.v", "surface: b b.s 1\n");
    const std::filesystem::path file = folder.write("a.v", "#include \"sub/more.v\"\nsurface: a a.s 1\n");
    CHECK(read_view_file(file, {}, other.path()).turtle.shapes->surfaces.size() == 2);
    CHECK_THROWS_WITH(read_view_file(file), Catch::Contains("there is no file 'a.s' in " + folder.path().string()));
}

TEST_CASE("missing files are errors that name both files", "[turtle]") {
    const Folder folder;
    for (const char* line : {"surface: a none.x 1", "tsurface: a none.x 1", "contour: 1 none.x", "curve: none.x",
                             "function set: none.x", "background scene: none.x", "line: a none.x 2"}) {
        CHECK(folder.complaint(std::string("angle factor: 4\n") + line) ==
              "F/a.v:2:1: there is no file 'none.x' in F\n    " + std::string(line) + "\n    ^");
    }
}

TEST_CASE("contours are read after the file, and the first of a number wins", "[turtle]") {
    const Folder folder;
    folder.write("d.con", diamond);
    std::string open = diamond;
    folder.write("o.con", open.replace(open.find("cr"), 2, "or"));
    folder.write("new.con", "cver 2 1\n");
    folder.write("short.con", "cver 1 3\nname: s\n");
    const View view = folder.read(
        "contour: 1 d.con\ncontour: 7 o.con\ncontour: 1 o.con\ncontour: 0 d.con\n"
        "contour: 2 new.con\ncontour: 3 short.con\nangle factor: 6\nangle facto: 3");
    const auto& contours = view.turtle.shapes->contours;
    CHECK(contours.size() == 2);
    CHECK(contours.at(1).closed());
    CHECK_FALSE(contours.at(7).closed());
    CHECK(folder.messages(view) ==
          Messages{"F/a.v:8:1: view files have no setting 'angle facto' (did you mean 'angle factor'?)",
                   "F/a.v:3:1: warning: contour 1 is there already; this one is ignored",
                   "F/a.v:4:1: warning: contour 0 is the circle already; this one is ignored",
                   "F/new.con:1:6: contours are read from 'cver 1 1' to 'cver 1 3' only; the circle is drawn instead",
                   "F/short.con:3:1: the file ends where 'points:' is expected"});
}

TEST_CASE("functions are numbered in order; one that cannot be read keeps its number and is 0", "[turtle]") {
    const Folder folder;
    folder.write("a.func", hill);
    folder.write("old.func", "range: 0 1\npoints: 4\n0 2\n0.3 2\n0.6 2\n1 2\n");
    folder.write("bad.func", "fver 9 9\n");
    const View view =
        folder.read("function: none.func\nfunction: a.func 100\nfunction: bad.func\nfunction: old.func 50\n");
    const auto& functions = view.resources->functions;
    REQUIRE(functions.size() == 4);
    CHECK(functions[0](0.5) == 0);
    CHECK(functions[1](0.5) == Approx(0.75).margin(1e-3));
    CHECK(functions[2](0.5) == 0);
    CHECK(functions[3](0.5) == 2);
    const Messages messages = folder.messages(view);
    REQUIRE(messages.size() == 4);
    CHECK(messages[0] == "F/a.v:1:1: warning: function 1 is 0 everywhere, because its file 'none.func' cannot be read");
    CHECK(messages[3] == "F/bad.func:1:6: warning: functions are read as 'fver 1 1' only");
    CHECK(view.files == std::vector<std::filesystem::path>{folder.path() / "a.func", folder.path() / "old.func"});
}

TEST_CASE("a function set begins the numbers anew and names its functions", "[turtle]") {
    const Folder folder;
    folder.write("a.func", hill);
    const auto named = [](const std::string& name) {
        std::string text = hill;
        return text.replace(text.find("name: hill"), 10, "name: " + name);
    };
    folder.write("a.fset", "funcgalleryver 1 1\nitems: 3\n" + named("Width.func") + named("2nd") + named("LENGTH"));
    folder.write("bad.fset", "nothing\n");
    const View view = folder.read("function: a.func\nfunction: a.func\nfunction set: a.fset\nfunction: a.func\n");
    CHECK(view.resources->functions.size() == 4);
    CHECK(view.function_names == Defines{{"Width", "1"}, {"LENGTH", "3"}});
    CHECK(folder.messages(view) ==
          Messages{"F/a.v:3:1: warning: function 2 of 'a.fset' has no name that models can use: '2nd'"});
    const View bad = folder.read("function: a.func\nfunction set: bad.fset\n");
    CHECK(bad.resources->functions.empty());
    CHECK(folder.messages(bad) == Messages{"F/bad.fset:1:1: a function set begins with 'funcgalleryver 1 1'"});
}

TEST_CASE("curves are numbered in order and measured with as many chords as their line says", "[turtle]") {
    const Folder folder;
    folder.write("c.con", "points: 4\ntype: bezier\n0 0\n0.333333 1.333333\n0.666667 1.333333\n1 0\n");
    const View view = folder.read("curve: c.con 3\ncurve: c.con\n");
    REQUIRE(view.resources->curves.size() == 2);
    CHECK(view.resources->curves[0].length() == Approx(2 * std::sqrt(1.25)).margin(1e-4));
    CHECK(view.resources->curves[1].length() == Approx(2.3234).margin(1e-3));  // length of a parabola of height 1
}

TEST_CASE("textures keep their numbers, whether or not they are understood", "[turtle]") {
    const Folder folder;
    folder.write("bark.png", "P6 1 1 255 abc");
    const View view = folder.read(
        "texture: F bark.png L l H n E decal S R 2\ntexture: L mln F: none.rgb\ntexture: S\n"
        "texture: F bark.png Q\ntexture: F bark.png L zzz\n");
    const auto& textures = view.turtle.shapes->textures;
    REQUIRE(textures.size() == 5);
    CHECK(textures[0].file == folder.path() / "bark.png");
    CHECK(textures[0].minification == "l");
    CHECK(textures[0].mode == "d");
    CHECK(textures[0].per_surface);
    CHECK(textures[0].ratio == 2);
    CHECK(textures[1].file == "none.rgb");
    CHECK(textures[1].minification == "mln");
    CHECK_FALSE(textures[1].per_surface);
    CHECK(folder.messages(view) ==
          Messages{"F/a.v:2:1: warning: there is no picture 'none.rgb' for texture 2",
                   "F/a.v:3:1: a texture needs its file: F name",
                   "F/a.v:4:1: 'Q' is none of F, L, H, E, S, R; texture 4 is read up to here",
                   "F/a.v:5:1: 'zzz' is no filter (n, l, m, mnn, mln, mnl, mll); texture 5 is read up to here"});
}

TEST_CASE("a texture that will not be shown is named when the view file is read", "[turtle]") {
    const Folder folder;
    folder.write("notes.png", "a shopping list");
    folder.write("own.bark", "stripes = 3\n");
    const View view = folder.read("texture: F own.bark\ntexture: F notes.png\n");
    REQUIRE(view.turtle.shapes->textures.size() == 2);
    const Messages messages = folder.messages(view);
    REQUIRE(messages.size() == 1);
    CHECK(messages[0].starts_with(
        "F/a.v:2:1: warning: the picture 'notes.png' of texture 2 will not be shown: it is none "
        "of SGI's (.rgb)"));
}

TEST_CASE("a later background scene takes the place of an earlier one", "[turtle]") {
    const Folder folder;
    folder.write("a.gls", "box 1 1 1");
    folder.write("b.gls", "box 2 2 2 blob");
    folder.write("c.gls", "sphere 1");
    const View view = folder.read("background scene: a.gls\nbackground scene: b.gls, c.gls\n");
    CHECK(view.backgrounds.size() == 2);
    REQUIRE(view.background);
    CHECK(view.background->pieces.size() == 2);
    CHECK(folder.messages(view) == Messages{"F/b.gls:1:11: background scenes have no command 'blob'"});
}

TEST_CASE("blob fields are refused in so many words", "[turtle]") {
    CHECK(read_view_text("blob: b.sdat 1 1 1\n", "a.v").diagnostics.at(0).message ==
          "blob fields such as 'b.sdat' are not read, and inblob() is not available");
}

TEST_CASE("broken surfaces and curves stop the reading, refused surfaces do not", "[turtle]") {
    const Folder folder;
    folder.write("a.s", "0 1 0 1 0 1\nCONTACT PLACE\n");
    CHECK(folder.complaint("surface: a a.s 1") ==
          "F/a.s:2:9: 'POINT' is expected here\n    CONTACT PLACE\n            ^");
    folder.write("c.con", "points: 4\n0 0\n");
    CHECK(folder.complaint("curve: c.con") ==
          "F/c.con:1:1: a curve needs at least 4 points, not 1\n    points: 4\n    ^");
    std::string lonely = surface();
    folder.write("b.s", lonely.replace(lonely.find("R: ~"), 4, "R: q"));
    const View view = folder.read("surface: b b.s 1\nsurface: c b.s 1\n");
    CHECK(view.turtle.shapes->surfaces.empty());
    CHECK(view.diagnostics.size() == 2);
}
