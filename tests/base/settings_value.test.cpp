#include "espalier/base/settings.h"

#include "catch.h"

#include <thread>

using namespace espalier;
using Catch::Contains;

TEST_CASE("a program makes tables of everything that TOML has", "[base]") {
    const Settings table{{"voxel", 0.25},
                         {"count", 3},
                         {"on", true},
                         {"mode", "add"},
                         {"names", {"light", "water"}},
                         {"centre", glm::dvec3(1, 2, 3)},
                         {"rates", std::vector<double>{0.5, 1.5}},
                         {"points", {{0, 0, 0}, {0, 1, 0}}},
                         {"motion", Settings{{"growth", {0, 1}}}}};
    CHECK(table.number("voxel") == 0.25);
    CHECK(table.number("count") == 3);
    CHECK(table.integer("count") == 3);
    CHECK(table.flag_or("on", false));
    CHECK(table.text("mode") == "add");
    CHECK(table.texts_or("names", {}) == std::vector<std::string>{"light", "water"});
    CHECK(table.vector("centre") == glm::dvec3(1, 2, 3));
    CHECK(table.numbers("rates") == std::vector<double>{0.5, 1.5});
    CHECK(table.vectors("points")[1] == glm::dvec3(0, 1, 0));
    CHECK(table.table("motion").numbers("growth") == std::vector<double>{0, 1});
    CHECK_NOTHROW(table.reject_unread());
}

TEST_CASE("a value of a program that means nothing is named with what would", "[base]") {
    const Settings table = Settings{{"voxle", 0.25}, {"mode", 3}}.copy("environment.light");
    CHECK(table.number_or("voxel", 1) == 1);
    CHECK_THROWS_WITH(table.text("mode"), Contains("environment.light: 'mode' must be a text, not a whole number"));
    CHECK_THROWS_WITH(table.reject_unread(),
                      Contains("environment.light: 'voxle' means nothing here (did you mean 'voxel'?)"));
}

TEST_CASE("a copy of a table is a table of its own, of which nothing is read", "[base]") {
    Settings table{{"voxel", 0.25}, {"motion", Settings{{"growth", 1}}}};
    CHECK(table.number("voxel") == 0.25);
    const Settings copy = table.copy("copy");
    table.put("voxel", 0.5);
    table.table("motion").put("growth", 2);
    CHECK_THROWS_WITH(copy.reject_unread(), Contains("voxel"));
    CHECK(copy.number("voxel") == 0.25);
    CHECK(copy.table("motion").integer("growth") == 1);
    CHECK_NOTHROW(copy.reject_unread());
}

TEST_CASE("several threads look up one table", "[base]") {
    const Settings table{{"voxel", 0.25}};
    std::vector<std::thread> threads;
    for (int k = 0; k < 4; ++k) {
        threads.emplace_back([&] {
            for (int i = 0; i < 1000; ++i) {
                table.number("voxel");
                table.number_or("key" + std::to_string(i), 1);
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    CHECK(table.resolved_json().find("key999") != std::string::npos);
    CHECK_NOTHROW(table.reject_unread());
}
