// Scenes, recordings and runs that a program makes without a scene file.
#include "espalier/simulation/simulation.h"

#include "catch.h"
#include "recorded_files.h"
#include "temporary_folder.h"

#include <filesystem>
#include <thread>

using namespace espalier;
using Catch::Contains;

namespace {

namespace fs = std::filesystem;

const char* const competing = R"(environment light;
lsystem: 1
seed: 3
derivation length: 8
axiom: ?light(1)A
?light(q) < A : q > 0.1 --> F(0.5)[+(35)/(90)?light(1)A]?light(1)A : 2
?light(q) < A : q > 0.1 --> F(0.7)/(137)?light(1)A : 1
?light(q) --> ?light(1)
endlsystem
)";

const char* const as_a_file = R"([simulation]
seed = 5
[[plant]]
model = 'competing.l'
positions = [[0, 0, 0], [1, 0, 0]]
[environment.light]
process = 'voxel-shade'
voxel = 0.25
[timeline]
fields = ['light']
every = 2
)";

Scene made_by_program() {
    Scene scene;
    scene.seed = 5;
    for (const double x : {0.0, 1.0}) {
        Plant plant = plant_of_text(competing, "competing.l");
        plant.turtle.pose.position.x = x;
        plant.name = x == 0 ? "competing-1" : "competing-2";
        scene.plants.push_back(plant);
    }
    scene.environment.add("light", "voxel-shade", {{"voxel", 0.25}});
    scene.timeline = {{"fields", {"light"}}, {"every", 2}};
    return scene;
}

/// Counts what it sees.
class Counter final : public Recorder {
public:
    void record(const Frame& frame) override {
        steps.push_back(frame.step);
        modules.push_back(frame.plants[0].string->size());
        is_last.push_back(frame.is_last);
    }
    void finish() override { finished = true; }

    std::vector<int> steps;
    std::vector<std::size_t> modules;
    std::vector<bool> is_last;
    bool finished = false;
};

}  // namespace

TEST_CASE("a scene made by a program grows and records what the same scene in a file does", "[simulation]") {
    const TemporaryFolder folder;
    folder.write("competing.l", competing);
    run(made_by_program(), {.output = folder.path() / "program"});
    run(read_scene_text(as_a_file, "scene.toml", folder.path()), {.output = folder.path() / "file"});
    auto program = recorded_files(folder.path() / "program"), file = recorded_files(folder.path() / "file");
    CHECK(program.size() > 10);
    REQUIRE(program.size() == file.size());
    for (const auto& [name, bytes] : program) {
        INFO(name);
        CHECK(bytes == file[name]);
    }
}

TEST_CASE("two worlds in two threads write the bytes that they write one after the other", "[simulation]") {
    const TemporaryFolder folder;
    const Scene one = made_by_program();
    Scene two = made_by_program();
    two.seed = 6;
    const auto grow = [&](const Scene& scene, const std::string& name) {
        run(scene, {.output = folder.path() / name});
    };
    grow(one, "one");
    grow(two, "two");
    for (int repetition = 0; repetition < 5; ++repetition) {
        const std::string suffix = std::to_string(repetition);
        std::thread first([&] { grow(one, "first" + suffix); });
        std::thread second([&] { grow(two, "second" + suffix); });
        std::thread third([&] { grow(one, "third" + suffix); });  // another world uses this scene, too
        first.join();
        second.join();
        third.join();
        CHECK(recorded_files(folder.path() / "one") == recorded_files(folder.path() / ("first" + suffix)));
        CHECK(recorded_files(folder.path() / "two") == recorded_files(folder.path() / ("second" + suffix)));
        CHECK(recorded_files(folder.path() / "one") == recorded_files(folder.path() / ("third" + suffix)));
    }
    CHECK(recorded_files(folder.path() / "one") != recorded_files(folder.path() / "two"));
}

TEST_CASE("worlds of two threads note what they read each in its own log", "[simulation]") {
    const TemporaryFolder folder;
    const auto files_of = [&](const std::string& name) {
        const fs::path model =
            folder.write(name + ".l", "lsystem: 1\nderivation length: 3\nStart: { f = fopen(\"" + name +
                                          ".txt\", \"r\"); }\naxiom: A\nA --> AA\nendlsystem\n");
        folder.write(name + ".txt", "1");
        const ReadLog log;
        Scene scene;
        scene.plants.push_back(plant_of_file(model));
        World world(scene);
        for (world.start(); !world.at_end();) world.step();
        std::vector<std::string> names;
        for (const auto& entry : log.files()) names.push_back(entry.first.filename().string());
        return names;
    };
    std::vector<std::string> first, second;
    std::thread one([&] { first = files_of("one"); }), two([&] { second = files_of("two"); });
    one.join();
    two.join();
    CHECK(first == std::vector<std::string>{"one.l", "one.txt"});
    CHECK(second == std::vector<std::string>{"two.l", "two.txt"});
}

TEST_CASE("a recorder of a program sees every frame of the world it is attached to, the last one marked",
          "[simulation]") {
    Scene scene;
    scene.plants.push_back(plant_of_text("lsystem: 1\nderivation length: 4\naxiom: A\nA --> AA\nendlsystem\n"));
    World world(scene);
    Counter counter;
    world.attach(counter);
    for (world.start(); !world.at_end();) world.step();
    CHECK(counter.steps == std::vector<int>{0, 1, 2, 3, 4});
    CHECK(counter.modules == std::vector<std::size_t>{1, 2, 4, 8, 16});
    CHECK(counter.is_last == std::vector<bool>{false, false, false, false, true});
    CHECK(world.times().record > 0);
}

TEST_CASE("plants of a program are individuals by their place in the scene, unless it says otherwise", "[simulation]") {
    const char* const bush = "lsystem: 1\nseed: 1\naxiom: A\nA --> F A : 1\nA --> F [+A] A : 1\nendlsystem\n";
    const auto strings = [&](std::optional<std::uint32_t> stream) {
        Scene scene;
        scene.steps = 6;
        for (int k = 0; k < 2; ++k) scene.plants.push_back(plant_of_text(bush, "bush"));
        scene.plants[1].stream = stream;
        World world(scene);
        for (world.start(); !world.at_end();) world.step();
        CHECK(world.scene().plants[1].name == "bush-2");
        return std::pair(to_text(world.string(0), world.model(0).alphabet),
                         to_text(world.string(1), world.model(1).alphabet));
    };
    const auto [first, second] = strings(std::nullopt);
    CHECK(first != second);
    const auto [one, same] = strings(0);
    CHECK(one == same);
}

TEST_CASE("a mistake in a program's process names the process", "[simulation]") {
    Scene scene = made_by_program();
    scene.environment.add("shadow", "voxel-shade", {{"voxle", 0.25}});
    CHECK_THROWS_WITH(World(scene), Contains("environment.shadow: ") && Contains("voxle"));
}
