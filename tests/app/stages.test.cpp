// Plants with geometry stages, from the scene to other programs' files.
#include "base/picture_file.h"
#include "catch.h"
#include "program.h"

#include <nlohmann/json.hpp>

#include <cstring>

using Catch::Contains;

namespace {

const char* const staged_scene = R"([[plant]]
model = "bush.l"
[[plant.stage]]
stage = "pipe-radii"
tip = 0.02
[[plant.stage]]
stage = "leaves"
kind = "KIND"
per_node = 3
size = 0.4
texture = "leaf.ppm"
)";

/// A bush whose leaves are half red, half blue.
struct Leafy : Workplace {
    Leafy() {
        write("bush.l", models::bush);
        write("leaf.ppm", std::string("P6\n2 1\n255\n") + "\xff" + std::string(4, '\0') + "\xff");
    }
    void grow(const std::string& kind) const {
        std::string text = staged_scene;
        text.replace(text.find("KIND"), 4, kind);
        write("scene.toml", text);
        const Outcome outcome = run("run scene.toml --steps 3 --output run --quiet");
        INFO(outcome.err);
        REQUIRE(outcome.code == 0);
    }
    nlohmann::json exported(const std::string& arguments) const {
        const Outcome outcome = run("export run --json " + arguments);
        INFO(outcome.err);
        REQUIRE(outcome.code == 0);
        return nlohmann::json::parse(outcome.out)["files"][0];
    }
    nlohmann::json glb(const std::string& name) const {
        const std::string bytes = text_of(path() / name);
        std::uint32_t length = 0;
        std::memcpy(&length, bytes.data() + 12, 4);
        return nlohmann::json::parse(bytes.substr(20, length));
    }
};

// After three steps.
constexpr std::size_t internodes = 26;

}  // namespace

TEST_CASE_METHOD(Leafy, "leaves reach OBJ with their pictures, two vertices a triangle", "[export]") {
    run("run bush.l --steps 3 --output bare --quiet");
    const auto bare = nlohmann::json::parse(run("export bare --format obj --json").out)["files"][0];
    const auto [kind, vertices] = GENERATE(table<std::string, std::size_t>({{"cross", 8}, {"card", 4}}));
    grow(kind);
    const auto leafy = exported("--format obj --output tree");
    const std::size_t leaves = 3 * internodes;
    CHECK(leafy["vertices"] == bare["vertices"].get<std::size_t>() + vertices * leaves);
    CHECK(leafy["triangles"] == bare["triangles"].get<std::size_t>() + vertices / 2 * leaves);
    const std::string materials = text_of(path() / "tree" / "scene-0003.mtl");
    CHECK_THAT(materials, Contains("map_Kd scene-leaf.png"));
    CHECK(std::filesystem::exists(path() / "tree" / "scene-leaf.png"));
}

TEST_CASE_METHOD(Leafy, "leaves are instances of one card in glTF", "[export]") {
    grow("cross");
    CHECK(exported("--format gltf --instances --output tree.glb")["instances"] == 3 * internodes);
    const nlohmann::json tree = glb("tree.glb");
    CHECK(tree["meshes"].size() == 2);  // the axes, and a leaf
    CHECK(tree["images"].size() == 1);
}

TEST_CASE_METHOD(Leafy, "render draws leaves with their pictures", "[render]") {
    grow("card");
    const Outcome drawn = run("render run --size 160x160 --output leaves.png");
    if (drawn.code == 2 && drawn.err.find("no picture can be drawn here") != std::string::npos) {
        WARN("skipped: " << drawn.err);
        return;
    }
    REQUIRE(drawn.code == 0);
    int red = 0, blue = 0, green = 0;
    for (const auto& [r, g, b] : espalier::read_picture(path() / "leaves.png").pixels) {
        red += r > g + 60 && r > b + 60;
        blue += b > g + 60 && b > r + 60;
        green += g > r + 20 && g > b + 20;
    }
    CHECK(red > 200);
    CHECK(blue > 200);
    CHECK(green == 0);
}

TEST_CASE_METHOD(Leafy, "a picture that is missing is told before the run", "[app]") {
    grow("cross");
    std::filesystem::remove(path() / "leaf.ppm");
    const Outcome outcome = run("run scene.toml --output other");
    CHECK(outcome.code == 1);
    CHECK_THAT(outcome.err, Contains("scene.toml:11") && Contains("there is no picture") && Contains("leaf.ppm"));
}

TEST_CASE_METHOD(Leafy, "stages are listed and explained", "[app]") {
    const Outcome all = run("list stages");
    for (const char* name : {"droop", "leaves", "pipe-radii", "smooth", "stem", "sway"})
        CHECK_THAT(all.out, Contains(name));
    CHECK_THAT(run("list stages droop").out, Contains("lambda") && Contains("Brzoska 2019"));
}
