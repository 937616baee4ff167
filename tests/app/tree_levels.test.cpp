// Coarse trees: how much of each preset's wood few triangles leave, and levels of detail in one file.
#include "archive/meshes/texture_picture.h"
#include "catch.h"
#include "formats/obj_file.h"
#include "program.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <numeric>
#include <set>

using Catch::Contains;
using nlohmann::json;
using namespace espalier;

namespace {

/// The axes of a mesh: how many there are, what they span, and how wide what stands half way up the stem is.
struct Wood {
    std::size_t axes = 0;
    glm::dvec3 lower{1e9}, upper{-1e9};
    double trunk = 0;

    Wood(const ObjFile& mesh, double stem) {
        std::set<std::string> names;
        double left = 1e9, right = -1e9;
        for (const auto& face : mesh.faces) {
            if (face.group.find("axis") == std::string::npos) continue;
            names.insert(face.group);
            for (std::size_t k = 0; k < 3; ++k) {
                const glm::dvec3 &a = mesh.points[face.points[k]], &b = mesh.points[face.points[(k + 1) % 3]];
                lower = glm::min(lower, a);
                upper = glm::max(upper, a);
                if ((a.y < stem / 2) == (b.y < stem / 2)) continue;
                const double x = a.x + (stem / 2 - a.y) / (b.y - a.y) * (b.x - a.x);
                left = std::min(left, x);
                right = std::max(right, x);
            }
        }
        axes = names.size();
        trunk = right - left;
    }
};

/// The JSON and the binary chunk of a .glb.
struct GlbFile {
    json description;
    std::string binary;

    explicit GlbFile(const std::filesystem::path& path) {
        const std::string bytes = text_of(path);
        std::uint32_t size = 0;
        std::memcpy(&size, bytes.data() + 12, sizeof size);
        description = json::parse(bytes.substr(20, size));
        binary = bytes.substr(20 + size + 8);
    }

    std::size_t triangles(std::size_t node) const {
        const json& mesh = description["meshes"][description["nodes"][node]["mesh"].get<std::size_t>()];
        std::size_t corners = 0;
        for (const json& part : mesh["primitives"]) {
            corners += description["accessors"][part["indices"].get<std::size_t>()]["count"].get<std::size_t>();
        }
        return corners / 3;
    }
};

}  // namespace

TEST_CASE_METHOD(Workplace, "few triangles leave a tree of each preset its trunk and the limbs of its first orders",
                 "[tree]") {
    int seed = 7300;
    for (const std::string preset : {"decurrent", "excurrent", "flat", "gnarly", "orchard", "shrub", "weeping"}) {
        const std::string tree = fmt::format("tree --preset {} --seed {} --json --quiet ", preset, ++seed);
        const std::size_t all = json::parse(run(tree + "--output " + preset + ".obj").out)["files"][0]["triangles"];
        const std::size_t asked = all / 20;
        REQUIRE(run(fmt::format("{} --triangles {} --output few-{}.obj", tree, asked, preset)).code == 0);
        const ObjFile whole(path() / (preset + ".obj")), few(path() / ("few-" + preset + ".obj"));
        constexpr double stem = 0.3;  // less than that of any preset
        const Wood before(whole, stem), after(few, stem);
        INFO(preset << ", seed " << seed << ": " << all << " triangles to " << few.faces.size() << ", axes "
                    << before.axes << " to " << after.axes << ", trunk " << before.trunk << " to " << after.trunk
                    << ", height " << before.upper.y << " to " << after.upper.y);
        CHECK(few.faces.size() <= asked);
        CHECK(few.faces.size() > 0.8 * double(asked));
        CHECK(after.axes >= 10);
        CHECK(after.trunk > 0.3 * before.trunk);  // a shrub loses stems
        CHECK(after.trunk < 1.6 * before.trunk);
        CHECK(after.lower.y < 0.05);
        CHECK(after.upper.y > 0.6 * before.upper.y);
        CHECK(after.upper.x - after.lower.x > 0.5 * (before.upper.x - before.lower.x));
    }
}

TEST_CASE_METHOD(Workplace, "levels of detail stand in one file, each coarser than the one before, the last two cards",
                 "[tree]") {
    const Outcome outcome = run("tree --age 14 --seed 7321 --lod 4 --json --quiet --output oak.glb");
    REQUIRE(outcome.code == 0);
    const json told = json::parse(outcome.out)["files"];
    REQUIRE(told.size() == 1);
    const GlbFile file(path() / "oak.glb");
    const json& glb = file.description;
    REQUIRE(glb["nodes"].size() == 4);
    // A viewer that does not know MSFT_lod shows the nodes of the scene: the finest level alone.
    CHECK(glb["scenes"][0]["nodes"] == json::array({0}));
    CHECK(glb["nodes"][0]["extensions"]["MSFT_lod"]["ids"] == json::array({1, 2, 3}));
    CHECK(glb["nodes"][0]["extras"]["MSFT_screencoverage"] == json::array({0.5, 0.25, 0.125, 0.0}));
    CHECK(glb["extensionsUsed"] == json::array({"KHR_materials_unlit", "MSFT_lod"}));
    CHECK_FALSE(glb.contains("extensionsRequired"));
    std::vector<std::size_t> triangles;
    for (std::size_t node = 0; node < 4; ++node) triangles.push_back(file.triangles(node));
    CHECK(told[0]["levels"] == json(triangles));
    CHECK(told[0]["triangles"] == std::accumulate(triangles.begin(), triangles.end(), std::size_t{0}));
    CHECK(triangles[0] ==
          json::parse(run("tree --age 14 --seed 7321 --json --quiet --output one.glb").out)["files"][0]["triangles"]);
    CHECK(triangles[1] == Approx(double(triangles[0]) / 4).epsilon(0.1));
    CHECK(triangles[2] == Approx(double(triangles[0]) / 16).epsilon(0.1));
    CHECK(triangles[3] == 4);
}

TEST_CASE_METHOD(Workplace, "the cards of a tree stand where it does, and wear pictures of it over nothing", "[tree]") {
    REQUIRE(run("tree --age 14 --seed 7322 --lod 2 --quiet --output oak.glb").code == 0);
    const GlbFile file(path() / "oak.glb");
    const json& glb = file.description;
    const auto bounds = [&](std::size_t node) -> const json& {
        const json& mesh = glb["meshes"][glb["nodes"][node]["mesh"].get<std::size_t>()];
        return glb["accessors"][mesh["primitives"][0]["attributes"]["POSITION"].get<std::size_t>()];
    };
    for (const char* side : {"min", "max"}) {
        for (std::size_t k = 0; k < 3; ++k) {
            // A picture has whole pixels: a card ends at most one of 512 behind the tree.
            CHECK(bounds(1)[side][k].get<double>() == Approx(bounds(0)[side][k].get<double>()).margin(0.03));
        }
    }
    for (const std::size_t card : {0, 1}) {
        const json& view = glb["bufferViews"][glb["images"][card]["bufferView"].get<std::size_t>()];
        write("card.png", file.binary.substr(view["byteOffset"], view["byteLength"]));
        const OpacityPicture picture = *texture_picture({}, (path() / "card.png").string());
        CHECK(std::max(picture.width, picture.height) == 512);
        std::size_t opaque = 0, green = 0;
        for (const auto& [red, greenness, blue, opacity] : picture.pixels) {
            opaque += opacity > 127;
            green += opacity > 127 && greenness > red && greenness > blue;
        }
        CHECK(opaque > picture.pixels.size() / 10);
        CHECK(opaque < 9 * picture.pixels.size() / 10);
        CHECK(green > opaque / 2);
    }
}

TEST_CASE_METHOD(Workplace, "levels of detail are refused where there can be none", "[tree]") {
    CHECK_THAT(run("tree --age 3 --lod 3 --output oak.obj").err, Contains("--lod needs the extension .glb"));
    CHECK_THAT(run("tree --age 3 --lod 3 --instances --output oak.glb").err, Contains("leave out --instances"));
    CHECK_THAT(run("tree --age 1 --leaves 0 --lod 8 --output oak.glb").err, Contains("ask for fewer levels"));
    CHECK_FALSE(std::filesystem::exists(path() / "oak.glb"));
}
