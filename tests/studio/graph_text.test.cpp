// The form of a component: every key of the schema is shown, and an edit changes its line of the text and no other.
#include "studio/document/graph_text.h"

#include "espalier/base/error.h"

#include "catch.h"
#include "language/pgraph/schema.h"
#include "studio/protocol/json.h"

#include <nlohmann/json.hpp>

using namespace espalier;
using Json = nlohmann::ordered_json;

namespace {

const std::string flower = R"(pgraph 1

Horn stem              // a bent cone
  length 2             // a key
  bend 3 .. -3

Hydra corolla
  count 5

Leaf petal

camera -> stem -> corolla -> petal
)";

std::string changed(const std::string& text, const Json& request) {
    return studio::edited_graph("flower.pgraph", text, studio::from_json<studio::GraphEdit>(request));
}

}  // namespace

TEST_CASE("the form of a component shows every key of its type with unit, range and default", "[studio]") {
    const Json types = studio::json_of(studio::component_forms());
    REQUIRE(types.size() == language::pgraph::component_types().size());
    for (std::size_t i = 0; i < types.size(); ++i) {
        const auto& type = language::pgraph::component_types()[i];
        CHECK(types[i]["name"] == type.name);
        REQUIRE(types[i]["keys"].size() == type.keys.size());
        for (std::size_t k = 0; k < type.keys.size(); ++k) {
            CHECK(types[i]["keys"][k]["unit"] == type.keys[k].unit);
            CHECK(types[i]["keys"][k]["standard"] == type.keys[k].standard);
        }
    }
}

TEST_CASE("a graph is shown as its components with what they say, and its links", "[studio]") {
    const Json graph = studio::json_of(studio::read_graph("flower.pgraph", flower).value());
    REQUIRE(graph["components"].size() == 3);
    CHECK(graph["components"][0]["type"] == "Horn");
    CHECK(graph["components"][0]["line"] == 3);
    CHECK(graph["components"][0]["values"] == Json({{"bend", "3 .. -3"}, {"length", "2"}}));
    CHECK(graph["links"].size() == 3);
    CHECK(graph["links"][2] == Json({{"from", "corolla"}, {"to", "petal"}, {"kind", "child"}}));
    CHECK_FALSE(studio::read_graph("flower.pgraph", "pgraph 1\nHorn\n"));
}

TEST_CASE("a value is changed, added and taken out on its own line, comments stay", "[studio]") {
    std::string text =
        changed(flower, Json({{"edit", "set"}, {"component", "stem"}, {"key", "length"}, {"text", "2.5"}}));
    CHECK(text.find("  length 2.5             // a key\n") != std::string::npos);
    CHECK(changed(text, Json({{"edit", "set"}, {"component", "stem"}, {"key", "length"}, {"text", "2"}})) == flower);

    text = changed(flower, Json({{"edit", "set"}, {"component", "petal"}, {"key", "length"}, {"text", "0.5 .. 0.9"}}));
    CHECK(text.find("Leaf petal\n  length 0.5 .. 0.9\n") != std::string::npos);
    CHECK(changed(text, Json({{"edit", "set"}, {"component", "petal"}, {"key", "length"}, {"text", nullptr}})) ==
          flower);

    for (const char* wrong : {"1 ..", "", "1\n  bend 2"}) {
        INFO(wrong);
        CHECK_THROWS_AS(
            changed(flower, Json({{"edit", "set"}, {"component", "corolla"}, {"key", "count"}, {"text", wrong}})),
            UserError);
    }
    CHECK_THROWS_AS(changed(flower, Json({{"edit", "set"}, {"component", "stem"}, {"key", "colr"}, {"text", "1"}})),
                    UserError);
    CHECK_THROWS_AS(changed(flower, Json({{"edit", "set"}, {"component", "root"}, {"key", "length"}, {"text", "1"}})),
                    UserError);
}

TEST_CASE("components and links are added and taken away, also out of the middle of a chain", "[studio]") {
    std::string text =
        changed(flower, Json({{"edit", "add"}, {"type", "Leaf"}, {"name", "sepal"}, {"from", "corolla"}}));
    CHECK(studio::read_graph("f", text)->components.size() == 4);
    text = changed(text, Json({{"edit", "unlink"}, {"from", "stem"}, {"to", "corolla"}, {"kind", "child"}}));
    CHECK(text.find("camera -> stem\ncorolla -> petal\n") != std::string::npos);
    text = changed(text, Json({{"edit", "link"}, {"from", "stem"}, {"to", "corolla"}, {"kind", "child"}}));
    CHECK(studio::read_graph("f", text)->links.size() == 4);
    text = changed(text, Json({{"edit", "remove"}, {"component", "petal"}}));
    CHECK(text.find("petal") == std::string::npos);
    CHECK(studio::read_graph("f", text)->links.size() == 3);
    CHECK_THROWS_AS(changed(flower, Json({{"edit", "link"}, {"from", "stem"}, {"to", "camera"}, {"kind", "child"}})),
                    UserError);
    CHECK_THROWS_AS(changed(flower, Json({{"edit", "link"}, {"from", "stem"}, {"to", "petal"}, {"kind", "branch"}})),
                    UserError);
}
