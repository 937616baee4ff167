#include "catch.h"
#include "lsystem/model_builder.h"

#include <set>

using namespace espalier;
using namespace espalier::lsystem;
using namespace espalier::test;

namespace {

RuleSet& decompose(ModelBuilder& model, std::string_view strict, std::string_view successor) {
    RuleSet& rules = model.system().decomposition;
    rules.productions.push_back(model.make({}, ModelBuilder::patterns(strict), {}, model.word(successor)));
    rules.present = true;
    return rules;
}

/// The string as it is drawn.
std::string pictured(ModelBuilder& model, int steps) {
    const auto compiled = model.compiled();
    Derivation derivation(compiled);
    const ModuleString string = grow(derivation, steps);
    BranchLinks links;
    link_branches(string, links);
    const std::vector<std::size_t> offsets = parameter_offsets(string, model.model().alphabet);
    ModuleString drawn;
    for (std::size_t i = 0; i < string.size(); ++i) {
        if (derivation.picture(string, &offsets, links, i, offsets[i], drawn)) continue;
        drawn.append(string.letters[i], {string.parameters.data() + offsets[i], offsets[i + 1] - offsets[i]});
    }
    return to_text(drawn, model.model().alphabet);
}

}  // namespace

TEST_CASE("decomposition goes as deep as it may, and the axiom's happens in step 1", "[lsystem]") {
    ModelBuilder model;
    model.system().axiom = model.word("AZ");
    model.rule("Z", "A");
    RuleSet& rules = decompose(model, "A", "bB");
    decompose(model, "B", "cC");
    decompose(model, "C", "d");
    CHECK(text_after(model, 0) == "AZ");
    CHECK(text_after(model, 1) == "bBbB");
    CHECK(text_after(model, 2) == "bcCbcC");
    rules.maximum_depth = number(2);
    CHECK(text_after(model, 1) == "bcCbcC");
    rules.maximum_depth = number(10);
    CHECK(text_after(model, 1) == "bcdbcd");
    rules.maximum_depth = number(0);
    CHECK(text_after(model, 1) == "AA");
}

TEST_CASE("recursive decomposition stops at its depth and says so once", "[lsystem]") {
    ModelBuilder model;
    model.system().axiom = model.word("A");
    RuleSet& rules = decompose(model, "A", "xA");
    rules.maximum_depth = number(4);
    int warnings = 0;
    DerivationSettings settings;
    settings.printout = std::make_shared<Printout>([&](const std::string&) { ++warnings; });
    CHECK(text_after(model, 2, settings) == "xxxxxxxxA");
    CHECK(warnings == 1);
    rules.warnings = false;
    text_after(model, 2, settings);
    CHECK(warnings == 1);
    rules.maximum_depth = number(100'000);
    CHECK(text_after(model, 1).size() == 100'001);
}

TEST_CASE("decomposition sees the context of the original string", "[lsystem]") {
    ModelBuilder model;
    model.system().axiom = model.word("LAR");
    model.rule("L", "K");
    model.rule("A", "PQ");
    RuleSet& rules = model.system().decomposition;
    rules.productions.push_back(model.make(ModelBuilder::patterns("L"), ModelBuilder::patterns("Q"),
                                           ModelBuilder::patterns("R"), model.word("q")));
    CHECK(text_after(model, 1) == "KPqR");
}

TEST_CASE("identities stay distinct when a successor is decomposed in the same step", "[lsystem]") {
    ModelBuilder model;
    model.system().axiom = model.word("A");
    model.rule("A", "AB");
    decompose(model, "A", "AB");
    decompose(model, "B", "BC");
    Derivation derivation(model.compiled(), with_lineage(1, 0));
    const ModuleString string = grow(derivation, 4);
    const std::vector<Identity> all = identities_of(string);
    const std::set<Identity> distinct(all.begin(), all.end());
    CHECK(distinct.size() == string.size());
    ModuleString axiom;
    derivation.start(axiom);
    CHECK(string.identity(0) == axiom.identity(0));
}

TEST_CASE("homomorphism changes what is drawn, not the string", "[lsystem]") {
    ModelBuilder model;
    model.system().axiom = {model.module("A", {number(2)}), model.module("F", {})};
    RuleSet& rules = model.system().homomorphism;
    rules.productions.push_back(
        model.make({}, {{"A", 1}}, {}, {model.module("F", {formal(0) * number(3)}), model.module("F", {})}));
    rules.productions.push_back(model.make({}, {{"F", 0}}, {}, model.word("xF")));
    CHECK(pictured(model, 0) == "F(6)FxF");
    rules.maximum_depth = number(3);
    CHECK(pictured(model, 0) == "F(6)xxFxxxF");
    CHECK(text_after(model, 2) == "A(2)F");
}

TEST_CASE("a picture whose production always applies is that of one with a condition that holds", "[lsystem]") {
    const auto drawn_of = [](double x, bool tested) {
        ModelBuilder model;
        model.system().axiom = {model.module("A", {number(x), number(-3)}), model.module("F", {}),
                                model.module("E", {})};
        const auto picture = [&](const char* strict, int arity, std::vector<ModuleTemplate> successor) {
            Production production = model.make({}, {{strict, arity}}, {}, std::move(successor));
            if (tested) production.condition = number(0) < number(1) + formal(0) * formal(0);
            model.system().homomorphism.productions.push_back(std::move(production));
        };
        picture("A", 2,
                {model.module("F", {formal(1) * number(2) - number(1)}),
                 model.module("G", {number(7), formal(0) * number(1e10)})});
        tested = false;
        picture("F", 0, {model.module("G", {number(0.5), number(1)})});
        picture("E", 0, {});
        return pictured(model, 0);
    };
    CHECK(drawn_of(2, false) == "F(-7)G(7,2e+10)G(0.5,1)");
    CHECK(drawn_of(2, true) == drawn_of(2, false));
    CHECK_THROWS_WITH(drawn_of(1e300, false), Catch::Contains("in module A(1e+300,-3) at step 0"));
}

TEST_CASE("homomorphism sees contexts with their parameters, with and without offsets", "[lsystem]") {
    ModelBuilder model;
    model.system().axiom = {model.module("L", {number(2)}), model.module("[", {}), model.module("L", {number(9)}),
                            model.module("]", {}),          model.module("S", {}), model.module("R", {number(5)})};
    model.system().homomorphism.productions.push_back(
        model.make({{"L", 1}}, {{"S", 0}}, {{"R", 1}}, {model.module("T", {formal(0), formal(1)})}));
    CHECK(pictured(model, 0) == "L(2)[L(9)]T(2,5)R(5)");
    Derivation derivation(model.compiled());
    const ModuleString string = grow(derivation, 0);
    BranchLinks links;
    link_branches(string, links);
    ModuleString drawn;
    CHECK(derivation.picture(string, nullptr, links, 4, 2, drawn));
    CHECK(to_text(drawn, model.model().alphabet) == "T(2,5)");
}

TEST_CASE("looking at a plant never changes its growth", "[lsystem]") {
    const auto grown = [](bool looked_at) {
        ModelBuilder model;
        const std::uint32_t n = model.add_global("n");
        model.system().axiom = model.word("A");
        model.rule({{"A", 0}},
                   {model.module("A", {}), model.module("B", {call(Function::ran, {number(1)}) + global(n)})});
        Production draws = model.make({}, {{"A", 0}}, {}, {model.module("C", {call(Function::ran, {number(1)})})});
        draws.before = {assign(global(n), number(7)), run(call(Function::srand, {number(3)}))};
        model.system().homomorphism.productions.push_back(draws);
        Derivation derivation(model.compiled());
        ModuleString string, next, picture;
        BranchLinks links;
        derivation.start(string);
        for (int k = 0; k < 4; ++k) {
            link_branches(string, links);
            if (looked_at) derivation.picture(string, nullptr, links, 0, 0, picture);
            derivation.step(string, next);
            std::swap(string, next);
        }
        return to_text(string, model.model().alphabet);
    };
    CHECK(grown(true) == grown(false));
}

TEST_CASE("a picture that doubles at every depth is stopped by the memory, not by the machine's end", "[lsystem]") {
    ModelBuilder model;
    model.system().axiom = model.word("X");
    model.system().homomorphism.productions.push_back(
        model.make({}, {{"X", 0}}, {}, {model.module("X", {}), model.module("X", {})}));
    model.system().homomorphism.maximum_depth = number(60);
    DerivationSettings settings;
    settings.memory = 1 << 20;
    Derivation derivation(model.compiled(), settings);
    ModuleString string, picture;
    derivation.start(string);
    BranchLinks links;
    link_branches(string, links);
    CHECK_THROWS_AS(derivation.picture(string, nullptr, links, 0, 0, picture), RunError);
    CHECK(picture.bytes() <= 2 << 20);
}
