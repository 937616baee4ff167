// Skeleton descriptions of the library: components in each generation, and what their fibres are.
#include "catch.h"
#include "experiments/growth.h"
#include "geometry/mesh_checks.h"
#include "models/measure.h"

using namespace espalier;

namespace {

LonePlant plant(const std::string& name) {
    return LonePlant("models/sdl/" + name + ".sdl");
}

}  // namespace

TEST_CASE("straw.sdl: n generations have 1 + n components, drawn as lines", "[models]") {
    LonePlant straw = plant("straw");
    for (int n = 1; n <= 12; ++n) {
        straw.grow(1);
        CHECK(straw.interpretation.geometry.internodes.size() == std::size_t(1 + n));
        for (const auto& features : parameters_of(straw.string, straw.model->alphabet, "straw")) {
            const double i = std::round(features[2] / 30);
            CHECK(features[0] >= 1 + 0.5 * std::max(1.0, features[2] / 40) - 1e-9);
            CHECK(features[0] <= 1 + 1.1 * features[2] / 20 + 1e-9);
            CHECK(i >= 1);
        }
    }
}

TEST_CASE("grass.sdl: sixty blades, then four stalks, then their ears", "[models]") {
    LonePlant grass = plant("grass");
    grass.grow(1);
    CHECK(grass.counts()["blade"] == 60);
    CHECK(grass.counts()["stalk"] == 0);
    grass.grow(1);
    CHECK(grass.counts()["stalk"] == 4);
    grass.grow(1);
    CHECK(grass.counts()["ear"] == 4);
}

TEST_CASE("fern.sdl: nine fronds get a segment in each generation, and each segment but the last two pinnae",
          "[models]") {
    LonePlant fern = plant("fern");
    fern.grow(1);
    for (int n = 2; n <= 12; ++n) {
        fern.grow(1);
        CHECK(fern.counts()["frond"] == 9);
        CHECK(fern.counts()["axis"] == 9 * (n - 1));
        CHECK(fern.counts()["right"] == 9 * (n - 2));
        CHECK(fern.counts()["left"] == 9 * (n - 2));
    }
}

TEST_CASE("daisy.sdl: five heads with 24 petals", "[models]") {
    LonePlant daisy = plant("daisy");
    daisy.grow(3);
    CHECK(daisy.counts()["head"] == 5);
    CHECK(daisy.counts()["petal"] == 120);
    CHECK(daisy.counts()["blade"] == 16);
}

TEST_CASE("palm.sdl: one trunk, and twenty fronds with leaflets when it is grown up", "[models]") {
    LonePlant palm = plant("palm");
    palm.grow(14);
    CHECK(palm.counts()["frond"] == 0);
    palm.grow(2);
    CHECK(palm.counts()["frond"] == 20);
    CHECK(palm.counts()["right"] == 20 * 24);
}

TEST_CASE("spruce.sdl: a whorl of six branches for each shoot but the last", "[models]") {
    LonePlant spruce = plant("spruce");
    for (int n = 1; n <= 6; ++n) {
        spruce.grow(1);
        CHECK(spruce.counts()["shoot"] == n);
        CHECK(spruce.counts()["branch"] == 6 * n);
    }
}

TEST_CASE("agave.sdl: 34 leaves, which enclose a volume", "[models]") {
    LonePlant agave = plant("agave");
    agave.grow(1);
    const DrawnMesh& mesh = agave.interpretation.geometry.mesh;
    CHECK(agave.counts()["blade"] == 34);
    CHECK(enclosed_volume(mesh) > 0);
}

TEST_CASE("bush.sdl: each generation has three times as many new twigs as the one before, and four leaves for each",
          "[models]") {
    LonePlant bush = plant("bush");
    for (int n = 1, twigs = 0, born = 3; n <= 6; ++n, born *= 3) {
        bush.grow(1);
        CHECK(bush.counts()["twig"] == (twigs += born));
        CHECK(bush.counts()["leaf"] == 4 * (twigs - 3));
    }
}

TEST_CASE("tree.sdl: of the boughs, 5 % end, 60 % fork in two and 35 % in three", "[models]") {
    LonePlant tree = plant("tree");
    tree.grow(5);
    const double older = tree.counts()["bough"];
    tree.grow(1);
    const double boughs = tree.counts()["bough"], forked = boughs - older;
    tree.grow(1);
    const double born = tree.counts()["bough"] - boughs - 3;  // three on the leader
    REQUIRE(forked > 100);
    const double variance = 0.6 * 4 + 0.35 * 9 - 2.25 * 2.25;
    CHECK(std::abs(born / forked - 2.25) < 3 * std::sqrt(variance / forked));
}
