#include "geometry/side_files/side_files.h"

#include "espalier/geometry/palette.h"
#include "espalier/turtle/background.h"

#include "catch.h"
#include "temporary_folder.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>

using namespace espalier;
using namespace espalier::geometry;

namespace {

std::string surface_text(const std::string& heading, const std::string& up, const std::string& patches) {
    return "-1 1 -1 1 -1 1\nCONTACT POINT X: 1 Y: 2 Z: 3\nEND POINT X: 2 Y: 5 Z: 7\nHEADING X: " + heading +
           "\nUP X: " + up + "\nSIZE: 4\n" + patches;
}

const std::string ahead = "0 Y: 1 Z: 0", down = "0 Y: 0 Z: -1";

/// A flat square patch from (0, 0, 0) to (3, 3, 0): s along y, t along x.
std::string patch(const std::string& name, const std::string& left = "~", const std::string& right = "~",
                  double shift = 0) {
    std::string text = name +
                       "\nTOP COLOR: 3 DIFFUSE: 0.5 BOTTOM COLOR: 4 DIFFUSE: 0.25\nAL: ~ A: ~ AR: ~\nL: " + left +
                       " R: " + right + "\nBL: ~ B: ~ BR: ~\n";
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) text += std::to_string(j + shift) + " " + std::to_string(i) + " 0 ";
        text += "\n";
    }
    return text;
}

Surface surface_of(const std::string& text, double size = 2) {
    std::vector<Diagnostic> diagnostics;
    const auto surface = read_surface_text(text, "a.s", size, diagnostics);
    CHECK(diagnostics.empty());
    REQUIRE(surface);
    return *surface;
}

std::string surface_complaint(const std::string& text) {
    std::vector<Diagnostic> diagnostics;
    try {
        read_surface_text(text, "a.s", 1, diagnostics);
    } catch (const UserError& error) {
        return error.what();
    }
    return diagnostics.empty() ? "" : to_string(diagnostics.at(0));
}

bool near(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::distance(a, b) < 1e-5;
}

struct ReadContour {
    std::optional<Contour> contour;
    std::vector<Diagnostic> diagnostics;
};

ReadContour contour_of(const std::string& text) {
    ReadContour read;
    read.contour = read_contour_text(text, "a.con", read.diagnostics);
    return read;
}

bool same(const Contour& a, const Contour& b) {
    if (a.closed() != b.closed()) return false;
    const auto p = a.sample(7), q = b.sample(7);
    for (std::size_t k = 0; k < p.size(); ++k) {
        if (!near(p[k].position, q[k].position)) return false;
    }
    return true;
}

Background background_of(const std::string& text, std::vector<Diagnostic>* found = nullptr) {
    Background background;
    std::vector<Diagnostic> diagnostics;
    read_background_text(text, "a.gls", Material{}, background, diagnostics);
    if (found) *found = diagnostics;
    if (!found) CHECK(diagnostics.empty());
    return background;
}

double volume_of(const Background& background) {
    double sum = 0;
    for (std::size_t i = 0; i < background.triangles.size(); i += 3) {
        const auto at = [&](std::size_t k) { return background.vertices[background.triangles[i + k]].position; };
        sum += glm::dot(at(0), glm::cross(at(1), at(2))) / 6;
    }
    return sum;
}

}  // namespace

TEST_CASE("an organ of a Wavefront file keeps its vertices, its scale and its frame", "[side-files]") {
    const std::string cube =
        "# a house without a roof\nmtllib none.mtl\no house\nv 0 0 0\nv 1 0 0\nv 1 2 0\nv 0 2 0\nv 0 0 3\nv 1 0 3\nv 1 "
        "2 3\n"
        "v 0 2 3\nvn 0 0 -1\nvn 0 0 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl wall\n"
        "f 4/4/1 3/3/1 2/2/1 1/1/1\nf -4//2 -3//2 -2//2 -1//2\n";
    const Surface surface = read_object_text(cube, "house.obj", 0.5);
    CHECK(surface.triangles.size() == 4);
    const SurfaceMesh mesh = mesh_of(surface);
    CHECK(mesh.vertices.size() == 8);
    glm::dvec3 low(1e9), high(-1e9);
    for (const SurfaceVertex& vertex : mesh.vertices) {
        low = glm::min(low, vertex.position);
        high = glm::max(high, vertex.position);
    }
    CHECK(near(low, {-0.5, 0, -1.5}));  // left is -x, up is -z of an upright turtle
    CHECK(near(high, {0, 1, 0}));
    CHECK(near(surface.triangles[0][0].normal, {0, 0, 1}));
    CHECK(surface.end == glm::dvec3(0));
}

TEST_CASE("a Wavefront file that is none is refused with its line", "[side-files]") {
    const auto mistake = [](const std::string& text) {
        try {
            read_object_text(text, "a.obj", 1);
        } catch (const UserError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
    CHECK(mistake(square).find("there is no face in this file") != std::string::npos);
    CHECK(mistake(square + "f 1 2 4\n").find("a.obj:4:7: there are 3 vertices above this face, not 4") == 0);
    CHECK(mistake(square + "f 1 2 -4\n").find("there are 3 vertices above this face, not -4") != std::string::npos);
    CHECK(mistake(square + "f 1/1 2/1 3/1\n").find("there are 0 texture coordinates") != std::string::npos);
    CHECK(mistake(square + "f 1 2\n").find("three corners or more") != std::string::npos);
    CHECK(mistake("v 0 zero 0\n").find("a.obj:1:5: expected 3 numbers") == 0);
    CHECK(mistake(square + "f a b c\n").find("expected a number, as in f 1/1/1") != std::string::npos);
}

TEST_CASE("a surface is placed by its contact point, heading, up and size", "[geometry]") {
    // Worked out by hand for contact (1, 2, 3), end (2, 5, 7) and half the file's size: q = (0.5, 1.5, 2). In the
    // start frame (left -x, up -z) the turtle ends at (-x, y, -z), at scale 3 three times as far.
    CHECK(near(surface_of(surface_text(ahead, down, patch("p"))).end, {-0.5, 1.5, -2}));
    CHECK(near(surface_of(surface_text("1 Y: 0 Z: 0", down, patch("p"))).end, {1.5, 0.5, -2}));
    const double root = std::sqrt(0.5);
    CHECK(near(surface_of(surface_text("0 Y: 1 Z: 1", "0 Y: 1 Z: -1", patch("p"))).end,
               {-0.5, 1.5 * root + 2 * root, 1.5 * root - 2 * root}));
    // A vector up that is not perpendicular is made so.
    CHECK(near(surface_of(surface_text(ahead, "0 Y: 5 Z: -5", patch("p")), 2).end, {-0.5 * root, 1.5, -2 * root}));
}

TEST_CASE("control points are placed as the end point is, rows first", "[geometry]") {
    const Surface surface = surface_of(surface_text(ahead, down, patch("p")));
    REQUIRE(surface.patches.size() == 1);
    const BicubicPatch& read = surface.patches[0];
    CHECK(near(read.points[0][0], {0.5, -1, 1.5}));  // (0, 0, 0) - contact, halved, x and z reversed
    CHECK(near(read.points[0][3], {-1, -1, 1.5}));
    CHECK(near(read.points[3][0], {0.5, 0.5, 1.5}));
    CHECK(read.name == "p");
    CHECK(read.top_colour == 3);
    CHECK(read.bottom_colour == 4);
    CHECK(read.top_diffuse == 0.5);
    CHECK(read.bottom_diffuse == 0.25);
    CHECK(surface.precision_s == 5);
}

TEST_CASE("of a precision line S counts for both directions, from 1 to 10", "[geometry]") {
    std::string text = surface_text(ahead, down, patch("p"));
    text.insert(text.find("CONTACT"), "PRECISION S: 7 T: 3\n");
    CHECK(surface_of(text).precision_s == 7);
    CHECK(surface_of(text).precision_t == 7);
    text.replace(text.find("S: 7"), 4, "S: 70");
    CHECK(surface_of(text).precision_t == 10);
}

TEST_CASE("neighbours must name each other", "[geometry]") {
    const Surface surface = surface_of(surface_text(ahead, down, patch("p", "~", "q") + patch("q", "p", "~", 3)));
    REQUIRE(surface.patches.size() == 2);
    CHECK(surface.patches[0].neighbours[BicubicPatch::right] == 1);
    CHECK(surface.patches[1].neighbours[BicubicPatch::left] == 0);
    CHECK(surface.patches[1].neighbours[BicubicPatch::right] == -1);
    CHECK(surface_complaint(surface_text(ahead, down, patch("p", "~", "q") + patch("q"))) ==
          "a.s:7:1: patch 'q' does not name this one at 'L:'; the surface is left out\n    p\n    ^");
    CHECK(surface_complaint(surface_text(ahead, down, patch("p", "~", "x"))) ==
          "a.s:7:1: there is no patch 'x' to be its neighbour; the surface is left out\n    p\n    ^");
}

TEST_CASE("a patch the file ends within is left out, and the surface stays", "[geometry]") {
    const std::string whole = surface_text(ahead, down, patch("p") + patch("q"));
    const std::size_t second = surface_text(ahead, down, patch("p")).size();
    for (std::size_t length = second + 1; length < whole.size() - 8; length += 7) {
        std::vector<Diagnostic> diagnostics;
        const auto surface = read_surface_text(whole.substr(0, length), "a.s", 2, diagnostics);
        REQUIRE(surface);
        CHECK(surface->patches.size() == 1);
        REQUIRE(diagnostics.size() == 1);
        CHECK(diagnostics[0].severity == Diagnostic::Severity::warning);
    }
    std::vector<Diagnostic> diagnostics;
    const auto empty = read_surface_text(surface_text(ahead, down, ""), "a.s", 2, diagnostics);
    REQUIRE(empty);
    CHECK(empty->patches.empty());
    CHECK(near(empty->end, {-0.5, 1.5, -2}));
}

TEST_CASE("white space in surface files is free", "[geometry]") {
    std::string text = surface_text(ahead, down, patch("p")), wide;
    for (const char c : text) wide += c == '\n' ? "\r\n\r\n" : c == ' ' ? " \t " : std::string(1, c);
    CHECK(surface_of(wide).patches[0].points == surface_of(text).patches[0].points);
}

TEST_CASE("mistakes in surface files are told with their place", "[geometry]") {
    const std::string good = surface_text(ahead, down, patch("p"));
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        return surface_complaint(text.replace(text.find(from), from.size(), to));
    };
    CHECK(surface_complaint("0 1 0 1") == "a.s:1:8: the file ends before its first patch\n    0 1 0 1\n           ^");
    CHECK(with("HEADING", "HEADNG") == "a.s:4:1: 'HEADING' is expected here\n    HEADNG X: 0 Y: 1 Z: 0\n    ^");
    CHECK(with("SIZE: 4", "SIZE: 0") == "a.s:6:7: SIZE must not be 0\n    SIZE: 0\n          ^");
    CHECK(with("SIZE: 4", "SIZE: big") == "a.s:6:7: 'big' is no number\n    SIZE: big\n          ^");
    CHECK(with("HEADING X: 0 Y: 1", "HEADING X: 0 Y: 0") ==
          "a.s:4:1: HEADING is a direction, not 0 0 0\n    HEADING X: 0 Y: 0 Z: 0\n    ^");
    CHECK(with("TOP COLOR: 3", "TOP COLOR: red") ==
          "a.s:8:12: 'red' is no whole number\n    TOP COLOR: red DIFFUSE: 0.5 BOTTOM COLOR: 4 DIFFUSE: 0.25\n"
          "               ^");
    std::string many = surface_text(ahead, down, "");
    for (int i = 0; i < 65; ++i) many += patch(std::string("p").append(std::to_string(i)));
    CHECK(surface_complaint(many) == "a.s:583:1: a surface has at most 64 patches\n    p64\n    ^");
}

TEST_CASE("triangles are read at the size that is asked for; vertices without normals have the triangle's",
          "[geometry]") {
    std::vector<Diagnostic> diagnostics;
    const auto surface = read_triangles_text(
        "made by hand\n\ntriangle 0 0 0  0 0 2\n1,0,0, 0,0,2, 0.5,1\n7\n\r\n"
        "1 1 0 0 0 2 1 1 99\ntriangle\n0:0:0\n0 1 0\n0 0 1\n9 9 9\n",
        "a.ray", 3, diagnostics);
    REQUIRE(surface);
    REQUIRE(surface->triangles.size() == 2);
    CHECK(surface->triangles[0][1].position == glm::dvec3(3, 0, 0));
    CHECK(surface->triangles[0][1].normal == glm::dvec3(0, 0, 1));
    CHECK(surface->triangles[0][1].uv == glm::dvec2(0.5, 1));
    CHECK(surface->triangles[1][0].normal == glm::dvec3(1, 0, 0));
    CHECK(surface->end == glm::dvec3(0));
    CHECK(diagnostics.empty());
}

TEST_CASE("a file of triangles that lacks vertices is left out", "[geometry]") {
    std::vector<Diagnostic> diagnostics;
    CHECK_FALSE(
        read_triangles_text("triangle\n0 0 0\n0 1 0\ntriangle\n0 0 0\n0 1 0\n1 1 1\n", "a.ray", 1, diagnostics));
    CHECK_FALSE(read_triangles_text("nothing\n", "a.ray", 1, diagnostics));
    REQUIRE(diagnostics.size() == 2);
    CHECK(to_string(diagnostics[0]) ==
          "a.ray:1:1: 1 of 2 triangles have fewer than three vertices; the surface is "
          "left out\n    triangle\n    ^");
    CHECK(diagnostics[1].message == "there is no triangle in this file; the surface is left out");
    CHECK_THROWS_WITH(read_triangles_text("triangle\n0 0 zero\n", "a.ray", 1, diagnostics),
                      "a.ray:2:5: 'zero' is no number\n    0 0 zero\n        ^");
}

TEST_CASE("contours are read in all their versions", "[geometry]") {
    const Contour diamond({{1, 0, 0}, {0, 2, 0}, {0, 2, 0}, {-1, 0, 0.5}, {0, -2, 0}}, true);
    const std::string points = "1 0 0 1\n0 2 0 2\n-1 0 0.5 1\n0 -2 0 1\n";
    const std::string head = "name: d\npoints: 4 5\n";
    CHECK(same(*contour_of("cver 1 3\n" + head + "type: cr\nsamples: 10\n" + points).contour, diamond));
    CHECK(
        same(*contour_of("cver 1 3\n" + head + "type: cr\nsamples: 10\nbackground: x\n1 2\nmarkers: 1\n0.5\n" + points)
                  .contour,
             diamond));
    CHECK(same(*contour_of("cver 1 2\n" + head + "type: cr\n" + points).contour, diamond));
    CHECK(same(*contour_of("cver 1 1\n" + head + "type: round\n" + points).contour, diamond));
    CHECK(same(*contour_of("5 3 closed\n1 0 0\n0 2 0\n0 2 0\n-1 0 0.5\n0 -2 0\n").contour, diamond));
    CHECK_FALSE(contour_of("cver 1 1\n" + head + "type: open\n" + points).contour->closed());
    CHECK_FALSE(contour_of("cver 1 3\n" + head + "type: or\nsamples: 1\n" + points).contour->closed());
    CHECK(contour_of("4 2 open\n0 0\n1 0\n1 1\n0 1\n").contour->sample(3).front().position.z == 0);
}

TEST_CASE("contours that go through their points are read as those that do not, with a word", "[geometry]") {
    const auto read = contour_of("cver 1 3\nname: d\npoints: 3 3\ntype: ce\nsamples: 1\n1 0 0 1\n0 1 0 1\n-1 0 0 1\n");
    CHECK(same(*read.contour, Contour({{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}}, true)));
    REQUIRE(read.diagnostics.size() == 1);
    CHECK(read.diagnostics[0].severity == Diagnostic::Severity::warning);
    CHECK(read.diagnostics[0].place.line == 4);
}

TEST_CASE("contours of unknown versions and types are the circle", "[geometry]") {
    const auto version = contour_of("cver 2 0\nname: d\n");
    CHECK_FALSE(version.contour);
    CHECK(version.diagnostics.at(0).message ==
          "contours are read from 'cver 1 1' to 'cver 1 3' only; the circle is drawn instead");
    const auto type = contour_of("cver 1 3\nname: d\npoints: 3 3\ntype: xr\n");
    CHECK_FALSE(type.contour);
    CHECK(type.diagnostics.at(0).place.column == 7);
    CHECK_THROWS_WITH(contour_of("cver 1 3\nname: d\npoints: 4 4\ntype: or\nsamples: 2\n0 0 0 1\n"),
                      "a.con:7:1: the file ends too early");
    CHECK_THROWS_WITH(contour_of("cver 1 3\nname: d\npoints: 3 3\ntype: or\nsamples: 2\n0 0 0 1\n1 0 0 1\n1 1 0 1\n"),
                      Catch::StartsWith("a.con:1:1: an open contour needs at least 4 points, not 3"));
}

TEST_CASE("a colour map is 256 colours", "[geometry]") {
    const TemporaryFolder folder;
    std::string bytes;
    for (int i = 0; i < 256; ++i) bytes += {char(i), char(255 - i), char(i / 2)};
    Palette palette;
    read_colour_map(folder.write("a.map", bytes + "more"), 1, palette);
    CHECK(palette.entries.size() == 256);
    CHECK(palette.material(10).diffuse == glm::dvec4(10 / 255., 245 / 255., 5 / 255., 1));
    CHECK(palette.material(256 + 10).diffuse == palette.material(10).diffuse);
    const double grey = 200 / 255.;
    CHECK(palette.material(512 + 10).diffuse == glm::dvec4(grey, grey, grey, 1));
    read_colour_map(folder.write("b.map", std::string("\1\2\3\4", 4)), 2, palette);
    CHECK(palette.material(512).diffuse == glm::dvec4(1 / 255., 2 / 255., 3 / 255., 1));
    CHECK(palette.material(513).diffuse == glm::dvec4(1));
    CHECK_THROWS_WITH(read_colour_map(folder.write("c.map", "ab"), 1, palette),
                      Catch::EndsWith("c.map is no colour map: it has 2 bytes, fewer than one entry's 3"));
    CHECK_THROWS_WITH(read_colour_map(folder.path() / "none.map", 1, palette), Catch::Contains("none.map"));
}

TEST_CASE("a material file has entries of 15 bytes, later ones in the place of earlier", "[geometry]") {
    const TemporaryFolder folder;
    const auto entry = [](char index, char transparency, char first) {
        std::string bytes{index, transparency};
        for (char i = 0; i < 12; ++i) bytes += char(first + i);
        bytes.push_back(char(77));
        return bytes;
    };
    Palette palette;
    read_materials(folder.write("a.mat", entry(5, 0, 0) + entry(7, 51, 20) + entry(5, 0, 100) + "rest"), 1, palette);
    CHECK(palette.entries.size() == 2);
    const Material glass = palette.material(7);
    CHECK(glass.ambient == glm::dvec4(20 / 255., 21 / 255., 22 / 255., 0.8));
    CHECK(glass.diffuse == glm::dvec4(23 / 255., 24 / 255., 25 / 255., 0.8));
    CHECK(glass.emissive == glm::dvec4(26 / 255., 27 / 255., 28 / 255., 0.8));
    CHECK(glass.specular == glm::dvec4(29 / 255., 30 / 255., 31 / 255., 0.8));
    CHECK(glass.shininess == 77);
    CHECK(palette.material(5).ambient.r == 100 / 255.);
    CHECK(palette.material(6).diffuse == glm::dvec4(1));
    CHECK_THROWS_WITH(read_materials(folder.write("b.mat", "short"), 1, palette),
                      Catch::Contains("is no material file"));
}

TEST_CASE("transformations of a background apply before those that stand there", "[geometry]") {
    const std::string moved = "translate 10 0 0\nrotate 90 0 0 1\n";
    const std::string corner = "polygon 1 1 1 0 0 0 1 0 0\n";
    const Background background = background_of(moved + "pushmatrix multmatrix 1 0 0 0 0 2 0 0 0 0 3 0 5 6 7 1\n" +
                                                corner + "popmatrix\n" + corner);
    REQUIRE(background.vertices.size() == 6);
    CHECK(near(background.vertices[0].position, {2, 6, 10}));
    CHECK(near(background.vertices[5].position, {10, 1, 0}));
    CHECK(background.pieces.size() == 1);
}

TEST_CASE("solids of a background are closed, outside out, where and as large as they should be", "[geometry]") {
    CHECK(volume_of(background_of("box 2 3 4")) == Approx(24));
    CHECK(volume_of(background_of("prism 2 3 4")) == Approx(24));
    const double round = 24 / (2 * std::acos(-1)) * std::sin(2 * std::acos(-1) / 24);  // a polygon of 24 sides
    const double pi = std::acos(-1);
    CHECK(volume_of(background_of("cylinder 2 5")) == Approx(20 * pi * round));
    CHECK(volume_of(background_of("cone 2 0 3")) == Approx(4 * pi * round));
    CHECK(volume_of(background_of("sphere 1")) == Approx(4 * pi / 3).epsilon(0.03));
    CHECK(volume_of(background_of("scale 2 1 1 sphere 1")) == Approx(8 * pi / 3).epsilon(0.03));
    for (const char* solid : {"box 1 2 3", "cylinder 1 2", "cone 1 0.5 2", "sphere 1"}) {
        const Background background = background_of(std::string("rotate 30 1 2 3 scale 1 2 3 ") + solid);
        for (std::size_t i = 0; i < background.triangles.size(); i += 3) {
            const auto& a = background.vertices[background.triangles[i]];
            const auto& b = background.vertices[background.triangles[i + 1]];
            const auto& c = background.vertices[background.triangles[i + 2]];
            const glm::dvec3 across = glm::cross(b.position - a.position, c.position - a.position);
            for (const auto& vertex : {a, b, c}) CHECK(glm::dot(vertex.normal, across) >= -1e-12);
            CHECK(glm::length(a.normal) == Approx(1));
        }
    }
}

TEST_CASE("meshes and rectangles of a background have the normals their order gives", "[geometry]") {
    const Background mesh = background_of("mesh 0 0 0  0 0 1  1 0 0  1 0 1  2 0 0  2 0 1");
    CHECK(mesh.triangles.size() == 12);
    // (P3 - P0) x (P2 - P1) = (1, 0, 1) x (1, 0, -1)
    CHECK(near(mesh.vertices[0].normal, {0, 1, 0}));
    const Background rectangle = background_of("rectangle 2 3 5 7");
    CHECK(near(rectangle.vertices[0].position, {5, 7, 0}));
    CHECK(near(rectangle.vertices[2].position, {7, 10, 0}));
    CHECK(near(background_of("rectangle 2 3").vertices[0].position, {0, 0, 0}));
    const Background normals = background_of("polygonuv 0 0 0 0 3 0  1 0 0 0 3 0  0 0 1 0 3 0");
    CHECK(near(normals.vertices[1].normal, {0, 1, 0}));
    CHECK(near(background_of("polygon 0 0 0 1 0 0 0 1 0").vertices[0].normal, {0, 0, 1}));
}

TEST_CASE("a material of a background holds until the next, and only its complete groups count", "[geometry]") {
    std::vector<Diagnostic> found;
    const Background background = background_of(
        "sphere 1\n"
        "material 0.1 0.2 0.3 1  0.4 0.5 0.6 0.5  0 0 0 1  0 0 0 1  9\nsphere 1\n"
        "material 1 1 1\nmaterial 1 1 1 1 0.7\nsphere 1\n"
        "/* the end */ material 0 0 0 1\n",
        &found);
    CHECK(found.size() == 1);  // the material of three numbers
    REQUIRE(background.pieces.size() == 3);
    CHECK(background.pieces[0].material.diffuse == glm::dvec4(1));
    CHECK_FALSE(background.pieces[0].transparent());
    CHECK(background.pieces[1].material.shininess == 9);
    CHECK(background.pieces[1].transparent());
    CHECK(background.pieces[2].material.ambient == glm::dvec4(1));
    CHECK(background.pieces[2].material.diffuse.a == 0.5);
    CHECK(background.pieces[0].count + background.pieces[1].count + background.pieces[2].count ==
          background.triangles.size());
}

TEST_CASE("backgrounds may define macros, and what nobody understands is told and passed over", "[geometry]") {
    std::vector<Diagnostic> found;
    const Background background = background_of(
        "#define SIZE 2 2 2\n"
        "matrixmode 1 loadidentity\n"
        "blob 1 2 3\n"
        "box SIZE\n"
        "cone 1\n"
        "popmatrix\n"
        "polygon 0 0 0, 1 1 1 2 2 2\n",
        &found);
    CHECK(volume_of(background) == Approx(8));
    REQUIRE(found.size() == 5);
    CHECK(to_string(found[0]) == "a.gls:3:1: background scenes have no command 'blob'\n    blob 1 2 3\n    ^");
    CHECK(found[1].message == "'cone' needs at least 3 numbers, not 1");
    CHECK(found[2].message == "no matrix was pushed that could be popped");
    CHECK(found[3].message == "'polygon' needs at least 9 numbers, not 3");
    CHECK(found[4].message == "background scenes have no command ','");
}
