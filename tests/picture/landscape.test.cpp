// Pictures of landscapes: rays against a plain search, cards, memory, and a hundred thousand plants.
#include "espalier/base/error.h"
#include "espalier/base/random.h"

#include "archive/landscape/planted.h"
#include "catch.h"
#include "picture/landscape/landscape_picture.h"

#include <glm/geometric.hpp>
#include <tbb/global_control.h>

#include <fstream>

using namespace espalier;
using namespace espalier::picture;
using Catch::Contains;

namespace {

const RayLight light{glm::normalize(glm::vec3(-1, 1, 1))};

std::shared_ptr<const OpacityPicture> no_texture(const std::string&) {
    return nullptr;
}

LandscapeLook small_look(int width = 96, int height = 64) {
    LandscapeLook look;
    look.size = {width, height};
    look.samples = 2;
    look.texture_of = no_texture;
    return look;
}

std::vector<std::vector<CardPicture>> cards_of(const PlantedLandscape& landscape, const LandscapeView& view) {
    std::vector<std::vector<CardPicture>> cards;
    for (const LandscapeSpecies& species : landscape.species) {
        cards.push_back(card_pictures(species, view.eye - view.target, light, 48, no_texture));
    }
    return cards;
}

/// Rows of plants that stand 4 m apart.
PlantedLandscape rows_of_plants(int count, double apart) {
    std::vector<StandPlant> stand;
    const int side = static_cast<int>(std::ceil(std::sqrt(count)));
    for (int i = 0; i < count; ++i) {
        stand.push_back({{apart * (i % side - side / 2.0), apart * (i / side - side / 2.0)}, 0.5, 1 + i % 2});
    }
    return planted(flat_terrain(apart * side), {small_species(1), small_species(2)}, stand, {0, 4, apart * side / 2.0},
                   few_levels, 3);
}

/// Resident memory of this program, bytes.
double resident() {
    std::ifstream file("/proc/self/statm");
    double pages = 0;
    file >> pages >> pages;
    return 4096 * pages;
}

}  // namespace

TEST_CASE("a ray meets what a search of all triangles finds", "[landscape]") {
    const FrameMesh mesh = small_species().levels.front();
    const RayMesh rays(mesh, no_texture);
    PlacedMeshes scene({&rays});
    scene.place({{0, 2, glm::vec3(5, 6, 7), glm::quat(0.5F, 0.5F, 0.5F, 0.5F)}});
    const auto outside = [](const glm::vec3& place) {  // the turn takes x to y, y to z and z to x
        return glm::vec3(5, 6, 7) + 2.0F * glm::vec3(place.z, place.x, place.y);
    };
    RandomSamples samples({1, 2, Stream::process}, 3, 4);
    int met = 0;
    for (int i = 0; i < 400; ++i) {
        const glm::vec3 from(4 * samples.uniform() - 2, 3 * samples.uniform(), 3),
            to(samples.uniform() - 0.5, 2 * samples.uniform(), -0.5);
        const glm::vec3 direction = glm::normalize(to - from);
        float nearest = std::numeric_limits<float>::max();
        for (const auto& [a, b, c] : mesh.triangles) {
            const glm::dvec3 o(mesh.points[a]), u = glm::dvec3(mesh.points[b]) - o, v = glm::dvec3(mesh.points[c]) - o;
            const glm::dvec3 normal = glm::cross(u, v), d(direction);
            if (glm::length(normal) == 0 || glm::dot(normal, d) == 0) continue;
            const double t = glm::dot(o - glm::dvec3(from), normal) / glm::dot(d, normal);
            const glm::dvec3 at = glm::dvec3(from) + t * d - o;
            const double s = glm::dot(glm::cross(at, v), normal) / glm::dot(normal, normal);
            const double r = glm::dot(glm::cross(u, at), normal) / glm::dot(normal, normal);
            if (t > 0 && s >= 0 && r >= 0 && s + r <= 1) nearest = std::min(nearest, static_cast<float>(t));
        }
        const glm::vec3 towards = glm::vec3(direction.z, direction.x, direction.y);
        const auto seen = scene.seen(outside(from), towards, light);
        const bool hit = seen.has_value();
        CHECK(hit == (nearest < 1e30F));
        CHECK(hit == scene.is_dark(outside(from), towards));
        if (hit) CHECK(seen->distance == Approx(2 * nearest).epsilon(1e-4));
        met += hit;
    }
    CHECK(met > 50);
}

TEST_CASE("a card's picture shows the plant over a transparent ground, and covers it", "[landscape]") {
    const LandscapeSpecies species = small_species();
    const CardPicture card = card_pictures(species, {0, 3, 20}, light, 128, no_texture).at(1);
    const OpacityPicture& picture = *card.picture;
    CHECK(std::max(picture.width, picture.height) == 128);
    std::size_t clear = 0, opaque = 0;
    std::array<bool, 4> touched{};
    for (std::size_t y = 0; y < picture.height; ++y) {
        for (std::size_t x = 0; x < picture.width; ++x) {
            clear += picture.at(x, y)[3] == 0;
            opaque += picture.at(x, y)[3] == 255;
            if (picture.at(x, y)[3] == 0) continue;
            const std::size_t edge = 2;
            touched[0] |= x < edge, touched[1] |= x + edge >= picture.width;
            touched[2] |= y < edge, touched[3] |= y + edge >= picture.height;
        }
    }
    CHECK(clear > picture.pixels.size() / 2);
    CHECK(opaque > 0);
    for (const bool edge : touched) CHECK(edge);  // no part of the plant is cut off, and no room is wasted
    // From straight ahead the foot is at the lower edge in the middle.
    CHECK(card.frame.lower.y < -0.45 * species.height);
    CHECK(card.frame.lower.x < 0);
    CHECK(card.frame.upper.x > 0);
}

TEST_CASE("a card covers in the picture what the plant itself covers", "[landscape]") {
    const LandscapeSpecies species = small_species();
    const LandscapeView view{{0, 1, 30}, {0, 1, 0}, 6};
    const std::vector<StandPlant> stand{{{0, 0}, species.radius, 1}};
    const auto covered = [&](double cards_from) {
        const PlantedLandscape landscape = planted(Terrain({-1, -1}, {1, 1}, {2, 2}, [](double, double) { return -9; }),
                                                   {species}, stand, view.eye, {{0}, cards_from}, 0);
        PlantedLandscape standing = landscape;
        standing.plants[0].position.y = 0;
        LandscapeLook look = small_look(160, 160);
        look.visibility = 1e9;
        const OpacityPicture picture =
            landscape_picture(standing, cards_of(standing, view), view, light, look, [](double) {});
        std::vector<bool> dark;
        for (const auto& pixel : picture.pixels) dark.push_back(pixel[2] < 190);  // the sky is bluer
        return dark;
    };
    const std::vector<bool> mesh = covered(1000), card = covered(1);
    double both = 0, any = 0;
    for (std::size_t i = 0; i < mesh.size(); ++i) {
        both += mesh[i] && card[i];
        any += mesh[i] || card[i];
    }
    CHECK(any > 300);
    CHECK(both / any > 0.6);  // twigs are thinner than a pixel of the card
}

TEST_CASE("a landscape is drawn the same with one thread, and a plant in the sun casts a shadow", "[landscape]") {
    const PlantedLandscape landscape = rows_of_plants(200, 4);
    const LandscapeView view{{0, 10, 40}, {0, 0, 0}, 40};
    const auto cards = cards_of(landscape, view);
    const auto draw = [&] { return landscape_picture(landscape, cards, view, light, small_look(), [](double) {}); };
    const OpacityPicture picture = draw();
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    CHECK(draw().pixels == picture.pixels);
    for (const auto& pixel : picture.pixels) CHECK(pixel[3] == 255);
    const RayMesh mesh(landscape.species[0].levels[0], no_texture);
    PlacedMeshes scene({&mesh});
    scene.place({{0, 1, glm::vec3(0), glm::quat(1, 0, 0, 0)}});
    CHECK(scene.is_dark(glm::vec3(0, 0.7F, 0) - 0.5F * light.towards_sun, light.towards_sun));
    CHECK_FALSE(scene.is_dark(glm::vec3(9, 0, 0), light.towards_sun));
}

TEST_CASE("a landscape that needs more memory than it may, or more time, says so", "[landscape]") {
    const PlantedLandscape landscape = rows_of_plants(20, 4);
    const LandscapeView view{{0, 10, 40}, {0, 0, 0}, 40};
    LandscapeLook look = small_look();
    look.memory = 1000;
    CHECK_THROWS_WITH(landscape_picture(landscape, cards_of(landscape, view), view, light, look, [](double) {}),
                      Contains("--memory 1000"));
    look.memory = 0;
    int bands = 0;
    const auto stop = [&](double) {
        if (++bands == 2) throw RunError("the time was over");
    };
    CHECK_THROWS_AS(landscape_picture(landscape, cards_of(landscape, view), view, light, look, stop), RunError);
}

TEST_CASE("102,000 plants take less than 2 GB", "[landscape]") {
    const double before = resident();
    const PlantedLandscape landscape = rows_of_plants(102000, 4);
    CHECK(landscape.plants.size() == 102000);
    CHECK(landscape.count(0, PlantedPlant::card_level) > 40000);
    const LandscapeView view{{0, 40, 640}, {0, 0, 0}, 40};
    const auto cards = cards_of(landscape, view);
    double most = 0;
    landscape_picture(landscape, cards, view, light, small_look(), [&](double) { most = std::max(most, resident()); });
    CHECK(most - before < 2e9);
    CHECK(landscape.triangles_in_full() == 102000 * landscape.species[0].triangles);
}
