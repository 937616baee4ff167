// What turtles read of fields: values between voxels, and slopes.
#include "espalier/geometry/field_values.h"

#include "espalier/base/error.h"

#include "catch.h"
#include "geometry/field_grids.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <sstream>

using namespace espalier;
using namespace espalier::test;

TEST_CASE("a field that is linear is read exactly, and so is its slope", "[geometry]") {
    Fields fields;
    // Sums of powers of two, which floats hold.
    fields.provide(field_of("light", 0.5, 8, [](const glm::dvec3& p) { return 1 + 2 * p.x - 0.5 * p.y + 4 * p.z; }));
    FieldValues values;
    values.take(fields, {"light", "water"});
    for (const glm::dvec3& place : {glm::dvec3(0), glm::dvec3(0.25, -1.125, 2), glm::dvec3(-1.75, 1.5, -0.375)}) {
        CHECK(values.value("light", place) == 1 + 2 * place.x - 0.5 * place.y + 4 * place.z);
        CHECK(values.gradient("light", place) == glm::dvec3(2, -0.5, 4));
    }
    CHECK(values.value("water", {0, 1, 0}) == 0);
    CHECK(values.gradient("water", {0, 1, 0}) == glm::dvec3(0));
    values.forget();
    CHECK(values.value("light", {1, 1, 1}) == 0);
}

TEST_CASE("the slope of a smooth field is met the better, the smaller its voxels are", "[geometry]") {
    const auto error = [](double voxel) {
        Fields fields;
        fields.provide(
            field_of("hill", voxel, int(2 / voxel), [](const glm::dvec3& p) { return std::sin(p.x) * p.y; }));
        FieldValues values;
        values.take(fields, {"hill"});
        const glm::dvec3 place(0.5, 1, 0);
        const glm::dvec3 slope(std::cos(place.x) * place.y, std::sin(place.x), 0);
        return glm::length(values.gradient("hill", place) - slope);
    };
    CHECK(error(0.25) < 0.02);
    CHECK(error(0.25) / error(0.125) == Approx(4).margin(0.3));
}

TEST_CASE("saved values of fields are restored to the last bit", "[geometry]") {
    Fields fields;
    fields.provide(field_of("hill", 0.25, 9, [](const glm::dvec3& p) { return std::sin(3 * p.x) * p.y + p.z; }));
    fields.provide(field_of("plain", 1, 1, [](const glm::dvec3&) { return 0.1; }));
    FieldValues values, restored;
    values.take(fields, {"hill", "plain"});
    std::ostringstream out;
    values.save(out);
    std::istringstream in(out.str());
    restored.restore(in);
    for (double x = -3; x < 3; x += 0.17) {
        const glm::dvec3 place(x, 0.3 * x, 0.1 - x);
        for (const char* name : {"hill", "plain"}) {
            CHECK(restored.value(name, place) == values.value(name, place));
            CHECK(restored.gradient(name, place) == values.gradient(name, place));
        }
    }
    std::istringstream cut(out.str().substr(0, out.str().size() / 2));
    CHECK_THROWS_AS(restored.restore(cut), RunError);
}
