#include "espalier/simulation/world.h"

#include "catch.h"
#include "temporary_folder.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <memory>
#include <set>
#include <vector>

using namespace espalier;
using Catch::Contains;

namespace {

class Worlds {
public:
    Scene scene(const std::string& model, const std::string& rest = "", const std::string& plant = "") {
        folder_.write("plant.l", model);
        return read_scene_text("[[plant]]\nmodel = 'plant.l'\n" + plant + rest, "scene.toml", folder_.path());
    }

private:
    TemporaryFolder folder_;
};

std::string text(const World& world, std::size_t plant = 0) {
    return to_text(world.string(plant), world.model(plant).alphabet);
}

std::vector<Identity> identities_of(const ModuleString& string) {
    std::vector<Identity> all;
    for (std::size_t i = 0; i < string.size(); ++i) all.push_back(string.identity(i));
    return all;
}

void walk(World& world, int steps) {
    world.start();
    for (int i = 0; i < steps; ++i) world.step();
}

const char* const doubling = "lsystem: 1\nderivation length: 4\naxiom: A\nA --> AA\nendlsystem\n";
const char* const stochastic =
    "lsystem: 1\nseed: 1\nderivation length: 6\naxiom: A\n"
    "A --> F A : 1\nA --> F [+A] A : 1\nA --> F [-A] A : 1\nendlsystem\n";

}  // namespace

TEST_CASE_METHOD(Worlds, "frame k is k derivations", "[simulation]") {
    World world(scene(doubling));
    world.start();
    for (int step = 0; step <= 4; ++step) {
        CHECK(world.frame().step == step);
        CHECK(world.modules() == std::size_t(1) << step);
        CHECK(world.frame().plants[0].string->size() == std::size_t(1) << step);
        world.step();
    }
}

TEST_CASE_METHOD(Worlds, "the axiom is exchanged before the first derivation", "[simulation]") {
    World world(
        scene("lsystem: 1\nderivation length: 1\naxiom: F(2)?P(0,0,0)\n?P(x,y,z) --> F(y)?P(0,0,0)\nendlsystem\n"));
    world.start();
    CHECK(text(world) == "F(2)?P(0,2,0)");
    world.step();
    CHECK(text(world) == "F(2)F(2)?P(0,4,0)");
}

TEST_CASE_METHOD(Worlds, "answers are kept as all parameters of a plant's arithmetic are", "[simulation]") {
    const std::string model = "lsystem: 1\nderivation length: 1\naxiom: +(10)F(0.1)?P(0,0)\nendlsystem\n";
    const auto height = [&](const std::string& arithmetic) {
        World world(scene(model, "", "arithmetic = '" + arithmetic + "'\n"));
        world.start();
        return world.string(0).parameters.back();
    };
    CHECK(height("double") != static_cast<float>(height("double")));
    CHECK(height("cpfg") == static_cast<float>(height("cpfg")));
}

TEST_CASE_METHOD(Worlds, "a plant is answered in the steps in which it asks, whoever else does", "[simulation]") {
    const std::string model =
        "#define WAIT 1\nlsystem: 1\nderivation length: 4\naxiom: F(2)A(WAIT)\nA(n) : n > 0 --> A(n - 1)\n"
        "A(n) --> ?P(0,0,0)\n?P(x,y,z) : y < 9 --> F(1)?P(y,9,0)\nendlsystem\n";
    World world(scene(model, "[[plant]]\nmodel = 'plant.l'\ndefine = { WAIT = 2 }\n"));
    walk(world, 2);
    CHECK(text(world, 0) == "F(2)?P(0,2,0)");
    CHECK(text(world, 1) == "F(2)A(0)");
    world.step();
    CHECK(text(world, 0) == "F(2)F(1)?P(0,3,0)");
    CHECK(text(world, 1) == "F(2)?P(0,2,0)");
}

TEST_CASE_METHOD(Worlds, "a plant stands where the scene puts it", "[simulation]") {
    World world(scene("lsystem: 1\nderivation length: 0\naxiom: F(1)?P(0,0,0)\nendlsystem\n", "",
                      "positions = [[3, 0, 0], [0, 0, -2]]\nheading = [1, 0, 0]\n"));
    world.start();
    CHECK(text(world, 0) == "F(1)?P(4,0,0)");
    CHECK(text(world, 1) == "F(1)?P(1,0,-2)");
}

TEST_CASE_METHOD(Worlds, "plants of one stream are the same individual, of two streams are not", "[simulation]") {
    World same(scene(stochastic, "[[plant]]\nmodel = 'plant.l'\nstream = 0\n"));
    walk(same, 6);
    CHECK(text(same, 0) == text(same, 1));
    World different(scene(stochastic, "[[plant]]\nmodel = 'plant.l'\n"));
    walk(different, 6);
    CHECK(text(different, 0) != text(different, 1));
}

TEST_CASE_METHOD(Worlds, "a neighbour does not change what a plant draws", "[simulation]") {
    World alone(scene(stochastic));
    World together(scene(stochastic, "[[plant]]\nmodel = 'plant.l'\nposition = [1, 0, 0]\n"));
    walk(alone, 6);
    walk(together, 6);
    CHECK(text(alone) == text(together));
}

TEST_CASE_METHOD(Worlds, "another seed grows another plant", "[simulation]") {
    World one(scene(stochastic, "[simulation]\nseed = 1\n")), two(scene(stochastic, "[simulation]\nseed = 2\n"));
    walk(one, 6);
    walk(two, 6);
    CHECK(text(one) != text(two));
}

TEST_CASE_METHOD(Worlds, "a model that calls stop() stops the world", "[simulation]") {
    World world(
        scene("lsystem: 1\nStartEach: { if (Q == 2) { stop(0); } }\nderivation length: 9\naxiom: A\nA --> AA\n"
              "endlsystem\n"));
    world.start();
    CHECK_FALSE(world.stopped());
    world.step();
    CHECK_FALSE(world.stopped());
    world.step();
    CHECK(world.stopped());
}

TEST_CASE_METHOD(Worlds, "of several plants that fail the first is named, whoever failed first", "[simulation]") {
    const char* const model =
        "#define WHEN 99\nlsystem: 1\nderivation length: 3\naxiom: A(0)\n"
        "A(n) --> A(1 / (WHEN - n - 1) * 0 + n + 1)\nendlsystem\n";
    for (int i = 0; i < 10; ++i) {
        World world(scene(model,
                          "[[plant]]\nmodel = 'plant.l'\nname = 'second'\ndefine = { WHEN = 1 }\n"
                          "[[plant]]\nmodel = 'plant.l'\nname = 'third'\ndefine = { WHEN = 1 }\n"));
        world.start();
        CHECK_THROWS_WITH(world.step(), Contains("plant 'second'") && Contains("plant.l:5"));
    }
}

TEST_CASE_METHOD(Worlds, "strings that would outgrow the memory end the run and name the step", "[simulation]") {
    World world(scene(doubling, "[simulation]\nsteps = 60\n"), {.memory = 64 << 20});
    world.start();
    const auto grow = [&] {
        while (world.steps_done() < 60) world.step();
    };
    CHECK_THROWS_AS(grow(), RunError);
    CHECK(world.steps_done() > 15);
    CHECK(world.steps_done() < 25);
}

TEST_CASE_METHOD(Worlds, "plants that share a step's memory, machines and painters grow as each does alone",
                 "[simulation]") {
    const std::string model =
        "lsystem: 1\nseed: 1\nderivation length: 7\nStart: { n = 0; }\nEndEach: { n = n + 1; }\n"
        "axiom: A(1)\nA(s) --> F(s)[+A(s * 0.9)]B(s) : 2\nA(s) --> F(s)A(s + n) : 1\nB(s) F(t) --> F(s * t)\n"
        "decomposition\nB(s) : s > 1.5 --> F(s / 2)A(s / 3)\n"
        "homomorphism\nF(s) --> F(s * ran(1) + n)[-F(s)] : 1\nF(s) --> f(s)F(1) : 1\nendlsystem\n";
    constexpr std::size_t plants = 5;
    World stand(scene(model, "", "grid = { columns = 5, spacing = 0.001 }\n"));
    walk(stand, 7);
    REQUIRE(stand.size() == plants);
    std::set<std::string> different;
    for (std::size_t plant = 0; plant < plants; ++plant) {
        const double x = 0.001 * (static_cast<double>(plant) - 2);
        World alone(scene(model, "", fmt::format("stream = {}\nposition = [{}, 0, 0]\n", plant, x)));
        walk(alone, 7);
        CHECK(text(stand, plant) == text(alone));
        const PlantGeometry& drawn = stand.interpretation(plant).geometry;
        CHECK(drawn.internodes.size() == alone.interpretation(0).geometry.internodes.size());
        CHECK(total_length(drawn) == total_length(alone.interpretation(0).geometry));
        CHECK(identities_of(stand.string(plant)) == identities_of(alone.string(0)));
        different.insert(text(alone));
    }
    CHECK(different.size() > 1);
}

TEST_CASE_METHOD(Worlds, "plants that pass on memory while they grow large and small again are those they are alone",
                 "[simulation]") {
    // 2^SIZE modules at most, then one.
    const std::string model =
        "#define SIZE 1\nlsystem: 1\nderivation length: 18\naxiom: A(SIZE)B(0)\nA(n) : n > 0 --> A(n - 1)A(n - 1)\n"
        "A(n) : n == 0 --> C\nC --> \nB(n) : n > 2 --> B(0)\nB(n) --> B(n + 1)\nendlsystem\n";
    const std::vector<int> sizes = {1, 14, 3, 3, 15, 2, 13, 1};
    std::string plants;
    for (std::size_t k = 1; k < sizes.size(); ++k) {
        plants += fmt::format("[[plant]]\nmodel = 'plant.l'\ndefine = {{ SIZE = {} }}\n", sizes[k]);
    }
    const std::size_t memory = GENERATE(std::size_t{1} << 40, std::size_t{100} << 20);  // plentiful, and not always
    const int threads = GENERATE(1, 4);
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    World stand(scene(model, plants), {.memory = memory});
    std::vector<std::unique_ptr<World>> alone;
    for (const int size : sizes) {
        alone.push_back(std::make_unique<World>(
            scene(model, "", fmt::format("stream = {}\ndefine = {{ SIZE = {} }}\n", alone.size(), size))));
    }
    for (int step = 0; step <= 18; ++step) {
        step == 0 ? stand.start() : stand.step();
        for (std::size_t k = 0; k < sizes.size(); ++k) {
            step == 0 ? alone[k]->start() : alone[k]->step();
            REQUIRE(stand.string(k).letters == alone[k]->string(0).letters);
            REQUIRE(stand.string(k).parameters == alone[k]->string(0).parameters);
            REQUIRE(identities_of(stand.string(k)) == identities_of(alone[k]->string(0)));
            REQUIRE(stand.string(k).births == alone[k]->string(0).births);
        }
    }
    CHECK(stand.string(1).size() == 1);
}

TEST_CASE_METHOD(Worlds,
                 "a herd whose strings explode in one step is told of by its largest plant, whatever the threads",
                 "[simulation]") {
    const std::string many(12000, 'A');
    const std::string model =
        "#define SIZE 1\nlsystem: 1\nderivation length: 9\naxiom: B(SIZE)\nB(n) : n > 0 --> B(n - 1)CCC\n"
        "B(n) --> A\nA --> " +
        many + "\nendlsystem\n";
    const auto message = [&](int threads) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                          static_cast<std::size_t>(threads));
        World world(scene(model, "[[plant]]\nmodel = 'plant.l'\nname = 'giant'\ndefine = { SIZE = 2 }\n",
                          "name = 'herb'\ngrid = { columns = 300, spacing = 1 }\n"),
                    {.memory = std::size_t{32} << 20});
        try {
            walk(world, 9);
        } catch (const RunError& error) {
            return std::string(error.what());
        }
        return std::string("no error");
    };
    CHECK_THAT(message(1), Contains("step 3: ") && Contains("the largest was 'giant' with 7 modules"));
    CHECK(message(1) == message(4));
}

TEST_CASE_METHOD(Worlds, "what is drawn of a string counts against the memory, too", "[simulation]") {
    const auto steps_within_64_mib = [&](const std::string& rule) {
        World world(scene("lsystem: 1\nderivation length: 60\naxiom: " + rule + "\nendlsystem\n"),
                    {.memory = 64 << 20});
        CHECK_THROWS_WITH(walk(world, 60), Contains("step ") && Contains("memory"));
        return world.steps_done();
    };
    CHECK(steps_within_64_mib("F\nF --> FF") < steps_within_64_mib("X\nX --> XX"));  // X draws nothing
}

TEST_CASE_METHOD(Worlds, "what counts against the memory depends on neither the threads nor who still reads frames",
                 "[simulation]") {
    // Large and small by turns, so that memory which serves again has room of its own; then too large.
    const std::string model =
        "lsystem: 1\nderivation length: 60\nStart: { k = 0; }\nStartEach: { k = k + 1; }\naxiom: A\n"
        "A : k <= 14 --> AA\nA : k > 31 --> AF(1)A\nA : k == 4 * floor(k / 4) --> AF(1)F(1)F(1)F(1)\n"
        "F(x) : k == 4 * floor(k / 4) + 2 --> *\nendlsystem\n";
    const auto message = [&](int threads, std::size_t frames) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                          static_cast<std::size_t>(threads));
        World world(scene(model), {.memory = std::size_t{160} << 20});
        std::vector<std::vector<PlantFrame>> kept;
        const auto keep = [&] {
            if (frames == 0) return;
            const Frame frame = world.frame();
            kept.emplace_back(frame.plants.begin(), frame.plants.end());
            if (kept.size() > frames) kept[kept.size() - 1 - frames].clear();
        };
        try {
            for (world.start(); world.steps_done() < 60; world.step()) keep();
        } catch (const RunError& error) {
            return std::string(error.what());
        }
        return std::string("no error");
    };
    const std::string expected = message(1, 0);
    CHECK_THAT(expected, Contains("step 3") && Contains("memory"));
    for (const std::size_t frames : {0, 1, 2, 3}) {
        CHECK(message(1, frames) == expected);
        CHECK(message(4, frames) == expected);
    }
}

TEST_CASE_METHOD(Worlds, "plants that fit one by one but not together end the run, and the largest is named",
                 "[simulation]") {
    const std::string model =
        "#define SIZE 1\nlsystem: 1\nderivation length: 60\naxiom: A(SIZE)\n"
        "A(n) : n == 2 --> F(1)F(1)\nA(n) --> F(1)\nF(l) --> F(l)F(l)\nendlsystem\n";
    World alone(scene(model, "[simulation]\nsteps = 14\n"), {.memory = 64 << 20});
    CHECK_NOTHROW(walk(alone, 14));
    World stand(scene(model,
                      "[simulation]\nsteps = 14\n"
                      "[[plant]]\nmodel = 'plant.l'\nname = 'oak'\ndefine = { SIZE = 2 }\n"
                      "[[plant]]\nmodel = 'plant.l'\nname = 'ash'\ngrid = { columns = 120, spacing = 1 }\n"),
                {.memory = 64 << 20});
    CHECK_THROWS_WITH(walk(stand, 14), Contains("step ") && Contains("'oak'") && Contains("--memory"));
    CHECK(stand.steps_done() < 14);
}

TEST_CASE_METHOD(Worlds, "an unknown process, and a query without a process, are errors before step 0",
                 "[simulation]") {
    CHECK_THROWS_WITH(World(scene(doubling, "[environment.light]\nprocess = 'voxel-shde'\n")),
                      Contains("voxel-shde") && Contains("did you mean 'voxel-shade'?"));
    CHECK_THROWS_WITH(World(scene("environment lamp;\nlsystem: 1\naxiom: ?lamp(1)\n\nendlsystem\n")), Contains("lamp"));
    CHECK_THROWS_WITH(World(scene("lsystem: 1\naxiom: ?E(1)\n\nendlsystem\n")), Contains("?E"));
}

TEST_CASE_METHOD(Worlds, "a parameter no process reads is refused with its place", "[simulation]") {
    CHECK_THROWS_WITH(World(scene(doubling, "[environment.light]\nprocess = 'voxel-shade'\nvoxle = 0.5\n")),
                      Contains("scene.toml:5:1: 'voxle' means nothing here (did you mean 'voxel'?)"));
}

TEST_CASE_METHOD(Worlds, "plants that are many outgrow the memory together before all of their strings are made",
                 "[simulation]") {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 1);
    const std::string square = "lsystem: 1\nderivation length: 9\naxiom: A\nA --> AAAAAAAAAAAAAAAA\nendlsystem\n";
    const Scene many = scene(square, "", "name = 'square'\ngrid = { columns = 200, spacing = 1 }\n");
    constexpr std::size_t memory = 8 << 20;
    World world(many, {.memory = memory});
    CHECK_THROWS_WITH(walk(world, 9), Contains("step 3: 51200 modules grow beyond the 7 MiB") &&
                                          Contains("'square-1' with 256 modules, most of them A"));
    std::size_t held = 0;
    for (std::size_t plant = 0; plant < world.size(); ++plant) held += world.string(plant).bytes();
    CHECK(held < memory);  // all would be 18 MB
}

TEST_CASE_METHOD(Worlds, "frames that somebody keeps stay as they were, and the world writes into what is let go",
                 "[simulation]") {
    const Scene stand = scene(stochastic, "", "name = 'bush'\ngrid = { columns = 3, spacing = 1 }\n");
    World world(stand);
    std::vector<std::vector<PlantFrame>> kept;
    std::set<const ModuleString*> strings;
    std::set<const Interpretation*> interpretations;
    const auto keep = [&] {
        const Frame frame = world.frame();
        kept.emplace_back(frame.plants.begin(), frame.plants.end());
        if (kept.size() > 3) kept[kept.size() - 4].clear();
        strings.insert(frame.plants[1].string.get());
        interpretations.insert(frame.plants[1].interpretation.get());
    };
    world.start();
    keep();
    for (int step = 1; step <= 12; ++step) {
        world.step();
        keep();
        for (int back = 0; back < std::min(3, step + 1); ++back) {
            World alone(stand);
            walk(alone, step - back);
            const std::vector<PlantFrame>& then = kept[std::size_t(step - back)];
            for (std::size_t plant = 0; plant < world.size(); ++plant) {
                CHECK(to_text(*then[plant].string, world.model(plant).alphabet) == text(alone, plant));
                CHECK(total_length(then[plant].interpretation->geometry) ==
                      total_length(alone.interpretation(plant).geometry));
            }
        }
    }
    CHECK(interpretations.size() == 4);
    CHECK(strings.size() <= 5);
}
