// The origin of a scene: given, or decided by the first file that lies far away.
#include "espalier/base/map_origin.h"

#include "catch.h"

#include <thread>

using namespace espalier;

TEST_CASE("an origin that is given is subtracted from all files", "[origin]") {
    MapOrigin origin(glm::dvec3(592783, 250, -5432100));
    CHECK(origin.of({0, 0, 0}, {1, 1, 1}, {}) == glm::dvec3(592783, 250, -5432100));
    CHECK(origin.take_warnings().empty());
}

TEST_CASE("without one, the first file beyond ten kilometres decides it, with a word", "[origin]") {
    MapOrigin origin;
    CHECK(origin.of({-9000, 0, 0}, {9000, 1, 1}, {}) == glm::dvec3(0));
    CHECK_FALSE(origin.value());
    CHECK(origin.of({592783.5, 250, -5432112}, {592785.5, 280, -5432110}, {"tree.csv", 1, 1}) ==
          glm::dvec3(592800, 0, -5432100));
    CHECK(origin.of({-9000, 0, 0}, {9000, 1, 1}, {}) == glm::dvec3(0));
    CHECK(origin.of({602783, 250, -5432112}, {602785, 280, -5432110}, {}) == glm::dvec3(592800, 0, -5432100));
    const std::vector<Diagnostic> warnings = origin.take_warnings();
    REQUIRE(warnings.size() == 1);
    CHECK(to_string(warnings[0].place) == "tree.csv:1:1");
    CHECK_THAT(warnings[0].message, Catch::Contains("[592800, 0, -5432100] m is taken as the origin"));
    CHECK(origin.take_warnings().empty());
}

TEST_CASE("decimals of a map come out as they were written", "[origin]") {
    CHECK(MapOrigin::shifted({592783.1234567, 1.5, -5432100.3}, {592783, 0, -5432100}) ==
          glm::dvec3(0.1234567, 1.5, -0.3));
    CHECK(MapOrigin::shifted({1.0 / 3, 0, 0}, {0, 0, 0}).x == 1.0 / 3);
}

TEST_CASE("an origin is current while its scope lasts, in its thread", "[origin]") {
    MapOrigin one, other;
    CHECK(MapOrigin::current() == nullptr);
    {
        const MapOrigin::Scope scope(&one);
        CHECK(MapOrigin::current() == &one);
        {
            const MapOrigin::Scope inner(&other);
            CHECK(MapOrigin::current() == &other);
        }
        CHECK(MapOrigin::current() == &one);
        MapOrigin* elsewhere = &one;
        std::thread([&] { elsewhere = MapOrigin::current(); }).join();
        CHECK(elsewhere == nullptr);
    }
    CHECK(MapOrigin::current() == nullptr);
}
