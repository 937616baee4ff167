// The clonal plant: it leaves the dark, fills the light, and gives back the light that its leaves took.
#include "base/picture_file.h"
#include "catch.h"
#include "experiments/growth.h"
#include "models/measure.h"
#include "temporary_folder.h"

#include <fmt/format.h>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <fstream>
#include <set>
#include <sstream>

using namespace espalier;

namespace {

constexpr double least = 0.1;  // light at which the plant grows
constexpr int life = 20;       // steps that a leaf lives
constexpr double side = 3;     // m, of the ground, whose middle is the origin

glm::dvec2 on_ground(const glm::dvec3& place) {
    return {place.x, place.z};
}

Picture ground() {
    return read_picture(source_path("environments/grounds/patches.png"));
}

double light_of(const Picture& ground, const glm::dvec2& place) {
    return ground.at(place.x / side + 0.5, place.y / side + 0.5)[1] / 255.0;
}

struct Leaf {
    glm::dvec2 place;
    double area;  ///< m2
};

/// A leaf for each upright internode, its petiole.
std::vector<Leaf> leaves(const World& world) {
    std::vector<Leaf> found;
    const auto areas = values_of(world.string(0), world.model(0).alphabet, "Leaf", 1);
    for (const Internode& internode : world.interpretation(0).geometry.internodes) {
        if (internode.tip.y < 0.001) continue;
        REQUIRE(found.size() < areas.size());
        found.push_back({on_ground(internode.base), areas[found.size()] / 10000});
    }
    REQUIRE(found.size() == areas.size());
    return found;
}

/// Apices and buds: what they are, where, and their light.
struct Asking {
    std::string name;
    glm::dvec2 place;
    double light;
};

std::vector<Asking> asking(const World& world) {
    std::vector<Asking> found;
    const ModuleString& string = world.string(0);
    const Alphabet& alphabet = world.model(0).alphabet;
    const auto offsets = parameter_offsets(string, alphabet);
    for (const Query& query : world.interpretation(0).queries) {
        const std::string& name = alphabet.name(string.letters[query.module - 1]);
        if (name != "Apex" && name != "Bud") continue;
        found.push_back({name, on_ground(query.pose.position), string.parameters[offsets[query.module]]});
    }
    return found;
}

using Line = std::array<long, 4>;

/// Level internodes from base to tip, in micrometres.
std::set<Line> stolons(const World& world) {
    std::set<Line> lines;
    const auto micrometres = [](double metres) { return std::lround(1e6 * metres); };
    for (const Internode& internode : world.interpretation(0).geometry.internodes) {
        if (internode.tip.y > 0.001) continue;
        lines.insert({micrometres(internode.base.x), micrometres(internode.base.z), micrometres(internode.tip.x),
                      micrometres(internode.tip.z)});
    }
    return lines;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - mean_of(a)) * (b[i] - mean_of(b));
    return sum / static_cast<double>(a.size() - 1) / (deviation_of(a) * deviation_of(b));
}

SceneOptions with_seed(std::uint64_t seed) {
    SceneOptions options;
    options.seed = seed;
    return options;
}

/// Places at the middles of every sixteenth cell of the ground.
constexpr int meters = 64;

glm::dvec2 place_of_meter(int column, int row) {
    return glm::dvec2(16 * column + 8.5, 16 * row + 8.5) / 1024.0 * side - side / 2;
}

/// The scene with a second plant, which measures the light of the ground. After the step `end` nothing grows any more.
Scene measured_scene(int end, std::uint64_t seed) {
    const TemporaryFolder folder;
    const std::string model = fmt::format(
        "environment light;\nlsystem: 1\naxiom: M(0)\n?light(l) --> ?light(0)\ndecomposition\nmaximum depth: {2}\n"
        "M(n) : n < {2} --> [ @M(((n % {0}) * 16 + 8.5) / 1024 * {1} - {1} / 2, 0, "
        "(floor(n / {0}) * 16 + 8.5) / 1024 * {1} - {1} / 2) ?light(0) ] M(n + 1)\nM(n) --> *\nendlsystem\n",
        meters, side, meters * meters);
    const std::string end_of_growth =
        fmt::format("[[plant.keyframes]]\nname = 'LEAST'\ntimes = [{}, {}.5]\nvalues = [{}, 1]\n", end, end, least);
    std::ifstream in(source_path("environments/clover.toml"));
    std::string text = (std::ostringstream() << in.rdbuf()).str();
    text.insert(text.find("[environment.light]"), end_of_growth);
    text += fmt::format("[[plant]]\nmodel = '{}'\n", folder.write("meter.l", model).string());
    return read_scene_text(text, "scene.toml", source_path("environments"), with_seed(seed));
}

/// Checks every meter. Returns how many are under leaves.
int check_light(const World& world, const Picture& ground) {
    const std::vector<Leaf> over = leaves(world);
    const auto measured = values_of(world.string(1), world.model(1).alphabet, "?light");
    REQUIRE(measured.size() == meters * meters);
    int shaded = 0;
    for (int i = 0; i < meters * meters; ++i) {
        const glm::dvec2 place = place_of_meter(i % meters, i / meters);
        const auto number = std::count_if(over.begin(), over.end(), [&](const Leaf& leaf) {
            return glm::distance(leaf.place, place) <= std::sqrt(leaf.area / std::numbers::pi);
        });
        CHECK(measured[std::size_t(i)] ==
              Approx(light_of(ground, place) * std::pow(0.01, number)).epsilon(1e-12).margin(1e-300));
        shaded += number > 0;
    }
    return shaded;
}

}  // namespace

TEST_CASE("clover: every internode begins where there was light, and no apex lives on in the dark", "[clover]") {
    for (const std::uint64_t seed : {21u, 22u}) {
        World world(read_scene(source_path("environments/clover.toml"), with_seed(seed)));
        world.start();
        int dark = 0;
        for (int step = 1; step <= 80; ++step) {
            const std::vector<Asking> before = asking(world);
            const std::set<Line> old = stolons(world);
            world.step();
            std::size_t fresh = 0, apices = 0, bright = 0;
            for (const Asking& end : before) {
                bright += end.name == "Apex" && end.light >= least;
                dark += end.light < least;
            }
            for (const Line& line : stolons(world)) {
                if (old.contains(line)) continue;
                ++fresh;
                const glm::dvec2 base = glm::dvec2(line[0], line[1]) / 1e6;
                CHECK((step == 1 || std::any_of(before.begin(), before.end(), [&](const Asking& end) {
                           return end.light >= least && glm::distance(end.place, base) < 3e-6;
                       })));
            }
            for (const Asking& end : asking(world)) apices += end.name == "Apex";
            CHECK(apices == fresh);
            CHECK(fresh >= bright);
        }
        CHECK(dark > 1000);
    }
}

TEST_CASE("clover: the density of leaves follows the light of the ground", "[clover]") {
    constexpr std::size_t squares = 10;
    const Picture picture = ground();
    std::vector<double> light(squares * squares);
    for (std::size_t i = 0; i < light.size(); ++i) {
        for (std::size_t k = 0; k < 900; ++k) {
            const glm::dvec2 within((k % 30 + 0.5) / 30, (k / 30 + 0.5) / 30);
            light[i] +=
                light_of(picture, (glm::dvec2(i % squares, i / squares) + within) * (side / squares) - side / 2);
        }
    }
    for (const std::uint64_t seed : {31u, 32u, 33u}) {
        World world(read_scene(source_path("environments/clover.toml"), with_seed(seed)));
        world.start();
        std::vector<double> density(squares * squares);
        for (int step = 1; step <= 200; ++step) {
            world.step();
            if (step <= 40) continue;
            for (const Leaf& leaf : leaves(world)) {
                const glm::dvec2 at = (leaf.place / side + 0.5) * static_cast<double>(squares);
                ++density[static_cast<std::size_t>(at.y) * squares + static_cast<std::size_t>(at.x)];
            }
        }
        CHECK(correlation(density, light) > 0.6);
    }
}

TEST_CASE("clover: where a cover takes the light, the last leaf is gone when it has lived its life", "[clover]") {
    for (const std::uint64_t seed : {0u, 41u, 42u, 43u}) {
        constexpr int covered = 35;
        World world(read_scene(source_path("environments/clover-cover.toml"), with_seed(seed)));
        world.start();
        const auto below = [&] {
            const auto all = leaves(world);
            return std::count_if(all.begin(), all.end(), [](const Leaf& leaf) {
                return glm::distance(leaf.place, glm::dvec2(-0.66, -0.63)) < 0.8;
            });
        };
        for (int step = 1; step <= covered; ++step) world.step();
        CHECK(below() > 50);
        int empty_after = 0;
        while (below() > 0 && empty_after < 100) {
            world.step();
            ++empty_after;
        }
        CHECK(std::abs(empty_after - life) <= 2);
        CHECK(leaves(world).size() > 50);
        for (int step = 0; step < 20; ++step) {
            world.step();
            CHECK(below() == 0);
        }
    }
}

TEST_CASE("clover: every leaf dims the light of the ground, and when all are gone the ground is as light as before",
          "[clover]") {
    const Picture picture = ground();
    for (const std::uint64_t seed : {51u, 52u}) {
        constexpr int end = 45;
        World world(measured_scene(end, seed));
        world.start();
        for (int step = 1; step <= end; ++step) world.step();
        CHECK(check_light(world, picture) > 50);
        int until_empty = 0;
        for (; !leaves(world).empty() && until_empty < 100; ++until_empty) world.step();
        CHECK(std::abs(until_empty - life) <= 2);
        CHECK(check_light(world, picture) == 0);
    }
}
