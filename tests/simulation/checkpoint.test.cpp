// A world that is saved and restored goes on as if nothing had happened.
#include "espalier/simulation/world_checkpoint.h"

#include "catch.h"
#include "temporary_folder.h"

#include <cstring>
#include <sstream>

using namespace espalier;

namespace {

const char* const thirsty = R"(environment light, water;
lsystem: 1
define: { array count[2]; }
seed: 3
Start: { total = 0; }
EndEach: { total = total + count[0]; }
derivation length: 12
axiom: ;(1)A(1)?light(1)[&(180)R?water(0.001,0,0,0)]
A(x) : x > 0.2 --> F(x)[+A(x*0.7)?light(0.5)]A(x*0.9) : 2
A(x) : x > 0.2 --> F(x)[-A(x*0.8)]A(x*0.85)?light(0) : 1
F(x) --> F(x*1.01)
R --> F(0.05)[+(20)R]R : 1
R --> F(0.1)R : 2
endlsystem
)";

const char* const scene_text = R"([simulation]
seed = 5
steps = 12
[[plant]]
model = "plant.l"
positions = [[0, 0, 0], [0.5, 0, 0]]
[environment.light]
process = "voxel-shade"
voxel = 0.25
[environment.water]
process = "soil-water"
voxel = 0.25
domain = { lower = [-2, -3, -2], upper = [2, 0, 2] }
diffusion = 0.01
initial = 0.3
)";

class Saved {
public:
    Saved() {
        folder_.write("plant.l", thirsty);
        scene = read_scene_text(scene_text, "scene.toml", folder_.path());
    }
    Scene scene;

private:
    TemporaryFolder folder_;
};

template <class T>
bool same(const Column<T>& a, const Column<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// Tables of siblings may differ in rows that no module points to.
bool same_lineage(const ModuleString& a, const ModuleString& b) {
    if (a.has_lineage() != b.has_lineage()) return false;
    for (std::size_t i = 0; a.has_lineage() && i < a.size(); ++i) {
        if (a.identity(i) != b.identity(i) || a.parent(i) != b.parent(i)) return false;
        if (a.step_of_birth(i) != b.step_of_birth(i)) return false;
    }
    return true;
}

bool same(const ModuleString& a, const ModuleString& b) {
    return same(a.letters, b.letters) && same(a.parameters, b.parameters) && same_lineage(a, b);
}

std::string saved(World& world) {
    std::ostringstream out;
    WorldCheckpoint(world).save(out);
    return out.str();
}

}  // namespace

TEST_CASE_METHOD(Saved, "a restored world goes on bit for bit", "[simulation]") {
    World through(scene);
    through.start();
    for (int step = 0; step < 7; ++step) through.step();
    World resumed(scene);
    std::istringstream in(saved(through));
    WorldCheckpoint(resumed).restore(in);
    CHECK(resumed.steps_done() == 7);
    CHECK(resumed.last_step() == through.last_step());
    for (int step = 7; step < 12; ++step) {
        through.step();
        resumed.step();
        const timeline::Frame frame = through.frame(), resumed_frame = resumed.frame();
        for (std::size_t plant = 0; plant < 2; ++plant) {
            REQUIRE(same(through.string(plant), resumed.string(plant)));
            const auto& here = frame.plants[plant].quantities;
            const auto& there = resumed_frame.plants[plant].quantities;
            REQUIRE(here.size() == there.size());
            for (std::size_t i = 0; i < here.size(); ++i) CHECK(here[i].value == there[i].value);
        }
    }
    CHECK(through.modules() > 1000);
    CHECK(saved(through) == saved(resumed));
}

TEST_CASE_METHOD(Saved, "a checkpoint that is cut short or of something else is refused", "[simulation]") {
    World world(scene);
    world.start();
    world.step();
    const std::string bytes = saved(world);
    for (std::size_t size = 0; size < bytes.size(); size += 97) {
        World other(scene);
        std::istringstream in(bytes.substr(0, size));
        CHECK_THROWS_AS(WorldCheckpoint(other).restore(in), std::runtime_error);
    }
}

TEST_CASE_METHOD(Saved, "a checkpoint whose strings no derivation could have left is refused", "[simulation]") {
    World world(scene);
    world.start();
    world.step();
    const std::string bytes = saved(world);
    const ModuleString& string = world.string(0);
    const std::string letters(reinterpret_cast<const char*>(string.letters.data()), string.size() * sizeof(LetterId));
    const std::size_t at = bytes.find(letters);
    REQUIRE(at != std::string::npos);
    const auto with_first_letter = [&](LetterId letter) {
        std::string changed = bytes;
        std::memcpy(changed.data() + at, &letter, sizeof letter);
        return changed;
    };
    const auto refusal = [&](const std::string& checkpoint) {
        World other(scene);
        std::istringstream in(checkpoint);
        try {
            WorldCheckpoint(other).restore(in);
        } catch (const RunError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    const Alphabet& alphabet = world.model(0).alphabet;
    CHECK(refusal(bytes).empty());
    CHECK(refusal(with_first_letter(static_cast<LetterId>(alphabet.size()))) ==
          "the checkpoint's strings are of another model");
    REQUIRE(alphabet.arity(string.letters[0]) > 0);
    CHECK(refusal(with_first_letter(Alphabet::open_bracket)) == "the checkpoint's strings are damaged");
}
