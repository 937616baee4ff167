// Vector fields that read what processes published.
#include "catch.h"
#include "geometry/field_grids.h"
#include "turtle/drawing.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

using namespace espalier;
using namespace espalier::test;

namespace {

/// The turtle after a text whose field 0 is read from the fields.
Pose after(const std::string& text, const std::string& field, const Fields& fields) {
    Drawing drawing(text);
    drawing.model.texts = {field};
    FieldValues values;
    values.take(fields, fields_read_by(drawing.model));
    drawing.options.fields = &values;
    return drawing.pose();
}

}  // namespace

TEST_CASE("@Tv along a field that is the same everywhere turns as @Th does", "[turtle]") {
    Fields fields;
    fields.provide(field_of("light", 1, 8, [](const glm::dvec3& p) { return 0.5 * p.x + 2 * p.y - p.z; }));
    const Pose expected = Drawing("+(50)f(1)@Th(0.5,2,-1,0.3)").pose();
    const double length = glm::length(glm::dvec3(0.5, 2, -1));
    const Pose turned = after(fmt::format("+(50)f(1)@Tv(0,{})", 0.3 / length), "gradient(light)", fields);
    CHECK(glm::length(turned.heading - expected.heading) < 1e-8);  // fields are floats
}

TEST_CASE("@Tv along a field that rotates curls an axis around the centre, to the side to which it rotates",
          "[turtle]") {
    Fields fields;
    fields.provide(field_of("wind.x", 1, 8, [](const glm::dvec3& p) { return p.z; }));
    fields.provide(field_of("wind.y", 1, 8, [](const glm::dvec3&) { return 0; }));
    fields.provide(field_of("wind.z", 1, 8, [](const glm::dvec3& p) { return -p.x; }));
    std::string axis = "-(90)f(2)";  // at (2, 0, 0), where the field points along -z
    for (int k = 0; k < 400; ++k) axis += "@Tv(0,0.1)f(0.01)";
    const Pose pose = after(axis, "vector( wind )", fields);
    CHECK(pose.position.z < -1);
    CHECK(pose.position.y == Approx(0).margin(1e-9));
    CHECK(glm::dot(glm::cross(pose.position, pose.heading), glm::dvec3(0, 1, 0)) > 0);
    const Pose by_expressions = after(axis, "z, 0, -x", fields);
    CHECK(glm::length(pose.position - by_expressions.position) < 1e-6);
}

TEST_CASE("where nothing was published, @Tv does not turn", "[turtle]") {
    CHECK(after("@Tv(0,1)", "gradient(light)", {}).heading == glm::dvec3(0, 1, 0));
    Drawing drawing("@Tv(0,1)");
    drawing.model.texts = {"vector(wind)"};
    CHECK(drawing.pose().heading == glm::dvec3(0, 1, 0));
}

TEST_CASE("a model's fields name the fields of processes that they read", "[turtle]") {
    Model model;
    model.texts = {"z, 0, -x", "a label", "gradient(light)", "vector(wind)", "gradient(light)"};
    CHECK(fields_read_by(model) == std::vector<std::string>{"light", "wind.x", "wind.y", "wind.z"});
}
