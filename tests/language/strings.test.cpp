#include "espalier/lsystem/derivation.h"

#include "catch.h"
#include "reading.h"

#include <algorithm>

using namespace espalier;
using namespace espalier::language;
using namespace espalier::test;

namespace {

std::string string_after(const std::string& text, int steps) {
    const auto model = read(text);
    Derivation derivation(compile(model));
    ModuleString string;
    ModuleString next;
    derivation.start(string);
    for (int step = 0; step < steps; ++step) {
        derivation.step(string, next);
        std::swap(string, next);
    }
    return to_text(string, model->alphabet);
}

std::string string_after(const std::string& axiom, const std::string& rules, int steps,
                         const std::string& header = "") {
    return string_after(lsystem_of(header, axiom, rules), steps);
}

auto count(const std::string& text, char symbol) {
    return std::count(text.begin(), text.end(), symbol);
}

}  // namespace

TEST_CASE("rewriting is parallel, letter for letter", "[language]") {
    CHECK(string_after("F--F--F", "F --> F+F--F+F\n", 1) == "F+F--F+F--F+F--F+F--F+F--F+F");
    const std::string rules = "a --> ab\nb --> a\n";
    CHECK(string_after("b", rules, 5) == "abaababa");
    CHECK(string_after("b", rules, 12).size() == 233);
}

TEST_CASE("the three plants of the book have their published numbers of letters", "[language]") {
    const std::string a = string_after("F", "F --> F[+F]F[-F]F\n", 5);
    CHECK(a.size() == 7811);
    CHECK(count(a, 'F') == 3125);
    CHECK(count(a, '[') == 1562);
    const std::string b = string_after("F", "F --> FF[-F+FF][+F-F-F]\n", 4);
    CHECK(b.size() == 9361);
    CHECK(count(b, 'F') == 4096);
    CHECK(count(b, '[') == 1170);
    const std::string c = string_after("X", "X --> F-[[X]+X]+F[+FX]-X\nF --> FF\n", 5);
    CHECK(c.size() == 6263);
    CHECK(count(c, 'F') == 1488);
    CHECK(count(c, '[') == 1023);
}

TEST_CASE("the bush has 243 apices, 420 F, 285 L and 135 leaves after 5 steps", "[language]") {
    // Apostrophes quote for the preprocessor, so that the slashes between two of them are no comment.
    const auto bush = [](const std::string& first, const std::string& second, const std::string& third) {
        return string_after("A",
                            "A --> [&FL!A]" + first + "'[&FL!A]" + second + "'[&FL!A]\nF --> S " + third +
                                "F\nS --> F L\nL --> ['''^^{-f+f+f-|-f+f+f}]\n",
                            5);
    };
    const std::string five = "/ / / / / ";
    const std::string text = bush(five, "/ / / / / / / ", five);
    CHECK(count(text, 'A') == 243);
    CHECK(count(text, 'F') == 420);
    CHECK(count(text, 'L') == 285);
    CHECK(count(text, '{') == 135);
    CHECK(text.size() == 8294);
    const std::string eight = "/ / / / / / / / ";
    CHECK(bush(eight, eight, eight).size() == 9354);
}

TEST_CASE("a module matches on symbol and number of parameters, the first production whose condition holds wins",
          "[language]") {
    const std::string rules = "A(x) : x > 2 --> B(x)\nA(x) : x > 1 --> C(x)\nA --> D\n";
    CHECK(string_after("A(3)A(2)A(1)AA(1,2)", rules, 1) == "B(3)C(2)A(1)DA(1,2)");
}

TEST_CASE("a signal moves one place a step", "[language]") {
    CHECK(string_after("baaaaaaaa", "b < a --> b\nb --> a\n", 2) == "aabaaaaaa");
}

TEST_CASE("left and right contexts skip branches and climb out of them", "[language]") {
    const std::string plant = "AB[C[D[EF]G][HIJ]K]L[MN]O[[PQR]ST[UV]WY]Z";
    const auto neighbours = [&](bool left) {
        std::string found;
        for (char symbol = 'A'; symbol <= 'Z'; ++symbol) {
            for (char other = 'A'; other <= 'Z'; ++other) {
                if (plant.find(symbol) == std::string::npos || plant.find(other) == std::string::npos) continue;
                const std::string s(1, symbol);
                const std::string o(1, other);
                const std::string rule = left ? o + " < " + s + " --> *\n" : s + " > " + o + " --> *\n";
                if (string_after(plant, rule, 1).size() < plant.size()) found += s + "-" + o + " ";
            }
        }
        return found;
    };
    CHECK(neighbours(true) ==
          "B-A C-B D-C E-D F-E G-D H-C I-H J-I K-C L-B M-L N-M O-L P-O Q-P R-Q S-O T-S U-T V-U W-T Y-W Z-O ");
    CHECK(neighbours(false) == "A-B B-L C-K D-G E-F H-I I-J L-O M-N O-Z P-Q Q-R S-T T-W U-V W-Y ");
}

TEST_CASE("a named branch matches completely, = skips to its end", "[language]") {
    CHECK(string_after("A[C[D]E]F", "A > [C]F --> B\n", 1) == "A[C[D]E]F");
    CHECK(string_after("A[C[D]E]F", "A > [C=]F --> B\n", 1) == "B[C[D]E]F");
    CHECK(string_after("A[C[D]E]F", "A > [C[D]E]F --> B\n", 1) == "B[C[D]E]F");
}

TEST_CASE("ignored symbols are invisible to contexts", "[language]") {
    CHECK(string_after("A+B", "A < B --> C\n", 1) == "A+B");
    CHECK(string_after("A+B", "A < B --> C\n", 1, "ignore: +-\n") == "A+C");
}

TEST_CASE("numbers are computed as the language says", "[language]") {
    CHECK(string_after("A(2^3^2)B(-2^2)C(7%4)", "D --> D\n", 0) == "A(64)B(4)C(3)");
    CHECK(string_after("A(1)", "A(x) --> A(x * 2)\n", 10) == "A(1024)");
}

TEST_CASE("blocks run in their order and their names are seen everywhere", "[language]") {
    CHECK(string_after("A(n, Q)", "A(x, y) : {m = x;} m > 0 {k = n;} --> A(k, Q)\n", 3,
                       "Start: { n = 10; }\nStartEach: { n += 1; }\nEndEach: { n *= 2; }\n") == "A(47,3)");
}

TEST_CASE("loops, branches and arrays compute", "[language]") {
    CHECK(string_after("A(s, t)", "B --> B\n", 0,
                       "define: { array a[3][2] = {1, 2, 3, 4, 5, 6}; }\nStart: {\n s = 0; t = 0;\n"
                       "for (i = 0; i < 3; i++) { for (j = 0; j < 2; j++) { s += a[i][j]; } }\n"
                       "while (1) { t += 1; if (t > 6) { break; } else if (t == 3) { t = 5; } }\n}\n") == "A(21,7)");
}

TEST_CASE("decomposition is applied within the step", "[language]") {
    CHECK(string_after("A", "A --> B\ndecomposition\nmaximum depth: 2\nB --> CC\nC --> D\n", 1) == "DD");
}

TEST_CASE("modules with names of several letters are written like any other", "[language]") {
    CHECK(string_after("module Apex(age), Internode(length);\n" +
                           lsystem_of("", "Apex(0)", "Apex(a) --> Internode(a + 1)[+Apex(a + 1)]Apex(a + 1)\n"),
                       2) == "Internode(1)[+Internode(2)[+Apex(2)]Apex(2)]Internode(2)[+Apex(2)]Apex(2)");
}
