#include "catch.h"
#include "reading.h"

using namespace espalier;
using namespace espalier::language;
using namespace espalier::test;

namespace {

std::string warnings(const std::string& text, const std::vector<std::string>& turtle_symbols = {}) {
    std::string result;
    for (const Diagnostic& warning : review(*read(text), turtle_symbols)) {
        CHECK(warning.severity == Diagnostic::Severity::warning);
        if (!result.empty()) result += "\n";
        if (warning.place.known()) result += std::to_string(warning.place.line) + ": ";
        result += warning.message;
    }
    return result;
}

}  // namespace

TEST_CASE("a sound model is not warned about", "[language]") {
    CHECK(warnings("environment light;\n" + lsystem_of("consider: A F[]\n", "A(1)?light(1)",
                                                       "A(x) ?light(l) > [F=] : x > 1 --> F[+A(x)?light(1)]@o\n"
                                                       "A(x) --> A(x+1)F\n?light(l) --> ?light(1)\n"),
                   {"F", "+", "@o"}) == "");
}

TEST_CASE("productions that can never apply are named with the reason", "[language]") {
    CHECK(warnings(lsystem_of("", "A(1)", "A --> B\n")) ==
          "3: this production can never apply: nothing produces 'A' (only with 1 parameter)");
    CHECK(warnings(lsystem_of("", "AB", "B < A > X --> B\n")) ==
          "3: this production can never apply: nothing produces 'X'; if it waits for a mouse, "
          "--insert puts modules into a string");
    CHECK(warnings(lsystem_of("", "A", "A --> AA\nA : Q > 1 --> A\n")) ==
          "4: this production can never apply: the one in model.l:3:1 takes all its modules");
    CHECK(warnings(lsystem_of("", "A", "A : 2 > 3 --> A\n")) ==
          "3: this production can never apply: its condition is always 0");
}

TEST_CASE("'=' and '==' in each other's place are warned about", "[language]") {
    CHECK(warnings(lsystem_of("Start: { n == 0; n = 1; if (n = 2) { n + 1; } while (n == 3) { srand(n); } }\n", "A",
                              "A : n = 2 --> A\nA : {n = Q;} n == 2 {n;} --> A\n")) ==
          "2: this statement changes nothing ('=' assigns)\n"
          "2: this condition assigns ('==' compares)\n"
          "2: this statement changes nothing ('=' assigns)\n"
          "4: this condition assigns ('==' compares)\n"
          "5: this statement changes nothing ('=' assigns)");
    CHECK(warnings(lsystem_of("Start: { for (i = 0; i < 3; i++) { ran(1); } i = 3; }\n", "A", "A --> A\n")) == "");
}

TEST_CASE("in a stochastic L-system a second production is another choice", "[language]") {
    CHECK(warnings(lsystem_of("seed: 1\n", "A", "A : ran(1) < 0.5 --> AA\nA --> A\n"))
              .find("drawn as often as each of the others of 'A'") != std::string::npos);
    CHECK(warnings(lsystem_of("seed: 1\n", "A", "A : ran(1) < 0.5 --> AA\n")) == "");
    CHECK(warnings(lsystem_of("seed: 1\n", "A", "A --> AA : 1\nA --> A : 2\n")) == "");
    CHECK(warnings(lsystem_of("seed: 1\n", "A", "A --> AA : 0\nA --> A : 0\n")) ==
          "4: all productions of 'A' have weight 0");
}

TEST_CASE("unmatched brackets of an axiom or a successor are a warning", "[language]") {
    CHECK(warnings(lsystem_of("", "A]", "A --> A\n")) == "2: this ']' closes no branch of this axiom");
    CHECK(warnings(lsystem_of("", "A[[A]", "A --> A\n")) ==
          "2: this branch is not closed in this axiom: ']' is missing");
    CHECK(warnings(lsystem_of("", "A", "A --> [A\n")) ==
          "3: this branch is not closed in this successor: ']' is missing");
    CHECK(warnings(lsystem_of("", "A", "A --> A]\n")) == "3: this ']' closes no branch of this successor");
}

TEST_CASE("consider without brackets flattens right contexts", "[language]") {
    CHECK(warnings(lsystem_of("consider: AB\n", "A[B]", "A > B --> B\n")).find("does not name the brackets") !=
          std::string::npos);
    CHECK(warnings(lsystem_of("consider: AB\n", "A[B]", "A < B --> B\n")) == "");
    // No branch can stand between an apex and its query.
    const std::string apex = "A > ?E(x) : x > 0 --> F[+A?E(1)]A\n";
    CHECK(warnings(lsystem_of("consider: A?E\n", "A?E(1)", "A > ?E(x) : x > 0 --> F[+A?E(1)]A?E(1)\n")) == "");
    CHECK(warnings(lsystem_of("consider: A?E\n", "A?E(1)", apex)).find("does not name the brackets") !=
          std::string::npos);
}

TEST_CASE("a word that is not declared is one warning, not one a letter", "[language]") {
    const std::string rules = "Apex(i) --> Internode(1)[+Leaf(i)]Apex(i+1)\n";
    CHECK(warnings(lsystem_of("", "Apex(0)", rules), {"F", "+"}) ==
          "3: 'Apex' is read as 4 modules of one letter each: 'module Apex(i);' before 'lsystem:' makes it one module");
    CHECK(warnings("module Apex(i), Internode(l), Leaf(i);\n" + lsystem_of("", "Apex(0)", rules), {"+"})
              .find("one letter") == std::string::npos);
    CHECK(warnings(lsystem_of("", "AB", "AB --> BA\n")) == "");
}

TEST_CASE("brackets in a left context are pointed out where they never match", "[language]") {
    const std::string text = lsystem_of("", "A[B]C", "[B] < C --> C\n");
    ReadOptions cpfg;
    cpfg.arithmetic = Arithmetic::cpfg;
    CHECK(review(*read(text), {}).empty());
    const std::vector<Diagnostic> found = review(*read(text, cpfg), {});
    REQUIRE(found.size() == 1);
    CHECK(found[0].message.find("brackets in a left context do not match") != std::string::npos);
}

TEST_CASE("a picture that contains itself is found at more than one level", "[language]") {
    const std::string rules = "A --> A\nhomomorphism\nmaximum depth: 5\nA --> FB\nB --> A\n";
    CHECK(warnings(lsystem_of("", "A", rules)).find("the picture of 'A' contains itself") != std::string::npos);
    CHECK(warnings(lsystem_of("", "A", "A --> A\nhomomorphism\nA --> FA\n")) == "");
    const std::string counted = "A --> A\nhomomorphism\nmaximum depth: 5\nA --> B(3)\nB(n) : n > 0 --> FB(n - 1)\n";
    CHECK(warnings(lsystem_of("", "A", counted)) == "");
}

TEST_CASE("questions that nobody answers are named", "[language]") {
    CHECK(warnings("environment light, water;\n" + lsystem_of("", "A?light(1)?watr(2)", "A --> A\n")) ==
          "'environment water;' is declared, but no module '?water' asks it\n"
          "3: no process answers '?watr': declare 'environment watr;' (did you mean 'water'?)");
    CHECK(warnings(lsystem_of("", "A?P(0,0,0)?E(1)", "A --> A\n")) == "");
}

TEST_CASE("modules of which neither a production nor the turtle takes notice are named once", "[language]") {
    CHECK(warnings(lsystem_of("", "A", "A --> F[+X]@oX~l\n"), {"F", "+", "@o"}) ==
          "3: 'X' has no effect: no production names it and the turtle does not know it");
}

TEST_CASE("L-systems that are not there, or that nobody calls, are pointed out", "[language]") {
    const std::string leaf = "lsystem: 2\naxiom: A\nA --> AF\nendlsystem\n";
    const auto plant = [](const std::string& call) { return lsystem_of("", "A", "A --> A" + call + "A$\n"); };
    CHECK(warnings(plant("?(2)") + leaf) == "");
    CHECK(warnings(plant("?(2, 0.5)") + leaf) == "");
    CHECK(warnings(plant("?(Q + 1)") + leaf) == "");
    CHECK(warnings(plant("?(3)") + leaf) ==
          "3: no L-system of this file has the label 3\n"
          "7: the L-system with the label 2 is never called: ?(2) ... $");
}

TEST_CASE("texts among the parameters of modules are nothing odd", "[language]") {
    CHECK(warnings(lsystem_of("", "A", "A --> A@L(\"%d\", 2)\n")) == "");
}

TEST_CASE("a production that also replaces a part of a symbol of the turtle is pointed out", "[language]") {
    const std::vector<std::string> symbols{"F", "@Ts", "@o", "@O"};
    CHECK(warnings(lsystem_of("", "T@Ts(1, 2)", "T --> FT\n"), symbols) ==
          "3: this production replaces the 'T' in @Ts too: call the module otherwise");
    CHECK(warnings(lsystem_of("", "o(1)F", "o(x) --> F@o(x)\n"), symbols) ==
          "3: this production replaces the 'o' with 1 parameter in @o too: call the module otherwise");
    // Another arity, a context, a symbol whose part is what is to be replaced, a question: all as they should be.
    CHECK(warnings(lsystem_of("", "T(1)@Ts(1, 2)", "T(x) --> FT(x)\n"), symbols) == "");
    CHECK(warnings(lsystem_of("", "FT@Ts(1, 2)", "F < T --> FT\n"), symbols) == "");
    CHECK(warnings(lsystem_of("", "@O(1)F", "O(d) --> O(2 * d)\n"), symbols) == "");
    CHECK(warnings(lsystem_of("", "o(1)", "o(x) --> Fo(x)\nhomomorphism\no(x) --> @o(x)\n"), symbols) == "");
    CHECK(warnings(lsystem_of("", "E(1)?E(1)", "E(x) --> E(x)\n"), symbols) == "");
}

TEST_CASE("weights that look like probabilities and do not sum to one are pointed out", "[language]") {
    const auto bush = [](const std::string& productions) {
        return "lsystem: 1\nseed: 1\nderivation length: 1\naxiom: F\n" + productions + "endlsystem\n";
    };
    CHECK(warnings(bush("F --> FF : 0.5\nF --> F : 0.3\n")) ==
          "5: the weights of 'F' sum to 0.8: they are not probabilities, each is divided by this sum");
    CHECK(warnings(bush("F --> FF : 0.33\nF --> F : 0.33\nF --> FFF : 0.33\n")) == "");
    CHECK(warnings(bush("F --> FF : 2\nF --> F : 0.5\n")) == "");
    CHECK(warnings(bush("F --> FF : 0.3\nF : 1 > 2 --> F : 0.3\n")).find("sum to") == std::string::npos);
    CHECK(warnings(bush("F < F --> FF : 0.3\nF --> F : 0.3\n")) == "");
}

TEST_CASE("a polygon within a polygon is pointed out", "[language]") {
    CHECK(warnings(lsystem_of("", "A", "A --> {.f.f{.f.f.}f.}\n")) ==
          "3: this polygon begins within another one, whose vertices it does not share: is a '}' missing?");
    CHECK(warnings(lsystem_of("", "A", "A --> {.f.f.}[{.f.f.}]\n")) == "");
}

TEST_CASE("a polygon that nothing closes or opens is warned about at its place", "[language]") {
    const auto found = review(*read(lsystem_of("", "A", "A --> F{F.F.\n")), {});
    REQUIRE(found.size() == 1);
    CHECK(found[0].message == "this polygon is not closed in this successor, nor elsewhere: '}' is missing");
    CHECK(found[0].place.line == 3);
    CHECK(found[0].place.column == 8);
    CHECK(warnings(lsystem_of("", "{A", "A --> AF\n")) ==
          "2: this polygon is not closed in this axiom, nor elsewhere: '}' is missing");
    CHECK(warnings(lsystem_of("", "A", "A --> F}F\n")) ==
          "3: this '}' closes no polygon of this successor, nor of others");
}

TEST_CASE("a polygon may be opened by one string and closed by another", "[language]") {
    CHECK(warnings(lsystem_of("", "A", "A --> {.B\nB --> F.}\n")) == "");
    CHECK(warnings(lsystem_of("", "{.A}", "A --> F.A\n")) == "");
    CHECK(warnings(lsystem_of("", "{.A}", "A --> F.A\n{ --> F{\n} --> F}\n")) == "");
}

TEST_CASE("modules that only their own productions produce are told apart from those that an axiom leads to",
          "[language]") {
    CHECK(warnings(lsystem_of("", "A", "A --> FA\nB --> FB\n"), {"F"}) ==
          "4: this production can never apply: 'B' is produced, but only by productions that no axiom leads to");
    CHECK(warnings(lsystem_of("", "A", "A --> FA\nC --> D\nD --> C\n"), {"F"}).find("5: ") != std::string::npos);
    CHECK(warnings(lsystem_of("", "A", "A --> FB\nB --> FA\n"), {"F"}) == "");
}

TEST_CASE("a query to a process of another name is offered the declared one that nothing asks", "[language]") {
    const std::string said = warnings("environment lite;\n" + lsystem_of("", "F?light(1)", "F --> F\n"), {"F"});
    CHECK(said.find("no process answers '?light': declare 'environment light;' (did you mean 'lite'?)") !=
          std::string::npos);
    CHECK(said.find("'i' has no effect") == std::string::npos);
}

TEST_CASE("a module that is declared without parameters may be written with empty brackets", "[language]") {
    const auto model = read("module Seed();\n" + lsystem_of("", "Seed()Seed", "Seed() --> Seed( )F\n"));
    REQUIRE(model->main().axiom.size() == 2);
    CHECK(model->main().axiom[0].letter == model->main().axiom[1].letter);
    CHECK(model->main().productions[0].strict[0].letter == model->main().axiom[0].letter);
    CHECK(model->main().productions[0].successor[0].letter == model->main().axiom[0].letter);
}
