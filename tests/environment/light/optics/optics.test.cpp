#include "environment/light/optics/optics.h"

#include "catch.h"
#include "environment/light/lit_leaves.h"
#include "temporary_folder.h"

using namespace espalier;
using namespace espalier::environment;

namespace {

Optics optics_of(const std::string& lines) {
    return Optics(Settings::parse_toml(lines, "scene.toml"));
}

}  // namespace

TEST_CASE("materials have optical numbers by colour, band and side", "[optics]") {
    const Optics optics = optics_of(
        "bands = { par = {}, nir = { leaf = [0.5, 0.3], leaf_back = [0.2, 0.6] } }\n"
        "[[materials]]\nname = \"petal\"\ncolours = [4, 7]\npar = [0.6, 0.2]\n"
        "par_back = [0.1, 0.2]\n[[materials]]\nname = \"other\"\n");
    const std::uint16_t petal = *optics.material_of(LitKind::leaf, 7), other = *optics.material_of(LitKind::leaf, 1);
    CHECK(optics.material_name(petal) == "petal");
    CHECK(optics.material_name(other) == "other");
    CHECK(optics.of(LitKind::leaf, petal, 0).front.reflectance == 0.6);
    CHECK(optics.of(LitKind::leaf, petal, 0).back.reflectance == 0.1);
    CHECK(optics.of(LitKind::leaf, petal, 1).back.transmittance == 0.6);
    CHECK(optics.of(LitKind::body, petal, 0).back.reflectance == 0.6);  // a fruit has no back that light meets
    CHECK(optics.of(LitKind::body, petal, 1).back.transmittance == 0);
    CHECK(optics.material_name(*optics.material_of(LitKind::stem, 1)) == "stem");
}

TEST_CASE("optical numbers that cannot be are refused in a line with their place", "[optics]") {
    const auto refusal = [](const std::string& lines) { return message_of([&] { optics_of(lines); }); };
    CHECK(lacks(refusal("bands.par = { leaf = [0.7, 0.4] }\n"), {"scene.toml:1", "1 together at most", "1.1"}) == "");
    CHECK(lacks(refusal("bands.par = { leaf_back = [0.7, 0.4] }\n"), {"leaf_back", "1 together"}) == "");
    CHECK(lacks(refusal("[[materials]]\nname = \"a\"\npar = [0.9, 0.2]\n"), {"scene.toml:3", "1 together"}) == "");
    CHECK(lacks(refusal("[[materials]]\nname = \"a\"\ncolours = [1]\n[[materials]]\nname = \"b\"\ncolours = [1]\n"),
                {"already that of the material 'a'"}) == "");
    CHECK(lacks(refusal("[[materials]]\nname = \"a\"\n[[materials]]\nname = \"b\"\n"), {"only one"}) == "");
    CHECK(lacks(refusal("bands.par = { soil = 1.5 }\n"), {"soil"}) == "");
    CHECK(lacks(refusal("bands.uv = { leaf = [0.1, 0] }\n"), {"'uv' needs share"}) == "");
}

TEST_CASE("a leaf without a material ends the run in one line", "[optics]") {
    for (const char* process : {"ray-light", "canopy-light"}) {
        Environment light = light_process(process, "materials = [{ name = \"leaf\", colours = [3] }]\n");
        AskingPlants plants;
        plants.add({{{0, 0, 0}, {0}}, {{0, 0, 0}, {0}}});
        draw_square(plants.interpretation(0).geometry, 1, {1, 1, 1}, {1, 0, 0}, {0, 0, 1}, 0.1, 3);
        plants.exchange(light, 1);
        draw_square(plants.interpretation(0).geometry, 1, {1, 1, 1}, {1, 0, 0}, {0, 0, 1}, 0.1, 5);
        const std::string message = message_of([&] { plants.exchange(light, 1); });
        CHECK(lacks(message, {"colour 5", "no material names", "colours"}) == "");
        CHECK(message.find('\n') == std::string::npos);
    }
}

TEST_CASE("the two sides of a leaf take different shares of the light that falls on them",
          "[canopy-light][ray-light]") {
    for (const char* process : {"ray-light", "canopy-light"}) {
        for (const bool upside_down : {false, true}) {
            Environment light = light_process(process,
                                              "bands.par = { leaf = [0.2, 0.1], leaf_back = [0.5, 0.1], soil = 0 }\n"
                                              "voxel = 0.5\n" +
                                                  sun_at(0));
            AskingPlants plants;
            plants.add({{{0, 0, 0}, {0, 0}}, {{0, 0, 0}, {0}}});
            const glm::dvec3 z(0, 0, upside_down ? 1 : -1);  // x cross -z is y
            draw_square(plants.interpretation(0).geometry, 1, {1, 1, 1}, {1, 0, 0}, z, 0.05);
            plants.exchange(light, 1);
            CHECK(plants.parameters()[0] == Approx(upside_down ? 0.4 : 0.7).epsilon(0.02));
        }
    }
}

TEST_CASE("a map of the soil goes from dark to bright as its picture does, again and again", "[optics]") {
    TemporaryFolder folder;
    // A Targa file of two pixels: black and white.
    const std::string head{0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 1, 0, 24, 0};
    const auto picture = folder.write("soil.tga", head + std::string(3, '\0') + std::string(3, '\xFF'));
    const Optics optics = optics_of(
        "bands.par = { soil = 0.2, soil_bright = 0.9 }\n"
        "soil_map = { picture = \"" +
        picture.string() + "\", corner = [1, 0], size = [2, 5] }\n");
    for (const double period : {-4.0, 0.0, 2.0}) {
        CHECK(optics.soil({period + 1.5, 0, 3}, 0) == Approx(0.2));
        CHECK(optics.soil({period + 2.5, 0, 3}, 0) == Approx(0.9));
    }
    CHECK(optics_of("bands.par = { soil = 0.3 }\n").soil({1, 2, 3}, 0) == 0.3);
}
