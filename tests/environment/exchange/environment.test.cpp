#include "espalier/base/error.h"
#include "espalier/geometry/openvdb_grid.h"

#include "catch.h"
#include "environment/exchange/exchange_plants.h"

using namespace espalier;
using namespace espalier::environment;

namespace {

const std::string two_processes = "[light]\nprocess = \"voxel-shade\"\n[lamp]\nprocess = \"voxel-shade\"";

ModuleTemplate module_of(Model& model, const std::string& symbol, int arity) {
    return {model.alphabet.letter(symbol, arity), {}, {"tree.l", 7, 3}};
}

}  // namespace

TEST_CASE("an unknown process is an error that offers the nearest name and its place", "[environment]") {
    const auto make = [] { environment_of("[light]\nprocess = \"voxel-shad\""); };
    CHECK_THROWS_AS(make(), UserError);
    CHECK(lacks(message_of(make), {"scene.toml:2", "did you mean 'voxel-shade'?"}) == "");
}

TEST_CASE("one process is the default; of several none is until it is named", "[environment]") {
    CHECK(environment_of("[light]\nprocess = \"voxel-shade\"").default_process() == 0u);
    Environment environment = environment_of(two_processes);
    CHECK_FALSE(environment.default_process());
    environment.set_default("lamp");
    CHECK(environment.default_process() == 1u);
    CHECK(lacks(message_of([&] { environment.set_default("lihgt"); }), {"did you mean 'light'?"}) == "");
}

TEST_CASE("a model that declares a process the scene lacks is refused before step 0", "[environment]") {
    const Environment environment = environment_of(two_processes);
    Model model;
    model.name = "root.l";
    model.processes = {"ligth"};
    model.systems.emplace_back();
    CHECK_THROWS_AS(environment.require_answers(model, "oak"), UserError);
    CHECK(lacks(message_of([&] { environment.require_answers(model, "oak"); }),
                {"oak", "root.l", "did you mean 'light'?"}) == "");
    model.processes = {"light"};
    CHECK_NOTHROW(environment.require_answers(model, "oak"));
}

TEST_CASE("a model that has a default for a process the scene lacks is not refused", "[environment]") {
    const Environment environment = environment_of(two_processes);
    Model model;
    model.processes = {"light", "nitrate"};
    model.default_answers = {{"light", {1}}, {"nitrate", {10}}};
    model.systems.emplace_back();
    CHECK_NOTHROW(environment.require_answers(model, "oak"));
    CHECK(environment.answered_by_default(model) == std::vector<std::string>{"nitrate"});
    CHECK_FALSE(needs_processes(model));
    model.processes.push_back("water");
    CHECK(needs_processes(model));
    CHECK_THROWS_AS(environment.require_answers(model, "oak"), UserError);
}

TEST_CASE("a model that asks ?E where no process is default is refused with its place", "[environment]") {
    Environment environment = environment_of(two_processes);
    Model model;
    model.systems.emplace_back();
    Production production;
    production.successor = {module_of(model, "?", 0), module_of(model, "E", 1)};
    model.systems[0].productions.push_back(production);
    CHECK(lacks(message_of([&] { environment.require_answers(model, "oak"); }), {"tree.l:7:3"}) == "");
    environment.set_default("light");
    CHECK_NOTHROW(environment.require_answers(model, "oak"));
}

TEST_CASE("a query written with a number of parameters its process does not take is refused", "[environment]") {
    const Environment environment = environment_of(two_processes);
    Model model;
    model.processes = {"light"};
    model.systems.emplace_back();
    model.systems[0].axiom = {module_of(model, "?light", 4), module_of(model, "E", 0)};
    CHECK_NOTHROW(environment.require_answers(model, "oak"));
    model.systems[0].axiom.push_back(module_of(model, "?light", 0));
    CHECK(lacks(message_of([&] { environment.require_answers(model, "oak"); }),
                {"tree.l:7:3", "0 parameters", "voxel-shade"}) == "");
}

TEST_CASE("statistics carry the name of their process", "[environment]") {
    std::vector<std::string> names;
    for (const Quantity& quantity : environment_of(two_processes).statistics(0)) names.push_back(quantity.name);
    REQUIRE(names.size() == 10);
    CHECK(names.front() == "light.mean");
    CHECK(names[5] == "lamp.mean");
}

TEST_CASE("a plant that asks nothing has no mean, least or most light", "[environment]") {
    const std::string process =
        GENERATE("voxel-shade", "chiba", "takenaka", "shadowpyramid", "clover", "density", "cohen", "ornament");
    INFO(process);
    Environment environment = environment_of("[light]\nprocess = \"" + process + "\"\n");
    const std::vector<double> question = process == "density" ? std::vector<double>{0, 0, 0} : std::vector(4, 0.5);
    AskingPlants plants;
    plants.add({}).add({{{0.1, 0.2, 0.3}, question}}).add({});
    plants.exchange(environment);
    const std::vector<Quantity> asked = environment.statistics(1);
    for (const std::uint32_t silent : {0U, 2U}) {
        const std::vector<Quantity> nothing = environment.statistics(silent);
        for (std::size_t i = 0; i < 3; ++i) {
            CHECK(std::isnan(nothing[i].value));
            CHECK(asked[i].value == asked[0].value);  // from one answer
        }
        CHECK(nothing[3].value == 0);
    }
    CHECK(asked[3].value == 1);
}

TEST_CASE("a field that is not there is an error that names those that are", "[environment]") {
    const Environment environment = environment_of(two_processes);
    CHECK(environment.fields().need("light.shade").name == "light.shade");
    CHECK(lacks(message_of([&] { environment.fields().need("light.shad"); }),
                {"did you mean 'light.shade'?", "lamp"}) == "");
}

TEST_CASE("the first voxel's centre lies half a voxel from the origin", "[environment]") {
    initialize_openvdb();
    const auto transform = cell_centred_transform(0.5, {1, 2, 3});
    const openvdb::Vec3d centre = transform->indexToWorld(openvdb::Coord(0, 0, 0));
    CHECK(centre == openvdb::Vec3d(1.25, 2.25, 3.25));
    CHECK(transform->indexToWorld(openvdb::Coord(2, 0, 0)).x() == 2.25);
}
