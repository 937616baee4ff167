#include "catch.h"
#include "lsystem/model_builder.h"

#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <set>
#include <sstream>

using namespace espalier;
using namespace espalier::lsystem;
using namespace espalier::test;

TEST_CASE("every letter is replaced at once", "[lsystem]") {
    ModelBuilder koch;
    koch.system().axiom = koch.word("F");
    koch.rule("F", "F+F--F+F");
    CHECK(text_after(koch, 1) == "F+F--F+F");
    CHECK(text_after(koch, 2) == "F+F--F+F+F+F--F+F--F+F--F+F+F+F--F+F");
}

TEST_CASE("the lengths of a, b -> a, a -> ab are Fibonacci numbers", "[lsystem]") {
    ModelBuilder algae;
    algae.system().axiom = algae.word("b");
    algae.rule("a", "ab");
    algae.rule("b", "a");
    const std::vector<std::string> expected = {"b", "a", "ab", "aba", "abaab", "abaababa"};
    for (int n = 0; n < 6; ++n) CHECK(text_after(algae, n) == expected[static_cast<std::size_t>(n)]);
    CHECK(text_after(algae, 25).size() == 121393);
}

TEST_CASE("ABOP's bracketed plants have the published numbers of letters", "[lsystem]") {
    const auto counts = [](std::string_view rule, int steps) {
        ModelBuilder plant;
        plant.system().axiom = plant.word("F");
        plant.rule("F", rule);
        const std::string text = text_after(plant, steps);
        return std::pair(text.size(), std::count(text.begin(), text.end(), 'F'));
    };
    CHECK(counts("F[+F]F[-F]F", 5) == std::pair<std::size_t, long>(7811, 3125));
    CHECK(counts("FF[-F+FF][+F-F-F]", 4) == std::pair<std::size_t, long>(9361, 4096));
}

TEST_CASE("long successors and empty ones are written whole", "[lsystem]") {
    ModelBuilder model;
    const std::string long_word = "abcdefghijklmnopqrstuvwxyzabcdefghijklmnopqrstuvwxyz";
    model.system().axiom = model.word("XYX");
    model.rule("X", long_word);
    model.rule("Y", "");
    CHECK(text_after(model, 1) == long_word + long_word);
}

TEST_CASE("an empty axiom and a string that dies stay empty", "[lsystem]") {
    ModelBuilder model;
    CHECK(text_after(model, 3).empty());
    model.system().axiom = model.word("A");
    model.rule("A", "");
    CHECK(text_after(model, 3).empty());
}

TEST_CASE("parameters are computed from the predecessor's", "[lsystem]") {
    ModelBuilder model;
    model.system().axiom = {model.module("A", {number(2), number(3)})};
    model.rule({{"A", 2}}, {model.module("B", {formal(0) * formal(1), formal(0), number(7)}),
                            model.module("A", {formal(1) * number(0.5) + number(1), number(1) - formal(0)})});
    CHECK(text_after(model, 1) == "B(6,2,7)A(2.5,-1)");
    CHECK(text_after(model, 2) == "B(6,2,7)B(-2.5,2.5,7)A(0.5,-1.5)");
}

TEST_CASE("modules match on their number of parameters", "[lsystem]") {
    ModelBuilder model;
    model.system().axiom = {model.module("A", {}), model.module("A", {number(1)}),
                            model.module("A", {number(1), number(2)})};
    model.rule({{"A", 1}}, model.word("x"));
    CHECK(text_after(model, 1) == "AxA(1,2)");
}

TEST_CASE("the first production in file order whose condition holds wins", "[lsystem]") {
    ModelBuilder model;
    model.system().axiom = {model.module("A", {number(1)}), model.module("A", {number(5)}),
                            model.module("A", {number(9)})};
    model.rule({{"A", 1}}, model.word("s")).condition = formal(0) < number(3);
    model.rule({{"A", 1}}, model.word("m")).condition = formal(0) < number(6);
    model.rule({{"A", 1}}, model.word("l")).condition = number(1);
    CHECK(text_after(model, 1) == "sml");
}

TEST_CASE("several strict modules are replaced as one", "[lsystem]") {
    ModelBuilder model;
    model.system().axiom = model.word("ABABCAB");
    model.add(model.make({}, ModelBuilder::patterns("AB"), ModelBuilder::patterns("C"), model.word("x")));
    model.add(model.make({}, ModelBuilder::patterns("AB"), {}, model.word("BA")));
    CHECK(text_after(model, 1) == "BAxCBA");
}

TEST_CASE("a block's assignments persist though the condition fails", "[lsystem]") {
    ModelBuilder model;
    const std::uint32_t n = model.add_global("n");
    model.system().axiom = {model.module("A", {}), model.module("B", {}), model.module("A", {}), model.module("B", {})};
    Production& counts = model.rule({{"A", 0}}, model.word("x"));
    counts.before = {assign(global(n), global(n) + number(1))};
    counts.condition = number(0);
    model.rule({{"B", 0}}, {model.module("C", {global(n)})});
    CHECK(has_order(*model.compiled()));
    CHECK(text_after(model, 1) == "AC(1)AC(2)");
}

TEST_CASE("blocks see Q and Z, and run in their order", "[lsystem]") {
    ModelBuilder model;
    const std::uint32_t log = model.add_global("log");
    const auto note = [&](double digit) {
        return Block{assign(global(log), global(log) * number(10) + number(digit))};
    };
    model.system().derivation_length = number(2);
    model.system().start = note(1);
    model.system().start_each = note(2);
    model.system().end_each = note(3);
    model.system().end = note(4);
    model.system().axiom = {model.module("A", {global(log), global(0), global(1)})};
    model.rule({{"A", 3}}, {model.module("A", {global(log), global(0), global(1)})});
    CHECK(text_after(model, 0) == "A(1,0,2)");
    CHECK(text_after(model, 1) == "A(12,1,2)");
    CHECK(text_after(model, 2) == "A(1232,2,2)");
    CHECK(text_after(model, 3) == "A(1.23234e+06,3,2)");
}

TEST_CASE("a cut deletes the rest of its branch on the step after it appears", "[lsystem]") {
    ModelBuilder model;
    model.system().axiom = model.word("A[BC[D]E]F");
    model.rule("B", "b%");
    model.rule("C", "c");
    model.rule("F", "fB");
    CHECK(text_after(model, 1) == "A[b%c[D]E]fB");
    CHECK(text_after(model, 2) == "A[b]fb%");
    CHECK(text_after(model, 3) == "A[b]fb");
}

TEST_CASE("a cut that has a production is a module like any other", "[lsystem]") {
    ModelBuilder model;
    model.system().axiom = model.word("A%B");
    model.rule("%", "x");
    CHECK(text_after(model, 1) == "AxB");
}

TEST_CASE("a cut keeps the parameters of what follows in step", "[lsystem]") {
    ModelBuilder model;
    model.system().axiom = {model.module("[", {}), model.module("%", {}),          model.module("F", {number(1)}),
                            model.module("]", {}), model.module("F", {number(2)}), model.module("G", {number(3)})};
    CHECK(text_after(model, 1) == "[]F(2)G(3)");
}

TEST_CASE("division by zero names place, module and values", "[lsystem]") {
    ModelBuilder model;
    model.system().axiom = {model.module("A", {number(4), number(0)})};
    model.rule({{"A", 2}}, {model.module("A", {formal(0) / formal(1), number(1)})});
    try {
        text_after(model, 1);
        FAIL("no error");
    } catch (const RunError& error) {
        CHECK(std::string(error.what()) ==
              "model.l:7:3: division by zero: 4 / 0 (--arithmetic cpfg divides by 1), in module A(4,0) at step 1");
    }
    model.model().arithmetic = Arithmetic::cpfg;
    CHECK(text_after(model, 1) == "A(4,1)");
}

TEST_CASE("a parameter that is not a number stops the run", "[lsystem]") {
    ModelBuilder model;
    model.system().axiom = {model.module("A", {number(-1), number(1e300)})};
    SECTION("NaN") {
        model.rule({{"A", 2}}, {model.module("B", {call(Function::sqrt, {formal(0)})})});
        CHECK_THROWS_AS(text_after(model, 1), RunError);
    }
    SECTION("infinite, in a simple successor") {
        model.rule({{"A", 2}}, {model.module("B", {formal(1) * number(1e300)})});
        CHECK_THROWS_AS(text_after(model, 1), RunError);
    }
    SECTION("in the axiom") {
        model.system().axiom = {model.module("A", {call(Function::log, {global(0) - number(1)})})};
        CHECK_THROWS_AS(text_after(model, 0), RunError);
    }
}

TEST_CASE("a string that would outgrow its memory stops before it is made", "[lsystem]") {
    ModelBuilder model;
    model.system().axiom = model.word("AB");
    model.rule("A", "AAAA");
    model.rule("B", "BB");
    DerivationSettings settings;
    settings.memory = 1 << 20;
    const auto message_of = [&] {
        try {
            text_after(model, 60, settings);
        } catch (const RunError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    const std::string two_passes = message_of();
    CHECK(two_passes.find("model.l:1:1") != std::string::npos);
    CHECK(two_passes.find("step 10:") != std::string::npos);
    model.add_global("n");
    model.system().productions[1].before = {assign(global(2), global(2) + number(1))};
    CHECK(message_of().find("model.l:1:1") != std::string::npos);
}

TEST_CASE("a loop that does not end is stopped and named", "[lsystem]") {
    ModelBuilder model;
    model.system().start = {while_loop(number(1), {})};
    try {
        text_after(model, 0);
        FAIL("no error");
    } catch (const RunError& error) {
        CHECK(std::string(error.what()).find("model.l:9:2") != std::string::npos);
    }
}

namespace {

/// A tree with everything that must not depend on threads: conditions, contexts, draws, branches.
void add_busy_tree(ModelBuilder& model) {
    model.system().seed = number(3);
    model.system().axiom = {model.module("A", {number(1)})};
    const auto branch = [&](double scale) {
        return std::vector<ModuleTemplate>{model.module("F", {formal(0)}),
                                           model.module("[", {}),
                                           model.module("+", {call(Function::ran, {number(30)})}),
                                           model.module("A", {formal(0) * number(scale)}),
                                           model.module("]", {}),
                                           model.module("A", {formal(0) * number(0.9)})};
    };
    model.rule({{"A", 1}}, branch(0.7)).weight = number(2);
    model.rule({{"A", 1}}, branch(0.5)).condition = number(0.01) < formal(0);
    model.add(model.make({{"F", 1}}, {{"F", 1}}, {}, {model.module("F", {formal(0) + formal(1) * number(0.5)})}));
}

}  // namespace

TEST_CASE("one thread and two write the same string", "[lsystem]") {
    const auto grown = [](std::size_t threads, bool decomposed, bool ordered) {
        ModelBuilder model;
        add_busy_tree(model);
        if (ordered) {
            model.add_global("unused");
            model.system().productions.back().before = {assign(global(2), global(2) + number(1))};
        }
        if (decomposed) {
            model.system().decomposition.productions.push_back(
                model.make({}, {{"F", 1}}, {}, {model.module("G", {formal(0) * call(Function::ran, {number(1)})})}));
            model.system().decomposition.productions.back().condition = formal(0) < number(0.3);
        }
        tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        Derivation derivation(model.compiled(), with_lineage(11, 4));
        return grow(derivation, 14);
    };
    const ModuleString plain = grown(1, false, false);
    CHECK(plain.size() > 60'000);
    CHECK(same(plain, grown(2, false, false)));
    CHECK(same(plain, grown(1, false, true)));
    CHECK(same(grown(1, true, false), grown(2, true, false)));
    CHECK(same(grown(2, true, false), grown(1, true, true)));
}

TEST_CASE("long runs of modules that live on are joined as they were between modules that decompose", "[lsystem]") {
    const auto grown = [](std::size_t threads, bool ordered, int steps) {
        ModelBuilder model;
        model.system().axiom = model.word("A");
        std::vector<ModuleTemplate> successor(20, model.module("b", {number(7), number(9)}));
        for (const char* apex : {"A", "c", "A"}) successor.push_back(model.module(apex, {}));
        model.rule({{"A", 0}}, successor);
        if (ordered) {
            const std::uint32_t n = model.add_global("n");
            model.system().productions.back().before = {assign(global(n), global(n) + number(1))};
        }
        model.system().decomposition.productions.push_back(
            model.make({}, {{"c", 0}}, {}, {model.module("d", {number(3)}), model.module("e", {})}));
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        Derivation derivation(model.compiled(), with_lineage(11, 4));
        return grow(derivation, steps);
    };
    const ModuleString joined = grown(2, false, 12);
    CHECK(joined.size() == 4095 * 22 + 4096);
    CHECK(joined.parameters[joined.parameters.size() - 1] == 3);
    CHECK(same(joined, grown(1, false, 12)));
    CHECK(same(joined, grown(1, true, 12)));  // written in one piece
    CHECK(same(grown(1, false, 6), grown(1, true, 6)));
}

TEST_CASE("a derivation restored from a checkpoint goes on as if nothing had happened", "[lsystem]") {
    ModelBuilder model;
    add_busy_tree(model);
    const std::uint32_t n = model.add_global("n");
    model.system().arrays.push_back({"heights", {number(3)}, {}, false, {}});
    model.system().start_each = {assign(global(n), global(n) + call(Function::ran, {number(1)})),
                                 assign(element(0, {number(1)}), global(n))};
    model.rule({{"+", 1}}, {model.module("+", {formal(0) + global(n) + element(0, {number(1)})})});
    const auto compiled = model.compiled();
    Derivation first(compiled, with_lineage(5, 0));
    const ModuleString halfway = grow(first, 4);
    std::stringstream checkpoint;
    first.save(checkpoint);
    ModuleString expected, found;
    first.step(halfway, expected);
    Derivation second(compiled, with_lineage(5, 0));
    second.restore(checkpoint);
    second.step(halfway, found);
    CHECK(same(expected, found));
    CHECK(second.steps_done() == 5);
    std::stringstream broken(checkpoint.str().substr(0, 30));
    CHECK_THROWS_AS(second.restore(broken), RunError);
}

TEST_CASE("the derivation length is the model's until it is set", "[lsystem]") {
    ModelBuilder model;
    model.system().derivation_length = number(7);
    const std::uint32_t n = model.add_global("n");
    model.system().start_each = {assign(global(n), call(Function::set_derivation_length, {number(4)})),
                                 run(call(Function::stop, {number(1)}))};
    model.system().axiom = model.word("A");
    Derivation derivation(model.compiled());
    CHECK(derivation.length() == 7);
    derivation.set_length(9);
    CHECK(derivation.length() == 9);
    CHECK_FALSE(derivation.stopped());
    grow(derivation, 1);
    CHECK(derivation.length() == 4);
    CHECK(derivation.stopped());
}

TEST_CASE("a derivation length that is none is refused, also if a block assigns it", "[lsystem]") {
    for (const double length : {-1.0, 1e12, std::numeric_limits<double>::quiet_NaN()}) {
        ModelBuilder model;
        model.system().axiom = model.word("A");
        model.system().end_each = {assign(global(1), number(length))};
        CHECK_THROWS_AS(text_after(model, 1), RunError);
    }
    ModelBuilder model;
    model.system().axiom = model.word("A");
    model.system().end_each = {assign(global(1), number(7.5))};
    Derivation derivation(model.compiled());
    grow(derivation, 1);
    CHECK(derivation.length() == 7);
}

TEST_CASE("a parameter of -0 stays -0 whichever way it is written", "[lsystem]") {
    ModelBuilder model;
    model.system().axiom = {model.module("A", {number(1)})};
    model.rule({{"A", 1}}, {model.module("A", {number(-0.0)})});
    CHECK(text_after(model, 1) == "A(-0)");
}

TEST_CASE("a model that lies where another lay before is derived by its own programs", "[lsystem]") {
    std::set<const CompiledModel*> places;
    for (int k = 0; k < 50; ++k) {
        ModelBuilder model;
        const Expression x = formal(0);
        model.system().axiom = {model.module("A", {number(1)})};
        model.rule({{"A", 1}}, {model.module("A", {choose(x < number(2), x * x + number(k), number(-1))})});
        const std::shared_ptr<const CompiledModel> compiled = model.compiled();
        places.insert(compiled.get());
        Derivation derivation(compiled);
        CHECK(grow(derivation, 1).parameters == Column<double>{1.0 + k});
    }
    CHECK_NOFAIL(places.size() < 50);  // a sanitizer's allocator gives no place twice
}

TEST_CASE("a module replaced by one of its own letter stays who it is", "[lsystem]") {
    ModelBuilder model;
    model.system().axiom = {model.module("F", {number(1)})};
    model.rule({{"F", 1}}, {model.module("F", {formal(0) * number(1.5) + number(1)})});
    Derivation derivation(model.compiled(), with_lineage());
    ModuleString string, next;
    derivation.start(string);
    derivation.step(string, next);
    CHECK(next.parameters[0] == 2.5);
    CHECK(next.identity(0) == string.identity(0));
    CHECK(next.step_of_birth(0) == 0);
}

TEST_CASE("the End block runs after the last of many steps", "[lsystem]") {
    ModelBuilder model;
    model.system().axiom = model.word("A");
    model.rule("A", "AB");
    model.system().derivation_length = number(3);
    model.system().end = {run(call(Function::stop, {number(0)}))};
    Derivation derivation(model.compiled(), with_lineage());
    ModuleString string, next;
    derivation.start(string);
    for (int step = 1; step <= 3; ++step) {
        CHECK_FALSE(derivation.stopped());
        derivation.step(string, next);
        std::swap(string, next);
    }
    CHECK(derivation.stopped());
}

TEST_CASE("values that are not finite, and strings whose parameters do not fit, are refused", "[lsystem]") {
    ModelBuilder model;
    model.system().axiom = {model.module("F", {number(1.5e308)})};
    model.rule({{"F", 1}}, {model.module("F", {formal(0) * number(1.5) + number(1)})});
    Derivation derivation(model.compiled(), with_lineage());
    ModuleString string, next;
    derivation.start(string);
    CHECK_THROWS_AS(derivation.step(string, next), RunError);
    string.parameters[0] = 1;
    string.parameters.push_back(1);
    CHECK_THROWS_AS(derivation.step(string, next), RunError);
}
