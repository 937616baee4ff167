// Section 13.3 of docs/language.md: timed productions.
#include "conformance.h"

using namespace espalier;
using namespace espalier::language;
using namespace espalier::test;

namespace {

std::string timed(const std::string& axiom, const std::string& lines, int steps = 1) {
    return derived("module A(age), B(age), P(age, vigour);\n" +
                   lsystem_of("derivation length: " + std::to_string(steps) + "\n", axiom, "timed\n" + lines));
}

std::string mistake_in(const std::string& lines) {
    return mistake(lsystem_of("derivation length: 1\n", "A(0)", lines));
}

}  // namespace

TEST_CASE("13.3 ages grow by the time step, and modules are replaced at their terminal ages", "[conformance]") {
    quote(
        "The first parameter of a timed module is its age. In each step it grows by the time step (default 1), which "
        "need not divide a terminal age.");
    quote(
        "A module that has reached its terminal age is replaced at once. The modules of the successor are as much "
        "older "
        "than it says as the module is older than its terminal age, so the string of a time does not depend on the "
        "steps that led to it.");
    const std::string productions = "A(age) : age == 1 --> A(0) B(0.25)\nB(age) : age == 1.5 --> A(0)\n";
    CHECK(timed("A(0)", productions, 1) == "A(0)B(0.25)");
    CHECK(timed("A(0)", "time step: 0.75\n" + productions, 1) == "A(0.75)");
    CHECK(timed("A(0)", "time step: 0.75\n" + productions, 2) == "A(0.5)B(0.75)");
    CHECK(timed("A(0)", "time step: 0.75\n" + productions, 4) == timed("A(0)", "time step: 3\n" + productions, 1));
    // Ten tenths are one.
    CHECK(timed("A(0)", "time step: 0.1\n" + productions, 10) == "A(0)B(0.25)");
}

TEST_CASE("13.3 conditions, modules that only age, and those that are not timed", "[conformance]") {
    quote(
        "A timed production replaces one module, without context and weight, and its condition begins with the age: "
        "`age == 1`, or `age == 2 && vigour > 1`.");
    quote("`ageing: symbols` lists modules that only grow older. Modules that are not timed are copied.");
    quote(
        "Of several timed productions for a module, the first that matches applies. An ordinary production for a timed "
        "module replaces it instead of letting it grow older.");
    CHECK(timed("P(1, 5)P(1, 1)", "P(age, v) : age == 2 && v > 1 --> B(0)\nP(age, v) : age == 2 --> *\n") == "B(0)");
    CHECK(timed("A(0)B(0)F(3)", "ageing: B\nA(age) : age == 0.5 --> F(age) B(0)\n", 1) == "F(1)B(0.5)B(1)F(3)");
    CHECK(step("A(0)", "A(x) --> A(x + 10)\ntimed\nA(age) : age == 100 --> B\n") == "A(10)");
    CHECK_THAT(mistake_in("timed\nA(age) --> B\n"), Catch::Contains("says at which age"));
    CHECK_THAT(mistake_in("timed\nA(age) : 1 == age --> B\n"), Catch::Contains("says at which age"));
    CHECK_THAT(mistake_in("timed\nB < A(age) : age == 1 --> B\n"), Catch::Contains("replaces one module"));
    CHECK_THAT(mistake_in("timed\nA(age) : age == 1 --> B : 2\n"), Catch::Contains("has no weight"));
    CHECK_THAT(mistake_in("timed\nA(age) : age == -1 --> B\n"), Catch::Contains("greater than 0, not -1"));
    CHECK_THAT(mistake_in("timed\ntime step: 0\nA(age) : age == 1 --> B\n"), Catch::Contains("greater than 0, not 0"));
}

TEST_CASE("13.3 generations in one step", "[conformance]") {
    quote(
        "`maximum depth: n` (default 1000) is the largest number of generations in one step. An L-system has timed "
        "productions or a decomposition, not both.");
    const std::string production = "A(age) : age == 0.01 --> F A(0)\n";
    CHECK(timed("A(0)", "maximum depth: 3\n" + production) == "FFFA(0.97)");
    CHECK(timed("A(0)", production) == std::string(100, 'F') + "A(0)");
    CHECK_THAT(mistake_in("timed\nA(age) : age == 1 --> B\ndecomposition\nB --> C\n"), Catch::Contains("not both"));
}
