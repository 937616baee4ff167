#include "catch.h"
#include "reading.h"

using namespace espalier;
using namespace espalier::language;
using namespace espalier::test;

namespace {

/// Symbols that act on any number of parameters.
ReviewOptions turtle_with(const std::vector<std::string>& symbols) {
    ReviewOptions options;
    for (const std::string& symbol : symbols) options.turtle[symbol];
    return options;
}

std::string warnings(const std::string& text, const ReviewOptions& options) {
    std::string result;
    for (const Diagnostic& warning : review(*read(text), options)) {
        CHECK(warning.severity == Diagnostic::Severity::warning);
        if (!result.empty()) result += "\n";
        if (warning.place.known()) result += std::to_string(warning.place.line) + ": ";
        result += warning.message;
    }
    return result;
}

std::string warnings(const std::string& text, const std::vector<std::string>& turtle_symbols = {}) {
    return warnings(text, turtle_with(turtle_symbols));
}

/// What --quiet does not silence.
std::string insistent_warnings(const std::string& text, const ReviewOptions& options = {}) {
    std::string result;
    for (const Diagnostic& warning : review(*read(text), options)) {
        if (warning.insistent) result += std::to_string(warning.place.line) + ": " + warning.message + "\n";
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

TEST_CASE("a module with a number of parameters that nothing takes is named, and what has one", "[language]") {
    ReviewOptions turtle = turtle_with({"F", "+", "@L", "{", "}", "."});
    turtle.turtle["@R"] = {2, 3, 4, 5, 6};
    turtle.turtle["@o"] = {0, 1};
    const auto of = [&](const std::string& axiom, const std::string& rules) {
        return warnings(lsystem_of("", axiom, rules), turtle);
    };
    const std::string comma =
        "is another module than 'F' with 1 parameter, and of its parameters only the first means "
        "something: is a ',' a '.'?";
    CHECK(of("F(1)A", "A --> F(1,5)A\n") == "3: 'F' with 2 parameters " + comma);
    CHECK(of("F(1)F(1,5)", "F(x) --> F(x*1.5)\n") == "2: 'F' with 2 parameters " + comma);
    CHECK(of("A(1)", "A(x) --> F(x)A(x,1)\n") ==
          "3: 'A' with 2 parameters is taken by no production; those for 'A' take 1");
    CHECK(of("@R(1)F", "F --> F\n") ==
          "2: '@R' with 1 parameter means nothing to the turtle, which takes 2 or 3 or 4 or "
          "5 or 6");
    CHECK(of("@o(1,2)F", "F --> F\n") == "2: '@o' with 2 parameters means nothing to the turtle, which takes 0 or 1");
    // Symbols with a default, data that only the timeline records, parts of the model that other productions take.
    CHECK(of("F(1)F", "F(x) --> F(x)[+F][+(30)F]\n") == "");
    CHECK(of("F(1,5)", "F(x,y) --> F(x,y+1)F(x,0)\n") == "");
    CHECK(of("F(1)F(1,5)", "F(x) --> F(x*2)\nF(x,y) --> F(x,y-1)\n") == "");
    CHECK(of("F(1)F(1,5)", "F(x,y) < F(z) --> F(z)\nF(x) --> F(x*2)\n") == "");
    CHECK(of("A(1)", "A(x) : x < 5 --> F(x)A(x+1)\nA(x) --> A\n") == "");
    CHECK(of("A(1)", "A(x) --> FA(x)\nhomomorphism\nA(x) --> @o(x)\n") == "");
    CHECK(of("A(1)", "A(x) --> @R(1,0)F@R(1,0,0)F@R(1,0,0,0,1,0)A(x)\n") == "");
    CHECK(of("A", "A --> @L(\"%d\",1)@L(\"a\")@L(\"%d %d\",1,2)A\n") == "");
    CHECK(of("A", "A --> {F.}{(1)F.(3)}{(1,4)F.}A\n") == "");
    CHECK(of("A?E(1,2)", "A > ?E(x) --> A?E(1)\nA > ?E(x,y) --> A?E(1,2)\n") == "");
}

TEST_CASE("a condition that is a number is taken for a probability, a switch is not", "[language]") {
    const auto under = [](const std::string& condition) {
        return warnings("#define DENSE 1\n#define P 0.3\n" + lsystem_of("", "F", "F : " + condition + " --> FF\n"));
    };
    CHECK(under("0.2") ==
          "5: this condition is the number 0.2, so it always holds: is it a probability? A weight stands "
          "behind the successor, '--> ... : 0.2', and needs a line 'seed: 1' in the header");
    CHECK(under("P").find("is it a probability?") != std::string::npos);
    CHECK(under("33").find("is it a probability?") != std::string::npos);
    for (const char* sound : {"1", "DENSE", "DENSE == 1", "2 > 1", "*", "ran(1) < 0.2", "Q"}) {
        INFO(sound);
        CHECK(under(sound) == "");
    }
}

TEST_CASE("labels of productions, as books have them, are refused or pointed out", "[language]") {
    CHECK(messages(lsystem_of("", "A(1)", "p1: A(d) : d>0 --> A(d-1)\np_2 : A(d) : d<=0 --> *\n")) ==
          "3:1: productions have no labels: leave 'p1:' away\n4:1: productions have no labels: leave 'p_2 :' away");
    CHECK(warnings(lsystem_of("", "A", "p1 : A --> AA\n")) ==
          "3: 'p1' is read as the modules that this production replaces, and nothing produces them. If it is a label: "
          "productions have none, so leave 'p1:' away");
    // Modules of these names, and the two ':' of one condition.
    CHECK(warnings(lsystem_of("", "p1", "p1 : Q > 1 --> p1p1\n")) == "");
    CHECK(messages(lsystem_of("", "A1", "A1 : Q > 1 ? 1 : 0 --> A1A1\n")) == "");
    CHECK(messages(lsystem_of("seed: 1\n", "p1", "p1 : Q > 1 --> p1 : 0.5\np1 --> p1p1 : 0.5\n")) == "");
}

TEST_CASE("what one string opens another may close, and --quiet then says nothing", "[language]") {
    CHECK(insistent_warnings(lsystem_of("", "A", "A --> F[A\n")) ==
          "3: this branch is not closed in this successor: ']' is missing\n");
    const std::string in_two = lsystem_of("", "A", "A --> F[B\nB --> FB]\n");
    CHECK(insistent_warnings(in_two) == "");
    CHECK(warnings(in_two).find("']' is missing") != std::string::npos);
}

TEST_CASE("warnings that --quiet does not silence are of what has not the effect it reads like", "[language]") {
    const ReviewOptions turtle = turtle_with({"F", "+"});
    CHECK(insistent_warnings(lsystem_of("", "A(1)", "A --> F\n")).find("nothing produces 'A'") != std::string::npos);
    CHECK(insistent_warnings(lsystem_of("", "A", "Apex --> F\n"), turtle).find("'Apex' is read as") !=
          std::string::npos);
    CHECK(insistent_warnings("environment light;\n" + lsystem_of("", "F?lite(1)", "F --> F\n"), turtle)
              .find("no process answers") != std::string::npos);
    // What waits for a mouse, what is odd but done as written.
    CHECK(insistent_warnings(lsystem_of("", "A", "X --> F\n"), turtle) == "");
    CHECK(insistent_warnings(lsystem_of("", "A", "A : 2 > 3 --> A\n"), turtle) == "");
    CHECK(insistent_warnings(lsystem_of("", "A", "A --> AX\n"), turtle) == "");
}

TEST_CASE("modules that a run inserts are produced", "[language]") {
    const auto model = read(lsystem_of("", "FA", "X(n) : n > 0 --> FX(n-1)\n"));
    ReviewOptions options = turtle_with({"F", "A"});
    CHECK(review(*model, options).size() == 1);
    options.inserted = {model->alphabet.find("X", 1).value()};
    CHECK(review(*model, options).empty());
}

TEST_CASE("a character that only looks like one of the keyboard is named with the key to type", "[language]") {
    const auto told = [](const std::string& successor) {
        std::string text;
        for (const Diagnostic& each : reading_warnings(lsystem_of("", "F", "F --> F" + successor + "\n"))) {
            text += (text.empty() ? "" : "\n") + each.message;
            CHECK(each.insistent);
        }
        return text;
    };
    CHECK(told("\u2212(30)F\u2212(10)F") == "this is a module of its own: '\u2212', a minus sign (U+2212): type '-'");
    CHECK(told("\u2013F") == "this is a module of its own: '\u2013', a dash (U+2013): type '-'");
    CHECK(told("F\u00A0F").find("(U+00A0): type a blank") != std::string::npos);
    CHECK(told("\u201CF\u201D").find("type '\"'") != std::string::npos);
    CHECK(told("\uFF26").find("(U+FF26): type 'F'") != std::string::npos);
    CHECK(told("\u0410").find("(U+0410): type 'A'") != std::string::npos);
    CHECK(told("\x96"
               "F")
              .find("the byte 0x96, which is no text in UTF-8: type '-', or save the file in UTF-8") !=
          std::string::npos);
    // Letters that nothing looks like, strings, comments.
    CHECK(told("\u03B1\u00FC") == "");
    CHECK(told("@L(\"\u2013\")/* \u2212 */") == "");
    // In an expression and for an arrow, where it is a mistake.
    CHECK(messages(lsystem_of("", "F(1)", "F(x) --> F(x \u2212 1)\n")) ==
          "3:14: expected ')' after the parameters of 'F', found '\u2212', a minus sign (U+2212): type '-'");
    CHECK(messages(lsystem_of("", "F", "F \u2192 FF\n")) == "3:3: the arrow of a production is '-->', not '\u2192'");
}

TEST_CASE("a character beyond ASCII that has no effect is told under --quiet, too", "[language]") {
    const ReviewOptions turtle = turtle_with({"F"});
    CHECK(insistent_warnings(lsystem_of("", "F\u03B1", "F --> FF\n"), turtle).find("'\u03B1' has no effect") !=
          std::string::npos);
    CHECK(insistent_warnings(lsystem_of("", "F\u03B1", "\u03B1 --> F\u03B1\n"), turtle) == "");
}
