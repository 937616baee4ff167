// The process as a scene meets it: fields, statistics, checkpoints, mistakes.
#include "catch.h"
#include "environment/water/soil.h"

#include <openvdb/tools/LevelSetSphere.h>

#include <cmath>

namespace espalier::test {
namespace {

const std::string soil_text = R"(
domain = { lower = [-1, -1, -1], upper = [1, 1, 1] }
voxel = 0.1
initial = 0.3
diffusion = 0.01
obstacles = [{ shape = "sphere", center = [0, 0, 0], radius = 0.31 }]
boundaries = { bottom = "open" }
)";

/// A distance field as another process provides it.
Field sphere_field(const std::string& name, const glm::dvec3& centre, float radius) {
    initialize_openvdb();
    auto grid = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(
        radius, openvdb::Vec3f(openvdb::Vec3d(centre.x, centre.y, centre.z)), 0.05f);
    const openvdb::CoordBBox box = grid->evalActiveVoxelBoundingBox();
    return {name, "m", "signed distance", std::make_shared<FieldGrid>(FieldGrid{grid, box})};
}

std::string mistake(const std::string& text, EnvironmentContext context = {}) {
    return user_error([&] { Soil soil(text, context); });
}

bool mentions(const std::string& message, const std::string& part) {
    INFO(message);
    CHECK(message.find(part) != std::string::npos);
    return message.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a request that no voxel can meet where amounts are volumes is a warning, once", "[environment][water]") {
    const std::string text = "domain = { lower = [0, 0, 0], upper = [1, 1, 1] }\nvoxel = 0.1\ninitial = 0.3\n";
    std::vector<Diagnostic> warnings;
    EnvironmentContext context;
    context.warnings = &warnings;
    Soil small(text + "amount = \"volume\"", context), content(text, context);
    for (int step = 0; step < 2; ++step) {
        content.step({{{0.5, 0.5, 0.5}, {0.15}}});
        small.step({{{0.5, 0.5, 0.5}, {0.0001}}});
    }
    CHECK(warnings.empty());
    Soil soil(text + "amount = \"volume\"", context);
    for (int step = 0; step < 2; ++step) soil.step({{{0.5, 0.5, 0.5}, {0.15}}});
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].place.line == 4);
    mentions(warnings[0].message, "plant 0 requests 0.15 of 'water', but a voxel holds at most 0.001");
    mentions(warnings[0].message, "content times m3");
}

TEST_CASE("the field is the content, free voxels active, in the domain's place", "[environment][water]") {
    Soil soil(soil_text);
    const Field& field = soil.fields.need("water");
    CHECK(field.unit == "m3/m3");
    CHECK(field.changes);
    CHECK(field.grid->box.dim() == openvdb::Coord(20, 20, 20));
    const openvdb::Vec3d first = soil.grid().indexToWorld(openvdb::Coord(0, 0, 0));
    CHECK(first.x() == Approx(-0.95));
    CHECK(soil.grid().getName() == "water");
    CHECK(soil.grid().activeVoxelCount() == 8000 - 136);
    CHECK(soil.grid().tree().getValue(openvdb::Coord(3, 4, 5)) == 0.3f);
    CHECK(soil.grid().tree().getValue(openvdb::Coord(10, 10, 10)) == 0);
    CHECK_FALSE(soil.grid().tree().isValueOn(openvdb::Coord(10, 10, 10)));
    soil.step({{{0.55, 0.55, 0.55}, {0.1}}});
    CHECK(soil.grid().tree().getValue(openvdb::Coord(15, 15, 15)) == Approx(0.2f));
    CHECK(soil.grid().tree().getValue(openvdb::Coord(15, 0, 15)) < 0.3f);
    CHECK(field.grid->grid->tree().getValue(openvdb::Coord(15, 15, 15)) == Approx(0.2f));
}

TEST_CASE("a grid once read does not change under its reader", "[environment][water]") {
    Soil soil(soil_text);
    const std::shared_ptr<const FieldGrid> before = soil.fields.need("water").grid;
    soil.step({{{0.55, 0.55, 0.55}, {0.1}}});
    CHECK(before->grid->tree().getValue(openvdb::Coord(15, 15, 15)) == 0.3f);
}

TEST_CASE("a grid that nobody keeps is written over", "[environment][water]") {
    Soil soil(soil_text);
    const FieldGrid* before = soil.fields.need("water").grid.get();
    soil.step({{{0.55, 0.55, 0.55}, {0.1}}});
    CHECK(soil.fields.need("water").grid.get() == before);
    CHECK(soil.grid().tree().getValue(openvdb::Coord(15, 15, 15)) == Approx(0.2f));
    CHECK_FALSE(soil.grid().tree().isValueOn(openvdb::Coord(10, 10, 10)));
}

TEST_CASE("statistics are per plant where they are the plant's, and of the world otherwise", "[environment][water]") {
    EnvironmentContext context;
    context.plants = 2;
    Soil soil(soil_text, context);
    soil.step({{{0.5, 0.5, 0.5}, {0.1}, {0, -1, 0}, 0}, {{-0.5, 0.5, 0.5}, {0.2}, {0, -1, 0}, 1}});
    CHECK(soil.quantity("uptake", 0) == Approx(0.1));
    CHECK(soil.quantity("uptake", 1) == Approx(0.2));
    CHECK(soil.quantity("drunk", 1) == Approx(0.3));
    CHECK(soil.quantity("total", 0) == soil.quantity("total", 1));
    CHECK(soil.quantity("boundary", 0) < 0);
    CHECK(std::abs(soil.quantity("balance")) < 1e-12);
    soil.step();
    CHECK(soil.quantity("uptake", 1) == 0);
    CHECK(soil.quantity("drunk", 1) == Approx(0.3));
}

TEST_CASE("a soil restored goes on with the same bytes", "[environment][water]") {
    const Tip tip{{0.51, 0.52, 0.53}, {0.1}};
    Soil whole(soil_text), first(soil_text), second(soil_text);
    for (int step = 0; step < 3; ++step) {
        whole.step({tip});
        first.step({tip});
    }
    std::istringstream in(first.saved());
    second.process->restore(in);
    CHECK(second.saved() == whole.saved());
    CHECK(second.grid().tree().getValue(openvdb::Coord(15, 15, 15)) ==
          whole.grid().tree().getValue(openvdb::Coord(15, 15, 15)));
    CHECK(second.step({tip}) == whole.step({tip}));
    CHECK(second.saved() == whole.saved());

    Soil other("domain = { lower = [0, 0, 0], upper = [1, 1, 1] }\nvoxel = 0.5");
    std::istringstream wrong(first.saved());
    CHECK_THROWS_AS(other.process->restore(wrong), RunError);
    std::istringstream cut(first.saved().substr(0, 9000));
    CHECK_THROWS_AS(second.process->restore(cut), RunError);
}

TEST_CASE("distance fields of other processes are obstacles and containers", "[environment][water]") {
    const std::string text =
        "voxel = 0.1\ninitial = 0.5\ndiffusion = 0.01\nobstacle_field = \"stone.distance\"\n"
        "container_field = \"pot.distance\"\n"
        "domain = { lower = [-1, -1, -1], upper = [1, 1, 1] }";
    Settings settings = Settings::parse_toml(text, "soil.toml");
    EnvironmentContext context;
    context.name = "water";
    context.plants = 1;
    Fields fields;
    CHECK(mentions(user_error([&] { registered<ProcessType>().at("soil-water")->make(settings, context, fields); }),
                   "stone.distance"));
    fields.provide(sphere_field("stone.distance", {0, 0.3, 0}, 0.3f));
    fields.provide(sphere_field("pot.distance", {0, 0, 0}, 0.9f));
    const auto process = registered<ProcessType>().at("soil-water")->make(settings, context, fields);
    const auto active = [&] { return fields.need("water").grid->grid->activeVoxelCount(); };
    CHECK(active() == Approx((4.0 / 3 * M_PI * (0.729 - 0.027)) / 1e-3).epsilon(0.02));

    // The stone moves: it pushes water out of the soil, and leaves dry voxels behind.
    fields.provide(sphere_field("stone.distance", {0, -0.3, 0}, 0.3f));
    const WorldView world;
    process->advance(world, {}, fields);
    process->answer(world, {}, {}, fields);
    std::map<std::string, double> quantities;
    for (const Quantity& quantity : process->statistics(0)) quantities[quantity.name] = quantity.value;
    CHECK(quantities["displaced"] == Approx(0.5 * 136));
    CHECK(quantities["minimum"] < 0.4);
    CHECK(std::abs(quantities["balance"]) < 1e-12);
}

TEST_CASE("the domain is the scene's unless the process has its own, and a thin one is two-dimensional",
          "[environment][water]") {
    EnvironmentContext context;
    context.domain = Box{{0, 0, -0.05}, {1, 1, 0.05}};
    Soil flat("voxel = 0.1\ninitial = 0.2", context);
    CHECK(flat.fields.need("water").grid->box.dim() == openvdb::Coord(10, 10, 1));
    flat.advance();
    CHECK(flat.obtain({{0.5, 0.5, 33}, {0.1}}) == Approx(0.1));
    Soil deep("voxel = 0.1\ninitial = 0.2\ndimensions = 3", context);
    deep.advance();
    CHECK(deep.obtain({{0.5, 0.5, 33}, {0.1}}) == 0);
    Soil own("voxel = 0.25\ndimensions = 2\ndomain = { lower = [0, 0, 0], upper = [1, 2, 1] }", context);
    CHECK(own.fields.need("water").grid->box.dim() == openvdb::Coord(4, 8, 1));
}

TEST_CASE("mistakes in a soil's table are explained", "[environment][water]") {
    const std::string domain = "domain = { lower = [0, 0, 0], upper = [1, 1, 1] }\n";
    CHECK(mentions(mistake(domain + "voxel = -0.1"), "voxel"));
    CHECK(mentions(mistake(domain), "voxel"));
    CHECK(mentions(mistake("voxel = 0.1"), "domain"));
    CHECK(mentions(mistake(domain + "voxel = 0.1\ndifusion = 1"), "diffusion"));
    CHECK(mentions(mistake(domain + "voxel = 0.1\ninitial = nan"), "initial"));
    CHECK(mentions(mistake(domain + "voxel = 0.1\ninitial = -1"), "initial"));
    CHECK(mentions(mistake(domain + "voxel = 0.1\ndiffusion = -1"), "diffusion"));
    CHECK(mentions(mistake(domain + "voxel = 0.1\nanisotropy = [1, -1, 1]"), "anisotropy"));
    CHECK(mentions(mistake(domain + "voxel = 0.1\nboundaries = { top = \"opne\" }"), "open"));
    CHECK(mentions(mistake(domain + "voxel = 0.1\nboundaries = { topp = \"open\" }"), "top"));
    CHECK(mentions(mistake(domain + "voxel = 1\nboundaries = { back = \"open\" }"), "two-dimensional"));
    CHECK(mentions(mistake(domain + "voxel = 0.1\nlayers = [{ bottom = 0.5, top = 0.2 }]"), "bottom"));
    CHECK(mentions(mistake(domain + "voxel = 0.1\nmode = \"relaxation\"\nboundaries = { top = \"open\" }"), "closed"));
    CHECK(mentions(mistake(domain + "voxel = 0.1\nregions = [{ shape = \"sphere\", center = [0, 0, 0], radius = 1 }]"),
                   "value"));
    const std::string sphere = "shape = \"sphere\", center = [0, 0, 0]";
    CHECK(mentions(mistake(domain + "voxel = 0.1\nsources = [{ " + sphere + ", radius = 1 }]"), "rate"));
    CHECK(mentions(mistake(domain + "voxel = 0.1\nsources = [{ " + sphere + ", radius = 0.01, rate = 1 }]"), "centre"));
    CHECK(mentions(mistake("voxel = 0.1\ndomain = { lower = [0, 0, 0], upper = [-1, 1, 1] }"), "upper"));
}

TEST_CASE("a domain of 10^12 voxels is refused before anything is allocated", "[environment][water]") {
    CHECK(mentions(mistake("voxel = 0.0001\ndomain = { lower = [0, 0, 0], upper = [1, 1, 1] }"), "1e+12 voxels"));
    EnvironmentContext context;
    context.memory = 1 << 20;
    CHECK(mentions(mistake("voxel = 0.01\ndomain = { lower = [0, 0, 0], upper = [1, 1, 1] }", context), "memory"));
    CHECK(mentions(mistake("voxel = 1e-300\ndomain = { lower = [0, 0, 0], upper = [1, 1, 1] }"), "voxels"));
}

}  // namespace espalier::test
