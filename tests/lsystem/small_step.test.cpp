// Steps of small strings whose letters tell all: they write what any step writes, and leave to it what is not for them.
#include "lsystem/derive/small_step.h"

#include "catch.h"
#include "lsystem/reference_derivation.h"

#include <utility>

using namespace espalier;
using namespace espalier::test;

namespace {

constexpr std::size_t plenty = std::size_t{1} << 30;
constexpr std::uint32_t some_step = 7;

/// Letters that stretch, branch, vanish, and have many parameters or long successors; K's depends on a condition.
struct Herb {
    ModelBuilder model;

    Herb() {
        const auto x = formal(0);
        model.system().axiom = {model.module("A", {number(8)}), model.module("W", numbers({1, 2, 3, 4, 5, 6}))};
        model.rule({{"A", 1}}, {model.module("F", {x}), model.module("[", {}), model.module("+", {number(30)}),
                                model.module("L", {}), model.module("]", {}), model.module("A", {x * number(0.5)})});
        model.rule({{"F", 1}}, {model.module("F", {x * number(1.5) + number(1)})});
        model.rule({{"L", 0}}, {model.module("M", {}), model.module("C", {})});
        model.rule({{"M", 0}}, model.word("MNMNMNMNMNMNMNMNMNMNMN"));
        model.rule({{"C", 0}}, {});
        model.rule({{"N", 0}}, {});
        model.rule({{"K", 1}}, {model.module("F", {x})}).condition = x < number(3);
    }
    std::shared_ptr<const CompiledModel> compiled() { return model.compiled(); }

private:
    static std::vector<Expression> numbers(std::initializer_list<double> values) {
        std::vector<Expression> all;
        for (const double value : values) all.push_back(number(value));
        return all;
    }
};

bool rewrites(const CompiledModel& model, const ModuleString& from, ModuleString& to, std::size_t memory = plenty) {
    return rewrite_small(model.main().plans, from, some_step, memory, to);
}

/// The string of such modules alone, with a lineage and room behind it.
ModuleString of_axiom(ModelBuilder& model, std::vector<ModuleTemplate> modules) {
    model.system().axiom = std::move(modules);
    Derivation derivation(model.compiled(), with_lineage());
    ModuleString string;
    derivation.start(string);
    return string;
}

std::size_t bytes(const ModuleString& string) {
    return string.size() * (sizeof(LetterId) + 2 * sizeof(Identity) + sizeof(std::uint32_t)) +
           string.parameters.size() * sizeof(double);
}

}  // namespace

TEST_CASE("small strings whose letters tell all are written as the plain derivation writes them", "[lsystem]") {
    Herb herb;
    const auto compiled = herb.compiled();
    ModuleString string = of_axiom(herb.model, herb.model.system().axiom), next;
    PlainString plain = plain_copy(string, herb.model.model().alphabet);
    std::uint32_t step = 0;
    while (rewrite_small(compiled->main().plans, string, ++step, plenty, next)) {
        std::swap(string, next);
        plain = plain_step(herb.model.model(), plain, step);
        INFO("step " << step);
        REQUIRE(differences(plain, plain_copy(string, herb.model.model().alphabet), true) == 0);
    }
    CHECK(step > 4);
    CHECK(string.size() > 100);
}

TEST_CASE("a module replaced by one of its own letter stays who it is", "[lsystem]") {
    Herb herb;
    const ModuleString string = of_axiom(herb.model, {herb.model.module("F", {number(1)})});
    ModuleString next;
    REQUIRE(rewrites(*herb.compiled(), string, next));
    CHECK(next.parameters[0] == 2.5);
    CHECK(next.identities == string.identities);
    CHECK(next.parents == string.parents);
    CHECK(next.births == string.births);
}

TEST_CASE("a letter that needs choosing leaves the whole string to any step", "[lsystem]") {
    Herb herb;
    ModuleString next;
    std::vector<ModuleTemplate> modules(40, herb.model.module("F", {number(1)}));
    CHECK(rewrites(*herb.compiled(), of_axiom(herb.model, modules), next));
    for (const double value : {2.0, 4.0}) {
        modules[20] = herb.model.module("K", {number(value)});
        CHECK_FALSE(rewrites(*herb.compiled(), of_axiom(herb.model, modules), next));
    }
}

TEST_CASE("small steps take no more memory than they may", "[lsystem]") {
    Herb herb;
    const ModuleString string = of_axiom(herb.model, herb.model.system().axiom);
    ModuleString next;
    REQUIRE(rewrites(*herb.compiled(), string, next));
    const std::size_t needed = bytes(string) + bytes(next);
    CHECK(rewrites(*herb.compiled(), string, next, needed));
    CHECK_FALSE(rewrites(*herb.compiled(), string, next, needed - 1));
}

TEST_CASE("small steps are of strings, old and new, of at most 1024 modules", "[lsystem]") {
    Herb herb;
    const auto compiled = herb.compiled();
    ModuleString next;
    // Where modules may have parameters, one has.
    const auto many = [&](const std::string& letter, std::size_t count) {
        std::vector<ModuleTemplate> modules(count, herb.model.module(letter, {}));
        modules.push_back(herb.model.module("F", {number(1)}));
        return of_axiom(herb.model, modules);
    };
    CHECK(rewrites(*compiled, many("]", 1023), next));
    CHECK_FALSE(rewrites(*compiled, many("]", 1024), next));
    CHECK(rewrites(*compiled, many("L", 511), next));
    CHECK(next.size() == 1023);
    CHECK_FALSE(rewrites(*compiled, many("L", 512), next));
    ModelBuilder vanishing;
    vanishing.rule("A", "");
    CHECK(rewrites(*vanishing.compiled(), of_axiom(vanishing, vanishing.word("ABA")), next));
    CHECK_FALSE(rewrites(*vanishing.compiled(), of_axiom(vanishing, vanishing.word("AA")), next));
}

TEST_CASE("values that are not finite, strings without room behind or lineage are not for small steps", "[lsystem]") {
    Herb herb;
    const auto compiled = herb.compiled();
    ModuleString next;
    CHECK_FALSE(rewrites(*compiled, of_axiom(herb.model, {herb.model.module("F", {number(1.5e308)})}), next));
    const ModuleString string = of_axiom(herb.model, {herb.model.module("F", {number(1)})});
    CHECK(rewrites(*compiled, string, next));
    CHECK_FALSE(rewrites(*compiled, ModuleString(string), next));  // a copy has no room
    ModuleString orphans = of_axiom(herb.model, {herb.model.module("F", {number(1)})});
    orphans.parents.clear();
    CHECK_FALSE(rewrites(*compiled, orphans, next));
    ModuleString unfit = of_axiom(herb.model, {herb.model.module("F", {number(1)})});
    unfit.parameters.push_back(1);
    CHECK_FALSE(rewrites(*compiled, unfit, next));
}

TEST_CASE("a cut leaves its string to any step, other strings of the model are small steps' own", "[lsystem]") {
    ModelBuilder model;
    model.rule("A", "BA");
    model.rule("D", "%");
    const ModuleString whole = of_axiom(model, model.word("ABD")), cut = of_axiom(model, model.word("AB%D"));
    ModuleString next;
    CHECK(rewrites(*model.compiled(), whole, next));
    CHECK_FALSE(rewrites(*model.compiled(), cut, next));
}

TEST_CASE("models whose steps run blocks or decompose have no small steps", "[lsystem]") {
    const auto changed = [](const auto& change) {
        Herb herb;
        change(herb.model);
        return has_small_steps(*herb.compiled());
    };
    CHECK(changed([](ModelBuilder&) {}));
    CHECK_FALSE(changed([](ModelBuilder& model) {
        model.system().end_each = {run(call(Function::set_derivation_length, {number(3)}))};
    }));
    CHECK_FALSE(changed([](ModelBuilder& model) {
        model.system().start_each = {run(call(Function::set_derivation_length, {number(3)}))};
    }));
    CHECK_FALSE(changed([](ModelBuilder& model) {
        model.system().decomposition.productions.push_back(
            model.make({}, ModelBuilder::patterns("C"), {}, model.word("M")));
    }));
}

TEST_CASE("the End block runs after the last of many small steps", "[lsystem]") {
    Herb herb;
    herb.model.system().derivation_length = number(3);
    herb.model.system().end = {run(call(Function::stop, {number(0)}))};
    Derivation derivation(herb.compiled(), with_lineage());
    ModuleString string, next;
    derivation.start(string);
    for (int step = 1; step <= 3; ++step) {
        CHECK_FALSE(derivation.stopped());
        derivation.step(string, next);
        std::swap(string, next);
    }
    CHECK(derivation.stopped());
}
