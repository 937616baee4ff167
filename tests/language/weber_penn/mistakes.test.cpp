// Mistakes in species files: each at its place, with what to write instead.
#include "espalier/base/error.h"
#include "espalier/language/notation.h"

#include "catch.h"

using namespace espalier;

namespace {

std::string mistakes_of_species(const std::string& text) {
    try {
        registered<NotationType>().at("species")->translate(text, "tree.species");
    } catch (const UserError& error) {
        std::string all;
        for (const Diagnostic& each : error.diagnostics()) all += to_string(each.place) + ": " + each.message + "\n";
        return all;
    }
    return "";
}

}  // namespace

TEST_CASE("Unknown parameters of a species are refused at their place, with the nearest", "[species]") {
    CHECK(mistakes_of_species("// a tree\nScale = 3\n1Lenght, 1LengthV = 0.3, 0\n") ==
          "tree.species:3:1: there is no parameter '1Lenght' (did you mean '1Length'?); 'espalier list notations "
          "species' has them all\n");
    CHECK_THAT(mistakes_of_species("0DownAngle = 3\n"), Catch::StartsWith("tree.species:1:1: there is no parameter"));
}

TEST_CASE("Values of a species are numbers of their ranges, as many as names, each set once", "[species]") {
    CHECK(mistakes_of_species("Scale = -3\n") == "tree.species:1:9: 'Scale' must be at least 0.001 m, not -3\n");
    CHECK(mistakes_of_species("Shape, BaseSize = 9, 0.2\n") ==
          "tree.species:1:19: 'Shape' must be from 0 to 8, not 9\n");
    CHECK(mistakes_of_species("Levels = 2.5\n") == "tree.species:1:10: 'Levels' is a whole number, not 2.5\n");
    CHECK(mistakes_of_species("Scale, ScaleV = 3, x\n") == "tree.species:1:20: 'ScaleV' is a number, not 'x'\n");
    CHECK(mistakes_of_species("Scale, ScaleV = 3\n") ==
          "tree.species:1:17: as many values as names, which are 2, and not 1\n");
    CHECK(mistakes_of_species("Scale 3\n") ==
          "tree.species:1:8: expected '=' between the names of parameters and their values\n");
    CHECK(mistakes_of_species("Scale = 3\nScale = 4\n") == "tree.species:2:1: 'Scale' is set twice\n");
}

TEST_CASE("Every mistake of a species is told at once, and helices are not pruned", "[species]") {
    CHECK(mistakes_of_species("Sale = 3 /* over\ntwo lines */\nLevels = 0\n") ==
          "tree.species:1:1: there is no parameter 'Sale' (did you mean 'Scale'?); 'espalier list notations species' "
          "has them all\ntree.species:3:10: 'Levels' must be from 1 to 9, not 0\n");
    CHECK(mistakes_of_species("PruneRatio = 1\n1CurveV = -20\n") ==
          "tree.species: 1CurveV must not be negative while PruneRatio is more than 0: helices are not pruned\n");
}
