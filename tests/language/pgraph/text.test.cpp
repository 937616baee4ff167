// The text of p-graphs: what is read is printed again, and mistakes are told where they are.
#include "espalier/language/notation.h"

#include "catch.h"
#include "language/pgraph/graphs.h"
#include "temporary_folder.h"

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
          "2:1: 'Hron' is no component; the components are Simple, Horn, Tree, Leaf, Hydra, Ring, Phiball, World, FFD "
          "(did you mean 'Horn'?)\n4:1: there is no component 'stem' to link");
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
    CHECK(horn("sides 2") == "3:9: 'sides' is 0, or from 3 to 256 around a closed surface, not 2");
    CHECK(horn("sides 2.5") == "3:9: 'sides' is a whole number in digits, not '2.5'");
    CHECK(horn("bend 1 noise 2") == "3:8: 'bend' takes no noise; write ran() into its ends instead");
    CHECK(horn("bend 1 then x * u") == "3:8: the function of 'bend' is one of x alone");
    CHECK(graph_mistakes("Simple core\n  shape spere\ncamera -> core\n") ==
          "3:9: 'shape' is none|sphere|cylinder|box, not 'spere' (did you mean 'sphere'?)");
}

TEST_CASE("Lines that are no component, key or link are refused at their place, with what to write", "[pgraph]") {
    const std::string stem = "Horn stem\n";
    CHECK(
        graph_mistakes("Horn Stem\n") ==
        "2:6: 'Stem' is no name of a component; a name has two or more of a to z, 0 to 9 and _, begins with a letter, "
        "and is not 'camera'");
    CHECK_THAT(graph_mistakes("Horn s\n"), Catch::StartsWith("2:6: 's' is no name of a component"));
    CHECK_THAT(graph_mistakes("Horn stem;\n"), Catch::StartsWith("2:6: 'stem;' is no name of a component"));
    CHECK_THAT(graph_mistakes("Horn my stem\n"), Catch::StartsWith("2:6: 'my stem' is no name of a component"));
    CHECK(graph_mistakes("Horn\n") == "2:5: expected a name after 'Horn'");
    CHECK(graph_mistakes(stem + "length 2\n") == "3:1: 'length' is a key, which stands behind blanks");
    CHECK(graph_mistakes("  length 2\n" + stem) ==
          "2:3: a key belongs to a component, which stands above it without blanks in front");
    for (const std::string link : {"camera->stem", "camera -> ->stem", "->stem", "camera -> -B-> stem"}) {
        INFO(link);
        CHECK_THAT(graph_mistakes(stem + link + "\n"),
                   Catch::Contains(": a link is two components with an arrow and blanks between: camera -> stem"));
    }
    CHECK(graph_mistakes(stem) == "2:6: no link begins at the camera: write 'camera -> stem'");
    CHECK(graph_mistakes("") == "1:1: a graph needs a component and a link from the camera to it: camera -> stem");
    CHECK(graph_mistakes(stem + "/* never closed\ncamera -> stem\n") ==
          "3:1: this comment is never closed: '*/' is missing");
}

TEST_CASE("Lines of #define that would change what follows them are refused", "[pgraph]") {
    const std::string stem = "Horn stem\n  length AB\ncamera -> stem\n";
    CHECK(graph_mistakes("#define AB 1\n#define AB 2\n" + stem) == "3:9: 'AB' is defined already, in line 2");
    CHECK(graph_mistakes("#define AB 1 \\\n" + stem) == "2:14: a #define is one line, without a '\\' at its end");
    CHECK(graph_mistakes("#define AB 1 /* open\n" + stem) ==
          "2:14: a comment behind a #define ends on its line: '*/' is missing");
    CHECK_THAT(graph_mistakes("\n#define AB 1 /* wide; 5..9 */\n" + stem),
               Catch::StartsWith("3:") && Catch::Contains("must be a number between 5 and 9, not 1"));
    CHECK(graph_mistakes("#define ab 1\n" + stem).starts_with("2:9: the name of a #define is written in capitals"));
    CHECK(graph_mistakes("#define AB CD\n#define CD AB\n" + stem) ==
          "5:10: 'AB' is no expression: 'AB' is not a constant");
}

TEST_CASE("A list of numbers is the same for all instances", "[pgraph]") {
    CHECK(graph_mistakes("Leaf blade\n  outline i, n\ncamera -> blade\n") ==
          "3:11: the numbers of 'outline' are the same for all instances");
    CHECK(graph_mistakes("World wind\n  gravity ran(1), 0, 0\nHorn stem\ncamera -> wind -> stem\n") ==
          "3:11: 'gravity' is a function of the place x, y, z alone");
}

TEST_CASE("What is no graph at all is told by its first line alone", "[pgraph]") {
    const auto said = [](const std::string& text) {
        try {
            pgraph::parse(text, "x.pgraph");
        } catch (const UserError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK(said("") == "x.pgraph:1:1: a graph begins with the line 'pgraph 1'");
    CHECK(said("// a comment\ndefine{ a[0,1,0,0]; }\nrules{ }\n") ==
          "x.pgraph:2:1: a graph begins with the line 'pgraph 1'");
}

TEST_CASE("A World is refused that is no function of the place, an FFD whose moves do not fit its lattice",
          "[pgraph]") {
    const auto component = [](const std::string& lines) { return graph_mistakes(lines + "\ncamera -> thing\n"); };
    CHECK(component("World thing\n  gravity 0, -1") ==
          "3:11: 'gravity' is x, y, z, or gradient(FIELD) or vector(FIELD)");
    CHECK(component("World thing\n  gravity gradient(wa\x1bter)") ==
          "3:11: 'gravity' is x, y, z, or gradient(FIELD) or vector(FIELD)");
    CHECK(component("World thing\n  gravity gradient(water)\n  light vector( wind )").empty());
    CHECK(component("World thing\n  gravity slope(water)") ==
          "3:11: 'gravity' is x, y, z, or gradient(FIELD) or vector(FIELD)");
    CHECK(component("World thing\n  gravity 0, i, 0") == "3:11: 'gravity' is a function of the place x, y, z alone");
    CHECK_THAT(component("World thing\n  light 0, y +, 0"), Catch::Contains("3:9: 'y +' is no expression"));
    CHECK(component("FFD thing") == "2:5: an FFD needs 'moves': x, y, z for each of the points of its lattice");
    CHECK(component("FFD thing\n  moves 1, 2, 3") ==
          "3:9: 'moves' needs x, y, z for each of the 8 points of the lattice: 24 numbers, not 3");
    CHECK_THAT(component("FFD thing\n  lattice 1, 2, 2\n  moves 0, 0"),
               Catch::Contains("3:11: 'lattice' must be from 2 to 16, not 1"));
}

TEST_CASE("A curve is refused that does not begin at the origin, or beside a length", "[pgraph]") {
    const auto horn = [](const std::string& keys) { return graph_mistakes("Horn stem\n" + keys + "camera -> stem\n"); };
    CHECK(horn("  curve 0, 0, 0, 1, 2\n") ==
          "3:9: 'curve' is x, y, z of two points or more, the first of which is 0, 0, 0");
    CHECK(horn("  curve 0, 0, 0, 0, 1, 0\n  length 2\n") ==
          "4:10: 'length' follows from 'curve'; leave one of them out");
    CHECK(horn("  curve 0, 0, 0, 0, 0, 0\n") == "3:9: two successive points of 'curve' are the same");
}

TEST_CASE("Graphs include others, whose mistakes are told with their own files and lines", "[pgraph]") {
    const TemporaryFolder folder;
    folder.write("leaves.pgraph", "pgraph 1\nLeaf oak\n  length 0.3\n");
    folder.write("wrong.pgraph", "pgraph 1\nLeaf oak\n  lenght 0.3\n");
    const auto path = (folder.path() / "plant.pgraph").string();
    const auto translated = [&](const std::string& lines) {
        return registered<NotationType>().at("pgraph")->translate("pgraph 1\n" + lines, path).text;
    };
    const std::string stem = "Tree stem\ncamera -> stem -B-> oak\n";
    CHECK_THAT(translated("include \"leaves.pgraph\"\n" + stem), Catch::Contains("Oak"));
    try {
        translated("include \"wrong.pgraph\"\n" + stem);
        FAIL("a wrong file was included");
    } catch (const UserError& error) {
        CHECK(error.diagnostics().at(0).place.file == (folder.path() / "wrong.pgraph").string());
        CHECK(error.diagnostics().at(0).place.line == 3);
        CHECK(error.diagnostics().at(0).source == "  lenght 0.3");
    }
    CHECK_THROWS_WITH(translated("Horn top\ninclude \"plant.pgraph\"\n"),
                      Catch::Contains("3:9: 'plant.pgraph' includes itself"));
    CHECK_THROWS_WITH(translated("include leaves\n"), Catch::Contains("expected a file in quotes"));
    CHECK_THROWS_WITH(translated("include \"none.pgraph\"\n"), Catch::Contains("none.pgraph"));
}

TEST_CASE("A graph without its version, or of another, is refused", "[pgraph]") {
    CHECK_THROWS_WITH(pgraph::parse("Horn stem\ncamera -> stem\n", "x"),
                      Catch::Contains("a graph begins with the line 'pgraph 1'"));
    CHECK_THROWS_WITH(pgraph::parse("pgraph 2\nHorn stem\ncamera -> stem\n", "x"),
                      Catch::Contains("this program reads graphs of version 1"));
}

TEST_CASE("The notation prints every key of every component with its range and default", "[pgraph]") {
    const std::string help = registered<NotationType>().at("pgraph")->help;
    for (const char* line :
         {"Horn: ", "Phiball: ", "  divergence    137.50776405 degrees; ", "0 degrees, -180 to 180; "}) {
        CHECK_THAT(help, Catch::Contains(line));
    }
}
