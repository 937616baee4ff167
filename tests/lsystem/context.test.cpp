#include "catch.h"
#include "lsystem/model_builder.h"

#include <ctime>
#include <functional>
#include <map>
#include <string>

using namespace espalier;
using namespace espalier::lsystem;
using namespace espalier::test;

namespace {

const std::string branching = "AB[C[D[EF]G][HIJ]K]L[MN]O[[PQR]ST[UV]WY]Z";

/// The string with every `target` that has the context replaced by `x`.
std::string marked(std::string_view string, std::string_view left, std::string_view target, std::string_view right,
                   const std::function<void(ModelBuilder&)>& prepare = {}) {
    ModelBuilder model;
    model.system().axiom = model.word(string);
    model.rule(left, target, right, "x");
    if (prepare) prepare(model);
    return text_after(model, 1);
}

bool applies(std::string_view string, std::string_view left, std::string_view target, std::string_view right,
             const std::function<void(ModelBuilder&)>& prepare = {}) {
    return marked(string, left, target, right, prepare).find('x') != std::string::npos;
}

}  // namespace

TEST_CASE("a signal moves one place per step", "[lsystem]") {
    ModelBuilder model;
    model.system().axiom = model.word("baaaaaaaa");
    model.rule("b", "a", "", "b");
    model.rule("b", "a");
    CHECK(text_after(model, 1) == "abaaaaaaa");
    CHECK(text_after(model, 2) == "aabaaaaaa");
    CHECK(text_after(model, 8) == "aaaaaaaab");
}

// The table of left and right neighbours of ABOP's bracketed example, letter by letter.
TEST_CASE("left contexts climb to the parent and skip finished branches", "[lsystem]") {
    const std::map<char, char> left = {{'B', 'A'}, {'C', 'B'}, {'D', 'C'}, {'E', 'D'}, {'F', 'E'}, {'G', 'D'},
                                       {'H', 'C'}, {'I', 'H'}, {'J', 'I'}, {'K', 'C'}, {'L', 'B'}, {'M', 'L'},
                                       {'N', 'M'}, {'O', 'L'}, {'P', 'O'}, {'Q', 'P'}, {'R', 'Q'}, {'S', 'O'},
                                       {'T', 'S'}, {'U', 'T'}, {'V', 'U'}, {'W', 'T'}, {'Y', 'W'}, {'Z', 'O'}};
    for (char target = 'A'; target <= 'Z'; ++target) {
        if (target == 'X') continue;
        for (char neighbour = 'A'; neighbour <= 'Z'; ++neighbour) {
            const auto found = left.find(target);
            const bool expected = found != left.end() && found->second == neighbour;
            INFO(neighbour << " < " << target);
            CHECK(applies(branching, std::string(1, neighbour), std::string(1, target), "") == expected);
        }
    }
}

TEST_CASE("right contexts stay on the axis", "[lsystem]") {
    const std::map<char, char> right = {{'A', 'B'}, {'B', 'L'}, {'C', 'K'}, {'D', 'G'}, {'E', 'F'}, {'H', 'I'},
                                        {'I', 'J'}, {'L', 'O'}, {'M', 'N'}, {'O', 'Z'}, {'P', 'Q'}, {'Q', 'R'},
                                        {'S', 'T'}, {'T', 'W'}, {'U', 'V'}, {'W', 'Y'}};
    for (char target = 'A'; target <= 'Z'; ++target) {
        if (target == 'X') continue;
        for (char neighbour = 'A'; neighbour <= 'Z'; ++neighbour) {
            const auto found = right.find(target);
            const bool expected = found != right.end() && found->second == neighbour;
            INFO(target << " > " << neighbour);
            CHECK(applies(branching, "", std::string(1, target), std::string(1, neighbour)) == expected);
        }
    }
}

TEST_CASE("contexts of several modules follow the axis", "[lsystem]") {
    CHECK(applies(branching, "ABC", "D", ""));
    CHECK(applies(branching, "BLO", "S", "TW"));
    CHECK(applies("ABC[DE][SG[HI[JK]L]MNO]", "BC", "S", "G[H=]M"));  // ABOP 1.8
    CHECK_FALSE(applies("ABC[DE][SG[HI[JK]L]MNO]", "BC", "S", "G[H]M"));
}

TEST_CASE("a right context may name a branch", "[lsystem]") {
    CHECK_FALSE(applies("A[C[D]E]F", "", "A", "[C]F"));
    CHECK(applies("A[C[D]E]F", "", "A", "[C=]F"));
    CHECK(applies("A[C[D]E]F", "", "A", "[C[D]E]F"));
    CHECK(applies("A[C]F", "", "A", "[C]F"));
    CHECK_FALSE(applies("AF", "", "A", "[C]F"));
    CHECK_FALSE(applies("A[CF", "", "A", "[C=]F"));
}

TEST_CASE("ignored modules are passed over", "[lsystem]") {
    const auto ignoring = [](ModelBuilder& model) {
        model.system().filter = LSystem::Filter::ignore;
        model.system().filtered = {model.model().alphabet.symbol("+"), model.model().alphabet.symbol("-")};
    };
    CHECK(applies("A++S-+B", "A", "S", "B", ignoring));
    CHECK_FALSE(applies("A++S-+B", "A", "S", "B"));
    CHECK(applies("A[+B]-S", "A", "S", "", ignoring));
}

TEST_CASE("a consider list without brackets flattens branches in right contexts only", "[lsystem]") {
    const auto considering = [](std::string_view symbols) {
        return [symbols](ModelBuilder& model) {
            model.system().filter = LSystem::Filter::consider;
            for (const char symbol : symbols) {
                model.system().filtered.push_back(model.model().alphabet.symbol(std::string(1, symbol)));
            }
        };
    };
    CHECK(applies("A[B]", "", "A", "B", considering("AB")));
    CHECK_FALSE(applies("A[B]", "", "A", "B", considering("AB[]")));
    CHECK(applies("A[B]C", "", "A", "C", considering("ABC[]")));
    CHECK_FALSE(applies("A[B]C", "", "A", "C", considering("ABC")));
    CHECK(applies("A[B]C", "A", "C", "", considering("ABC")));
}

TEST_CASE("in a ring the first and the last module are neighbours", "[lsystem]") {
    const auto ring = [](ModelBuilder& model) { model.system().ring = true; };
    CHECK(marked("ABC", "C", "A", "", ring) == "xBC");
    CHECK(marked("ABC", "", "C", "AB", ring) == "ABx");
    CHECK(marked("ABC", "C", "A", "") == "ABC");
    CHECK_FALSE(applies("+++", "Z", "+", "Z", ring));
}

TEST_CASE("a successor reads parameters of its context", "[lsystem]") {
    ModelBuilder model;
    model.system().axiom = {model.module("L", {number(2)}), model.module("[", {}),
                            model.module("B", {number(9)}), model.module("]", {}),
                            model.module("S", {number(3)}), model.module("R", {number(5)})};
    model.add(model.make({{"L", 1}}, {{"S", 1}}, {{"R", 1}},
                         {model.module("S", {formal(0) * number(100) + formal(1) * number(10) + formal(2)})}));
    CHECK(text_after(model, 1) == "L(2)[B(9)]S(235)R(5)");
}

TEST_CASE("unmatched brackets end contexts quietly", "[lsystem]") {
    CHECK_FALSE(applies("]A]B[C[", "Z", "A", "Z"));
    CHECK_FALSE(applies("[[[A", "Z", "A", "B"));
    CHECK(applies("B[[A", "B", "A", ""));
}

TEST_CASE("right contexts across deeply nested branches take linear time", "[lsystem]") {
    const auto seconds = [](std::size_t depth, bool context) {
        ModelBuilder model;
        std::string nested;
        for (std::size_t k = 0; k < depth; ++k) nested += "A[";
        nested += 'A';
        nested.append(depth, ']');
        nested += 'B';
        model.system().axiom = model.word(nested);
        if (context)
            model.rule("", "A", "B", "A");
        else
            model.rule("A", "A");
        Derivation derivation(model.compiled());
        ModuleString string, next;
        derivation.start(string);
        derivation.step(string, next);
        const std::clock_t begin = std::clock();
        for (int k = 0; k < 20; ++k) derivation.step(string, next);
        return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    };
    // Processor time, since the machine may be busy; quadratic matching would take 256 times as long.
    CHECK(seconds(64'000, true) < 16 * 5 * seconds(4'000, true) + 0.05);
}
