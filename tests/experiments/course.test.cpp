// The course of models, 01 to 07: each does what its first lines say.
#include "catch.h"
#include "experiments/growth.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <vector>

using namespace espalier;

TEST_CASE("01: after n steps the curve has 4^n segments, is (4/3)^n long for its span, and ends on its base line",
          "[course]") {
    LonePlant curve("models/course/01-curve.l");
    curve.grow(4);
    const PlantGeometry& geometry = curve.interpretation.geometry;
    CHECK(geometry.internodes.size() == 256);
    CHECK(total_length(geometry) == Approx(256));
    const glm::dvec3 end = geometry.internodes.back().tip;
    CHECK(end.x == Approx(81));
    CHECK(std::abs(end.y) < 1e-9);
}

TEST_CASE("02: the plant has 3^n apices and 0, 2, 10, 38, 130, 422 segments", "[course]") {
    LonePlant plant("models/course/02-branching.l");
    int apices = 1;
    for (int segments : {2, 10, 38, 130, 422}) {
        plant.grow(1);
        apices *= 3;
        CHECK(plant.counts()["F"] == segments);
        CHECK(plant.counts()["X"] == apices);
    }
}

TEST_CASE("03: internodes along the trunk shorten by R1, and none is shorter than the condition allows", "[course]") {
    LonePlant tree("models/course/03-parameters.l");
    tree.grow(10);
    std::vector<double> trunk;
    for (const Internode& internode : tree.interpretation.geometry.internodes) {
        const double length = glm::length(internode.tip - internode.base);
        CHECK(length > 0.1);
        if (internode.order == 0) trunk.push_back(length);
    }
    REQUIRE(trunk.size() == 10);
    for (std::size_t i = 1; i < trunk.size(); ++i) CHECK(trunk[i] == Approx(0.9 * trunk[i - 1]));
}

TEST_CASE("03: a #define given from outside replaces the model's own", "[course]") {
    LonePlant tree("models/course/03-parameters.l", {{"R1", "0.5"}});
    tree.grow(2);
    CHECK(tree.interpretation.geometry.internodes[0].tip.y == Approx(1));
    CHECK(tree.text().find("F(0.5)") != std::string::npos);
}

TEST_CASE("04: flowers open from the base upwards, one node a step, and the apex flowers with the last of them",
          "[course]") {
    LonePlant plant("models/course/04-signals.l");
    std::vector<int> flowering_step;
    for (int step = 1; step <= 24; ++step) {
        const int before = plant.counts()["W"];
        plant.grow(1);
        for (int i = before; i < plant.counts()["W"]; ++i) flowering_step.push_back(step);
    }
    REQUIRE(flowering_step.size() >= 4);
    for (std::size_t i = 0; i + 1 < flowering_step.size(); ++i) {
        CHECK(flowering_step[i] == flowering_step.front() + static_cast<int>(i));
    }
    CHECK(flowering_step.back() == flowering_step[flowering_step.size() - 2]);
    CHECK(plant.counts()["A"] == 0);
    CHECK(plant.counts()["K"] == 0);
}

TEST_CASE("05: one seed gives one plant, another seed another, and growth is 3.66-fold a step on average", "[course]") {
    LonePlant first("models/course/05-stochastic.l", {}, 1), again("models/course/05-stochastic.l", {}, 1);
    first.grow(4);
    again.grow(4);
    CHECK(first.text() == again.text());

    LonePlant other("models/course/05-stochastic.l", {}, 2);
    other.grow(4);
    CHECK(first.text() != other.text());

    double segments = 0;
    const int plants = 400;
    for (int seed = 0; seed < plants; ++seed) {
        LonePlant plant("models/course/05-stochastic.l", {}, static_cast<std::uint64_t>(seed));
        plant.grow(3);
        segments += plant.counts()["F"];
    }
    CHECK(segments / plants == Approx(std::pow(3.66, 3)).epsilon(0.05));
}

TEST_CASE("06: decomposition makes metamers within the step, homomorphism draws what the string does not hold",
          "[course]") {
    LonePlant shoot("models/course/06-decomposition-homomorphism.l");
    shoot.grow(12);
    auto counts = shoot.counts();
    CHECK(counts["I"] == 12);
    CHECK(counts["L"] == 12);
    CHECK(counts["M"] == 0);
    CHECK(counts["F"] == 0);
    const PlantGeometry& geometry = shoot.interpretation.geometry;
    CHECK(geometry.internodes.size() == 12);
    CHECK(geometry.polygons.size() == 12);
    CHECK(geometry.internodes.front().tip_radius > geometry.internodes.back().tip_radius);
}

TEST_CASE("07: whatever is drawn begins inside the box, and the box is reached on every side", "[course]") {
    LonePlant hedge("models/course/07-queries.l");
    hedge.grow(9);
    const PlantGeometry& geometry = hedge.interpretation.geometry;
    REQUIRE(geometry.internodes.size() > 50);
    for (const Internode& internode : geometry.internodes) {
        CHECK(std::abs(internode.base.x) <= 1.5);
        CHECK(internode.base.y <= 3);
        CHECK(std::abs(internode.base.z) <= 1.5);
    }
    CHECK(geometry.bounds.upper.x > 1);
    CHECK(geometry.bounds.lower.x < -1);
    CHECK(geometry.bounds.upper.y > 2.5);
}
