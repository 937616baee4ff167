#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "catch.h"
#include "timeline/frames.h"

using namespace espalier;
using Catch::Contains;

namespace {

std::string statistics(const std::string& toml) {
    const RunFolder folder;
    Timeline timeline(folder.path, timeline_table("skeleton = false\n" + toml), 1);
    HandmadePlant plant;
    plant.add("F", {2, 0.5}, 1, 0, 0);
    plant.add("A", {}, 2, 1, 0);
    plant.add("F", {3, 0.25}, 3, 1, 0);
    plant.add("?", {}, 4, 1, 0);
    plant.add("E", {7}, 5, 1, 0);
    const HandmadePlant empty;
    record(timeline, 0, {&plant, &empty});
    timeline.finish();
    return read_text(folder.path / "statistics.csv");
}

std::string message(const std::string& toml) {
    try {
        return statistics(toml);
    } catch (const UserError& error) {
        return error.what();
    }
}

}  // namespace

TEST_CASE("quantities of a model's modules are columns behind all others", "[timeline]") {
    const std::string csv = statistics(
        "quantities = { mass = \"sum(F.1)\", vigour = \"mean(F.2)\", low = \"min(F.1)\", "
        "high = \"max(F.1)\", number = \"count(F.2)\", light = \"sum(?E.1)\" }\n");
    CHECK_THAT(csv, Contains(",born,died,mass,vigour,low,high,number,light\n"));
    CHECK_THAT(csv, Contains(",5,0.375,2,3,2,7\n"));
    CHECK_THAT(csv, Catch::EndsWith(",0,,,,0,0\n"));
}

TEST_CASE("a quantity that no model has is an error at its place", "[timeline]") {
    CHECK_THAT(message("quantities = { a = \"sum(F.3)\" }\n"), Contains("scene.toml:2") && Contains("number 3"));
    CHECK_THAT(message("quantities = { a = \"sum(G.1)\" }\n"), Contains("no model of this scene has a module 'G'"));
    CHECK_THAT(message("quantities = { a = \"sun(F.1)\" }\n"), Contains("did you mean 'sum'?"));
    CHECK_THAT(message("quantities = { a = \"F.1\" }\n"), Contains("as in \"sum(F.2)\""));
    CHECK_THAT(message("quantities = { a = \"sum(F)\" }\n"), Contains("a dot and the number of a parameter"));
    CHECK_THAT(message("quantities = { mass = 3 }\n"), Contains("scene.toml:2"));
}
