// Models that live by collision and by questions to the turtle: Ulam, Honda 1981, canalisation, queries.
#include "catch.h"
#include "environment/space/ulam_automaton.h"
#include "experiments/growth.h"
#include "models/measure.h"

#include <glm/mat3x3.hpp>

#include <array>
#include <bit>
#include <map>
#include <set>

using namespace espalier;

namespace {

int count(const World& world, const std::string& symbol, std::size_t plant = 0) {
    return static_cast<int>(parameters_of(world.string(plant), world.model(plant).alphabet, symbol).size());
}

// Cells after 0, 1, ... steps of a scene.
std::vector<int> cells_of(const std::string& scene, int steps, const SceneOptions& options = {}) {
    const Scene read = read_scene(source_path(scene), options);
    World world(read);
    world.start();
    std::vector<int> cells = {count(world, "K")};
    for (int step = 0; step < steps; ++step) {
        world.step();
        cells.push_back(count(world, "K"));
    }
    return cells;
}

SceneOptions overriding(std::vector<std::pair<std::string, std::string>> overrides) {
    SceneOptions options;
    options.overrides = std::move(overrides);
    return options;
}

int forks_of(const std::string& scene, int steps, const std::string& radius) {
    SceneOptions options = overriding({{"environment.collisions.radius", radius}});
    options.steps = steps;
    return count(*grown(scene, options), "N");
}

// Where the modules of one symbol stand that are followed by ?E.
std::vector<glm::dvec3> places_of(const World& world, const std::string& symbol) {
    std::vector<glm::dvec3> places;
    const ModuleString& string = world.string(0);
    for (const Query& query : world.interpretation(0).queries) {
        // symbol ? E
        if (world.model(0).alphabet.name(string.letters[query.module - 2]) == symbol)
            places.push_back(query.pose.position);
    }
    return places;
}

}  // namespace

TEST_CASE("ulam: the published counts of cells, and births by the binary digits of the step", "[environment]") {
    const std::vector<int> cells = cells_of("environments/ulam.toml", 80);
    CHECK(std::vector<int>(cells.begin(), cells.begin() + 16) ==
          std::vector<int>{1, 5, 9, 21, 25, 37, 49, 85, 89, 101, 113, 149, 161, 197, 233, 341});
    for (unsigned n = 2; n <= cells.size(); ++n) {
        int births = 4;
        for (int ones = std::popcount(n - 1); ones > 1; --ones) births *= 3;
        CHECK(cells[n - 1] - cells[n - 2] == births);
    }
}

TEST_CASE("sierpinski-triangle: the cells of 64 steps are the odd numbers of Pascal's triangle", "[environment]") {
    const std::vector<int> counts = cells_of("environments/sierpinski-triangle.toml", 64);
    CHECK(std::vector<int>(counts.begin(), counts.begin() + 7) == std::vector<int>{1, 3, 5, 9, 11, 15, 19});
    CHECK(counts[32] == 245);
    CHECK(counts[63] == 729);
    for (unsigned n = 1; n < counts.size(); ++n) CHECK(counts[n] - counts[n - 1] == 1 << std::popcount(n));

    SceneOptions options;
    options.steps = 64;
    const auto world = grown("environments/sierpinski-triangle.toml", options);
    std::set<std::pair<unsigned, unsigned>> cells, odd;
    for (const Organ& organ : world->interpretation(0).geometry.organs) {
        const double row = organ.pose.position.z / std::sqrt(0.75), column = organ.pose.position.x + row / 2;
        CHECK(std::abs(row - std::round(row)) + std::abs(column - std::round(column)) < 1e-9);
        cells.emplace(std::lround(row), std::lround(column));
    }
    for (unsigned n = 0; n <= 64; ++n) {
        for (unsigned k = 0; k <= n; ++k) {
            if ((k & (n - k)) == 0) odd.emplace(n, k);  // Kummer 1852
        }
    }
    CHECK(cells == odd);
}

TEST_CASE("ulam-branching: 80 steps of the variant whose candidates exclude each other even if they fail",
          "[environment]") {
    CHECK(cells_of("environments/ulam-branching.toml", 80) == UlamAutomaton({"wishes"}).cells(80));
    CHECK(cells_of("environments/ulam-branching.toml", 80, overriding({{"environment.collisions.radius", "1.1"}})) ==
          UlamAutomaton({"wishes", false, false}).cells(80));
}

TEST_CASE("cells: 80 steps of every rule on squares, and the published counts on hexagons", "[environment]") {
    const auto grown_by = [](const std::string& rule, const std::string& persistent = "0") {
        return cells_of(
            "environments/cells.toml", 80,
            overriding({{"environment.cells.rule", '"' + rule + '"'}, {"plant.0.define.PERSISTENT", persistent}}));
    };
    for (const char* rule : {"simple", "births", "eligible", "wishes"}) {
        INFO(rule);
        CHECK(grown_by(rule) == UlamAutomaton({rule}).cells(80));
    }
    CHECK(grown_by("wishes", "1") == UlamAutomaton({"wishes", true}).cells(80));
    CHECK(cells_of("environments/cells.toml", 8, overriding({{"plant.0.define.SIDES", "6"}})) ==
          std::vector<int>{1, 7, 13, 31, 37, 55, 85, 127, 133});
}

TEST_CASE("cells: triangles, cubes and the bonds of a diamond fill as a separate program finds", "[environment]") {
    // A neighbour is `steps[k]` away from an even cell, and minus that from an odd one.
    using Site = std::array<int, 3>;
    const auto separate = [](const std::vector<Site>& steps, int count, auto is_odd) {
        std::set<Site> living{{0, 0, 0}};
        std::vector<int> cells{1};
        for (int step = 0; step < count; ++step) {
            std::map<Site, int> touched;
            for (const Site& cell : living) {
                const int sign = is_odd(cell) ? -1 : 1;
                for (const Site& by : steps) {
                    ++touched[{cell[0] + sign * by[0], cell[1] + sign * by[1], cell[2] + sign * by[2]}];
                }
            }
            for (const auto& [place, neighbours] : touched) {
                if (neighbours == 1) living.insert(place);
            }
            cells.push_back(static_cast<int>(living.size()));
        }
        return cells;
    };
    const auto sides = [](const char* number, int steps) {
        return cells_of("environments/cells.toml", steps, overriding({{"plant.0.define.SIDES", number}}));
    };
    CHECK(sides("3", 15) == std::vector<int>{1, 4, 10, 16, 22, 34, 52, 64, 70, 82, 106, 136, 160, 190, 232, 256});
    CHECK(sides("3", 15) == separate({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 15,
                                     [](const Site& cell) { return cell[0] + cell[1] + cell[2] == 1; }));
    CHECK(sides("8", 8) == separate({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}, 8,
                                    [](const Site&) { return false; }));
    CHECK(sides("12", 8) == separate({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, 8,
                                     [](const Site& cell) { return cell[0] % 2 != 0; }));
}

TEST_CASE("cells: a cube of Ulam's cells has all 48 symmetries of the cube", "[environment]") {
    SceneOptions options = overriding({{"plant.0.define.SIDES", "8"}});
    options.steps = 6;
    const auto world = grown("environments/cells.toml", options);
    std::set<std::array<long, 3>> cells;
    for (const Organ& organ : world->interpretation(0).geometry.organs) {
        const glm::dvec3& place = organ.pose.position;
        cells.insert({std::lround(place.x), std::lround(place.y), std::lround(place.z)});
    }
    REQUIRE(cells.size() == 109);
    for (const std::array<long, 3>& cell : cells) {
        std::array<long, 3> axes = {0, 1, 2};
        do {
            for (int signs = 0; signs < 8; ++signs) {
                std::array<long, 3> image{};
                for (std::size_t i = 0; i < 3; ++i) {
                    image[i] = cell[static_cast<std::size_t>(axes[i])] * ((signs >> i) % 2 ? -1 : 1);
                }
                CHECK(cells.count(image) == 1);
            }
        } while (std::next_permutation(axes.begin(), axes.end()));
    }
}

TEST_CASE("cells: tetrahedra that fill space grow as a separate program finds, with the first one's symmetries",
          "[environment]") {
    // The centres of tetragonal disphenoids are the corners of truncated octahedra that fill space: of the coordinates
    // one is odd, and the even ones differ by 2 modulo 4. Neighbours share a triangle.
    using Site = std::array<long, 3>;
    const auto is_site = [](const Site& site) {
        std::vector<long> even;
        for (const long x : site) {
            if (x % 2 == 0) even.push_back(x);
        }
        return even.size() == 2 && (even[0] - even[1]) % 4 != 0;
    };
    const Site first{0, 1, 2};
    std::set<Site> expected{first};
    std::vector<int> counts{1};
    for (int step = 0; step < 8; ++step) {
        std::map<Site, int> touched;
        for (const Site& cell : expected) {
            for (int way = 0; way < 12; ++way) {
                Site next = cell;
                next[std::size_t(way / 4)] += way & 1 ? 1 : -1;
                next[std::size_t((way / 4 + 1) % 3)] += way & 2 ? 1 : -1;
                if (is_site(next)) ++touched[next];
            }
        }
        for (const auto& [place, neighbours] : touched) {
            if (neighbours == 1) expected.insert(place);
        }
        counts.push_back(static_cast<int>(expected.size()));
    }
    CHECK(counts == std::vector<int>{1, 5, 13, 21, 45, 77, 85, 109, 157});
    const SceneOptions options = overriding({{"plant.0.define.SIDES", "24"}});
    CHECK(cells_of("environments/cells.toml", 8, options) == counts);

    SceneOptions of_eight = options;
    of_eight.steps = 8;
    const auto world = grown("environments/cells.toml", of_eight);
    // The first turtle heads against one edge of a square and has the other to its left.
    const glm::dmat3 axes(glm::dvec3(-1, 1, 0) / std::sqrt(2.0), glm::dvec3(-1, -1, 0) / std::sqrt(2.0), {0, 0, 1});
    const glm::dmat3 turtle({0, 0, -1}, {-1, 0, 0}, {0, -1, 0});  // heading, left and up behind &(90)
    std::set<Site> cells;
    const ModuleString& string = world->string(0);
    for (const Query& query : world->interpretation(0).queries) {
        if (world->model(0).alphabet.name(string.letters[query.module - 1]) != "K") continue;
        const glm::dvec3 place = std::sqrt(2.0) * (axes * (glm::transpose(turtle) * query.pose.position));
        cells.insert(
            {first[0] + std::lround(place.x), first[1] + std::lround(place.y), first[2] + std::lround(place.z)});
    }
    CHECK(cells == expected);
    for (const Site& cell : cells) {
        const long x = cell[0] - first[0], y = cell[1] - first[1], z = cell[2] - first[2];
        CHECK(cells.contains({first[0] - x, cell[1], cell[2]}));
        CHECK(cells.contains({cell[0], cell[1], first[2] - z}));
        CHECK(cells.contains({first[0] + z, first[1] - y, first[2] + x}));
    }
}

TEST_CASE("cells: with wishes to the side in every third step only, the births are Holladay's", "[environment]") {
    for (const char* rule : {"births", "eligible", "wishes"}) {
        const std::vector<int> cells = cells_of(
            "environments/cells.toml", 100,
            overriding({{"environment.cells.rule", '"' + std::string(rule) + '"'}, {"plant.0.define.STRAIGHT", "1"}}));
        CHECK(cells[1] == 5);
        for (unsigned generation = 3; generation <= cells.size(); ++generation) {
            int births = generation % 3 == 2 ? 12 : 4;
            for (int ones = std::popcount(generation / 3); ones > 1; --ones) births *= 3;
            CHECK(cells[generation - 1] - cells[generation - 2] == births);
        }
    }
}

TEST_CASE("reaction-diffusion: the stem bears every leaf that arose, and vein-net draws every cell of the net",
          "[environment]") {
    const auto stem = grown("environments/reaction-diffusion.toml");
    const auto heights = values_of(stem->string(0), stem->model(0).alphabet, "L", 1);
    CHECK(heights.size() > 30);
    CHECK(*std::max_element(heights.begin(), heights.end()) > 1.5);
    CHECK(*std::max_element(heights.begin(), heights.end()) < 0.01 * (20 + 160));

    const auto net = grown("environments/vein-net.toml");
    const auto cells = values_of(net->string(0), net->model(0).alphabet, "K");
    CHECK(cells.size() == 56 * 40);
    const auto veins = std::count_if(cells.begin(), cells.end(), [](double v) { return v > 0.5; });
    CHECK(veins > 500);
    CHECK(net->interpretation(0).geometry.organs.size() == static_cast<std::size_t>(veins));
}

TEST_CASE("terminalia: 635, 230 and 107 forks after seven steps for the radii 0, 0.3 and 0.5", "[environment]") {
    CHECK(forks_of("environments/terminalia.toml", 7, "0") == 635);
    CHECK(forks_of("environments/terminalia.toml", 7, "0.3") == 230);
    CHECK(forks_of("environments/terminalia.toml", 7, "0.5") == 107);
}

TEST_CASE("terminalia: without radius 5 * 2^k apices; with it no fork within the radius of an older end",
          "[environment]") {
    SceneOptions free = overriding({{"environment.collisions.radius", "0"}});
    free.steps = 5;
    CHECK(count(*grown("environments/terminalia.toml", free), "A") == 5 * 32);

    const Scene scene = read_scene(source_path("environments/terminalia.toml"), {});
    World world(scene);
    world.start();
    std::vector<glm::dvec3> older;
    std::size_t forks = 0;
    for (int step = 0; step < 7; ++step) {
        world.step();
        // Forks come in the order of the string, old and new; the new ones are those that were no end before.
        std::vector<glm::dvec3> ends = places_of(world, "N");
        for (const glm::dvec3& fork : ends) {
            const bool is_old = std::any_of(older.begin(), older.end(),
                                            [&](const glm::dvec3& end) { return glm::distance(fork, end) < 1e-9; });
            if (is_old) continue;
            ++forks;
            for (const glm::dvec3& end : older) CHECK(glm::distance(fork, end) > 0.5);
        }
        for (const glm::dvec3& end : places_of(world, "K")) ends.push_back(end);
        older = std::move(ends);
    }
    CHECK(forks == 107);
}

TEST_CASE("terminalia: of two tiers each forks less than alone and leans away; far apart they are as alone",
          "[environment]") {
    SceneOptions options;
    options.steps = 10;
    const auto alone = grown("environments/terminalia.toml", options);
    const auto both = grown("environments/terminalia-two-tiers.toml", options);
    const int forks = count(*alone, "N");
    for (std::size_t tier = 0; tier < 2; ++tier) CHECK(count(*both, "N", tier) <= 0.75 * forks);

    SceneOptions apart = overriding({{"plant.0.positions.0.0", "-50"}, {"plant.0.positions.1.0", "50"}});
    apart.steps = 10;
    const auto separate = grown("environments/terminalia-two-tiers.toml", apart);
    for (std::size_t tier = 0; tier < 2; ++tier) CHECK(count(*separate, "N", tier) == forks);

    // Mean place of what each tier drew, from its own centre, along x.
    const auto lean = [](const World& world, std::size_t tier, double centre) {
        double sum = 0;
        const auto& internodes = world.interpretation(tier).geometry.internodes;
        for (const Internode& internode : internodes) sum += internode.tip.x - centre;
        return sum / static_cast<double>(internodes.size());
    };
    CHECK(lean(*both, 0, -1.1) < lean(*alone, 0, 0) - 0.3);
    CHECK(lean(*both, 1, 1.1) > lean(*alone, 0, 0) + 0.3);
}

TEST_CASE("canalisation: the number of free organs is mostly a Fibonacci number", "[environment]") {
    const std::set<int> fibonacci = {1, 2, 3, 5, 8, 13, 21, 34, 55, 89};
    const auto scene = read_scene(source_path("environments/canalisation.toml"), {});
    World world(scene);
    world.start();
    int fibonacci_steps = 0, steps = 0;
    std::set<int> met;
    for (int step = 1; step <= 200; ++step) {
        world.step();
        if (step < 20) continue;
        const auto answers = values_of(world.string(0), world.model(0).alphabet, "E");
        const int free = static_cast<int>(std::count(answers.begin(), answers.end(), 1.0));
        ++steps;
        if (fibonacci.count(free) == 1) {
            ++fibonacci_steps;
            met.insert(free);
        }
    }
    CHECK(fibonacci_steps > 0.85 * steps);
    CHECK(met.count(8) + met.count(13) + met.count(21) == 3);
}

namespace {

// A turtle of its own, by rotation matrices about the world's axes: the columns of `frame` are heading, left and up.
struct PlainTurtle {
    glm::dvec3 position{0, 0, 0};
    glm::dmat3 frame{glm::dvec3(0, 1, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, -1)};

    // Turns column `a` towards column `b`.
    void turn(int a, int b, double degrees) {
        const double angle = degrees * std::numbers::pi / 180;
        const glm::dvec3 from = frame[a], to = frame[b];
        frame[a] = std::cos(angle) * from + std::sin(angle) * to;
        frame[b] = std::cos(angle) * to - std::sin(angle) * from;
    }
};

}  // namespace

TEST_CASE("queries: every answer is what an independent turtle finds at that place, for 100 seeds", "[environment]") {
    int checked = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        LonePlant plant("models/environment/queries.l", {}, seed);
        plant.grow(8);
        const Alphabet& alphabet = plant.model->alphabet;
        const auto offsets = parameter_offsets(plant.string, alphabet);
        std::vector<PlainTurtle> stack = {PlainTurtle{}};
        for (std::size_t i = 0; i < plant.string.size(); ++i) {
            const std::string& symbol = alphabet.name(plant.string.letters[i]);
            const double* parameter = plant.string.parameters.data() + offsets[i];
            PlainTurtle& turtle = stack.back();
            if (symbol == "F" || symbol == "f") turtle.position += parameter[0] * turtle.frame[0];
            if (symbol == "+") turtle.turn(0, 1, parameter[0]);
            if (symbol == "&") turtle.turn(0, 2, parameter[0]);
            if (symbol == "^") turtle.turn(0, 2, -parameter[0]);
            if (symbol == "/") turtle.turn(1, 2, parameter[0]);
            if (symbol == "\\") turtle.turn(1, 2, -parameter[0]);
            if (symbol == "|") turtle.turn(0, 1, 180);
            if (symbol == "[") stack.push_back(PlainTurtle(turtle));
            if (symbol == "]") stack.pop_back();
            if (alphabet.arity(plant.string.letters[i]) != 3) continue;
            const glm::dvec3 answer(parameter[0], parameter[1], parameter[2]);
            const glm::dvec3 expected = symbol == "P"   ? turtle.position
                                        : symbol == "H" ? turtle.frame[0]
                                        : symbol == "L" ? turtle.frame[1]
                                                        : turtle.frame[2];
            CHECK(glm::distance(answer, expected) < 1e-9);
            ++checked;
        }
    }
    CHECK(checked > 1000);
}

TEST_CASE("towards-light: beside an awning a tree leans away from it, and without one it stands upright",
          "[environment]") {
    const auto tip_of_trunk = [](const SceneOptions& options) {
        World world(read_scene(source_path("environments/towards-light.toml"), options));
        world.start();
        while (world.steps_done() < world.last_step()) world.step();
        glm::dvec3 tip(0);
        for (const Internode& internode : world.interpretation(0).geometry.internodes) {
            if (internode.order == world.interpretation(0).geometry.internodes.front().order) tip = internode.tip;
        }
        return tip;
    };
    const glm::dvec3 beside = tip_of_trunk({});
    CHECK(beside.x > 0.5);
    CHECK(std::abs(beside.z) < 0.2 * beside.x);
    const glm::dvec3 bare = tip_of_trunk(overriding({{"environment.light.strength", "0"}}));
    CHECK(bare.y == Approx(2.6));
    CHECK(std::hypot(bare.x, bare.z) < 1e-6);
}

TEST_CASE("awning: the light below it is less than beside it", "[environment]") {
    World world(read_scene(source_path("environments/towards-light.toml"), {}));
    world.start();
    FieldValues light;
    light.take(world.environment().fields(), {"light"});
    CHECK(light.value("light", {-1.25, 2, 0}) < 0.8);
    CHECK(light.value("light", {2.5, 2, 0}) == Approx(1));
    CHECK(light.gradient("light", {0, 2, 0}).x > 0.05);
}

TEST_CASE("self-thinning: plants only become fewer, those that win stand apart, and the more room each has",
          "[environment]") {
    for (const std::uint64_t seed : {0u, 1u, 2u}) {
        SceneOptions options = overriding({{"plant.0.define.SEEDS", "1500"}, {"plant.0.define.SIDE", "120"}});
        options.seed = seed;
        World world(read_scene(source_path("environments/self-thinning.toml"), options));
        world.start();
        std::vector<double> numbers, radii;
        for (int step = 1; step <= 15; ++step) {
            world.step();
            const auto queries = parameters_of(world.string(0), world.model(0).alphabet, "?stand");
            const auto& stems = world.interpretation(0).geometry.internodes;
            REQUIRE(stems.size() == queries.size());
            numbers.push_back(static_cast<double>(stems.size()));
            double sum = 0;
            int overlapping = 0;
            for (std::size_t i = 0; i < stems.size(); ++i) {
                sum += stems[i].base_radius;
                for (std::size_t k = 0; k < i && queries[i][0] == 1; ++k) {
                    const double apart = glm::distance(stems[i].base, stems[k].base);
                    overlapping += queries[k][0] == 1 && apart <= stems[i].base_radius + stems[k].base_radius;
                }
            }
            CHECK(overlapping == 0);
            radii.push_back(sum / numbers.back());
            if (step == 1) continue;
            CHECK(numbers[numbers.size() - 1] <= numbers[numbers.size() - 2]);
            CHECK(radii.back() > radii[radii.size() - 2]);
        }
        CHECK(numbers.front() == 1500);
        CHECK(numbers.back() < 0.5 * numbers.front());
    }
}
