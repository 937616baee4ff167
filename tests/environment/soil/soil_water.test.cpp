// The process as a scene meets it: fields, statistics, checkpoints, mistakes.
#include "espalier/geometry/field_values.h"

#include "catch.h"
#include "environment/soil/linear/soil.h"

#include <fmt/format.h>
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

TEST_CASE("the soil of a step is that of its time: erfc(x / sqrt(4 D t)) below a wet face", "[environment][water]") {
    const double diffusion = GENERATE(1e-3, 2.7e-3), dt = GENERATE(0.25, 0.7);
    INFO("D " << diffusion << ", dt " << dt);
    Soil soil(
        fmt::format("domain = {{ lower = [0, 0, 0], upper = [1, 0.01, 0] }}\nvoxel = 0.01\ndiffusion = {}\n"
                    "boundaries = {{ left = {{ fixed = 0.4 }} }}",
                    diffusion));
    soil.world.step = 0;
    for (int step = 0; step * dt <= 8; ++step) {
        soil.step({}, dt);
        const double t = step * dt;
        if (step == 0) CHECK(soil.quantity("maximum") == 0);
        if (t < 2) continue;
        for (const double x : {0.033, 0.055, 0.087}) {
            const double expected = 0.4 * std::erfc(x / std::sqrt(4 * diffusion * t));
            INFO("x " << x << ", t " << t);
            CHECK(soil.ask({{{x, 0.005, 0}, {0, 0}}})[0][1] == Approx(expected).epsilon(0.01));
        }
    }
}

TEST_CASE("n steps have n pulses of rain, and step 0 is the beginning", "[environment][water]") {
    const std::string mode = GENERATE("diffusion = 0.001", "mode = \"relaxation\"");
    Soil soil("domain = { lower = [0, 0, 0], upper = [1, 1, 1] }\nvoxel = 0.1\ninitial = 0.1\n" + mode +
              "\nsources = [{ shape = \"box\", lower = [0, 0.9, 0], upper = [1, 1, 1], rate = 0.002 },"
              "{ shape = \"sphere\", center = [0.5, 0.2, 0.5], radius = 0.1, hold = 0.3 }]");
    soil.world.step = 0;
    soil.step({}, 0.5);
    const double held = soil.quantity("added");
    CHECK(soil.quantity("total") == Approx(100 + held));
    CHECK(soil.ask({{{0.55, 0.25, 0.55}, {0, 0}}})[0][1] == Approx(0.3));
    CHECK(soil.ask({{{0.55, 0.95, 0.55}, {0, 0}}})[0][1] == Approx(0.1));
    Soil rain("domain = { lower = [0, 0, 0], upper = [1, 1, 1] }\nvoxel = 0.1\ninitial = 0.1\n" + mode +
              "\nsources = [{ shape = \"box\", lower = [0, 0.9, 0], upper = [1, 1, 1], rate = 0.002 }]");
    rain.world.step = 0;
    for (int step = 0; step <= 40; ++step) {
        rain.step({}, 0.5);
        CHECK(rain.quantity("added") == Approx(step * 0.5 * 0.002 * 100));
    }
}

TEST_CASE("rain that finds no room runs off, and the balance knows it", "[environment][water]") {
    const std::string relaxation = "mode = \"relaxation\"";
    const std::string mode = GENERATE_COPY(std::string("diffusion = 0.0004"), std::string("diffusion = 0"), relaxation);
    Soil soil("domain = { lower = [0, 0, 0], upper = [1, 1, 0.1] }\nvoxel = 0.1\ninitial = 0.1\nporosity = 0.43\n" +
              mode +
              "\nsources = [{ shape = \"box\", lower = [0, 0.9, 0], upper = [1, 1, 0.1], rate = 0.07 },"
              "{ shape = \"box\", lower = [0.5, 0.8, 0], upper = [1, 1, 0.1], rate = 0.01 }]");
    double before = 0;
    for (int step = 0; step < 60; ++step) {
        soil.step({{{0.31, 0.94, 0.05}, {0.02}}});
        CHECK(soil.quantity("maximum") <= 0.43);
        if (mode != relaxation) CHECK(std::abs(soil.quantity("balance")) < 1e-12);
        CHECK(soil.quantity("runoff") >= before);
        before = soil.quantity("runoff");
    }
    CHECK(before > 0);
    CHECK(soil.quantity("added") == Approx(60 * (0.07 * 10 + 0.01 * 10)));
    if (mode == relaxation) return;  // does not conserve
    CHECK(soil.quantity("total") == Approx(10 + soil.quantity("added") - soil.quantity("drunk") - before));
}

TEST_CASE("models read the field up to its sides and stones as the process answers it", "[environment][water]") {
    // Content that rises along x and y by 0.3 and 0.2 per metre, in a soil with a stone; also in the plane.
    const bool flat = GENERATE(false, true);
    std::string text = fmt::format(
        "domain = {{ lower = [-1, -1, {0}], upper = [1, 1, {1}] }}\nvoxel = 0.1\n"
        "obstacles = [{{ shape = \"box\", lower = [-0.3, -0.4, -9], upper = [0.2, 0.1, 9] }}]\nregions = [\n",
        flat ? 0 : -1, flat ? 0 : 1);
    for (int i = 0; i < 20; ++i) {
        for (int j = 0; j < 20; ++j) {
            const double x = -0.95 + 0.1 * i, y = -0.95 + 0.1 * j;
            text += fmt::format("{{ shape = \"box\", lower = [{}, {}, -9], upper = [{}, {}, 9], value = {} }},\n",
                                x - 0.04, y - 0.04, x + 0.04, y + 0.04, 0.5 + 0.3 * x + 0.2 * y);
        }
    }
    Soil soil(text + "]\n");
    FieldValues values;
    values.take(soil.fields, {"water"});
    RandomSamples samples({4, 0, Stream::process}, 1, 1);
    for (int i = 0; i < 300; ++i) {
        const glm::dvec3 place(2 * samples.uniform() - 1, 2 * samples.uniform() - 1,
                               flat ? 0 : 2 * samples.uniform() - 1);
        const auto near_stone = [&](double margin) {
            return std::max(std::abs(place.x + 0.05), std::abs(place.y + 0.15)) < 0.25 + margin;
        };
        if (near_stone(0.05)) continue;
        const glm::dvec3 slope = values.gradient("water", place);
        INFO(place.x << " " << place.y << " " << place.z);
        const double answered = soil.ask({{place, {0, 0}}})[0][1];
        CHECK(values.value("water", place) == Approx(answered).margin(1e-6));
        if (near_stone(0.2)) continue;  // slopes beside corners are less exact
        CHECK(slope.x == Approx(0.3).epsilon(1e-4));
        CHECK(slope.y == Approx(0.2).epsilon(1e-4));
        CHECK(std::abs(slope.z) < 1e-4);
    }
}

TEST_CASE("more water than room is a warning, once, where the soil has no porosity", "[environment][water]") {
    const std::string text =
        "domain = { lower = [0, 0, 0], upper = [1, 1, 1] }\nvoxel = 0.1\n"
        "sources = [{ shape = \"box\", lower = [0, 0.9, 0], upper = [1, 1, 1], rate = 0.4 }]\n";
    std::vector<Diagnostic> warnings;
    EnvironmentContext context;
    context.warnings = &warnings;
    Soil soil(text, context), plain(text + "unit = \"mol/m3\"", context), full(text + "porosity = 0.4", context);
    for (int step = 0; step < 5; ++step) {
        for (Soil* each : {&soil, &plain, &full}) each->step();
    }
    REQUIRE(warnings.size() == 1);
    mentions(warnings[0].message, "'water' holds 1.2 m3/m3");
    mentions(warnings[0].message, "porosity");
}

TEST_CASE("mistakes in a soil's table are explained", "[environment][water]") {
    const std::string domain = "domain = { lower = [0, 0, 0], upper = [1, 1, 1] }\n";
    CHECK(mentions(mistake(domain + "voxel = -0.1"), "voxel"));
    const std::string full = domain + "voxel = 0.1\nporosity = 0.4\n";
    CHECK(mistake(full + "initial = 0.4").empty());
    CHECK(mentions(mistake(full + "initial = 0.5"), "a content of 0.5 is more than the porosity of the soil, 0.4"));
    CHECK(mentions(mistake(full + "boundaries = { top = { fixed = 1 } }"), "porosity"));
    CHECK(mentions(mistake(full + "layers = [{ initial = 0.41 }]"), "porosity"));
    CHECK(mentions(mistake(full + "regions = [{ shape = \"sphere\", center = [0, 0, 0], radius = 1, value = 0.41 }]"),
                   "porosity"));
    CHECK(mentions(mistake(full + "sources = [{ shape = \"sphere\", center = [0, 0, 0], radius = 1, hold = 0.41 }]"),
                   "porosity"));
    CHECK(mentions(mistake(full + "begin = \"steady\"\ndiffusion = 0.01\nboundaries = { top = \"open\" }\n"
                                  "sources = [{ shape = \"box\", lower = [0, 0, 0], upper = [1, 1, 1], rate = 1 }]"),
                   "porosity"));
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
    CHECK(mentions(mistake("voxel = 1\ndomain = { lower = [0, 0, 0], upper = [1e200, 1e200, 1e200] }"), "voxels"));
}

}  // namespace espalier::test
