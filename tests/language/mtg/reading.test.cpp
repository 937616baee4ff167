// Measured plants as multiscale tree graphs: topology, coordinates, and what is no such file.
#include "catch.h"
#include "language/notation_text.h"

using namespace espalier;

namespace {

const NotationText notation{"mtg", "tree.mtg"};

std::string model_of(const std::string& text) {
    return notation.model_of(text);
}

std::string mistake(const std::string& text) {
    return notation.mistake(text);
}

const std::string head =
    "CODE:\tFORM-A\n\nCLASSES:\nSYMBOL\tSCALE\tDECOMPOSITION\tINDEXATION\tDEFINITION\n$\t0\tFREE\tFREE\tIMPLICIT\n"
    "P\t1\tFREE\tFREE\tEXPLICIT\nA\t2\tFREE\tFREE\tEXPLICIT\nU\t3\tFREE\tFREE\tEXPLICIT\n\n"
    "DESCRIPTION:\nLEFT\tRIGHT\tRELTYPE\tMAX\nU\tU\t+\t?\n\nFEATURES:\nNAME\tTYPE\nXX\tREAL\nYY\tREAL\nZZ\tREAL\n\n";
constexpr int lines_of_head = 19;

/// With two columns of entities.
std::string plant(const std::string& lines, const std::string& features = "XX\tYY\tZZ\tdiameter") {
    return head + "MTG:\nENTITY-CODE\t\t" + features + "\n" + lines;
}

std::string axiom_of(const std::string& text) {
    const std::string model = model_of(text);
    const std::size_t begin = model.find("axiom:") + 6;
    return model.substr(begin, model.find("\nendlsystem") - begin);
}

}  // namespace

TEST_CASE("MTG: axes follow by < and are borne by +, with z upwards", "[mtg]") {
    CHECK(axiom_of(plant("/P1/A1/U1\t\t0\t0\t1\t0.2\n"
                         "\t+A2/U2\t1\t0\t1\t0.1\n"
                         "\t^<U3\t2\t0\t1\t0.1\n"
                         "^<U4\t\t0\t0\t3\t0.2\n")) ==
          "\n\t[@Ax(0) @R(0, 1, 0) f(1)\n\t[!(0.1) @R(1, 0, 0) F(1) !(0.1) @R(1, 0, 0) F(1) Tip(1)]"
          " !(0.2) @R(0, 1, 0) F(2) Tip(0)]");
}

TEST_CASE("MTG: codes from the root name the same plant as codes that go on", "[mtg]") {
    const std::string brief =
        "# unit: m\n" + plant("/P1/A1/U1\t\t0\t0\t1\t1\n^<U2\t\t0\t0\t2\t1\n^+U3\t\t1\t0\t2\t1\n");
    const std::string whole =
        "# unit: m\n" + plant("/P1/A1/U1\t\t0\t0\t1\t1\n/P1/A1/U1<U2\t\t0\t0\t2\t1\n/P1/A1/U1<U2+U3\t\t1\t0\t2\t1\n");
    CHECK(axiom_of(brief) == axiom_of(whole));
    CHECK_THAT(axiom_of(brief), Catch::Contains("F(1)\n\t[!(1) @R(1, 0, 0) F(1) Tip(1)] Tip(0)"));
}

TEST_CASE("MTG: entities without coordinates lie between their neighbours, and bear what stands on them", "[mtg]") {
    const std::string text =
        plant("/P1/A1/U1\t\t0\t0\t0\t1\n^<U2\n^<U3\n\t+U7\t3\t0\t2\t1\n^<U4\t\t0\t0\t3\t1\n^<U5\n\t+U8\t0\t9\t3\n");
    CHECK_THAT(axiom_of(text),
               Catch::Contains("!(1) @R(0, 1, 0) F(1) !(1) @R(0, 1, 0) F(1)\n\t[!(1) @R(1, 0, 0) F(3) Tip(1)]"
                               " !(1) @R(0, 1, 0) F(1)\n\t[!(1) @R(0, 0, -1) F(9) Tip(1)] Tip(0)"));
}

TEST_CASE("MTG: lines say the unit and what points upwards, a length where a trunk begins", "[mtg]") {
    CHECK_THAT(axiom_of("# unit: cm\n# up: y\n" + plant("/P1/A1/U1\t\t0\t50\t0\t2\t20\n^<U2\t\t0\t100\t0\t2\t50\n",
                                                        "XX\tYY\tZZ\tTopDia\tlength")),
               Catch::Contains("@R(0, 1, 0) f(0.3) !(0.02) @R(0, 1, 0) F(0.2) !(0.02) @R(0, 1, 0) F(0.5)"));
}

TEST_CASE("MTG: entities with a birth appear on their day", "[mtg]") {
    const std::string model =
        model_of(plant("/P1/A1/U1\t\t0\t0\t1\t1\n^<U2\t\t0\t0\t2\t2\n^<U3\n^<U4\t\t0\t0\t4\t4\n", "XX\tYY\tZZ\tbirth"));
    CHECK_THAT(model,
               Catch::Contains("Node(2, 0, 1, 0, 1, 0.005) Node(2, 0, 1, 0, 1, 0.005) Node(4, 0, 1, 0, 1, 0.005)"));
    CHECK_THAT(model, Catch::Contains("derivation length: 4 / DT + 0.999"));
}

TEST_CASE("MTG: mistakes are named with their line and column", "[mtg]") {
    const auto at = [](int line, int column) {
        return "tree.mtg:" + std::to_string(lines_of_head + line) + ":" + std::to_string(column) + ": ";
    };
    CHECK(mistake("") == "tree.mtg:1:1: this file has no section MTG:");
    CHECK(mistake(plant("")) == "tree.mtg:21:1: this file has no entities below MTG:");
    CHECK_THAT(mistake(plant("^<U1\n")), Catch::StartsWith(at(3, 1) + "there is no entity above"));
    CHECK_THAT(mistake(plant("\t+U1\n")), Catch::StartsWith(at(3, 2) + "there is no entity above"));
    CHECK_THAT(mistake(plant("P1\n")), Catch::Contains("'P1' begins no entity: write /, < or +"));
    CHECK_THAT(mistake(plant("/P1/A1/\n")), Catch::Contains("has no class"));
    CHECK_THAT(mistake(plant("/A1/P1\n")), Catch::Contains("P1 is no part of A1"));
    CHECK_THAT(mistake(plant("+U1\n")), Catch::Contains("U1 stands on nothing"));
    CHECK_THAT(mistake("# unit: miles\n" + plant("/P1/A1/U1\t\t0\t0\t1\n")), Catch::Contains("the unit 'miles'"));
    std::string deep = "/P1/A1/U1\t\t0\t0\t1\n";
    for (int i = 2; i < 80; ++i) deep += "^+U" + std::to_string(i) + "\t\t0\t0\t" + std::to_string(i) + "\n";
    CHECK(mistake(plant(deep)).empty());
}
