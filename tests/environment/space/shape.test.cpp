#include "espalier/environment/environment_process.h"
#include "espalier/geometry/openvdb_grid.h"

#include "catch.h"
#include "environment/space/shapes/tables.h"

#include <tbb/global_control.h>

#include <cmath>

using namespace espalier;
using namespace espalier::environment;

namespace {

constexpr int slots = 8;

/// A process of one shape, asked at points by two plants in turn.
class AskedShape {
public:
    explicit AskedShape(const std::string& toml, EnvironmentContext context = {}) {
        context.name = "hedge";
        context.plants = 2;
        Settings settings = Settings::parse_toml(toml, "test.toml");
        process = registered<ProcessType>().at("shape")->make(settings, context, fields);
        settings.reject_unread();
    }

    /// The answers in a row, `arity` for each point.
    std::vector<double> ask(const std::vector<glm::dvec3>& points, int arity, int step = 0) {
        std::vector<double> values(points.size() * arity, 7);
        std::vector<Query> queries(points.size());
        std::vector<Answer> answers;
        for (std::size_t i = 0; i < points.size(); ++i) {
            queries[i].plant = i % 2;
            queries[i].pose.position = points[i];
            answers.emplace_back(values.data() + i * arity, arity);
        }
        WorldView world;
        world.step = step;
        process->advance(world, queries, fields);
        process->answer(world, queries, answers, fields);
        return values;
    }

    Fields fields;
    std::unique_ptr<EnvironmentProcess> process;
};

const char* const unit_sphere = "shape = 'sphere'\ncenter = [0, 0, 0]\nradius = 1\n";

}  // namespace

TEST_CASE("a shape answers as many groups as the query has room for", "[shape]") {
    AskedShape asked(unit_sphere);
    const std::vector<glm::dvec3> point = {{0, 3, 0}};
    const double whole[slots] = {0, 2, 0, 1, 0, 0, 1, 0};
    const int answered[slots] = {1, 2, 2, 2, 5, 5, 5, 8};
    for (int arity = 1; arity <= slots; ++arity) {
        const std::vector<double> values = asked.ask(point, arity);
        for (int i = 0; i < arity; ++i)
            CHECK(values[i] == Approx(i < answered[arity - 1] ? whole[i] : 7).margin(1e-12));
    }
    CHECK(asked.process->query_arity() == std::pair(1, slots));
}

TEST_CASE("one parameter and eight tell inside alike, and statistics count it by plant", "[shape]") {
    AskedShape asked(
        "shape = 'difference'\nof = [{ shape = 'sphere', center = [0, 0, 0], radius = 2 },"
        " { shape = 'ellipsoid', center = [0, 1, 0], radii = [1, 2, 1] }]");
    const std::vector<glm::dvec3> points = random_points(2000, 2.5);
    const std::vector<double> one = asked.ask(points, 1), eight = asked.ask(points, slots);
    double inside[2] = {0, 0};
    for (std::size_t i = 0; i < points.size(); ++i) {
        REQUIRE(one[i] == eight[i * slots]);
        inside[i % 2] += one[i];
    }
    for (std::uint32_t plant : {0u, 1u}) {
        const std::vector<Quantity> statistics = asked.process->statistics(plant);
        CHECK(statistics[0].name == "inside");
        CHECK(statistics[0].value == inside[plant]);
        CHECK(statistics[1].value == 1000 - inside[plant]);
    }
}

TEST_CASE("answers are the same bits with one thread and with many", "[shape]") {
    AskedShape asked("shape = 'ellipsoid'\ncenter = [0, 1, 0]\nradii = [1, 2, 1.5]");
    const std::vector<glm::dvec3> points = random_points(5000, 3);
    const auto answers = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return asked.ask(points, slots);
    };
    CHECK(answers(1) == answers(4));
}

TEST_CASE("the distance field is the shape's distance near the surface and has its sign everywhere", "[shape]") {
    AskedShape asked(std::string(unit_sphere) + "voxel = 0.05");
    const Field& field = asked.fields.need("hedge.distance");
    CHECK_FALSE(field.changes);
    const openvdb::FloatGrid& grid = *field.grid->grid;
    CHECK(grid.background() == Approx(0.15));
    CHECK(grid.getGridClass() == openvdb::GRID_LEVEL_SET);
    int near = 0;
    for (auto at = field.grid->box.begin(); at; ++at) {
        const double exact = grid.indexToWorld(*at).length() - 1;
        const double value = grid.tree().getValue(*at);
        if (std::abs(exact) < 0.149) {
            REQUIRE(value == Approx(exact).margin(1e-6));
            ++near;
        } else {
            REQUIRE(value == Approx(std::copysign(0.15, exact)).margin(2e-3));
        }
    }
    // The band 4 pi r^2 2 b in voxels.
    CHECK(near == Approx(4 * 3.14159 * 0.3 / std::pow(0.05, 3)).epsilon(0.03));
}

TEST_CASE("motion grows and moves a shape linearly between its times", "[shape]") {
    AskedShape asked(
        std::string(unit_sphere) +
        "voxel = 0.1\nmotion = { times = [10, 20], growth = [0, -0.5], movement = [[0, 0, 0], [4, 0, 0]] }");
    const std::vector<glm::dvec3> point = {{0, 0, 0}};
    const auto distance_at = [&](int step) { return asked.ask(point, 2, step)[1]; };
    CHECK(distance_at(0) == Approx(-1));
    CHECK(distance_at(10) == Approx(-1));
    CHECK(distance_at(15) == Approx(2 - 0.75));
    CHECK(distance_at(30) == Approx(4 - 0.5));
    const Field& field = asked.fields.need("hedge.distance");
    CHECK(field.changes);
    const openvdb::FloatGrid& grid = *field.grid->grid;
    CHECK(grid.tree().getValue(openvdb::Coord::round(grid.worldToIndex({4, 0, 0}))) < 0);
    CHECK(grid.tree().getValue(openvdb::Coord::round(grid.worldToIndex({0, 0, 0}))) > 0);
    CHECK(distance_at(12) == Approx(0.8 - 0.9));  // back again, as a resumed run asks
}

TEST_CASE("a half-space fills the scene's domain with its field, or has none", "[shape]") {
    const char* const ground = "shape = 'half-space'\nnormal = [0, 1, 0]\nvoxel = 0.25";
    CHECK(AskedShape(ground).fields.all().empty());
    EnvironmentContext context;
    context.domain = Box{{-2, -2, -2}, {2, 2, 2}};
    const AskedShape asked(ground, context);
    const FieldGrid& field = *asked.fields.need("hedge.distance").grid;
    CHECK(field.box.dim() == openvdb::Coord(16));
    CHECK(field.grid->tree().getValue({3, 7, 3}) == Approx(-0.125));
    CHECK(field.grid->tree().getValue({3, 8, 3}) == Approx(0.125));
    CHECK(field.grid->tree().getValue({3, 0, 3}) == Approx(-0.75));
}

TEST_CASE("a field that would not fit is refused before it is made", "[shape]") {
    EnvironmentContext context;
    context.memory = 1 << 20;
    CHECK_THROWS_AS(AskedShape(std::string(unit_sphere) + "voxel = 0.01", context), UserError);
    CHECK_THROWS_AS(AskedShape(std::string(unit_sphere) + "voxel = 1e-12", context), UserError);
    CHECK_THROWS_AS(AskedShape(std::string(unit_sphere) + "voxel = -1"), UserError);
}

TEST_CASE("mistakes in motion are told with their place", "[shape]") {
    using Catch::Contains;
    const auto message = [](const char* motion) -> std::string {
        try {
            AskedShape(std::string(unit_sphere) + "motion = " + motion);
        } catch (const UserError& error) {
            return error.what();
        }
        return "accepted";
    };
    CHECK_THAT(message("{ times = [1, 1], growth = [0, 1] }"), Contains("test.toml:4") && Contains("must rise"));
    CHECK_THAT(message("{ times = [], growth = [] }"), Contains("one step or more"));
    CHECK_THAT(message("{ times = [1, 2], growth = [0] }"), Contains("each of the 2 times, not 1"));
    CHECK_THAT(message("{ times = [1], grow = [0] }"), Contains("did you mean 'growth'"));
}
