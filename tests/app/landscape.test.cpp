// `espalier landscape` from outside.
#include "catch.h"
#include "program.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>

namespace {

using Catch::Contains;

/// Plants of two species in a row, and a plant to stand for them.
struct LandscapePlace : Workplace {
    LandscapePlace() {
        write("bush.l", models::bush);
        write("stand.l",
              "lsystem: 1\nderivation length: 0\naxiom: -(90) @M(0, 0, 0) A A A A A A\n"
              "homomorphism\nA --> [ ,(1) !(2) F(0.3) ] f(3) [ ,(2) !(1) F(0.3) ] f(3)\nendlsystem\n");
        REQUIRE(run("run bush.l --output bush --quiet").code == 0);
        REQUIRE(run("run stand.l --output stand --quiet").code == 0);
        landscape("");
    }

    void landscape(const std::string& more, const std::string& heights = "0.1 * x") {
        write("land.toml", fmt::format("[stand]\nrun = 'stand'\n[terrain]\nheights = '{}'\nlower = [-50, -30]\n"
                                       "upper = [50, 30]\nplaces = 17\n"
                                       "[[species]]\ncolour = 1\nrun = 'bush'\n[[species]]\ncolour = 2\nrun = 'bush'\n"
                                       "[detail]\nlevels = [0, 20]\ncards = 30\ncard_pixels = 24\nsamples = 1\n{}",
                                       heights, more));
    }

    std::string bytes(const std::string& file) const {
        std::ifstream in(path() / file, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
};

}  // namespace

TEST_CASE("landscape draws and exports the plants of a stand, and says how many there are", "[landscape]") {
    const LandscapePlace place;
    const Outcome outcome = place.run(
        "landscape land.toml --output made/a.png --output made/a.glb --output made/a.usda --cards cards --size 80x60 "
        "--json");
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const auto json = nlohmann::json::parse(outcome.out);
    CHECK(json["plants"] == 12);
    CHECK(json["species"].size() == 2);
    std::size_t plants = 0, triangles = 0;
    for (const auto& species : json["species"]) {
        for (const auto& level : species["levels"]) {
            plants += level["plants"].get<std::size_t>();
            triangles += level["plants"].get<std::size_t>() * level["triangles"].get<std::size_t>();
        }
    }
    CHECK(plants == 12);
    CHECK(json["triangles"] == triangles);
    CHECK(place.bytes("made/a.png").substr(1, 3) == "PNG");
    CHECK(place.bytes("made/a.glb").substr(0, 4) == "glTF");
    CHECK(place.bytes("made/a.usda").find("def PointInstancer") != std::string::npos);
    CHECK(place.run("landscape land.toml --output made/b.png --size 80x60").code == 0);
    CHECK(place.bytes("made/a.png") == place.bytes("made/b.png"));
    CHECK(place.run("landscape land.toml --output made/c.png --size 80x60 --set light.azimuth=60").code == 0);
    CHECK(place.bytes("made/a.png") != place.bytes("made/c.png"));
}

TEST_CASE("landscape covers the ground around the eye, and names individuals of a species by numbers", "[landscape]") {
    LandscapePlace place;
    place.landscape("[[cover]]\nrun = 'bush'\ndensity = 0.05\ndistance = 40\nsize = 0.3\n");
    const Outcome outcome = place.run(
        "landscape land.toml --output a.png --output a.usda --cards cards --size 40x30 --json --set "
        "terrain.second_share='x > 0 ? 1 : 0' --set camera.eye=[0,3,10]");
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const auto json = nlohmann::json::parse(outcome.out);
    CHECK(json["plants"] > 100);
    CHECK(json["species"][0]["species"] == "bush");
    CHECK(json["species"][1]["species"] == "bush-2");
    CHECK(json["species"][2]["species"] == "bush-3");
    CHECK_THAT(place.run("landscape land.toml --output b.png --set species.0.colour=7").err,
               Contains("there are 7, 2"));
    CHECK_THAT(place.run("landscape land.toml --output b.png --set cover.0.density=1e9").err,
               Contains("--set cover.0.density") && Contains("plants"));
}

TEST_CASE("landscape says what is wrong, and where", "[landscape]") {
    LandscapePlace place;
    const auto message = [&](const std::string& options) {
        const Outcome outcome = place.run("landscape land.toml --output a.png --size 40x30 " + options);
        CHECK(outcome.code != 0);
        CHECK_FALSE(std::filesystem::exists(place.path() / "a.png"));
        return outcome.err;
    };
    CHECK_THAT(message("--output a.jpg"), Contains("a .png, .glb or .usda file"));
    CHECK_THAT(message("--set stand.run=nowhere"), Contains("--set stand.run: nowhere"));
    CHECK_THAT(message("--set species.0.colour=7"), Contains("colour 1") && Contains("there are 7, 2"));
    CHECK_THAT(message("--set detail.levels=[5,20]"), Contains("begin with 0"));
    CHECK_THAT(message("--memory 1K"), Contains("--memory 1024"));
    CHECK_THAT(message("--timeout 0.000001"), Contains("the time was over"));
    CHECK_THAT(place.run("landscape land.toml --output a.png --size 99999x9").err, Contains("8192"));
    place.landscape("card = 3\n");
    CHECK_THAT(message(""), Contains("card") && Contains("land.toml:"));
    place.landscape("", "sqrt(x)");
    CHECK_THAT(message(""), Contains("land.toml:4:") && Contains("no height at x = -50"));
    place.landscape("", "0.1 * y +");
    CHECK_THAT(message(""), Contains("land.toml:4:"));
}
