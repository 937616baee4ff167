// The text of p-graphs: what is read is printed again, and mistakes are told where they are.
#include "espalier/language/notation.h"

#include "catch.h"
#include "language/pgraph/graphs.h"

using namespace espalier;
using namespace espalier::test;

TEST_CASE("A graph that is printed reads as the same graph", "[pgraph]") {
    const pgraph::Graph graph = graph_of(R"(/* A comment
   of two lines */
#define COUNT 4   /* how many; 1..9 whole */
Hydra star          // with a comment
  count COUNT
  angle 10..20 then x ^ 2   noise 3
Leaf blade
  outline 0, 1,0.5 , 0
Tree stem
camera -> stem -> star -> blade
stem -B-> blade
)");
    CHECK(graph.components.size() == 3);
    CHECK(graph.links.size() == 4);
    CHECK(graph.components[0].keys[1].value.parts == std::vector<std::string>{"10", "20"});
    CHECK(graph.components[0].keys[1].value.function == "x ^ 2");
    CHECK(graph.components[0].keys[1].value.noise == "3");
    CHECK(pgraph::parse(pgraph::print(graph), "printed") == graph);
}

TEST_CASE("Unknown components, keys, links and names are refused at their place, with the nearest", "[pgraph]") {
    CHECK(graph_mistakes("Hron stem\n  length 3\ncamera -> stem\n") ==
          "2:1: 'Hron' is no component; the components are Simple, Horn, Tree, Leaf, Hydra, Ring, Phiball, World (did "
          "you mean 'Horn'?)\n4:1: there is no component 'stem' to link");
    CHECK_THAT(graph_mistakes("Horn stem\n  lenght 3\ncamera -> stem\n"),
               Catch::StartsWith("3:3: Horn has no key 'lenght'; its keys are length, ") &&
                   Catch::EndsWith("(did you mean 'length'?)"));
    CHECK(graph_mistakes("Horn stem\ncamera -> stem\nstem -X-> stem\n") ==
          "4:6: '-X->' is no link; the links are -> (child), -B-> (branch) and -L-> (leaf)");
    CHECK(graph_mistakes("Horn stem\ncamera -> stme\n") ==
          "3:1: there is no component 'stme' to link (did you mean 'stem'?)");
    CHECK(graph_mistakes("Horn stem\nHorn stem\ncamera -> stem\n") ==
          "3:6: there is a component 'stem' already, in line 2");
    CHECK(graph_mistakes("Horn stem\n  length 1\n  length 2\ncamera -> stem\n") == "4:3: 'length' is set twice");
    CHECK(graph_mistakes("Horn stem\ncamera -> stem ->\n") == "3:18: expected a component behind the arrow");
}

TEST_CASE("Values are refused that are none or out of range", "[pgraph]") {
    const auto horn = [](const std::string& key) {
        return graph_mistakes("Horn stem\n  " + key + "\ncamera -> stem\n");
    };
    CHECK(horn("length -3") == "3:10: 'length' must be at least 0 m, not -3");
    CHECK(horn("bend 0 .. 200") == "3:8: 'bend' must be from -180 to 180 degrees, not 200");
    CHECK_THAT(horn("length 3 +"), Catch::StartsWith("3:10: '3 +' is no expression: "));
    CHECK_THAT(horn("length WIDTH"), Catch::StartsWith("3:10: 'WIDTH' is no expression: "));
    CHECK_THAT(horn("length 1 .. 2 .. 3"), Catch::StartsWith("3:10: 'length' is a number or a range 'a .. b'"));
    CHECK(horn("sides 2.5") == "3:9: 'sides' is a whole number in digits, not '2.5'");
    CHECK(horn("bend 1 noise 2") == "3:8: 'bend' takes no noise; write ran() into its ends instead");
    CHECK(horn("bend 1 then x * u") == "3:8: the function of 'bend' is one of x alone");
    CHECK(graph_mistakes("Simple core\n  shape spere\ncamera -> core\n") ==
          "3:9: 'shape' is none|sphere|cylinder|box, not 'spere' (did you mean 'sphere'?)");
}

TEST_CASE("A graph without its version, or of another, is refused", "[pgraph]") {
    CHECK_THROWS_WITH(pgraph::parse("Horn stem\ncamera -> stem\n", "x"),
                      Catch::Contains("a graph begins with the line 'pgraph 1'"));
    CHECK_THROWS_WITH(pgraph::parse("pgraph 2\nHorn stem\ncamera -> stem\n", "x"),
                      Catch::Contains("this program reads graphs of version 1"));
}

TEST_CASE("The notation prints every key of every component with its range and default", "[pgraph]") {
    const std::string help = registered<NotationType>().at("pgraph")->help;
    for (const char* line : {"Horn: ", "Phiball: ", "  divergence ", "-180..180", "default 137.50776405"}) {
        CHECK_THAT(help, Catch::Contains(line));
    }
}
