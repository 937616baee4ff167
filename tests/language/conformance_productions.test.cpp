// Sections 3 to 5 of docs/language.md: the header, productions, contexts.
#include "conformance.h"

#include <map>

using namespace espalier;
using namespace espalier::language;
using namespace espalier::test;

TEST_CASE("3 derivation length, Q and Z", "[conformance]") {
    quote("number of steps; 0 if missing; only that of the first L-system is used");
    CHECK(derived("lsystem: 1\naxiom: A\nA --> B\nendlsystem\n") == "A");
    CHECK(derived("#define N 4\nlsystem: 1\nderivation length: (N - 1) / 3 + 1\naxiom: A\nA --> AB\nendlsystem\n") ==
          "ABB");
    quote("`Q` is the number of the current step and `Z` the derivation length.");
    CHECK(step("A(Q, Z)", "A(q, z) --> B(q, z)A(Q, Z)\n", "derivation length: 2\n") == "B(0,2)B(1,2)A(2,2)");
}

TEST_CASE("3 arrays", "[conformance]") {
    quote(
        "Each dimension of an array has its own brackets, `rate[1][2]`, and subscripts count from 0. Values fill the "
        "array row by row, with or without inner braces; the remaining elements are 0. One statement may declare "
        "several arrays.");
    const std::string values = "A --> B(a[0][0], a[1][2], b[1], c[0][0][1], c[1][1][1])\n";
    CHECK(step("A", values,
               "define: { array a[2][3] = { {1, 2, 3}, {4, 5, 6} }, b[4] = {7, 8}; array c[2][2][2] = {1, 2}; }\n") ==
          "B(1,6,8,2,0)");
    CHECK(step("A", values, "define { array a[2][3] = {1,2,3,4,5,6,}, b[4]={7,8}, c[2][2][2]={{{1,2}}} }\n") ==
          "B(1,6,8,2,0)");
    CHECK(step("A", "A --> B(a[0][1], a[1][0])\n", "define: { array a[2][3] = { {1}, {4, 5} }; }\n") == "B(0,4)");
    quote("A subscript out of range is an error; with `--arithmetic cpfg`, the nearest element is used.");
    const std::string outside =
        lsystem_of("derivation length: 1\ndefine: { array a[3] = {1, 2, 3}; }\n", "A", "A --> B(a[7], a[-1])\n");
    CHECK(mistake(outside).find("model.l:5:9") != std::string::npos);
    ReadOptions cpfg;
    cpfg.arithmetic = Arithmetic::cpfg;
    CHECK(derived(outside, cpfg) == "B(3,1)");
}

TEST_CASE("3 variables", "[conformance]") {
    quote(
        "A name that is assigned anywhere in an L-system is one of its variables. Its value is 0 until it is "
        "assigned.");
    CHECK(step("A(n)A(n)", "A(x) : n == 0 {n = 5;} --> B(n)\nA(x) --> C(n)\n") == "B(5)C(5)");
    quote("A name that is read but never assigned is 0, with a warning.");
    const std::string unknown = lsystem_of("derivation length: 1\n", "A(n)", "A(x) : x == lenght --> B(lenght + 1)\n");
    CHECK(derived(unknown) == "B(1)");
    const std::vector<Diagnostic> warnings = reading_warnings(unknown);
    REQUIRE(warnings.size() == 2);
    CHECK(warnings[1].message == "'lenght' is no parameter here and never assigned, so its value is 0");
}

TEST_CASE("4 the parts of a production", "[conformance]") {
    quote("Only the strict predecessor, the arrow and the successor are required. The arrow is `-->` or `-o>`.");
    CHECK(step("LAR", "L < A > R : {n = 1;} n > 0 {m = 2;} --> B(n, m)\n") == "LB(1,2)R");
    CHECK(step("A(1)", "A(x) : x > 0 -o> B\n") == "B");
    CHECK(step("A(1)B", "A(x) : {n = x;} --> C(n)\nB : n > 0 --> D\n") == "C(1)D");
    quote(
        "`*` means an empty context, a condition that always holds, or an empty successor. A successor may also be "
        "empty, with a warning.");
    CHECK(step("ABC(2)", "* < B > * --> *\nC(x) : * {y = x;} --> D(y)\n") == "AD(2)");
    CHECK(step("AB", "A -->\nB --> C\n") == "C");
    CHECK(reading_warnings(lsystem_of("", "AB", "A -->\nB --> C\n")).size() == 1);
    quote("The strict predecessor may consist of several modules, which are replaced together.");
    CHECK(step("ABABA", "AB --> X\n") == "XXA");
    CHECK(step("A(1)BCA(2)B", "A(x)B > C --> X(x)\n") == "X(1)CA(2)B");
    quote("Parameters of the predecessor and of the contexts are names. Each name occurs only once in a production.");
    CHECK(mistake(lsystem_of("", "A(1)", "A(x) < B(x) --> C\n")).find("two parameters") != std::string::npos);
    CHECK(mistake(lsystem_of("", "A(1)", "A(1) --> C\n")).find("the name of a parameter") != std::string::npos);
    quote(
        "The parameters of the successor are expressions in the parameters of the predecessor and the "
        "contexts, variables and arrays.");
    CHECK(step("L(2)A(3)R(5,7)", "L(l) < A(x) > R(r, s) --> B(l + x * r - s + n + a[1])\n",
               "Start: { n = 100; a[1] = 1000; }\ndefine: { array a[2]; }\n") == "L(2)B(1110)R(5,7)");
}

TEST_CASE("4.1 which production is applied", "[conformance]") {
    quote(
        "The first production that matches, in the order of the file, replaces its modules. A module without a "
        "matching production is copied.");
    CHECK(step("A(1)A(5)C(3)", "A(x) : x > 2 --> B\nA(x) --> D\nA(x) --> E\n") == "DBC(3)");
    quote(
        "A production matches if its strict predecessor, its right context and its left context match, tested in this "
        "order. Then the parameters get their values, the block before the condition runs, and the condition must not "
        "be 0.");
    CHECK(step("LARLA", "L < A > R : {n = n + 1;} n == 1 --> X(n)\nA : {n = n + 10;} n > 1 --> Y(n)\n") ==
          "LX(1)RLY(11)");
    quote("Assignments in the block before the condition remain, even if the condition fails.");
    CHECK(step("A(1)", "A(x) : {n = n + x;} 0 --> B\nA(x) --> C(n)\n") == "C(1)");
    quote(
        "The block after the condition runs only if the production is applied, before the parameters of the successor "
        "are evaluated.");
    CHECK(step("A(1)A(2)", "A(x) : x > 1 {n = n + 1;} --> B(n)\nA(x) --> C(n)\n") == "C(0)B(1)");
    quote(
        "Productions are applied from left to right through the string, and each sees the variables that earlier ones "
        "assigned.");
    CHECK(step("AAA", "A : {n = n + 1;} --> B(n)\n") == "B(1)B(2)B(3)");
}

TEST_CASE("4.3 stochastic L-systems", "[conformance]") {
    quote(
        "With a `seed:` line, one of the matching productions is chosen at random. Its probability is its weight "
        "divided by the sum of the weights of all matching productions.");
    std::string axiom;
    for (int i = 0; i < 4000; ++i) axiom += "A(1)";
    const std::string drawn = step(axiom,
                                   "A(x) --> B : 2 * x\nA(x) : x > 0 --> C : 6\nA(x) : x < 0 --> D : 100\n"
                                   "A(x) --> E : 0\nA(x) --> F : x\n",
                                   "seed: 7\n");
    std::map<char, int> counts;
    for (const char c : drawn) ++counts[c];
    CHECK(counts['B'] + counts['C'] + counts['F'] == 4000);
    CHECK(std::abs(counts['B'] - 4000 * 2 / 9) < 130);  // five standard deviations
    CHECK(std::abs(counts['C'] - 4000 * 6 / 9) < 150);
    quote(
        "A weight is an expression that must not be negative; the default is 1. Weights without a `seed:` line are an "
        "error.");
    CHECK(step("AAAA", "A --> B : 0\nA --> C\n", "seed: 1\n") == "CCCC");
    CHECK(step("A(2)", "A(x) --> B : x / 3\n", "seed: 1\n") == "B");
    CHECK(mistake(lsystem_of("", "A", "A --> B : 1\n")).find("a weight needs a 'seed: number' line") !=
          std::string::npos);
}

TEST_CASE("5 contexts and branches", "[conformance]") {
    const auto proves = [](const std::string& production, const std::string& axiom, const std::string& gives) {
        INFO(production << " on " << axiom);
        quote("| `" + production + " --> X` | `" + axiom + "` | gives `" + gives + "`");
        CHECK(step(axiom, production + " --> X\n") == gives);
    };
    proves("B < A", "B[C]A", "B[C]X");
    proves("B < A", "B[+A]", "B[+A]");
    proves("B < A", "B[[A]]", "B[[X]]");
    proves("A > B", "A[C]B", "X[C]B");
    proves("A > [C]B", "A[C[D]E]B", "A[C[D]E]B");
    proves("A > [C=]B", "A[C[D]E]B", "X[C[D]E]B");
    proves("A > [C[D]E]B", "A[C[D]E]B", "X[C[D]E]B");
    quote(
        "The left context is searched towards the beginning of the axis. Closed branches and opening brackets are "
        "skipped.");
    CHECK(step("C[D]B[[E]F[A]]", "CB < A --> X\n") == "C[D]B[[E]F[A]]");
    CHECK(step("C[D]B[[E][A]]", "CB < A --> X\n") == "C[D]B[[E][X]]");
    quote(
        "The right context skips side branches unless the pattern contains their bracket. The search ends at the end "
        "of the branch.");
    CHECK(step("[A[C][D]B]B", "A > BB --> X\n") == "[A[C][D]B]B");
    CHECK(step("[A[C][D]BE]B", "A > BE --> X\n") == "[X[C][D]BE]B");
    CHECK(step("A[C]B", "A > [C]B --> X\n") == "X[C]B");
}

TEST_CASE("5 ignore and consider", "[conformance]") {
    quote(
        "`ignore: symbols` lists the symbols that contexts skip, and `consider: symbols` lists the only symbols that "
        "contexts do not skip. Use one or the other. Neither affects the strict predecessor.");
    CHECK(step("B+(3)FA", "B < A --> X\n", "ignore: + - F\n") == "B+(3)FX");
    CHECK(step("B+FA", "B < A --> X\n", "ignore: +\n") == "B+FA");
    CHECK(step("B+FA", "B < A --> X\n", "consider: AB\n") == "B+FX");
    CHECK(step("B+FA", "B < + --> X\n", "ignore: +\n") == "BXFA");
    CHECK(step("BA", "B < A --> X\n", "ignore:\n") == "BX");
    CHECK(step("BA", "B < A --> X\n", "ignore: *\n") == "BX");
    CHECK(mistake(lsystem_of("ignore: F\nconsider: B\n", "A", "A --> A\n")).find("exclude each other") !=
          std::string::npos);
    quote(
        "Left contexts always recognise brackets, even ignored ones. Right contexts apply the list first: if brackets "
        "are ignored, or not considered, they enter branches as if these belonged to the axis, so that `A > B` matches "
        "`A[B]`. Write `consider: AB[]` to avoid this.");
    CHECK(step("B[C]A", "B < A --> X\n", "ignore: []\n") == "B[C]X");
    CHECK(step("B[C]A", "C < A --> X\n", "consider: ABC\n") == "B[C]A");
    CHECK(step("A[B]", "A > B --> X\n", "consider: A B\n") == "X[B]");
    CHECK(step("A[B]", "A > B --> X\n", "ignore: []\n") == "X[B]");
    CHECK(step("A[B]", "A > B --> X\n", "consider: AB[]\n") == "A[B]");
    CHECK(step("A[B]", "A > B --> X\n") == "A[B]");
}

TEST_CASE("5 rings, and contexts of the old string", "[conformance]") {
    quote("With `ring lsystem`, the last module is the left neighbour of the first.");
    CHECK(step("ABC", "C < A --> X\nC > A --> Y\n", "ring lsystem\n") == "XBY");
    CHECK(step("ABC", "C < A --> X\nC > A --> Y\n") == "ABC");
    quote("Contexts are matched in the string before the step.");
    CHECK(step("BAAA", "B < A --> B\nB --> A\n") == "ABAA");
    CHECK(step("BAAA", "B < A --> B\nB --> A\n", "derivation length: 3\n") == "AAAB");
}
