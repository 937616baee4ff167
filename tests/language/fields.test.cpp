// Fields: vectors by expressions of a place.
#include "catch.h"
#include "language/parser/vector_field.h"
#include "language/reading.h"

using namespace espalier;
using namespace espalier::test;

TEST_CASE("a field has a vector for every place", "[language]") {
    const VectorField field = VectorField::parse("-z / 2, sqrt(x ^ 2 + z ^ 2), y > 1 ? 3 : x");
    CHECK(*field.at({3, 0, 4}) == glm::dvec3(-2, 5, 3));
    CHECK(*field.at({1, 2, 0}) == glm::dvec3(0, 1, 3));
    CHECK_FALSE(VectorField::parse("1 / x, 0, 0").at({0, 1, 2}));
}

TEST_CASE("a model declares fields, whose names stand for them", "[language]") {
    const auto model =
        read("#define PULL 2\nfield swirl = -z * PULL, 0, x;\n" + lsystem_of("", "@Tv(swirl, 0.1) F", ""));
    REQUIRE(model->texts.size() == 1);
    CHECK(*VectorField::parse(model->texts[0]).at({3, 0, 4}) == glm::dvec3(-8, 0, 3));
}

TEST_CASE("a field may read the fields of processes", "[language]") {
    const VectorField slope = VectorField::parse("gradient(pot.distance)"), flow = VectorField::parse("vector (wind )");
    CHECK(slope.kind() == VectorField::Kind::gradient);
    CHECK(slope.fields() == std::vector<std::string>{"pot.distance"});
    CHECK(flow.kind() == VectorField::Kind::components);
    CHECK(flow.fields() == std::vector<std::string>{"wind.x", "wind.y", "wind.z"});
    const auto model = read("field sun = gradient( light );\n" + lsystem_of("", "@Tv(sun, 0.1) F", ""));
    REQUIRE(model->texts.size() == 1);
    CHECK(VectorField::parse(model->texts[0]).fields() == std::vector<std::string>{"light"});
}

TEST_CASE("a field that is none is refused at its place", "[language]") {
    const auto field = [](const std::string& text) { return messages(text + "\n" + lsystem_of("", "F", "")); };
    CHECK_THAT(field("field swirl = -z, 0;"), Catch::Contains("1:20: expected ','"));
    CHECK_THAT(field("field sun = gradient();"), Catch::Contains("1:"));
    CHECK_THAT(field("field sun = gradient(a;b);"), Catch::Contains("1:"));
    CHECK_THAT(field("field sun = gradient(light), 0;"), Catch::Contains("1:28: "));
    CHECK_THAT(field("field swirl = -w, 0, x;"), Catch::Contains("'w' is not a constant"));
    CHECK_THAT(field("field swirl = ran(1), 0, x;"),
               Catch::Contains("1:7: the field 'swirl': its components must be functions of x, y and z alone"));
    CHECK_THAT(field("field swirl = 1, 0, x;\nfield swirl = 1, 0, x;"), Catch::Contains("defined a second time"));
}
