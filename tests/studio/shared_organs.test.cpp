// What a shared page tells of organs.
#include "studio/server/shared_organs.h"

#include "session_fixture.h"

using namespace studio_test;
using namespace espalier;
using namespace espalier::studio;

namespace {

const char* const shoot =
    "lsystem: 1\nderivation length: 3\naxiom: A(1)\nA(x) --> F(x)A(x/3)\nF(x) --> F(x*2)\nendlsystem\n";

}  // namespace

TEST_CASE("a shared page names every organ once, and tells the parameters of each step", "[studio][share]") {
    TemporaryFolder folder;
    folder.write("plant.l", shoot);
    folder.write("scene.toml", "[[plant]]\nmodel = \"plant.l\"\n[timeline]\nparameters = { length = \"F.1\" }\n");
    record(folder.path() / "scene.toml", 3, folder.path() / "run");
    const RecordedRun run(folder.path() / "run");
    SharedOrgans organs(run);
    std::vector<nlohmann::ordered_json> moments;
    for (const RecordedFrame& frame : run.frames()) moments.push_back(organs.add(DrawnFrame(run, frame)));
    const auto table = organs.table();

    REQUIRE(moments.size() == 4);
    CHECK(moments[0]["organ"].empty());
    // From the base up: an internode keeps its number, and those that follow count on.
    CHECK(moments[3]["organ"] == Json({0, 1, 1}));
    CHECK(moments[2]["parameters"]["length"] == Json({2, 0.333333}));
    CHECK(moments[3]["parameters"]["length"] == Json({4, 0.666667, 0.111111}));
    CHECK(table["symbols"] == Json({"F"}));
    CHECK(table["symbol"] == Json({0, 0, 0}));
    CHECK(table["born"] == Json({1, 2, 3}));
    CHECK(table["order"] == Json({0, 0, 0}));
    CHECK(table["plants"]["0"] == "plant");
    REQUIRE(table["identity"].size() == 3);
    CHECK(table["identity"][0].get<std::string>().size() == 16);
    CHECK(table["identity"][0] != table["identity"][1]);
    CHECK(table["parent"] == Json({-1, -1, -1}));  // apices are not drawn
}
