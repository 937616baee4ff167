// scan: what it writes, and what it says of wrong words.
#include "catch.h"
#include "program.h"

#include <nlohmann/json.hpp>

using Catch::Contains;
using nlohmann::json;

TEST_CASE("scan writes points of a run, and refuses what no instrument is", "[app]") {
    const Workplace place;
    place.write("leaf.l",
                "lsystem: 1\nderivation length: 1\naxiom: !(0.2)F(1)[@M(0,1,0)&(90){.f(1).+(90)f(1).+(90)f(1).}]\n"
                "endlsystem\n");
    REQUIRE(place.run("run leaf.l --output run").code == 0);
    const Outcome outcome = place.run("scan run --fly=-2,10,0:2,10,0 --pulses 100 --density 0.5 --projection 1 --json");
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const json told = json::parse(outcome.out);
    CHECK(told["leaf_area"]["true"] == Approx(1).epsilon(0.01));
    CHECK(told["points"] == told["beams"]);  // each meets the plant or the ground
    CHECK(text_of(place.path() / "run/scan.ply").starts_with("ply\n"));
    CHECK_THAT(text_of(place.path() / "run/scan-density.csv"), Contains("x,y,z,beams,contacts,path,estimated,true\n"));
    for (const auto& [words, reason] : std::vector<std::pair<const char*, const char*>>{
             {"scan run", "needs one instrument"},
             {"scan run --at 1,2,3 --eye 1,2,3", "needs one instrument"},
             {"scan run --at 1,2", "expected 3 numbers"},
             {"scan run --at 1,2,3 --columns colour", "no such column"},
             {"scan run --at 1,2,3 --output scan.las", "expected the name of a .csv"},
             {"scan run --at 1,2,3 --elevations 30", "expected LOW:HIGH"},
             {"scan run --fly=0,-1,0:1,-1,0", "above height 0"},
             {"scan run --eye 0,1,0 --target 0,1,0", "one place"},
             {"scan run --at 1,2,3 --angle 0.001", "larger angle"},
             {"scan run --at 1,2,3 --step all", "one frame"},
             {"scan none --at 1,2,3", "none"}}) {
        const Outcome wrong = place.run(words);
        INFO(words);
        CHECK(wrong.code == 1);
        CHECK_THAT(wrong.err, Contains(reason));
    }
}
