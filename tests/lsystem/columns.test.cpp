// Programs that are run for many modules at once give each what it gets alone. Models with an order are run one module
// after the other: what they grow is compared with what others do.
#include "catch.h"
#include "lsystem/model_builder.h"

#include <string>
#include <vector>

using namespace espalier;
using namespace espalier::lsystem;
using namespace espalier::test;

namespace {

/// Adds a production that counts, so that the model's modules are replaced one after the other.
void give_order(ModelBuilder& model) {
    const std::uint32_t count = model.add_global("count");
    model.rule("Z", "Z").after = {assign(global(count), global(count) + number(1))};
}

}  // namespace

TEST_CASE("conditions and values of many modules at once are those of each alone", "[lsystem]") {
    const auto grown = [](bool ordered) {
        ModelBuilder model;
        const std::uint32_t limit = model.add_global("limit");
        model.system().start = {assign(global(limit), number(40))};
        for (int k = 0; k < 20'000; ++k) model.system().axiom.push_back(model.module("A", {number(k % 97), number(k)}));
        const Expression x = formal(0), y = formal(1);
        model
            .rule({{"A", 2}},
                  {model.module("A", {x * y * number(0.5),
                                      call(Function::sin, {x + y}) +
                                          call(Function::cos, {x * y}) * call(Function::exp, {x * number(-0.1)}) +
                                          call(Function::log, {x + number(1)}) + call(Function::sqrt, {y})})})
            .condition = x < global(limit);
        model.rule({{"A", 2}}, {model.module("B", {x * x, y / number(3), y})}).condition = y < x * number(100);
        if (ordered) give_order(model);
        return text_after(model, 2);
    };
    CHECK((grown(false) == grown(true)));
}

TEST_CASE("where many modules are computed at once, each takes its own way through && || and ?:", "[lsystem]") {
    const auto grown = [](bool ordered) {
        ModelBuilder model;
        for (int k = 0; k < 20'000; ++k) model.system().axiom.push_back(model.module("A", {number(k % 7), number(k)}));
        const Expression x = formal(0), y = formal(1);
        const Expression has_x = apply(Operator::not_equal, {x, number(0)});
        const Expression half = choose(apply(Operator::remainder, {y, number(2)}), y / number(2), number(-1));
        // Nobody divides by zero who does not come to it.
        model
            .rule({{"A", 2}},
                  {model.module("A", {x + number(1), choose(has_x, choose(number(3) < x, y / x, half), x - y)})})
            .condition = apply(Operator::logical_and, {has_x, y / x < number(3000)});
        model.rule({{"A", 2}}, {model.module("B", {y / (x + number(1)), half})}).condition =
            apply(Operator::logical_or, {y < number(9000), number(0) < x * y});
        if (ordered) give_order(model);
        return text_after(model, 3);
    };
    CHECK((grown(false) == grown(true)));
}

TEST_CASE("where many modules are computed at once, each reads the parameters of its own neighbours", "[lsystem]") {
    const auto grown = [](bool ring, bool ignores, bool ordered) {
        ModelBuilder model;
        const auto module = [&](const char* symbol, double value) { return model.module(symbol, {number(value)}); };
        for (int k = 0; k < 6'000; ++k) {
            for (ModuleTemplate& each : std::vector<ModuleTemplate>{
                     module("A", k % 5 + 1), module("I", k), model.module("[", {}), module("A", k % 3), module("B", k),
                     model.module("]", {}), module("B", k % 11)}) {
                model.system().axiom.push_back(std::move(each));
            }
        }
        model.system().ring = ring;
        if (ignores) {
            model.system().filter = LSystem::Filter::ignore;
            model.system().filtered = {model.model().alphabet.symbol_of(model.module("I", {number(0)}).letter)};
        }
        const std::vector<Pattern> a = {{"A", 1}}, b = {{"B", 1}};
        // Formals: left, strict, right.
        model.add(model.make(a, b, a, {module("B", 0.5), model.module("A", {formal(0) + formal(1) - formal(2)})}))
            .condition = apply(Operator::logical_or, {formal(0) < formal(2), formal(1) < number(3)});
        model.add(model.make({}, b, b, {model.module("B", {formal(1) * number(0.5)})}));
        model.add(model.make(b, a, {}, {model.module("A", {formal(1) / (formal(0) + number(1))})})).condition =
            formal(0) < number(50);
        model.add(model.make(a, a, {}, {model.module("A", {formal(0) + number(2)}), module("I", 1)}));
        if (ordered) give_order(model);
        return text_after(model, 4);
    };
    for (const bool ring : {false, true}) {
        for (const bool ignores : {false, true}) CHECK((grown(ring, ignores, false) == grown(ring, ignores, true)));
    }
    CHECK((grown(false, true, false) != grown(true, true, false)));
    CHECK((grown(false, true, false) != grown(false, false, false)));
}

TEST_CASE("random numbers of many modules at once are those of each alone", "[lsystem]") {
    const auto grown = [](bool ordered) {
        ModelBuilder model;
        model.system().seed = number(5);
        for (int k = 0; k < 3'000; ++k) model.system().axiom.push_back(model.module("A", {number(k % 13), number(k)}));
        const Expression x = formal(0), y = formal(1), ran = call(Function::ran, {number(1)});
        const Expression normal = call(Function::nran, {x, y * number(0.01)});
        // Who does not come to a random number takes none.
        const Expression sometimes = apply(Operator::logical_and, {number(3) < x, ran < number(0.6)});
        model
            .rule({{"A", 2}}, {model.module("A", {choose(x < number(6), ran, normal) + ran, call(Function::ran, {y})}),
                               model.module("B", {normal, call(Function::pow, {y, ran})})})
            .condition = sometimes;
        model.rule({{"A", 2}}, {model.module("A", {x + number(1), y * ran})}).condition = ran < number(0.8);
        if (ordered) give_order(model);
        return text_after(model, 4);
    };
    CHECK((grown(false) == grown(true)));
}

TEST_CASE("weights of many modules at once choose what those of each alone choose", "[lsystem]") {
    const auto grown = [](bool ordered) {
        ModelBuilder model;
        model.system().seed = number(6);
        for (int k = 0; k < 3'000; ++k) model.system().axiom.push_back(model.module("A", {number(k % 13)}));
        const Expression x = formal(0);
        const auto rule = [&](const char* symbol, double value, Expression weight) -> Production& {
            Production& made = model.rule({{"A", 1}}, {model.module(symbol, {x * number(0.5) + number(value)})});
            made.weight = std::move(weight);
            return made;
        };
        rule("A", 1, number(0.3)).condition = x < number(9);
        rule("A", 2, x).condition = call(Function::ran, {number(13)}) < x;
        rule("B", 3, number(0));
        rule("A", 4, apply(Operator::power, {x, number(1.5)})).condition = number(11) < x;
        rule("C", 5, number(2)).condition = apply(Operator::equal, {x, number(0)});
        if (ordered) give_order(model);
        return text_after(model, 5);
    };
    CHECK((grown(false) == grown(true)));
}

namespace {

Statement branch(Expression condition, Block then, Block otherwise = {}) {
    Statement statement;
    statement.kind = Statement::Kind::branch;
    statement.expressions.emplace_back(std::move(condition));
    statement.bodies.push_back(std::move(then));
    if (!otherwise.empty()) statement.bodies.push_back(std::move(otherwise));
    return statement;
}

}  // namespace

TEST_CASE("variables that each module assigns before it reads them make no order, and change nothing", "[lsystem]") {
    const auto grown = [](bool ordered) {
        ModelBuilder model;
        const std::uint32_t t = model.add_global("t"), u = model.add_global("u"), limit = model.add_global("limit");
        model.system().start = {assign(global(limit), number(9)), assign(global(t), number(77))};
        for (int k = 0; k < 4'000; ++k) model.system().axiom.push_back(model.module("A", {number(k % 13), number(k)}));
        const Expression x = formal(0), y = formal(1);
        // The block before the condition changes a parameter, which the successor reads, too.
        Production& first = model.rule({{"A", 2}}, {model.module("A", {x, global(t)}), model.module("B", {global(u)})});
        first.before = {assign(global(t), y / number(3)), assign(x, x + number(1))};
        first.condition = x < global(limit);
        first.after = {branch(number(5) < x, {assign(global(u), call(Function::ran, {global(t)}))},
                              {assign(global(u), call(Function::pow, {y, number(1.5)}))})};
        Production& second = model.rule({{"A", 2}}, {model.module("C", {x * number(0.5), global(u)})});
        second.condition = y < number(3000);
        second.after = {assign(global(t), x),
                        while_loop(number(2) < global(t), {assign(global(t), global(t) / number(2))}),
                        assign(global(u), global(t))};
        // What stands beside a module has its own.
        Production& third = model.add(model.make({{"C", 2}}, {{"B", 1}}, {}, {model.module("B", {global(t)})}));
        third.before = {assign(global(t), formal(0) + formal(2))};
        third.condition = global(t) < number(1e9);
        if (ordered) give_order(model);
        CHECK(has_order(*model.compiled()) == ordered);
        return text_after(model, 4);
    };
    CHECK((grown(false) == grown(true)));
}

TEST_CASE("what modules say to each other, or to who comes after them, has an order", "[lsystem]") {
    const Expression x = formal(0);
    std::uint32_t t = 0;
    const auto ordered = [&](const auto& change) {
        ModelBuilder model;
        t = model.add_global("t");
        model.system().axiom = {model.module("A", {number(1)})};
        model.rule({{"A", 1}}, {model.module("A", {global(t)})}).after = {assign(global(t), x)};
        change(model, model.system().productions.back());
        return has_order(*model.compiled());
    };
    const auto unchanged = [](ModelBuilder&, Production&) {};
    CHECK_FALSE(ordered(unchanged));
    // Another production, a block or a picture reads what modules left.
    CHECK(ordered([&](ModelBuilder& model, Production&) { model.rule({{"B", 1}}, {model.module("B", {global(t)})}); }));
    CHECK(ordered([&](ModelBuilder& model, Production&) { model.rule("C", "CC").condition = global(t) < number(1); }));
    CHECK(ordered([&](ModelBuilder& model, Production&) { model.system().end_each = {assign(global(1), global(t))}; }));
    CHECK(ordered([&](ModelBuilder& model, Production&) {
        model.system().homomorphism.productions.push_back(
            model.make({}, {{"D", 0}}, {}, {model.module("F", {global(t)})}));
    }));
    // It is not assigned on every way.
    CHECK(ordered([&](ModelBuilder&, Production& p) { p.after = {branch(x < number(3), {assign(global(t), x)})}; }));
    CHECK(
        ordered([&](ModelBuilder&, Production& p) { p.after = {while_loop(x < number(0), {assign(global(t), x)})}; }));
    CHECK(ordered([&](ModelBuilder&, Production& p) { p.after = {assign(global(t), global(t) + x)}; }));
    CHECK_FALSE(ordered([&](ModelBuilder&, Production& p) {
        p.after = {branch(x < number(3), {assign(global(t), x)}, {assign(global(t), number(2))})};
    }));
    // The step and the length are everybody's; a condition that assigns, and one that comes behind random numbers.
    CHECK(ordered([&](ModelBuilder&, Production& p) { p.after.push_back(assign(global(1), x)); }));
    CHECK(ordered([&](ModelBuilder&, Production& p) { p.condition = *assign(formal(0), number(2)).expressions[0]; }));
    CHECK(ordered([&](ModelBuilder&, Production& p) { p.before = {assign(formal(0), call(Function::ran, {x}))}; }));
    CHECK(ordered([&](ModelBuilder& model, Production& p) {
        model.system().seed = number(1);
        p.before = {assign(formal(0), number(2))};
    }));
    CHECK(ordered([&](ModelBuilder&, Production& p) { p.after.push_back(run(call(Function::stop, {number(0)}))); }));
    // Blocks that may fail are run, though their module has no values.
    const auto without_values = [&](const Expression& value) {
        return ordered([&](ModelBuilder& model, Production& p) {
            p.after = {assign(global(t), value)};
            p.successor = model.word("BB");
        });
    };
    CHECK(without_values(number(1) / x));
    CHECK_FALSE(without_values(x / number(2)));
}

TEST_CASE("a weight that is none, and a random number that is not to be had, are named", "[lsystem]") {
    const auto refused = [](bool by_weight) {
        ModelBuilder model;
        model.system().seed = number(1);
        for (int k = 0; k < 300; ++k) model.system().axiom.push_back(model.module("A", {number(200 - k)}));
        const Expression x = formal(0), huge = number(1e300) * number(1e300);
        model
            .rule({{"A", 1}},
                  {model.module("A", {by_weight ? x : call(Function::ran, {choose(x < number(0), huge, x)})})})
            .weight = by_weight ? x : number(1);
        text_after(model, 1);
    };
    CHECK_THROWS_WITH(refused(true), Catch::Contains("a weight must be") && Catch::Contains("A(-1)"));
    CHECK_THROWS_WITH(refused(false), Catch::Contains("finite") && Catch::Contains("A(-1)"));
}

TEST_CASE("the first module that divides by zero is named, however many are computed at once", "[lsystem]") {
    ModelBuilder model;
    const auto axiom = [&](int zero_of_b, int zero_of_a) {
        model.system().axiom.clear();
        for (int k = 0; k < 300; ++k) {
            model.system().axiom.push_back(model.module("A", {number(k == zero_of_a ? 0 : k + 1)}));
            model.system().axiom.push_back(model.module("B", {number(k == zero_of_b ? 0 : k + 1), number(k)}));
        }
    };
    // One is found by a condition, the other by a value.
    model.rule({{"A", 1}}, {model.module("A", {number(2)})}).condition = number(1) / formal(0) < number(2);
    model.rule({{"B", 2}}, {model.module("C", {formal(1) / formal(0)})}).condition =
        apply(Operator::remainder, {formal(1), formal(0)}) < number(1000);
    const auto refused = [&] {
        Derivation derivation(model.compiled());
        ModuleString string, next;
        derivation.start(string);
        derivation.step(string, next);
    };
    axiom(200, 100);
    CHECK_THROWS_WITH(refused(), Catch::Contains("1 / 0") && Catch::Contains("A(0)"));
    axiom(100, 200);
    CHECK_THROWS_WITH(refused(), Catch::Contains("100 % 0") && Catch::Contains("B(0,100)"));
}
