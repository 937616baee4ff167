// The numbers of modules, which frames show as `organ`: in the order of births, and the same for life.
#include "catch.h"
#include "simulation/resumed_world.h"
#include "temporary_folder.h"

#include <tbb/global_control.h>

#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

using namespace espalier;
using namespace espalier::simulation;
using simulation_test::ResumedWorld;

namespace {

/// Modules die, are born between others, and are decomposed between their siblings.
const char* const shedding = R"(lsystem: 1
derivation length: 9
seed: 1
axiom: A B
A --> F [ +A ] C A : .6
A --> F A : .3
A --> * : .1
F --> F C
C --> *
decomposition
B --> F C B
maximum depth: 3
endlsystem
)";

const char* const growing = R"(#define SIDES 2  /* laterals of an apex; 0..9 */
lsystem: 1
derivation length: 5
axiom: A
A : SIDES >= 3 --> F [ A ] [ A ] [ A ] A
A : SIDES < 3 --> F [ A ] A
endlsystem
)";

class Stand {
public:
    Stand() {
        folder_.write("shedding.l", shedding);
        folder_.write("growing.l", growing);
    }

    Scene scene(const std::string& plants) const {
        return read_scene_text("[simulation]\nseed = 5\n" + plants, "scene.toml", folder_.path());
    }

private:
    TemporaryFolder folder_;
};

const std::string two_shedding = "[[plant]]\nmodel = 'shedding.l'\n[[plant]]\nmodel = 'shedding.l'\n";

using Key = std::pair<std::size_t, Identity>;
using Numbers = std::map<Key, std::uint64_t>;

/// The numbers of all modules at this step; modules that were there before must have theirs. Returns those of the new
/// ones in the order of plants and strings.
std::vector<std::uint64_t> follow(const World& world, Numbers& known) {
    std::vector<std::uint64_t> fresh;
    for (std::size_t plant = 0; plant < world.size(); ++plant) {
        const ModuleString& string = world.string(plant);
        for (std::size_t module = 0; module < string.size(); ++module) {
            const std::uint64_t number = string.birth_number(module);
            const auto [at, is_new] = known.emplace(Key{plant, string.identity(module)}, number);
            if (is_new) fresh.push_back(number);
            REQUIRE(at->second == number);
        }
    }
    return fresh;
}

}  // namespace

TEST_CASE("births are numbered from 0, step by step, plant by plant, in the order of the string", "[simulation]") {
    const Stand stand;
    for (const std::string& plants : {two_shedding, two_shedding + two_shedding}) {
        World world(stand.scene(plants));
        Numbers known;
        std::uint64_t next = 0;
        world.start();
        for (int step = 0; step <= 9; ++step) {
            if (step > 0) world.step();
            for (const std::uint64_t number : follow(world, known)) REQUIRE(number == next++);
        }
        CHECK(next > 100);
    }
}

TEST_CASE("a module keeps its identity where decomposition parts its siblings", "[simulation]") {
    const Stand stand;
    World world(stand.scene(two_shedding));
    world.start();
    for (int step = 1; step <= 9; ++step) world.step();
    const ModuleString& string = world.string(1);
    std::set<Identity> identities;
    for (std::size_t module = 0; module < string.size(); ++module) identities.insert(string.identity(module));
    CHECK(identities.size() == string.size());
}

TEST_CASE("a run that goes on from a checkpoint numbers its births as one that was not left", "[simulation]") {
    const Stand stand;
    ResumedWorld worlds(stand.scene(two_shedding), 4);
    Numbers through, resumed;
    for (int step = 5; step <= 9; ++step) {
        worlds.step();
        follow(worlds.through, through);
        follow(worlds.resumed, resumed);
        REQUIRE(through == resumed);
    }
}

TEST_CASE("the numbers of births do not depend on the number of threads", "[simulation]") {
    const Stand stand;
    std::vector<Numbers> all;
    for (const std::size_t threads : {1u, 4u}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        World world(stand.scene(two_shedding + two_shedding + two_shedding));
        Numbers& known = all.emplace_back();
        world.start();
        for (int step = 1; step <= 9; ++step) {
            world.step();
            follow(world, known);
        }
    }
    CHECK(all[0] == all[1]);
}

TEST_CASE("a plant that grows anew in every step keeps the numbers of what it had", "[simulation]") {
    const Stand stand;
    const std::string regrown =
        "[[plant]]\nmodel = 'growing.l'\nregrow = true\n[[plant.keyframes]]\nname = 'SIDES'\n"
        "times = [0, 2, 5]\nvalues = [2, 4, 2]\n";
    ResumedWorld worlds(stand.scene(two_shedding + regrown), 1);
    Numbers through, resumed;
    std::set<std::uint64_t> numbers;
    for (int step = 2; step <= 6; ++step) {
        worlds.step();
        follow(worlds.through, through);
        follow(worlds.resumed, resumed);
        REQUIRE(through == resumed);
    }
    for (const auto& [key, number] : through) numbers.insert(number);
    CHECK(numbers.size() == through.size());
}
