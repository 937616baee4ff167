#include "catch.h"
#include "lsystem/model_builder.h"
#include "lsystem/programs/constant.h"
#include "lsystem/programs/functions.h"

#include <cmath>

using namespace espalier;
using namespace espalier::lsystem;
using namespace espalier::test;

namespace {

/// The value of an expression in which formal 0 is `x`.
double value_of(const Expression& expression, double x = 0, Arithmetic arithmetic = Arithmetic::double_precision) {
    ModelBuilder model;
    model.model().arithmetic = arithmetic;
    model.system().axiom = {model.module("A", {number(x)})};
    model.rule({{"A", 1}}, {model.module("B", {expression})});
    Derivation derivation(model.compiled(), with_lineage(1, 0));
    return grow(derivation, 1).parameters.at(0);
}

std::string printed(std::vector<Expression> arguments) {
    ModelBuilder model;
    model.system().start = {run(call(Function::print, std::move(arguments)))};
    std::string text;
    DerivationSettings settings;
    settings.printout = std::make_shared<Printout>([&](const std::string& piece) { text += piece; });
    text_after(model, 0, settings);
    return text;
}

}  // namespace

TEST_CASE("functions work in degrees, folded or not", "[lsystem]") {
    const auto both = [](Function function, double x) {
        const double folded = value_of(call(function, {number(x)}));
        CHECK(value_of(call(function, {formal(0)}), x) == folded);
        return folded;
    };
    CHECK(both(Function::sin, 30) == Approx(0.5));
    CHECK(both(Function::cos, 60) == Approx(0.5));
    CHECK(both(Function::tan, 45) == Approx(1));
    CHECK(both(Function::asin, 1) == Approx(90));
    CHECK(both(Function::acos, 0) == Approx(90));
    CHECK(both(Function::atan, 1) == Approx(45));
    CHECK(both(Function::exp, 1) == Approx(std::exp(1)));
    CHECK(both(Function::trunc, -2.7) == -2);
    CHECK(both(Function::round, 2.5) == 3);
    CHECK(both(Function::sign, -3) == -1);
    CHECK(both(Function::floor, -0.5) == -1);
    CHECK(both(Function::ceil, 0.5) == 1);
    CHECK(value_of(call(Function::atan2, {number(1), number(0)})) == Approx(90));
    CHECK(value_of(call(Function::atan, {number(0), number(1)})) == Approx(90));
    CHECK(value_of(call(Function::min, {number(3), formal(0), number(7)}), 5) == 3);
    CHECK(value_of(call(Function::clamp, {formal(0), number(0), number(1)}), 5) == 1);
    CHECK(value_of(call(Function::lerp, {number(10), number(20), formal(0)}), 0.25) == 12.5);
}

TEST_CASE("a constant is known where what it depends on is", "[lsystem]") {
    const auto value = [](const Expression& expression) {
        return constant_value(expression, Arithmetic::double_precision);
    };
    CHECK(value(apply(Operator::add, {number(2), apply(Operator::negate, {number(5)})})) == -3);
    CHECK(value(call(Function::max, {number(2), number(7), number(5)})) == 7);
    CHECK_FALSE(value(formal(0)));
    CHECK_FALSE(value(call(Function::ran, {number(1)})));
    // What is never evaluated may be anything.
    CHECK(value(apply(Operator::logical_and, {number(0), formal(0)})) == 0);
    CHECK(value(apply(Operator::logical_or, {number(2), formal(0)})) == 1);
    CHECK_FALSE(value(apply(Operator::logical_and, {number(1), formal(0)})));
    // A division by zero is a mistake of whoever gets there, and a number arguments short is no call.
    CHECK_FALSE(value(apply(Operator::divide, {number(1), number(0)})));
    CHECK_FALSE(value(apply(Operator::remainder, {number(1), number(0.5)})));
    CHECK(constant_value(apply(Operator::divide, {number(3), number(0)}), Arithmetic::cpfg) == 3);
    CHECK_FALSE(value(call(Function::atan2, {})));
}

TEST_CASE("operators are those of the language", "[lsystem]") {
    CHECK(value_of(apply(Operator::remainder, {formal(0), number(3.9)}), 7.9) == 1);
    CHECK(value_of(apply(Operator::remainder, {number(-7), number(3)})) == -1);
    CHECK(value_of(apply(Operator::power, {formal(0), number(3)}), 2) == 8);
    CHECK(value_of(apply(Operator::logical_not, {formal(0)}), 2) == 0);
    CHECK(value_of(apply(Operator::equal, {formal(0), number(2)}), 2) == 1);
    CHECK(value_of(choose(formal(0) < number(3), number(10), number(20)), 2) == 10);
    CHECK(value_of(choose(formal(0) < number(3), number(10), number(20)), 4) == 20);
}

TEST_CASE("&&, || and ?: evaluate only what they need", "[lsystem]") {
    const Expression fails = number(1) / formal(0);
    CHECK(value_of(apply(Operator::logical_and, {formal(0), fails})) == 0);
    CHECK(value_of(apply(Operator::logical_or, {apply(Operator::logical_not, {formal(0)}), fails})) == 1);
    CHECK(value_of(choose(formal(0), fails, number(4))) == 4);
    CHECK(value_of(apply(Operator::logical_and, {number(2), formal(0)}), 5) == 1);
}

TEST_CASE("the reference program's quirks come back on request", "[lsystem]") {
    CHECK(value_of(formal(0) / number(0), 3, Arithmetic::cpfg) == 3);
    CHECK(value_of(call(Function::trunc, {number(2.5)}), 0, Arithmetic::cpfg) == 3);
    CHECK_THROWS_AS(value_of(formal(0) / number(0), 3), RunError);
    CHECK_THROWS_AS(value_of(number(1) / number(0)), RunError);
}

TEST_CASE("simple successors round exactly as their expressions do", "[lsystem]") {
    for (const double x : {0.1, -0.0, 1e-310, 12345.678}) {
        CHECK(value_of(formal(0) * number(0.3) + number(0.7), x) == x * 0.3 + 0.7);
        CHECK(value_of(number(0.7) - formal(0), x) == 0.7 - x);
        CHECK(value_of(number(0.7) - number(0.3) * formal(0), x) == 0.7 - 0.3 * x);
        CHECK(value_of(formal(0) * number(0.1) * number(0.3), x) == x * 0.1 * 0.3);
        CHECK(std::signbit(value_of(formal(0), x)) == std::signbit(x));
    }
}

TEST_CASE("arrays are row-major, zero-filled and bounded", "[lsystem]") {
    ModelBuilder model;
    model.system().arrays.push_back(
        {"a", {number(2), number(3)}, {number(1), number(2), number(3), number(4)}, false, {}});
    model.system().axiom = {
        model.module("A", {element(0, {number(1), number(0)}), element(0, {number(1), number(2)})})};
    CHECK(text_after(model, 0) == "A(4,0)");
    model.system().axiom = {model.module("A", {element(0, {number(0), number(3)})})};
    CHECK_THROWS_AS(text_after(model, 0), RunError);
    model.model().arithmetic = Arithmetic::cpfg;
    CHECK(text_after(model, 0) == "A(3)");
    model.system().axiom = {model.module("A", {element(0, {number(0)})})};
    CHECK_THROWS_AS(model.compiled(), UserError);
    model.system().axiom.clear();
    model.system().arrays[0].dimensions = {number(1e6), number(1e6)};
    CHECK_THROWS_AS(model.compiled(), UserError);
}

TEST_CASE("loops, branches and breaks run as written", "[lsystem]") {
    ModelBuilder model;
    const std::uint32_t i = model.add_global("i");
    const std::uint32_t sum = model.add_global("sum");
    Statement stop;
    stop.kind = Statement::Kind::branch;
    stop.expressions = {number(5) < global(i)};
    Statement leave;
    leave.kind = Statement::Kind::break_loop;
    stop.bodies = {{leave}, {assign(global(sum), global(sum) + number(100))}};
    Statement loop;
    loop.kind = Statement::Kind::for_loop;
    loop.expressions = {assign(global(i), number(1)).expressions[0], std::nullopt,
                        assign(global(i), global(i) + number(1)).expressions[0]};
    loop.bodies = {{stop, assign(global(sum), global(sum) + global(i))}};
    Statement once;
    once.kind = Statement::Kind::do_loop;
    once.expressions = {number(0)};
    once.bodies = {{assign(global(sum), global(sum) + number(1000))}};
    model.system().start = {loop, once};
    model.system().axiom = {model.module("A", {global(i), global(sum)})};
    CHECK(text_after(model, 0) == "A(6,1515)");
    model.system().start = {leave};
    CHECK_THROWS_AS(model.compiled(), UserError);
}

TEST_CASE("printf fills its format", "[lsystem]") {
    CHECK(printed({text("%g|%5.2f|%d|%s|%%\n"), number(0.1), number(3.14159), number(7.9), text("leaf")}) ==
          "0.1| 3.14|7|leaf|%\n");
    CHECK(printed({text("plain")}) == "plain");
    CHECK(printed({text("100%! %g%"), number(1)}) == "100%! 1%");
    CHECK(printed({text("%n %"), number(1)}) == "%n %");
    CHECK_THROWS_AS(printed({text("%s"), number(1)}), UserError);
    CHECK(printed({text("%999999999999d"), number(1)}) == "%999999999999d");
    CHECK(printed({text("%g|%d|%s")}) ==
          "model.l:8:5: warning: the format asks for 3 values and is given 0; those that are missing are 0\n0|0|");
}

TEST_CASE("fields of blobs are refused with their place", "[lsystem]") {
    try {
        value_of(call(Function::in_blob, {number(1), number(0), number(0), number(0)}));
        FAIL("no error");
    } catch (const UserError& error) {
        CHECK(error.diagnostics().at(0).place.line == 8);
    }
    CHECK_THROWS_AS(value_of(call(Function::clamp, {number(1)})), UserError);
}

TEST_CASE("random functions have their distributions and ranges", "[lsystem]") {
    constexpr int n = 20'000;
    const auto mean = [&](Expression expression) {
        ModelBuilder model;
        for (int k = 0; k < n; ++k) model.system().axiom.push_back(model.module("A", {}));
        model.rule({{"A", 0}}, {model.module("B", {std::move(expression)})});
        Derivation derivation(model.compiled(), with_lineage(1, 0));
        double sum = 0;
        for (const double value : grow(derivation, 1).parameters) sum += value;
        return sum / n;
    };
    CHECK(mean(call(Function::ran, {number(6)})) == Approx(3).margin(0.05));
    CHECK(mean(call(Function::nran, {number(5), number(2)})) == Approx(5).margin(0.06));
    CHECK(mean(call(Function::bran, {number(2), number(6)})) == Approx(0.25).margin(0.01));
    CHECK(mean(call(Function::biran, {number(10), number(0.3)})) == Approx(3).margin(0.05));
    CHECK_THROWS_AS(mean(call(Function::bran, {number(0), number(1)})), RunError);
    CHECK_THROWS_AS(mean(call(Function::biran, {number(1e30), number(0.5)})), RunError);
}

TEST_CASE("noise is 0 on the lattice, bounded and continuous", "[lsystem]") {
    double largest = 0;
    for (int k = 0; k < 20'000; ++k) {
        const double x = k * 0.137, y = k * 0.011, z = k * -0.29;
        const double here = gradient_noise(x, y, z);
        largest = std::max(largest, std::abs(here));
        CHECK(std::abs(gradient_noise(x + 1e-6, y, z) - here) < 1e-5);
    }
    CHECK(largest <= 1);
    CHECK(largest > 0.5);
    CHECK(gradient_noise(3, -7, 12) == 0);
    CHECK(value_of(call(Function::noise, {formal(0)}), 0.5) == gradient_noise(0.5, 0, 0));
}
