// Whole models, from text to geometry.
#include "espalier/language/reader.h"
#include "espalier/turtle/interpretation.h"

#include "base/parallel.h"
#include "catch.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

using namespace espalier;
using namespace espalier::turtle;

namespace {

DerivationSettings settings_with_lineage() {
    DerivationSettings settings;
    settings.lineage = true;
    return settings;
}

/// A plant of a model given as text, one step at a time.
struct Growing {
    std::shared_ptr<const Model> model;
    Derivation derivation;
    ModuleString string, next;
    TurtleSettings settings;
    Interpretation result;

    explicit Growing(const std::string& text)
        : model(read_model_text(text, "test.l")), derivation(compile(model), settings_with_lineage()) {
        derivation.start(string);
    }
    void step() {
        derivation.step(string, next);
        std::swap(string, next);
    }
    const Interpretation& draw() {
        interpret(*model, *symbol_table(*model), string, settings, &derivation, {}, result);
        return result;
    }
};

double area(const PlantGeometry& geometry) {
    double sum = 0;
    for (const Polygon& polygon : geometry.polygons) {
        glm::dvec3 normal(0);
        for (std::uint32_t i = 1; i + 1 < polygon.count; ++i) {
            const glm::dvec3* v = &geometry.vertices[polygon.first];
            normal += glm::cross(v[i] - v[0], v[i + 1] - v[0]);
        }
        sum += glm::length(normal) / 2;
    }
    return sum;
}

}  // namespace

TEST_CASE("the Koch model of 5 steps has 1024 segments", "[turtle]") {
    Growing koch("lsystem: 1\naxiom: -(90)F\nF --> F+F--F+F\nendlsystem\n");
    koch.settings.angle = std::numbers::pi / 3;
    for (int i = 0; i < 5; ++i) koch.step();
    const PlantGeometry& geometry = koch.draw().geometry;
    CHECK(geometry.internodes.size() == 1024);
    CHECK(geometry.internodes.back().tip.x == Approx(243));
}

TEST_CASE("the framework leaf has 2n growing polygons after n steps", "[turtle]") {
    // ABOP 5.2, the simple leaf: marked points on two edges tied to the midrib.
    Growing leaf(
        "lsystem: 1\n"
        "axiom: [A][B]\n"
        "A --> [+A{.].C.}\n"
        "B --> [-B{.].C.}\n"
        "C --> GC\n"
        "endlsystem\n");
    leaf.settings.angle = std::numbers::pi / 6;
    const auto letters = [&](char symbol) {
        int count = 0;
        for (const LetterId letter : leaf.string.letters) count += leaf.model->alphabet.name(letter)[0] == symbol;
        return count;
    };
    const std::size_t sizes[] = {6, 24, 44, 66, 90, 116};
    double last_area = 0;
    for (int n = 0; n <= 5; ++n) {
        const PlantGeometry& geometry = leaf.draw().geometry;
        CHECK(leaf.string.size() == sizes[n]);
        CHECK(letters('G') == n * (n - 1));
        CHECK(geometry.polygons.size() == std::size_t(n > 0 ? 2 * n : 0));
        if (n > 2) CHECK(area(geometry) > last_area);
        last_area = area(geometry);
        leaf.step();
    }
}

TEST_CASE("a picture is drawn in place of its module and belongs to it", "[turtle]") {
    Growing plant(
        "lsystem: 1\n"
        "axiom: FA(2)F\n"
        "A(x) --> A(x)\n"
        "homomorphism\n"
        "A(x) --> [+(90)!(0.5)F(x)@O(x)]{.f.f.}\n"
        "endlsystem\n");
    const PlantGeometry& geometry = plant.draw().geometry;
    REQUIRE(geometry.internodes.size() == 3);
    CHECK(geometry.internodes[1].module == 1);
    CHECK(geometry.internodes[1].tip_radius == 0.25);
    CHECK(geometry.internodes[1].tip.x == Approx(-2));
    CHECK(geometry.internodes[2].module == 2);
    REQUIRE(geometry.organs.size() == 1);
    CHECK(geometry.organs[0].module == 1);
    CHECK(geometry.polygons.at(0).module == 1);
}

TEST_CASE("pictures of pictures are drawn to the maximum depth", "[turtle]") {
    Growing plant(
        "lsystem: 1\n"
        "axiom: A\n"
        "A --> A\n"
        "homomorphism\n"
        "maximum depth: 3\n"
        "A --> F[+A]F\n"
        "endlsystem\n");
    const PlantGeometry& geometry = plant.draw().geometry;
    CHECK(geometry.internodes.size() == 6);
    for (const Internode& internode : geometry.internodes) CHECK(internode.module == 0);
}

TEST_CASE("what a cut will take is drawn by the L-system it stands in until then", "[turtle]") {
    Growing plant(
        "lsystem: 1\n"
        "axiom: ?(2,0.5)%Y$Y?P(0,0)%?(2)Y$\n"
        "\n"
        "homomorphism\n"
        "Y --> f(100)\n"
        "endlsystem\n"
        "lsystem: 2\n"
        "axiom: Y\n"
        "\n"
        "homomorphism\n"
        "Y --> FF\n"
        "endlsystem\n");
    const Interpretation& drawn = plant.draw();
    CHECK(drawn.answers.at(0).position.y == 101);
    REQUIRE(drawn.geometry.internodes.size() == 4);
    CHECK(drawn.geometry.internodes[1].tip.y == 1);
    CHECK(drawn.geometry.internodes[3].tip.y == 103);
}

TEST_CASE("queries in pictures are not sent, those of the string are", "[turtle]") {
    Growing plant(
        "lsystem: 1\n"
        "axiom: A?P(0,0)F?E(1)\n"
        "A --> A\n"
        "homomorphism\n"
        "A --> F?P(0,0)?E(1)\n"
        "endlsystem\n");
    const Interpretation& drawn = plant.draw();
    REQUIRE(drawn.answers.size() == 1);
    CHECK(drawn.answers[0].position.y == 1);
    CHECK(drawn.answers[0].module == 2);
    REQUIRE(drawn.queries.size() == 1);
    CHECK(drawn.queries[0].identity == plant.string.identity(5));
}

TEST_CASE("declared processes are asked by name from a model file", "[turtle]") {
    Growing plant(
        "lsystem: 1\n"
        "environment light, water;\n"
        "axiom: A?water(1,2)F?light(3)\n"
        "A --> A\n"
        "endlsystem\n");
    const QueryColumn& queries = plant.draw().queries;
    REQUIRE(queries.size() == 2);
    CHECK(plant.model->processes.at(queries[0].process) == "water");
    CHECK(plant.model->processes.at(queries[1].process) == "light");
    CHECK(queries[1].parameters[0] == 3);
    CHECK(queries[0].module == 1);
}

TEST_CASE("plants of one model are interpreted in parallel with the same result", "[turtle]") {
    Growing plant(
        "lsystem: 1\n"
        "axiom: A(1)\n"
        "A(x) --> F(x)[+(30)A(x*0.7)][&(40)A(x*0.8)]/(137.5)L(x)A(x*0.9)\n"
        "homomorphism\n"
        "L(x) --> [-(50)F(x)@O(x)]{.f.+f.}?E(x)\n"
        "endlsystem\n");
    for (int i = 0; i < 7; ++i) plant.step();
    const PlantGeometry expected = plant.draw().geometry;
    const auto symbols = symbol_table(*plant.model);
    std::vector<Interpretation> results(16);
    for_in_parallel(std::size_t(0), results.size(), [&](std::size_t i) {
        interpret(*plant.model, *symbols, plant.string, {}, &plant.derivation, {}, results[i]);
    });
    for (const Interpretation& result : results) {
        REQUIRE(result.geometry.internodes.size() == expected.internodes.size());
        CHECK(result.geometry.bounds.lower == expected.bounds.lower);
        CHECK(result.geometry.bounds.upper == expected.bounds.upper);
        bool equal = true;
        for (std::size_t i = 0; i < expected.internodes.size(); ++i) {
            equal = equal && result.geometry.internodes[i].tip == expected.internodes[i].tip;
        }
        CHECK(equal);
    }
}
