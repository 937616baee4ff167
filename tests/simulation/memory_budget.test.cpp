// What counts against --memory: more than strings and drawings, and the same whoever counts when.
#include "simulation/plant/memory_budget.h"

#include "espalier/simulation/world_checkpoint.h"
#include "espalier/timeline/timeline.h"

#include "catch.h"
#include "temporary_folder.h"

#include <fmt/format.h>

#include <sstream>

using namespace espalier;
using namespace espalier::simulation;
using Catch::Contains;

namespace {

/// Counts as the timeline does, and writes nothing.
class Counted final : public Recorder {
public:
    explicit Counted(const Timeline& timeline) : timeline_(timeline) {}
    void record(const Frame&) override {}
    void finish() override {}
    RecordedMemory memory(int step, const ModuleString& string, const Interpretation& interpretation) const override {
        return timeline_.memory(step, string, interpretation);
    }

private:
    const Timeline& timeline_;
};

/// A world of one plant whose timeline is `table`, in so much memory.
class RecordedWorld {
public:
    RecordedWorld(const std::string& model, const std::string& table, std::size_t memory,
                  const std::string& processes = "")
        : scene_(scene(folder_, model, processes)),
          timeline_(folder_.path() / "run", Settings::parse_toml(table, "scene.toml"), 1000),
          world(scene_, {.memory = memory}) {
        world.attach(counted_);
    }

private:
    static Scene scene(const TemporaryFolder& folder, const std::string& model, const std::string& processes) {
        folder.write("plant.l", "lsystem: 1\nderivation length: 1000\n" + model + "endlsystem\n");
        return read_scene_text("[[plant]]\nmodel = 'plant.l'\n" + processes, "scene.toml", folder.path());
    }

    TemporaryFolder folder_;
    Scene scene_;
    Timeline timeline_;
    Counted counted_{timeline_};

public:
    World world;
};

/// What ended the growth; "" if nothing did in so many steps.
std::string refusal(World& world, int steps = 1000) {
    try {
        if (world.steps_done() == 0) world.start();
        while (world.steps_done() < steps) world.step();
    } catch (const RunError& error) {
        return error.what();
    }
    return "";
}

/// The model lies in a folder of its own.
std::string without_file(const std::string& message) {
    return message.substr(0, message.find(", which the production"));
}

int steps_within_64_mib(const std::string& organ, const std::string& table) {
    RecordedWorld recorded("axiom: A\nA --> " + organ + "AA\n", table, std::size_t{64} << 20);
    CHECK_THAT(refusal(recorded.world), Contains("step ") && Contains("memory"));
    return recorded.world.steps_done();
}

}  // namespace

TEST_CASE("a plant counts as what it will be in the timeline: balls more than discs, fine ones more than coarse",
          "[simulation]") {
    const int discs = steps_within_64_mib("@!(8)@c(1)", ""), balls = steps_within_64_mib("@!(8)@O(1)", "");
    CHECK(balls < discs);
    CHECK(steps_within_64_mib("@!(32)@O(1)", "") < balls);
    const std::string unseen = "skeleton = false\nlifespans = false";
    CHECK(steps_within_64_mib("@!(8)@c(1)", unseen) == steps_within_64_mib("@!(8)@O(1)", unseen));
    CHECK(steps_within_64_mib("@!(8)@c(1)", unseen) > discs);
}

TEST_CASE("internodes count to the end of the run once they have lived, if their lives are recorded", "[simulation]") {
    // 2,000 internodes a step, each for one step.
    const std::string flickering = "axiom: " + std::string(2000, 'A') + "\nA --> AF(0.1)\nF(x) --> *\n";
    constexpr std::size_t memory = std::size_t{16} << 20;
    RecordedWorld kept(flickering, "", memory), forgotten(flickering, "lifespans = false", memory);
    CHECK_THAT(refusal(kept.world, 100), Contains("--memory"));
    CHECK(kept.world.steps_done() > 5);
    CHECK(refusal(forgotten.world, 100).empty());
}

TEST_CASE("a world that was saved runs out of memory where it would have without", "[simulation]") {
    const std::string bush =
        "axiom: A(0)\nA(n) : n > 0 --> A(n - 1)\nA(n) : n <= 0 --> F(1)[+(20)A(3)@O(0.1)]-(30)A(4)\n";
    constexpr std::size_t memory = std::size_t{24} << 20;
    RecordedWorld through(bush, "", memory);
    const std::string message = refusal(through.world);
    CHECK_THAT(message, Contains("--memory") && Contains("with what is drawn and recorded"));
    const int last = through.world.steps_done() - 1;
    RecordedWorld interrupted(bush, "", memory), resumed(bush, "", memory);
    CHECK(refusal(interrupted.world, last).empty());
    std::stringstream checkpoint;
    WorldCheckpoint(interrupted.world).save(checkpoint);
    WorldCheckpoint(resumed.world).restore(checkpoint);
    CHECK(without_file(refusal(resumed.world)) == without_file(message));
    CHECK(resumed.world.steps_done() == last + 1);
}

TEST_CASE("memory is kept back for what processes need, not for each that there is", "[simulation]") {
    const std::string bush = "axiom: ?E(0)A\nA --> F(1)[+(20)A]-(30)A\n";
    const auto refused = [&](const std::string& processes) {
        RecordedWorld recorded(bush, "", std::size_t{72} << 20, processes);
        return without_file(refusal(recorded.world));
    };
    const std::string needs_nothing = "[environment.a]\nprocess = 'honda81'\n";
    const std::string alone = refused(needs_nothing);
    CHECK_THAT(alone, Contains("--memory leaves 63 MiB"));  // 7/8, as without a process
    std::string several = "[environment]\ndefault = 'a'\n" + needs_nothing;
    for (const char* name : {"ecosystem", "cohen", "takenaka", "ulam"})
        several += fmt::format("[environment.{0}]\nprocess = '{0}'\n", name);
    CHECK(refused(several) == alone);
    // The soil takes what it says: 29 bytes for each of 0.5 million voxels.
    const std::string soil = refused(
        "[environment.a]\nprocess = 'soil-water'\nvoxel = 0.01\n"
        "domain = { lower = [0, 0, 0], upper = [1, 1, 0.5] }\n");
    CHECK_THAT(soil, Contains("memory"));
    CHECK(soil != alone);
}

TEST_CASE("the shade of a large crown takes memory from the plants, and plants from the shade", "[simulation]") {
    const auto refused = [](const std::string& model) {
        RecordedWorld recorded(model, "skeleton = false\nlifespans = false\n", std::size_t{48} << 20,
                               "[environment.light]\nprocess = 'voxel-shade'\nvoxel = 0.1\ndepth = 40\n");
        return refusal(recorded.world, 400);
    };
    // Ever more shade of few organs may take more than half; of many plants' modules it gets what they leave.
    CHECK_THAT(refused("environment light;\naxiom: A\nA --> f(2)?light(1)A\n"),
               Contains("the shade of this step needs"));
    CHECK_THAT(refused("environment light;\naxiom: A?light(1)\nA --> AB\nB --> BB\n"),
               Contains("of memory left to it"));
}

TEST_CASE("what the timeline holds of all steps adds up, what it holds of a frame does not", "[simulation]") {
    PlantMemory memory;
    memory.strings = 1000;
    memory.drawn = 50;
    memory.set_recorded({100, 10, 30}, 20);
    CHECK(memory.total() == 1000 + 50 + 20 + 10 + 100);
    memory.set_recorded({100, 10, 130}, 50);
    CHECK(memory.total() == 1000 + 50 + 50 + 20 + 160);  // at the end of the run the frame is gone
    CHECK(memory.grown(2, true).total() == 1000 + 100 + 50 + 40 + 320);
    CHECK(memory.grown(2, false).total() == 1000 + 100 + 40 + 320);
    PlantMemory two = memory;
    two.add(memory);
    CHECK(two.total() == 2 * memory.total());
}
