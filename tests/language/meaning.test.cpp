// What models mean, sentence by sentence, where the sentence is about growth.
#include "catch.h"
#include "language/growing.h"

using namespace espalier;
using namespace espalier::language;
using namespace espalier::test;

namespace {

std::string one(const std::string& header, const std::string& axiom, const std::string& rules) {
    return "lsystem: 1\n" + header + "axiom: " + axiom + "\n" + rules + "endlsystem\n";
}

}  // namespace

// "ring lsystem: first and last module are neighbours in context search"
TEST_CASE("in a ring the first and the last module are neighbours, on both sides", "[language]") {
    const std::string left = "B < A --> x\n", right = "A > B --> x\n";
    CHECK(grown(one("ring lsystem\n", "ACB", left), 1) == "xCB");
    CHECK(grown(one("", "ACB", left), 1) == "ACB");
    CHECK(grown(one("ring lsystem\n", "BCA", right), 1) == "BCx");
    CHECK(grown(one("", "BCA", right), 1) == "BCA");
    CHECK(grown(one("ring lsystem\n", "BACC", "CC < B > AC --> x\n"), 1) == "xACC");
    CHECK(grown(one("ring lsystem\nignore: +\n", "+ACB+", left), 1) == "+xCB+");
    CHECK(grown(one("ring lsystem\n", "A(3)B(5)", "B(x) < A(y) > B(z) --> C(x*100+y*10+z)\n"), 1) == "C(535)B(5)");
}

// "right context looks at the filter before looking at brackets: with `consider: A B` the brackets themselves are
// ignored and branches are flattened (A[B] satisfies right context B)"
TEST_CASE("a consider list without brackets flattens branches to the right, not to the left", "[language]") {
    CHECK(grown(one("consider: A B\n", "A[B]", "A > B --> x\n"), 1) == "x[B]");
    CHECK(grown(one("consider: A B []\n", "A[B]", "A > B --> x\n"), 1) == "A[B]");
    CHECK(grown(one("consider: A B []\n", "A[C]B", "A > B --> x\n"), 1) == "x[C]B");
    CHECK(grown(one("consider: A B\n", "B[C]A", "B < A --> x\n"), 1) == "B[C]x");
    CHECK(grown(one("consider: A B\n", "C[B]A", "B < A --> x\n"), 1) == "C[B]A");
    CHECK(grown(one("ignore: []\n", "A[C[B]]", "A > CB --> x\n"), 1) == "x[C[B]]");
    CHECK(grown(one("ignore: C\n", "C(1)A", "C(x) < A --> D(x)\n"), 1) == "C(1)A");
}

// "`A > [C]F` fails on `A[C[D]E]F`, `A > [C=]F` and `A > [C[D]E]F` succeed"
TEST_CASE("= skips to the end of the current branch", "[language]") {
    CHECK(grown(one("", "A[C[D]E]F", "A > [C]F --> x\n"), 1) == "A[C[D]E]F");
    CHECK(grown(one("", "A[C[D]E]F", "A > [C=]F --> x\n"), 1) == "x[C[D]E]F");
    CHECK(grown(one("", "A[C[D]E]F", "A > [C[D]E]F --> x\n"), 1) == "x[C[D]E]F");
    CHECK(grown(one("", "A[CDE][G]F", "A > [C=][G]F --> x\n"), 1) == "x[CDE][G]F");
    CHECK(grown(one("", "[AB]F", "A > =]F --> x\n"), 1) == "[xB]F");
}

// "Strict predecessor may be several modules; so may contexts"
TEST_CASE("several modules are replaced as a block, with contexts and parameters", "[language]") {
    CHECK(grown(one("", "LA(1)B(2)RA(1)B(2)", "L < A(x)B(y) > R --> C(x,y)\n"), 1) == "LC(1,2)RA(1)B(2)");
    CHECK(grown(one("", "AAAAA", "AA --> A\n"), 1) == "AAA");
    CHECK(grown(one("", "@Gs@Ge", "@Gs --> s\n@Ge --> e\n"), 1) == "se");
    CHECK(grown(one("ignore: +\n", "A+B", "AB --> x\n"), 1) == "A+B");
}

TEST_CASE("several modules may be decomposed and drawn as a block too", "[language]") {
    CHECK(grown(one("", "X", "X --> A(1)B(2)B(3)C\ndecomposition\nA(x)B(y) --> D(x+y)\n"), 1) == "D(3)B(3)C");
    CHECK(grown(one("", "X", "X --> ABC\ndecomposition\nmaximum depth: 3\nAB --> D\nDC --> E\n"), 1) == "E");
    CHECK(grown(one("", "X", "X --> A\ndecomposition\nAB --> D\n"), 1) == "A");
    const Grown plant(one("", "A(1)B(2)B(3)", "X --> X\nhomomorphism\nA(x)B(y) --> F(x*10+y)\nB(y) --> G\n"));
    CHECK(plant.drawn() == "F(12)G");
}

// "Order of tests: strict predecessor, right context, left context, then parameter binding, pre-block, condition.
// Pre-block assignments to globals persist even if the condition fails."
TEST_CASE("a pre-block runs once everything before it fits, whatever the condition says", "[language]") {
    const std::string count = "A > R : {n = n + 1;} 0 --> x\nL < A : {n = n + 10;} 0 --> x\nA : 1 --> B(n)\n";
    CHECK(grown(one("Start: { n = 0; }\n", "A", count), 1) == "B(0)");
    CHECK(grown(one("Start: { n = 0; }\n", "AR", count), 1) == "B(1)R");
    CHECK(grown(one("Start: { n = 0; }\n", "LAR", count), 1) == "LB(11)R");
}

// "Post-block runs only when chosen, before successor evaluation."
TEST_CASE("a post-block runs when its production is chosen, before its successor", "[language]") {
    const std::string rules = "A(x) : x > 5 {n = n + 1;} --> B(n)\nA(x) : 1 {n = n + 100;} --> C(n)\n";
    CHECK(grown(one("Start: { n = 0; }\n", "A(7)A(1)A(8)", rules), 1) == "B(1)C(101)B(102)");
}

TEST_CASE("a block may change its production's own parameters", "[language]") {
    const auto model = [](const std::string& axiom, const std::string& rule) { return one("", axiom, rule); };
    try {
        read_model_text(model("A(1)", "A(x) : {x = x + 1;} 1 --> A(x)\n"), "model.l");
    } catch (const UserError&) {
        return;  // the reader's to decide
    }
    CHECK(grown(model("A(1)", "A(x) : {x = x * 3;} x > 2 {x = x + 1;} --> A(x)\n"), 2) == "A(13)");
}

// "weights are any non-negative expressions, normalised by their sum; missing weight = 1"
TEST_CASE("a mistake in a block tells its place, in models whose modules have an order, too", "[language]") {
    std::string counting;  // what is compiled behind the block that fails
    for (int i = 1; i <= 8; ++i) {
        counting += "C" + std::to_string(i) + "(x) : {total = total + x; y = x * 2 + total;} 1 --> F(x+y)\n";
    }
    const std::string model =
        "lsystem: 1\nderivation length: 1\naxiom: AC1(1)\nA --> B(1e308)\n"
        "B(x) : {y = x * 10; total = total + ran(y);} 1 --> F(total)\n" +
        counting + "endlsystem\n";
    CHECK(failure(model, 2) ==
          "model.l:5:37: ran(inf): the arguments must be finite numbers, in module B(1e+308) at step 2");
}

TEST_CASE("every production that matches goes into the pool", "[language]") {
    const std::string text =
        grown(one("seed: 3\n", std::string(30000, 'A'), "A --> B\nA --> C : 2\nA > Z --> D : 99\n"), 1);
    CHECK(std::count(text.begin(), text.end(), 'B') / 30000.0 == Approx(1 / 3.0).margin(0.015));
    CHECK(std::count(text.begin(), text.end(), 'D') == 0);
}

// "Decomposition: ... shares random numbers, deterministic choice (first match)"
TEST_CASE("decomposition takes the first production that applies, whatever the weights", "[language]") {
    CHECK(grown(one("seed: 3\n", "X", "X --> AAAAAAAA\ndecomposition\nA --> b : 1\nA --> c : 1000\n"), 1) ==
          "bbbbbbbb");
}

// "Start ... run before the axiom is evaluated"
TEST_CASE("the seed and the derivation length may be set by the Start block", "[language]") {
    const auto text = [](int seed) {
        return one("seed: s\nderivation length: n + 2\nStart: { s = " + std::to_string(seed) + "; n = 3; }\n", "A(n)",
                   "A(x) --> A(ran(1))\n");
    };
    Grown plant(text(1));
    CHECK(plant.derivation.length() == 5);
    CHECK(plant.text() == "A(3)");
    CHECK(plant.steps(1).text() == Grown(text(1)).steps(1).text());
    CHECK(plant.text() != Grown(text(2)).steps(1).text());
    Grown loud(one("derivation length: n\nStart: { n = 3; printf(\"once\"); }\n", "A", "A --> A\n"));
    CHECK(loud.said == "once");
}

// "on the step after it appears, everything from it to the unmatched closing bracket (or string end, or `$`) is
// deleted"
TEST_CASE("a cut from a homomorphism cuts nothing", "[language]") {
    Grown plant(one("", "AB", "B --> BC\nhomomorphism\nA --> %\n"));
    CHECK(plant.steps(2).text() == "ABCC");
    CHECK(plant.drawn() == "%BCC");
}

// "The delimiter -o> is a historical variant and otherwise behaves as -->."
TEST_CASE("-o> is an arrow", "[language]") {
    CHECK(grown(one("", "A", "A -o> BA\n"), 2) == "BBA");
}

// "stop(n)", "Get/SetDerivationLength"
TEST_CASE("a model may stop itself and change its length", "[language]") {
    Grown plant(one("derivation length: 9\nEndEach: { if (Q == 2) { stop(0); } SetDerivationLength(Z + 1); }\n", "A(0)",
                    "A(x) --> A(GetDerivationLength())\n"));
    plant.steps(1);
    CHECK_FALSE(plant.derivation.stopped());
    plant.steps(1);
    CHECK(plant.derivation.stopped());
    CHECK(plant.derivation.length() == 11);
    CHECK(plant.text() == "A(10)");
}

TEST_CASE("arrays that the memory cannot hold are refused before they are made", "[language]") {
    DerivationSettings settings;
    settings.memory = 1 << 20;
    const std::string model = one("define: { array a[900000000]; }\n", "A", "A --> A\n");
    CHECK_THROWS_AS(Grown(model, settings), RunError);
}
