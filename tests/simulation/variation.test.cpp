#include "simulation/scene/variation.h"

#include "espalier/base/error.h"

#include "catch.h"

using namespace espalier;
using Values = std::vector<std::string>;

namespace {

/// Returns the values of the only key.
Values values_of(const std::string& text) {
    Values values;
    for (const Values& value : parse_variation(text).values) values.push_back(value.at(0));
    return values;
}

}  // namespace

TEST_CASE("values are spread evenly, counted one by one, or listed", "[simulation]") {
    CHECK(values_of("a.b=0.1:0.9:9") == Values{"0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "0.7", "0.8", "0.9"});
    CHECK(values_of("a.b=1:2:1") == Values{"1"});
    CHECK(values_of("simulation.seed=-1..2") == Values{"-1", "0", "1", "2"});
    CHECK(values_of("light.mode=add,attenuate") == Values{"add", "attenuate"});
    CHECK(values_of("light.voxel=0.5") == Values{"0.5"});
    CHECK(parse_variation("a.b=c").keys == Values{"a.b"});
}

TEST_CASE("what is no variation is refused in words", "[simulation]") {
    for (const char* text :
         {"", "a", "=1", "a=", "a=1,,2", "a=1:2:x", "a=1:2:0", "a=1:2:2.5", "a=3..1", "a=1.5..3", "a=1..9999999",
          "a=1:2:9999999", "a=nan:1:2", "a,b=1", "a,b=1:2,3", "a,b=1:2:3", "a,=1:2", "a,b=1:", "a,b=1:2,1:2"}) {
        CHECK_THROWS_AS(parse_variation(text), UserError);
    }
    CHECK_THROWS_AS(combine({{{"a"}, {{"1"}}}, {{"b", "a"}, {{"2", "3"}}}}), UserError);
    CHECK_THROWS_AS(combine({{{"a"}, std::vector<Values>(2000, {"1"})}, {{"b"}, std::vector<Values>(2000, {"1"})}}),
                    UserError);
}

TEST_CASE("a sweep is every combination, the last key fastest, each with a name of its own", "[simulation]") {
    const auto variants = combine({{{"light.voxel"}, {{"1"}, {"2"}}}, {{"simulation.seed"}, {{"7"}, {"8"}}}});
    REQUIRE(variants.size() == 4);
    CHECK(variants[0].name == "voxel=1,seed=7");
    CHECK(variants[1].name == "voxel=1,seed=8");
    CHECK(variants[2].name == "voxel=2,seed=7");
    CHECK(variants[3].values.front() == std::pair<std::string, std::string>("light.voxel", "2"));
    CHECK(combine({{{"left.voxel"}, {{"1"}}}, {{"right.voxel"}, {{"a/b"}}}})[0].name ==
          "left.voxel=1,right.voxel=a%2Fb");
    CHECK(combine({}).size() == 1);
}

TEST_CASE("keys that vary together have as many runs as values, not their product", "[simulation]") {
    const auto variants =
        combine({parse_variation("plant.*.define.A,b.c=3:4,5:6"), parse_variation("simulation.seed=1..2")});
    REQUIRE(variants.size() == 4);
    CHECK(variants[1].name == "A=3,c=4,seed=2");
    CHECK(variants[2].name == "A=5,c=6,seed=1");
    CHECK(variants[2].values == std::vector<std::pair<std::string, std::string>>{
                                    {"plant.*.define.A", "5"}, {"b.c", "6"}, {"simulation.seed", "1"}});
}
