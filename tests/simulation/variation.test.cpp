#include "simulation/scene/variation.h"

#include "espalier/base/error.h"

#include "catch.h"

using namespace espalier;
using Values = std::vector<std::string>;

TEST_CASE("values are spread evenly, counted one by one, or listed", "[simulation]") {
    CHECK(parse_variation("a.b=0.1:0.9:9").values ==
          Values{"0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "0.7", "0.8", "0.9"});
    CHECK(parse_variation("a.b=1:2:1").values == Values{"1"});
    CHECK(parse_variation("simulation.seed=-1..2").values == Values{"-1", "0", "1", "2"});
    CHECK(parse_variation("light.mode=add,attenuate").values == Values{"add", "attenuate"});
    CHECK(parse_variation("light.voxel=0.5").values == Values{"0.5"});
    CHECK(parse_variation("a.b=c").key == "a.b");
}

TEST_CASE("what is no variation is refused in words", "[simulation]") {
    for (const char* text : {"", "a", "=1", "a=", "a=1,,2", "a=1:2:x", "a=1:2:0", "a=1:2:2.5", "a=3..1", "a=1.5..3",
                             "a=1..9999999", "a=1:2:9999999", "a=nan:1:2"}) {
        CHECK_THROWS_AS(parse_variation(text), UserError);
    }
    CHECK_THROWS_AS(combine({{"a", {"1"}}, {"a", {"2"}}}), UserError);
    CHECK_THROWS_AS(combine({{"a", Values(2000, "1")}, {"b", Values(2000, "1")}}), UserError);
}

TEST_CASE("a sweep is every combination, the last key fastest, each with a name of its own", "[simulation]") {
    const auto variants = combine({{"light.voxel", {"1", "2"}}, {"simulation.seed", {"7", "8"}}});
    REQUIRE(variants.size() == 4);
    CHECK(variants[0].name == "voxel=1,seed=7");
    CHECK(variants[1].name == "voxel=1,seed=8");
    CHECK(variants[2].name == "voxel=2,seed=7");
    CHECK(variants[3].values.front() == std::pair<std::string, std::string>("light.voxel", "2"));
    CHECK(combine({{"left.voxel", {"1"}}, {"right.voxel", {"a/b"}}})[0].name == "left.voxel=1,right.voxel=a%2Fb");
    CHECK(combine({}).size() == 1);
}
