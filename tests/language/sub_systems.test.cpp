#include "catch.h"
#include "language/growing.h"

#include <sstream>

using namespace espalier;
using namespace espalier::language;
using namespace espalier::test;

namespace {

/// A main L-system and others after it.
std::string systems(const std::string& axiom, const std::string& productions, const std::string& others,
                    const std::string& header = "") {
    return "lsystem: 1\n" + header + "derivation length: 10\naxiom: " + axiom + "\n" + productions + "endlsystem\n" +
           others;
}

std::string inner(const std::string& label, const std::string& productions, const std::string& header = "") {
    return "lsystem: " + label + "\n" + header + "axiom: X\n" + productions + "endlsystem\n";
}

}  // namespace

// "from `?` to `$` the productions ... of L-system id apply"
TEST_CASE("between ? and $ another L-system's productions apply", "[language]") {
    const std::string model = systems("A?(2)A$A", "A --> B\n", inner("2", "A --> AC\n"));
    CHECK(grown(model, 1) == "B?(2)AC$B");
    CHECK(grown(model, 3) == "B?(2)ACCC$B");
    CHECK(grown(systems("?(2,0.5)A$", "A --> B\n", inner("2", "A --> C\n")), 1) == "?(2,0.5)C$");
    CHECK(grown(systems("?(2.9)A$", "A --> B\n", inner("2", "A --> C\n")), 1) == "?(2.9)C$");
}

// "The sub-system's axiom is ignored."
TEST_CASE("a sub-L-system starts with what stands between ? and $", "[language]") {
    CHECK(grown(systems("?(2)$", "A --> B\n", inner("2", "X --> Y\n")), 2) == "?(2)$");
}

TEST_CASE("the modules ? and $ belong to the L-system around", "[language]") {
    CHECK(grown(systems("?(2)A$", "?(x) --> ?(x+1)\n$ --> $E\n",
                        inner("2", "? --> Q\nA --> B\n$ --> D\n") + inner("3", "B --> C\n")),
                2) == "?(4)C$EE");
}

TEST_CASE("productions may open sub-L-systems, which grow from the next step on", "[language]") {
    const std::string model =
        systems("A", "A --> ?(2)AA$A\ndecomposition\nA --> a\n", inner("2", "A --> B\ndecomposition\nB --> bC\n"));
    CHECK(grown(model, 1) == "?(2)AA$a");
    CHECK(grown(model, 2) == "?(2)bCbC$a");
}

// "ends with its `$`, with its branch, or with the string"
TEST_CASE("brackets save and restore which L-system applies", "[language]") {
    const std::string others = inner("2", "A --> b\n");
    CHECK(grown(systems("[?(2)A]A", "A --> a\n", others), 1) == "[?(2)b]a");
    CHECK(grown(systems("?(2)A[A]A", "A --> a\n", others), 1) == "?(2)b[b]b");
    CHECK(grown(systems("?(2)A[A$A]A$A", "A --> a\n", others), 1) == "?(2)b[b$a]b$a");
    // Brackets that do not match do no harm.
    CHECK(grown(systems("BA", "B --> $A]A]?(2)A[A\nA --> a\n", others), 2) == "$a]a]?(2)b[ba");
}

TEST_CASE("sub-L-systems nest, and each level has its own productions", "[language]") {
    const std::string model =
        systems("A?(2)A?(3)A$A$A", "A --> a\n", inner("2", "A --> b\n") + inner("3", "A --> c\n"));
    CHECK(grown(model, 1) == "a?(2)b?(3)c$b$a");
}

// "direct or indirect recursion is an error"
TEST_CASE("an L-system inside itself is an error that names the way in", "[language]") {
    const std::string three = inner("2", "A --> b\n") + inner("3", "A --> c\n");
    CHECK(failure(systems("?(2)?(3)?(2)A$$$", "A --> a\n", three), 1) ==
          "model.l: L-system 2 stands inside itself (2 > 3 > 2), at step 1");
    CHECK(failure(systems("?(1)A$", "A --> a\n", three), 1).find("(1 > 1)") != std::string::npos);
    CHECK(failure(systems("?(7)A$", "A --> a\n", three), 1) ==
          "model.l: ?(7) asks for an L-system that does not exist, at step 1; there is 1, 2 and 3");
}

// "at most 100 nested"
TEST_CASE("a hundred L-systems may be nested, and no more", "[language]") {
    std::string others, open, close;
    for (int k = 2; k <= 103; ++k) others += inner(std::to_string(k), "A --> B\n");
    for (int k = 2; k <= 101; ++k) {
        open += "?(" + std::to_string(k) + ")";
        close += "$";
    }
    CHECK(grown(systems(open + "A" + close, "A --> C\n", others), 1) == open + "B" + close);
    CHECK(failure(systems(open + "?(102)A$" + close, "A --> C\n", others), 1).find("more than 100 deep") !=
          std::string::npos);
}

// "Each occurrence owns an instance of that L-system's variables; its Start block runs at first entry,
// StartEach/EndEach on each pass"
TEST_CASE("each occurrence has variables of its own", "[language]") {
    const std::string counter =
        inner("2", "A(x) : x > 1 {n = n + x;} --> A(x)N(n)\n",
              "Start: { n = 100; s = 0; }\nStartEach: { n = n + 1; }\nEndEach: { s = s + 1; }\n");
    const std::string model = systems("?(2)A(2)$?(2)A(5)$", "B --> B\n", counter);
    CHECK(grown(model, 1) == "?(2)A(2)N(103)$?(2)A(5)N(106)$");
    CHECK(grown(model, 2) == "?(2)A(2)N(106)N(103)$?(2)A(5)N(112)N(106)$");
}

TEST_CASE("an instance follows its module through copies, moves and births", "[language]") {
    const std::string counter =
        inner("2", "A --> AN(n)\nN(x) --> N(x)\n", "Start: { n = 0; }\nStartEach: { n = n + 1; }\n");
    // The first ? is rewritten to itself behind a new one: what was old has counted on.
    const std::string model = systems("P?(2)A$", "P --> P?(2)A$\n", counter);
    CHECK(grown(model, 3) == "P?(2)A$?(2)AN(1)$?(2)AN(2)N(1)$?(2)AN(3)N(2)N(1)$");
    // ?(2) --> ?(2) keeps the instance, ?(3) is another L-system's.
    const std::string changing = systems("?(2)A$", "?(x) : Q == 2 --> ?(3)\n", counter + inner("3", "A --> A\n"));
    CHECK(grown(changing, 1) == "?(2)AN(1)$");
    CHECK(grown(changing, 4) == "?(3)AN(2)N(1)$");
}

// "End when it is cut or on the last step"
TEST_CASE("the End block of an instance runs when it is gone, or on the last step", "[language]") {
    const std::string others = inner(
        "2", "X --> X\n", "define: { external log; }\nStart: { log = log * 10 + 1; }\nEnd: { log = log * 10 + 9; }\n");
    const std::string start = "Start: { log = 0; }\n";
    CHECK(grown(systems("P?(2)X$L(0)", "P : Q == 2 --> %\nL(x) --> L(log)\n", others, start), 2) == "%?(2)X$L(1)");
    CHECK(grown(systems("P?(2)X$EL(0)", "P : Q == 2 --> %\nL(x) --> L(log)\n", others, start), 3) == "");
    CHECK(grown(systems("L(0)[P?(2)X$E]", "P : Q == 2 --> %\nL(x) --> L(log)\n", others, start), 4) == "L(19)[]");
    CHECK(grown(systems("?(2)X$L(0)", "?(x) : Q == 2 --> *\nL(x) --> L(log)\n", others, start), 4) == "X$L(19)");
    const std::string last =
        "lsystem: 1\nderivation length: 2\nStart: { log = 0; }\n"
        "End: { printf(\"%g\\n\", log); }\naxiom: ?(2)X$\nL --> L\nendlsystem\n";
    Grown plant(last + others);
    plant.steps(2);
    CHECK(plant.said == "19\n");
}

// "`external` names are shared variables of the surrounding L-system"
TEST_CASE("external variables and arrays are those of the L-system around", "[language]") {
    const std::string adder =
        "lsystem: 2\ndefine: { external sum; external array a[3]; }\nStart: { a[1] = 7; }\naxiom: X\n"
        "A(x) : 1 {sum = sum + x;} --> A(x)\nendlsystem\n";
    const std::string model = systems("?(2)A(3)$?(2)A(4)$S(0)", "S(x) --> S(sum+a[1])\n", adder,
                                      "define: { array a[3]; }\nStart: { sum = 0; }\n");
    CHECK(grown(model, 1) == "?(2)A(3)$?(2)A(4)$S(14)");
    CHECK(grown(model, 2) == "?(2)A(3)$?(2)A(4)$S(21)");
}

TEST_CASE("external variables reach through several levels, one at a time", "[language]") {
    const std::string middle = inner("2", "B --> B\n", "define: { external n; }\n");
    const std::string deepest = inner("3", "A : 1 {n = n + 1;} --> A\n", "define: { external n; }\n");
    const std::string model = systems("?(2)?(3)A$$N(0)", "N(x) --> N(n)\n", middle + deepest, "Start: { n = 5; }\n");
    CHECK(grown(model, 2) == "?(2)?(3)A$$N(7)");
    const std::string own = inner("2", "B(x) --> B(n)\n", "Start: { n = 50; }\n");
    CHECK(grown(systems("?(2)?(3)A$B(0)$N(0)", "N(x) --> N(n)\n", own + deepest, "Start: { n = 5; }\n"), 2) ==
          "?(2)?(3)A$B(52)$N(5)");
}

TEST_CASE("an external variable that nobody lends is an error that names the L-systems", "[language]") {
    const std::string model =
        systems("?(2)A$", "A --> A\n", inner("2", "A : 1 {n = 1;} --> A\n", "define: { external n; }\n"));
    CHECK(failure(model, 0).find("'n' is external in L-system 2, but no other L-system has a variable of that name; "
                                 "there are L-systems 1 and 2") != std::string::npos);
    const std::string elsewhere = systems(
        "?(2)A$", "A --> A\n",
        inner("2", "A : 1 {n = 1;} --> A\n", "define: { external n; }\n") + inner("3", "A : 1 {n = 1;} --> A\n"));
    CHECK(failure(elsewhere, 1).find("'n' is external in L-system 2, but there is none in L-system 1 around it") !=
          std::string::npos);
}

// "Q = current step, Z = derivation length" are predefined; every L-system sees the same.
TEST_CASE("Q and Z are shared", "[language]") {
    const std::string others = inner("2", "A --> B(Q,Z)\nB(x,y) : Q == 2 {SetDerivationLength(20);} --> B(x,y)\n");
    Grown plant(systems("?(2)A$A", "A --> C\n", others));
    CHECK(plant.steps(1).text() == "?(2)B(1,10)$C");
    plant.steps(1);
    CHECK(plant.derivation.length() == 20);
}

TEST_CASE("filters are those of the L-system whose production is tried", "[language]") {
    const std::string others = inner("2", "L < A --> b\n", "ignore: N\n");
    CHECK(grown(systems("?(2)LNA$LNA", "L < A --> a\n", others), 1) == "?(2)LNb$LNA");
    // Contexts look across ? and $, which are modules like others.
    CHECK(grown(systems("L?(2)A$", "Z --> Z\n", inner("2", "L < A --> b\n", "ignore: ?\n")), 1) == "L?(2)b$");
    CHECK(grown(systems("L?(2)A$", "Z --> Z\n", inner("2", "L < A --> b\n")), 1) == "L?(2)A$");
}

TEST_CASE("predecessors of several modules stay within their L-system", "[language]") {
    CHECK(grown(systems("A?(2)AA$", "A --> c\n", inner("2", "AA --> b\n")), 1) == "c?(2)b$");
    CHECK(grown(systems("?(2)A$A", "A$A --> x\nA --> c\n", inner("2", "A$A --> y\nA --> b\n")), 1) == "?(2)b$c");
}

// "everything from it to the unmatched closing bracket (or string end, or `$`) is deleted"
TEST_CASE("a cut ends at the $ of its own sub-L-system", "[language]") {
    const std::string others = inner("2", "A --> b\n") + inner("3", "A --> c\n");
    CHECK(grown(systems("?(2)A%A$A", "A --> a\n", others), 1) == "?(2)b$a");
    CHECK(grown(systems("?(2)A%?(3)A$A$A", "A --> a\n", others), 1) == "?(2)b$a");
    CHECK(grown(systems("[%?(2)A$A]A", "A --> a\n", others), 1) == "[]a");
    CHECK(grown(systems("?(2)A[A%A]A$A", "A --> a\n", others), 1) == "?(2)b[b]b$a");
    // A `%` that one L-system rewrites cuts in another.
    CHECK(grown(systems("%A?(2)A%A$A", "% --> P\nA --> a\n", others), 1) == "Pa?(2)b$a");
    CHECK(grown("lsystem: 1\naxiom: A%B[C]$D\nD --> E\nendlsystem\n", 1) == "A$E");
}

// "the productions, ignore set, homomorphism and variables of L-system id apply"
TEST_CASE("pictures are drawn by the right L-system with the instance's variables", "[language]") {
    const std::string others =
        inner("2", "A --> A\nhomomorphism\nA --> F(n)\n", "Start: { n = 3; }\nStartEach: { n = n + 1; }\n");
    Grown plant(systems("A?(2)A$A", "B --> B\nhomomorphism\nA --> G\n", others));
    CHECK(plant.drawn() == "G?(2)F(3)$G");
    CHECK(plant.drawn() == "G?(2)F(3)$G");
    plant.steps(2);
    CHECK(plant.drawn() == "G?(2)F(5)$G");
    CHECK(plant.text() == "A?(2)A$A");
}

TEST_CASE("a picture may enclose a sub-L-system", "[language]") {
    const std::string others =
        inner("2", "A --> A\nhomomorphism\nmaximum depth: 3\nA --> F(n)\n", "Start: { n = 3; }\n");
    Grown plant(systems("P", "B --> B\nhomomorphism\nP --> [?(2)A]A?(2)AA$A\nA --> G\n", others));
    CHECK(plant.drawn() == "[?(2)F(3)]A?(2)F(3)F(3)$A");
    Grown recursive(systems("?(2)P$", "B --> B\n", inner("2", "A --> A\nhomomorphism\nP --> ?(2)A$\n")));
    CHECK_THROWS_AS(recursive.drawn(), RunError);
}

TEST_CASE("a plant with sub-L-systems goes on from a checkpoint as if nothing had happened", "[language]") {
    const std::string others =
        inner("2", "A --> AN(n+a[1])\n",
              "define: { array a[2]; }\nStart: { n = 0; }\nStartEach: { n = n + 1; a[1] = n * 10; }\n");
    const std::string model = systems("P?(2)A$", "P --> P?(2)A$\n", others);
    Grown first(model);
    first.steps(3);
    std::stringstream checkpoint;
    first.derivation.save(checkpoint);
    Grown second(model);
    second.derivation.restore(checkpoint);
    second.string = first.string;
    CHECK(second.drawn() == first.drawn());
    CHECK(second.steps(2).text() == first.steps(2).text());
}

TEST_CASE("stochastic sub-L-systems draw by their own weights", "[language]") {
    const std::string others = inner("2", "A --> b : 0\nA --> c : 3\nA --> d : 0\n", "seed: 5\n");
    CHECK(grown(systems("?(2)AAAA$A", "A --> a\n", others), 1) == "?(2)cccc$a");
}

TEST_CASE("the example of the page on derivation grows as it says", "[language]") {
    const std::string leaf =
        "lsystem: 2\ndefine: { external leaves; }\nStart: { age = 0; }\n"
        "StartEach: { age = age + 1; }\nB : 1 {leaves = leaves + 1;} --> L(age)B\nendlsystem\n";
    const std::string model =
        "lsystem: 1\nderivation length: 3\nStart: { leaves = 0; }\nEnd: { printf(\"%g\", leaves); }\n"
        "axiom: A\nA --> F[?(2, 0.5)B$]A\nendlsystem\n";
    Grown plant(model + leaf);
    CHECK(plant.steps(3).text() == "F[?(2,0.5)L(1)L(2)B$]F[?(2,0.5)L(1)B$]F[?(2,0.5)B$]A");
    CHECK(plant.said == "3");
}
