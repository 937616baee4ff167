#include "catch.h"
#include "lsystem/model_builder.h"

#include <algorithm>
#include <cmath>
#include <set>

using namespace espalier;
using namespace espalier::lsystem;
using namespace espalier::test;

TEST_CASE("productions are chosen with the frequency of their weights", "[lsystem]") {
    ModelBuilder chooser;
    chooser.system().seed = number(1);
    constexpr std::size_t n = 100'000;
    chooser.system().axiom = chooser.word(std::string(n, 'F'));
    const double weights[] = {33, 33, 34};  // weights are normalised by their sum
    const char* names[] = {"a", "b", "c"};
    for (int k = 0; k < 3; ++k) chooser.rule("F", names[k]).weight = number(weights[k]);
    const std::string text = text_after(chooser, 1);
    double chi_square = 0;
    for (int k = 0; k < 3; ++k) {
        const double expected = n * weights[k] / 100;
        const double difference = static_cast<double>(std::count(text.begin(), text.end(), names[k][0])) - expected;
        chi_square += difference * difference / expected;
    }
    CHECK(chi_square < 9.21);  // p > 0.01 with 2 degrees of freedom
    CHECK(text_after(chooser, 1) == text);
}

TEST_CASE("a production of weight 0 is never chosen, and none if all are", "[lsystem]") {
    ModelBuilder model;
    model.system().seed = number(1);
    model.system().axiom = model.word(std::string(1000, 'F') + "G");
    model.rule("F", "a").weight = number(0);
    model.rule("F", "b").weight = number(0.1);
    model.rule("G", "a").weight = number(0);
    CHECK(text_after(model, 1) == std::string(1000, 'b') + "G");
    model.rule("G", "c").weight = number(-1);
    CHECK_THROWS_AS(text_after(model, 1), RunError);
}

TEST_CASE("a module's draws do not depend on its neighbours", "[lsystem]") {
    const auto angle = [](int extra) {
        ModelBuilder model;
        model.system().axiom = {model.module("A", {}), model.module("B", {})};
        std::vector<ModuleTemplate> successor = {model.module("A", {})};
        for (int k = 0; k < extra; ++k) successor.push_back(model.module("C", {call(Function::ran, {number(1)})}));
        model.rule({{"A", 0}}, successor);
        model.rule({{"B", 0}}, {model.module("B", {}), model.module("D", {call(Function::ran, {number(1)})})});
        Derivation derivation(model.compiled(), with_lineage());
        const ModuleString string = grow(derivation, 3);
        return std::vector<double>(string.parameters.end() - 3, string.parameters.end());
    };
    CHECK(angle(0) == angle(5));
}

TEST_CASE("the seed, the plant and srand change what is drawn", "[lsystem]") {
    ModelBuilder model;
    model.system().axiom = {model.module("A", {})};
    model.rule({{"A", 0}}, {model.module("D", {call(Function::ran, {number(1)})})});
    const std::string text = text_after(model, 1, with_lineage(1));
    CHECK(text_after(model, 1, with_lineage(1)) == text);
    CHECK(text_after(model, 1, with_lineage(2)) != text);
    CHECK(text_after(model, 1, with_lineage(1, 1)) != text);
    model.system().start = {run(call(Function::srand, {number(5)}))};
    CHECK(text_after(model, 1, with_lineage(1)) != text);
}

TEST_CASE("srand in a production begins the sequence anew", "[lsystem]") {
    ModelBuilder model;
    model.system().axiom = {model.module("A", {}), model.module("A", {})};
    Production& rule = model.rule({{"A", 0}}, {model.module("D", {call(Function::ran, {number(1)})})});
    rule.before = {run(call(Function::srand, {number(5)}))};
    Derivation derivation(model.compiled(), with_lineage());
    const ModuleString string = grow(derivation, 1);
    CHECK(string.parameters[0] == string.parameters[1]);
}

TEST_CASE("a rewritten module lives on in the first module of its symbol", "[lsystem]") {
    ModelBuilder model;
    model.system().axiom = model.word("A");
    model.rule("A", "F[A]A");
    Derivation derivation(model.compiled(), with_lineage());
    ModuleString axiom, first, second;
    derivation.start(axiom);
    derivation.step(axiom, first);   // F[A]A
    derivation.step(first, second);  // F[F[A]A]F[A]A
    CHECK(first.identity(2) == axiom.identity(0));
    CHECK(first.step_of_birth(2) == 0);
    CHECK(first.parent(2) == 0);
    for (const std::size_t child : {0, 1, 3, 4}) {
        CHECK(first.parent(child) == axiom.identity(0));
        CHECK(first.step_of_birth(child) == 1);
    }
    CHECK(second.identity(0) == first.identity(0));  // F is copied
    CHECK(second.identity(4) == first.identity(2));  // F[ F[A ...: the inner A
    CHECK(second.parent(2) == first.identity(2));
    CHECK(second.step_of_birth(2) == 2);
    const std::vector<Identity> all = identities_of(second);
    const std::set<Identity> distinct(all.begin(), all.end());
    CHECK(distinct.size() == second.size());
}

TEST_CASE("each strict module hands its identity to a module of its own symbol", "[lsystem]") {
    ModelBuilder model;
    model.system().axiom = model.word("AB");
    model.add(model.make({}, ModelBuilder::patterns("AB"), {}, model.word("BCAB")));
    Derivation derivation(model.compiled(), with_lineage());
    ModuleString axiom, next;
    derivation.start(axiom);
    derivation.step(axiom, next);
    CHECK(next.identity(0) == axiom.identity(1));
    CHECK(next.identity(2) == axiom.identity(0));
    CHECK(next.parent(1) == axiom.identity(0));
    CHECK(next.parent(3) == axiom.identity(0));
    CHECK(next.identity(1) != next.identity(3));
}

TEST_CASE("identities of two plants of one model differ, of one plant with two seeds do not", "[lsystem]") {
    const auto identities = [](std::uint64_t seed, std::uint32_t plant) {
        ModelBuilder model;
        model.system().axiom = model.word("A");
        model.rule("A", "F[A]A");
        Derivation derivation(model.compiled(), with_lineage(seed, plant));
        const ModuleString string = grow(derivation, 3);
        return identities_of(string);
    };
    CHECK(identities(1, 0) == identities(2, 0));
    const auto first = identities(1, 0);
    for (const Identity identity : identities(1, 1)) CHECK(std::count(first.begin(), first.end(), identity) == 0);
}

namespace {

/// A stochastic plant whose string is the same whatever is done to make the engine take another way.
ModuleString grown_by(const std::string& way, bool lineage = true) {
    ModelBuilder model;
    model.system().seed = number(1);
    const Expression draw = call(Function::ran, {number(1)});
    model.system().axiom = {model.module("A", {number(0)}), model.module("A", {number(1)})};
    model.rule({{"A", 1}}, {model.module("F", {draw}), model.module("[", {}), model.module("A", {formal(0) + draw}),
                            model.module("]", {}), model.module("A", {draw})});
    model.rule({{"A", 1}}, {model.module("A", {draw}), model.module("F", {formal(0)})});
    model.rule({{"F", 1}}, {model.module("F", {formal(0) * number(1.1)}), model.module("L", {draw})}).weight =
        number(0.2);
    if (way == "decomposed") {
        model.system().decomposition.productions.push_back(model.make({}, {{"Z", 0}}, {}, model.word("ZZ")));
    } else if (way == "blocks") {
        model.add(model.make({}, ModelBuilder::patterns("YZ"), {}, model.word("ZY")));
    } else if (way == "ordered") {
        const std::uint32_t count = model.add_global("count");
        model.rule("Z", "Z").after = {assign(global(count), global(count) + number(1))};
    }
    DerivationSettings settings = with_lineage();
    settings.lineage = lineage;
    Derivation derivation(model.compiled(), settings);
    return grow(derivation, 18);
}

}  // namespace

TEST_CASE("steps in parallel, with decomposition and in order give the same modules, lineages and draws", "[lsystem]") {
    const ModuleString expected = grown_by("in parallel");
    REQUIRE(expected.size() > 20'000);  // several chunks
    const std::vector<Identity> all = identities_of(expected);
    const std::set<Identity> distinct(all.begin(), all.end());
    CHECK(distinct.size() == expected.size());
    for (const char* way : {"decomposed", "blocks", "ordered"}) {
        INFO(way);
        const ModuleString string = grown_by(way);
        CHECK(same(string, expected));
    }
}

TEST_CASE("models that take random numbers keep their lineage without being asked, and grow the same", "[lsystem]") {
    for (const char* way : {"in parallel", "decomposed", "blocks", "ordered"}) {
        INFO(way);
        CHECK(same(grown_by(way, false), grown_by(way)));
    }
}

TEST_CASE("a module decomposed draws the same whatever grows beside it", "[lsystem]") {
    const auto drawn = [](int extra) {
        ModelBuilder model;
        const Expression draw = call(Function::ran, {number(1)});
        model.system().axiom = {model.module("A", {}), model.module("B", {})};
        std::vector<ModuleTemplate> successor = {model.module("A", {})};
        for (int k = 0; k < extra; ++k) successor.push_back(model.module("C", {draw}));
        model.rule({{"A", 0}}, successor);
        model.rule({{"B", 0}}, {model.module("B", {}), model.module("D", {draw})});
        RuleSet& rules = model.system().decomposition;
        rules.maximum_depth = number(2);
        rules.productions.push_back(model.make({}, {{"C", 1}}, {}, {model.module("E", {draw})}));
        rules.productions.push_back(
            model.make({}, {{"D", 1}}, {}, {model.module("D", {draw}), model.module("G", {formal(0)})}));
        Derivation derivation(model.compiled(), with_lineage());
        const ModuleString string = grow(derivation, 2);
        return std::vector<double>(string.parameters.end() - 6, string.parameters.end());
    };
    CHECK(drawn(0) == drawn(5));
    const std::vector<double> values = drawn(3);
    CHECK(std::set<double>(values.begin(), values.end()).size() == values.size());
}

TEST_CASE("a picture draws for its module wherever that stands in the string", "[lsystem]") {
    const auto picture = [](const char* axiom) {
        ModelBuilder model;
        model.system().axiom = model.word("AB");
        model.rule("A", axiom);
        model.system().homomorphism.productions.push_back(
            model.make({}, {{"B", 0}}, {}, {model.module("D", {call(Function::ran, {number(1)})})}));
        Derivation derivation(model.compiled());
        const ModuleString string = grow(derivation, 1);
        BranchLinks links;
        link_branches(string, links);
        ModuleString result;
        REQUIRE(derivation.picture(string, nullptr, links, string.size() - 1, 0, result));
        return result.parameters.front();
    };
    CHECK(picture("A") == picture("AFFF"));
}

TEST_CASE("a predecessor that reaches over a cut takes its modules once", "[lsystem]") {
    ModelBuilder model;
    model.system().axiom = model.word("[A%B]C");
    model.add(model.make({}, ModelBuilder::patterns("A%B]"), {}, model.word("X]")));
    Derivation derivation(model.compiled(), with_lineage());
    const ModuleString string = grow(derivation, 1);
    CHECK(to_text(string, model.model().alphabet) == "[X]C");
    const std::vector<Identity> all = identities_of(string);
    const std::set<Identity> distinct(all.begin(), all.end());
    CHECK(distinct.size() == string.size());
}

TEST_CASE("plain derivation pays nothing for lineage", "[lsystem]") {
    ModelBuilder model;
    model.system().axiom = model.word("A");
    model.rule("A", "AA");
    Derivation derivation(model.compiled());
    CHECK_FALSE(grow(derivation, 2).has_lineage());
    ModuleString without, next;
    without.append(model.model().alphabet.letter("A", 0));
    Derivation keeping(model.compiled(), with_lineage());
    CHECK_THROWS_AS(keeping.step(without, next), RunError);
}
