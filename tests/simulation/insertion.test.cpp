// Modules that are put into a string while it grows: what the mouse did in a window.
#include "simulation/scene/insertion.h"

#include "espalier/base/error.h"
#include "espalier/simulation/simulation.h"
#include "espalier/simulation/world_checkpoint.h"

#include "catch.h"
#include "temporary_folder.h"

#include <set>
#include <sstream>

using namespace espalier;
using Catch::Contains;
using espalier::simulation::read_insertion;

namespace {

/// X climbs from internode to internode; `@c` has a letter that is one of the turtle's.
const char* const model_of_insertion =
    "lsystem: 1\nderivation length: 6\naxiom: A\nA --> F[-(30)F]A\nX(n) > F --> \nX(n) < F --> FX(n + 1)\n"
    "F --> F@c(1)\nendlsystem\n";

Scene scene_with(const std::string& insertions, const std::string& text = model_of_insertion) {
    TemporaryFolder folder;
    folder.write("plant.l", text);
    return read_scene_text("[[plant]]\nmodel = 'plant.l'\ninsert = [" + insertions + "]\n", "scene.toml",
                           folder.path());
}

std::string string_at(const Scene& scene, int step) {
    World world(scene);
    world.start();
    while (world.steps_done() < step) world.step();
    return to_text(world.string(0), world.model(0).alphabet);
}

}  // namespace

TEST_CASE("an insertion names modules, a step and, if it likes, a place", "[simulation]") {
    const Insertion plain = read_insertion("X(1)@5", {});
    CHECK(plain.modules == "X(1)");
    CHECK(plain.step == 5);
    CHECK(plain.before.empty());
    const Insertion placed = read_insertion("[@c(2)X]@12:F.3", {});
    CHECK(placed.modules == "[@c(2)X]");
    CHECK(placed.step == 12);
    CHECK(placed.before == "F");
    CHECK(placed.number == 3);
    CHECK(read_insertion("X@0:A", {}).number == 1);
    for (const char* wrong : {"", "X", "@5", "X@", "X@-1", "X@1.5", "X@5:F.0", "X@5:F.x"}) {
        INFO(wrong);
        CHECK_THROWS_WITH(read_insertion(wrong, {}), Contains("is no insertion"));
    }
}

TEST_CASE("inserted modules stand in the string of their step, and the next derivation sees them", "[simulation]") {
    const char* const waiting = "lsystem: 1\nderivation length: 4\naxiom: AB\nX > A --> \nX < A --> C\nendlsystem\n";
    CHECK(string_at(scene_with("", waiting), 3) == "AB");
    CHECK(string_at(scene_with("'X@2'", waiting), 2) == "XAB");
    CHECK(string_at(scene_with("'X@2'", waiting), 3) == "CB");
    CHECK(string_at(scene_with("'X@2:B'", waiting), 4) == "AXB");
    CHECK(string_at(scene_with("'X@0', '[XX]@1:B'", waiting), 1) == "C[XX]B");
}

TEST_CASE("an insertion before the third of a symbol stands there", "[simulation]") {
    const Scene scene = scene_with("'X(2.5)@2:F.3'");
    CHECK(string_at(scene, 2) == "F@c(1)[-(30)F@c(1)]X(2.5)F[-(30)F]A");
}

TEST_CASE("inserted modules have identities of their own, born in their step of no parent", "[simulation]") {
    World world(scene_with("'X(1)X(2)@2'"));
    world.start();
    world.step();
    world.step();
    const ModuleString& string = world.string(0);
    std::set<Identity> identities;
    for (std::size_t module = 0; module < string.size(); ++module) identities.insert(string.identity(module));
    CHECK(identities.size() == string.size());
    CHECK(string.parent(0) == 0);
    CHECK(string.step_of_birth(1) == 2);
}

TEST_CASE("a run with an insertion goes on from its checkpoint as if it had not stopped", "[simulation]") {
    const Scene scene = scene_with("'X(1)@2'");
    World whole(scene), first(scene), second(scene);
    whole.start();
    first.start();
    for (int step = 0; step < 3; ++step) first.step();
    std::stringstream checkpoint;
    WorldCheckpoint(first).save(checkpoint);
    WorldCheckpoint(second).restore(checkpoint);
    while (!whole.at_end()) whole.step();
    while (!second.at_end()) second.step();
    CHECK(to_text(whole.string(0), whole.model(0).alphabet) == to_text(second.string(0), second.model(0).alphabet));
}

TEST_CASE("what cannot be inserted is refused with its reason", "[simulation]") {
    CHECK_THROWS_WITH(scene_with("'Y@1'"), Contains("scene.toml:3") && Contains("no module 'Y' with 0 parameters"));
    CHECK_THROWS_WITH(scene_with("'X@1'"), Contains("no module 'X' with 0 parameters"));
    CHECK_THROWS_WITH(scene_with("'[X(1)@1'"), Contains("brackets do not match"));
    CHECK_THROWS_WITH(scene_with("'X(a)@1'"), Contains("'a' is no number"));
    World world(scene_with("'X(1)@1:F.9'"));
    world.start();
    CHECK_THROWS_WITH(world.step(), Contains("cannot insert 'X(1)' at step 1: the string has 2 modules 'F', not 9"));
}
