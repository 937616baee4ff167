// Section 14.1 of docs/language.md: the arithmetic of cpfg, and that of everybody else beside it.
#include "conformance.h"

using namespace espalier;
using namespace espalier::language;
using namespace espalier::test;

namespace {

std::string in_cpfg(const std::string& text) {
    ReadOptions cpfg;
    cpfg.arithmetic = Arithmetic::cpfg;
    return derived(text, cpfg);
}

std::string after(int steps, const std::string& axiom, const std::string& productions) {
    return lsystem_of("derivation length: " + std::to_string(steps) + "\n", axiom, productions);
}

}  // namespace

TEST_CASE("14.1 parameters are 32-bit floats, expressions are not", "[conformance]") {
    quote("Parameters are rounded to 32-bit floats when they are written to the string");
    const std::string clock = after(100, "A(0)", "A(t) : t+0.02<2 --> A(t+0.02)\nA(t) : t+0.02>=2 --> B(t+0.02)\n");
    CHECK(in_cpfg(clock) == "A(2)");
    CHECK(derived(clock) == "B(2)");
    // 0.1 + 0.2 is compared in double precision.
    const std::string sum = after(1, "A", "A : 0.1+0.2==0.3 --> B\nA --> C\n");
    CHECK(in_cpfg(sum) == derived(sum));
    const std::string axiom = after(1, "A(0.1)", "A(x) : x==0.1 --> B\n");
    CHECK(in_cpfg(axiom) == "A(0.1)");
    CHECK(derived(axiom) == "B");
    // Variables keep all their digits.
    const std::string variable =
        lsystem_of("derivation length: 1\nStart: {v = 0.1;}\n", "A(v)", "A(x) : v==0.1 && x!=v --> B\n");
    CHECK(in_cpfg(variable) == "B");
    CHECK(derived(variable) == "A(0.1)");
}

TEST_CASE("14.1 parameters that become infinite as 32-bit floats are errors", "[conformance]") {
    const std::string large = after(1, "A(1e30)", "A(x) --> A(x*1e30)\n");
    CHECK_THROWS_AS(in_cpfg(large), RunError);
    CHECK(derived(large) == "A(1e+60)");
}

TEST_CASE("14.1 divisions, rounding and subscripts", "[conformance]") {
    quote("A division by zero divides by 1: `x / 0` is x, and `x % 0` is 0.");
    CHECK(in_cpfg(after(1, "A(3,0)", "A(x,y) --> B(x/y,x%y)\n")) == "B(3,0)");
    quote("`trunc(x)` rounds: `trunc(2.5)` is 3.");
    CHECK(in_cpfg(after(0, "A(trunc(2.5))", "B --> C\n")) == "A(3)");
    quote("A subscript out of range is the nearest one in range.");
    const std::string turns =
        lsystem_of("define: { array turn0[7] = {0,1,2,3,4,5,6}; }\n", "A(turn0[7],turn0[-1])", "B --> C\n");
    CHECK(in_cpfg(turns) == "A(6,0)");
    CHECK_THROWS_AS(derived(turns), RunError);
}

TEST_CASE("14.1 || has the value of a compound left operand, in its lowest byte", "[conformance]") {
    quote(
        "`a || b` is a where a holds and is more than a number or a name: `-2 || 1` is -2, `2 || 1` is 1. It is 1 "
        "where the");
    quote("integer part of a is a multiple of 256: `x - 2.5 || 0` is 1 for x = 3.");
    const std::string either = after(1, "A(-2,0)", "A(x,y) --> A(-2||1,x||1,y||3)\n");
    CHECK(in_cpfg(either) == "A(-2,1,1)");
    CHECK(derived(either) == "A(1,1,1)");
    const auto of = [&](const std::string& a, const std::string& x) {
        return in_cpfg(after(1, "A(" + x + ",0)", "A(x,y) --> A(" + a + ")\n"));
    };
    CHECK(of("2||1", "3") == "A(1)");
    CHECK(of("x-2.5||0", "3") == "A(1)");
    CHECK(of("-x||y", "3") == "A(-3)");
    CHECK(of("x*128||0", "2") == "A(1)");
    CHECK(of("x*128||0", "3") == "A(384)");
    CHECK(of("x*128||0", "0") == "A(0)");
    CHECK(of("x*128||0", "-4") == "A(1)");
    CHECK(of("1+1||0", "3") == "A(2)");
    CHECK(of("y||x||x", "3") == "A(1)");
    CHECK(of("(x-2.5||0)?5:6", "3") == "A(5)");
    const std::string global = lsystem_of("Start: {g = 2;}\n", "A(g*128||0,g||0,g*3||0)", "B --> C\n");
    CHECK(in_cpfg(global) == "A(1,1,6)");
}

TEST_CASE("a string of which nothing is left is empty in both arithmetics", "[conformance]") {
    const std::string gone = after(2, "AB", "A --> *\nB --> *\n");
    CHECK(in_cpfg(gone).empty());
    CHECK(derived(gone).empty());
    const std::string cut = after(2, "A", "A --> %\n");
    CHECK(in_cpfg(cut).empty());
    CHECK(derived(cut).empty());
    // What is dead stays dead, whatever productions there are.
    const std::string late = after(3, "A", "A : Q < 2 --> *\nA --> B(Q)\n");
    CHECK(in_cpfg(late).empty());
    CHECK(derived(late).empty());
}

TEST_CASE("14.1 parentheses do not separate ?: from what stands before them", "[conformance]") {
    quote("`5 * (1 ? g * g : 2)` is 9 for g = 3");
    const std::string product = after(1, "A(3)", "A(g) --> A(5*(1?g*g:2),5*(g>4?g:2),(1?g:2)*5,5*((1?g:2)+0))\n");
    CHECK(in_cpfg(product) == "A(9,2,15,15)");
    CHECK(derived(product) == "A(45,10,15,15)");
}

TEST_CASE("14.1 brackets in a left context never match", "[conformance]") {
    quote("A production with a bracket in its left context never applies.");
    const std::string branch = after(1, "A[B]C", "[B] < C --> D\nC --> E\n");
    CHECK(in_cpfg(branch) == "A[B]E");
    CHECK(derived(branch) == "A[B]D");
    CHECK(in_cpfg(after(1, "A[B]C", "[B] < C --> D\n")) == "A[B]C");
    CHECK(in_cpfg(after(1, "A[B]C[D]", "A < C > [D] --> E\n")) == "A[B]E[D]");
    CHECK(in_cpfg(after(1, "[B]X", "X --> C\ndecomposition\n[B] < C --> D\n")) == "[B]C");
}
