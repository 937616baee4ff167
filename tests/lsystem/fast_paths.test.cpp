// Whatever a step is taken for, it writes what the plain derivation writes.
#include "catch.h"
#include "lsystem/compile/plans.h"
#include "lsystem/reference_derivation.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <string>

using namespace espalier;
using namespace espalier::lsystem;
using namespace espalier::test;

namespace {

/// What a random model may have.
struct Kind {
    bool parameters = false, conditions = false, several = false, weights = false;
    std::size_t longest = 20;  ///< successor
    int letters = 6;
};

class RandomModel {
public:
    RandomModel(unsigned seed, const Kind& kind) : random_(seed), kind_(kind) {
        for (int k = 0; k < kind.letters; ++k) arities_.push_back(kind.parameters ? below(7) : 0);
        builder.system().axiom = word(20, 0);
        if (kind.weights) builder.system().seed = number(1);
        const int rules = 3 + below(3);
        for (int r = 0; r < rules; ++r) add_rule();
    }

    ModelBuilder builder;

private:
    int below(int limit) { return std::uniform_int_distribution(0, limit - 1)(random_); }
    std::string symbol(int index) const { return std::string(1, static_cast<char>('A' + index)); }

    void add_rule() {
        std::vector<Pattern> strict;
        int formals = 0;
        const int width = kind_.several && below(2) == 0 ? 2 + below(2) : 1;
        for (int k = 0; k < width; ++k) {
            const int letter = below(kind_.letters);
            strict.push_back({symbol(letter), arities_[static_cast<std::size_t>(letter)]});
            formals += strict.back().arity;
        }
        // Mostly short, so that strings grow slowly; sometimes longer than any block.
        const int length = below(8) == 0 ? below(static_cast<int>(kind_.longest)) : below(4);
        Production& production = builder.rule(strict, word(length, formals));
        if (kind_.weights && below(3) > 0) production.weight = number(below(4) / 3.0);
        if (kind_.conditions && formals > 0 && below(2) == 0) production.condition = condition(formals);
    }

    std::vector<ModuleTemplate> word(int length, int formals) {
        std::vector<ModuleTemplate> modules;
        for (int k = 0; k < length; ++k) {
            const int letter = below(kind_.letters);
            std::vector<Expression> arguments;
            for (int a = 0; a < arities_[static_cast<std::size_t>(letter)]; ++a) arguments.push_back(value(formals));
            modules.push_back(builder.module(symbol(letter), std::move(arguments)));
        }
        return modules;
    }

    Expression condition(int formals) {
        const Expression first = value(formals) < value(formals);
        if (below(2) == 0) return first;
        return apply(below(2) == 0 ? Operator::logical_and : Operator::logical_or,
                     {first, value(formals) < value(formals)});
    }

    /// Copies, constants, products and sums that lanes can hold, and some that only a program can.
    Expression value(int formals) {
        const double constant = (below(200) - 100) / 64.0;
        if (formals == 0) return number(constant);
        const Expression parameter = formal(static_cast<std::uint32_t>(below(formals)));
        const Expression other = formal(static_cast<std::uint32_t>(below(formals)));
        switch (below(10)) {
            case 8:
                return choose(apply(Operator::logical_and, {other < number(0), parameter < other}), parameter / other,
                              number(constant));
            case 9:
                return apply(Operator::remainder, {parameter, number(1) + other * other});
            case 0:
                return number(constant);
            case 1:
            case 2:
                return parameter;
            case 3:
                return parameter * number(constant / 2);
            case 4:
                return number(constant) - parameter * number(0.25);
            case 5:
                return parameter * number(0.5) + number(constant);
            case 6:
                return (parameter + other) * number(0.375);
            default:
                return choose(parameter < other, parameter * number(0.5), other * number(0.25));
        }
    }

    std::mt19937 random_;
    Kind kind_;
    std::vector<int> arities_;
};

constexpr std::size_t longest_string = 150'000;

/// Grows a model and the plain one side by side; returns the longest string.
std::size_t compare(ModelBuilder& model, bool lineage, std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    DerivationSettings settings;
    settings.lineage = lineage;
    Derivation derivation(model.compiled(), settings);
    const Alphabet& alphabet = model.model().alphabet;
    ModuleString string, next;
    Derivation(model.compiled(), with_lineage()).start(string);
    PlainString plain = plain_copy(string, alphabet);
    derivation.start(string);
    std::size_t longest = 0;
    for (std::uint32_t step = 1; step <= 40; ++step) {
        plain = plain_step(model.model(), plain, step, longest_string);
        if (plain.size() > longest_string) break;
        if (step % 3 == 0) string = ModuleString(string);  // a copy has no room behind it
        derivation.step(string, next);
        std::swap(string, next);
        INFO("step " << step);
        REQUIRE(differences(plain, plain_copy(string, alphabet), lineage) == 0);
        longest = std::max(longest, plain.size());
    }
    return longest;
}

void compare_many(const Kind& kind) {
    std::size_t longest = 0;
    for (unsigned seed = 0; seed < 24; ++seed) {
        INFO("seed " << seed);
        const std::size_t threads[] = {1, 2, 8};
        RandomModel model(seed, kind);
        longest = std::max(longest, compare(model.builder, seed % 2 == 0, threads[seed % 3]));
    }
    CHECK(longest > 30'000);  // more than a chunk
}

/// Marks what a string's columns have behind the room that is spared behind so many elements.
class Marks {
public:
    Marks(ModuleString& string, const ModuleString& expected) : string_(string), expected_(expected) {
        for_each([](auto& column, std::size_t end) {
            column.resize(end + count);
            std::fill_n(column.data() + end, count, mark<decltype(column[0])>);
            column.clear();
        });
    }
    bool stand() {
        bool all = true;
        for_each([&](const auto& column, std::size_t end) {
            REQUIRE(column.capacity() >= end + count);  // the memory is that which was marked
            const auto* const first = column.data() + end;
            all &= std::all_of(first, first + count, [](auto value) { return value == mark<decltype(value)>; });
        });
        return all;
    }

private:
    static constexpr std::size_t count = 64;
    template <class T>
    static constexpr std::decay_t<T> mark = std::decay_t<T>{12345};

    template <class Action>
    void for_each(const Action& action) {
        action(string_.letters, expected_.letters.size() + spare_letters);
        action(string_.parameters, expected_.parameters.size() + spare_values);
        action(string_.births, expected_.births.size() + spare_births);
    }

    ModuleString& string_;
    const ModuleString& expected_;
};

}  // namespace

TEST_CASE("random bare models grow as the plain derivation does", "[lsystem]") {
    compare_many({});
}

TEST_CASE("random models with very long successors grow as the plain derivation does", "[lsystem]") {
    compare_many({.longest = 3000});
}

TEST_CASE("random parametric models grow as the plain derivation does", "[lsystem]") {
    compare_many({.parameters = true});
}

TEST_CASE("random models with conditions grow as the plain derivation does", "[lsystem]") {
    compare_many({.parameters = true, .conditions = true});
}

TEST_CASE("random models with predecessors of several modules grow as the plain derivation does", "[lsystem]") {
    compare_many({.parameters = true, .conditions = true, .several = true});
}

TEST_CASE("random stochastic models grow as the plain derivation does", "[lsystem]") {
    compare_many({.weights = true});
    compare_many({.parameters = true, .weights = true});
    compare_many({.parameters = true, .conditions = true, .weights = true});
    compare_many({.parameters = true, .conditions = true, .several = true, .weights = true});
}

TEST_CASE("predecessors of several modules replace what stands across any place of the string", "[lsystem]") {
    compare_many({.parameters = true, .several = true, .letters = 2});
    compare_many({.several = true, .longest = 300, .letters = 3});
}

TEST_CASE("symbols of several modules are replaced whether a production writes them whole or in parts", "[lsystem]") {
    for (const bool whole : {true, false}) {
        for (const std::size_t threads : {1, 2, 8}) {
            ModelBuilder model;
            const auto apex = [&](double share) { return model.module("A", {formal(0) * number(share)}); };
            const ModuleTemplate mark = model.module("?", {}), open = model.module("[", {}),
                                 close = model.module("]", {});
            model.system().axiom = {model.module("A", {number(1)})};
            std::vector<ModuleTemplate> successor{model.module("F", {formal(0)}),
                                                  open,
                                                  apex(0.5),
                                                  mark,
                                                  model.module("P", {formal(0), number(2)}),
                                                  close,
                                                  apex(0.75),
                                                  mark};
            // What the next module writes may end the symbol that this one begins.
            successor.push_back(whole ? model.module("H", {formal(0)}) : model.module("B", {formal(0)}));
            model.rule(std::vector<Pattern>{{"A", 1}}, successor);
            model.rule(std::vector<Pattern>{{"B", 1}}, {model.module("H", {formal(0) - number(1)})});
            model.rule(std::vector<Pattern>{{"?", 0}, {"P", 2}}, {});
            model.rule(std::vector<Pattern>{{"?", 0}, {"H", 1}},
                       {model.module("F", {formal(0)}), mark, model.module("G", {}), mark});
            model.rule(std::vector<Pattern>{{"?", 0}, {"G", 0}, {"?", 0}}, {model.module("C", {number(3)})});
            CHECK(compare(model, threads != 2, threads) > 30'000);
        }
    }
}

TEST_CASE("what is written in whole blocks stays in the room behind the string", "[lsystem]") {
    const Kind kinds[] = {{.longest = 40},
                          {.parameters = true},
                          {.parameters = true, .conditions = true},
                          {.parameters = true, .conditions = true, .several = true},
                          {.parameters = true, .weights = true}};
    for (unsigned seed = 0; seed < 60; ++seed) {
        RandomModel model(seed, kinds[seed % 5]);
        DerivationSettings settings;
        settings.lineage = seed % 2 == 0;
        const auto compiled = model.builder.compiled();
        Derivation derivation(compiled, settings), again(compiled, settings);
        ModuleString string, next, marked;
        derivation.start(string);
        again.start(next);
        for (int step = 1; step <= 20 && string.size() < 20'000; ++step) {
            INFO("seed " << seed << ", step " << step);
            derivation.step(string, next);
            Marks marks(marked, next);
            again.step(string, marked);
            CHECK(marks.stand());
            CHECK(same(marked, next));
            std::swap(string, next);
        }
    }
}

TEST_CASE("the leftmost predecessor of several modules replaces its modules, however long the string", "[lsystem]") {
    for (const std::size_t threads : {1, 2, 8}) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        ModelBuilder model;
        model.system().axiom = model.word("A");
        model.rule("AAA", "B");
        model.rule("A", std::string(50'000, 'A'));
        CHECK(text_after(model, 2) == std::string(16'666, 'B') + std::string(2 * 50'000, 'A'));
        CHECK(text_after(model, 3) == std::string(16'666 + 33'333, 'B') + std::string(50'000, 'A'));
    }
}

TEST_CASE("the right context of several modules begins behind the last of them", "[lsystem]") {
    for (const std::size_t times : {1, 9000}) {
        ModelBuilder model;
        std::string axiom, expected;
        for (std::size_t k = 0; k < times; ++k) {
            axiom += "ABCABD[AB]C";
            expected += "XYCABD[AB]C";
        }
        model.system().axiom = model.word(axiom);
        model.rule("", "AB", "C", "XY");
        model.rule("", "A", "C", "Z");
        CHECK(text_after(model, 1) == expected);
    }
}

TEST_CASE("what a cut deletes is no part of a predecessor of several modules", "[lsystem]") {
    for (const std::size_t times : {1, 9000}) {
        ModelBuilder model;
        std::string axiom, expected;
        for (std::size_t k = 0; k < times; ++k) {
            axiom += "[AB%AB]A[B]";
            expected += "[X]A[B]";
        }
        model.system().axiom = model.word(axiom);
        model.rule("AB", "X");
        CHECK(text_after(model, 1) == expected);
    }
}

TEST_CASE("with decomposition, predecessors of several modules replace the same modules", "[lsystem]") {
    for (const std::size_t threads : {1, 2, 8}) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        ModelBuilder plain, decomposed;
        std::string axiom;
        std::mt19937 random(5);
        for (int k = 0; k < 50'000; ++k) axiom += "ABC"[random() % 3];
        for (ModelBuilder* model : {&plain, &decomposed}) model->system().axiom = model->word(axiom);
        for (const char* const strict : {"AB", "BC", "ABA", "CC"}) {
            plain.rule(strict, "EE");
            decomposed.rule(strict, "D");
        }
        Production split = decomposed.make({}, {{"D", 0}}, {}, decomposed.word("EE"));
        decomposed.system().decomposition.productions.push_back(std::move(split));
        CHECK(text_after(decomposed, 1) == text_after(plain, 1));
    }
}

TEST_CASE("letters that somebody changed between steps are derived as they stand", "[lsystem]") {
    for (const bool stochastic : {false, true}) {
        ModelBuilder model;
        const std::vector<ModuleTemplate> bears = {model.module("A", {formal(0), formal(1) * number(0.5)}),
                                                   model.module("B", {formal(0)}),
                                                   model.module("A", {formal(1), formal(0)})};
        model.system().axiom = {model.module("A", {number(1), number(2)})};
        model.rule({{"A", 2}}, bears);
        model.rule({{"B", 1}}, {model.module("C", {}), model.module("B", {formal(0)})});
        if (stochastic) {
            model.system().seed = number(1);
            model.rule({{"A", 2}}, {bears[2], bears[1], bears[0]});
            model.rule({{"B", 1}}, {model.module("B", {formal(0)})});
        }
        const Alphabet& alphabet = model.model().alphabet;
        const auto changes = [&](const auto& change) {
            Derivation derivation(model.compiled(), with_lineage(0));
            ModuleString string = grow(derivation, 14), next;
            REQUIRE(string.size() > 40'000);
            change(string.letters);
            const PlainString expected = plain_step(model.model(), plain_copy(string, alphabet), 15);
            derivation.step(string, next);
            CHECK(differences(expected, plain_copy(next, alphabet), true) == 0);
        };
        // As many of each letter as before, but in other places, so that every chunk's measure is wrong.
        changes([](Column<LetterId>& letters) { std::reverse(letters.begin(), letters.end()); });
        // Two alone, as far apart as blocks of any size might be.
        for (const std::size_t apart : {1, 64, 1024, 32 * 1024}) {
            changes([&](Column<LetterId>& letters) {
                std::size_t at = 100;
                while (letters[at] == letters[at + apart]) ++at;
                std::swap(letters[at], letters[at + apart]);
            });
        }
    }
}

TEST_CASE("a step that failed fails again, where it would have changed the string", "[lsystem]") {
    ModelBuilder model;
    model.system().axiom = {model.module("A", {number(1)})};
    model
        .rule({{"A", 1}}, {model.module("B", {}), model.module("A", {formal(0) * number(1e30)}),
                           model.module("A", {formal(0) * number(1e30)})})
        .condition = number(0) < formal(0);
    Derivation derivation(model.compiled());
    const ModuleString string = grow(derivation, 10);
    REQUIRE(string.size() > 1000);
    ModuleString next;
    for (const char* const step : {"at step 11", "at step 12"}) {
        try {
            derivation.step(string, next);
            FAIL("no error");
        } catch (const RunError& error) {
            CHECK(std::string(error.what()).find("in module A(1e+300) " + std::string(step)) != std::string::npos);
        }
    }
}

TEST_CASE("a step takes the memory of both strings and their lineages, and no more", "[lsystem]") {
    ModelBuilder model;
    model.system().seed = number(1);
    model.system().axiom = model.word("AB");
    model.rule("A", "AA");
    model.rule("A", "ABA");
    model.rule("B", "CB");
    Derivation free(model.compiled());
    const ModuleString string = grow(free, 13);
    ModuleString next;
    free.step(string, next);
    REQUIRE(string.size() > 1000);
    DerivationSettings settings;
    for (const std::size_t less : {0, 1}) {
        settings.memory = string.content() + next.content() - less;
        Derivation derivation(model.compiled(), settings);
        const ModuleString from = grow(derivation, 13);
        ModuleString to;
        if (less > 0) {
            CHECK_THROWS_AS(derivation.step(from, to), RunError);
        } else {
            derivation.step(from, to);
            CHECK(same(to, next));
        }
    }
}

TEST_CASE("the first value of many that is not finite is named", "[lsystem]") {
    ModelBuilder model;
    model.system().axiom = {model.module("A", {number(1), number(1)})};
    model.rule({{"A", 2}}, {model.module("A", {formal(0) * number(2), formal(1) * number(1e20)}),
                            model.module("A", {formal(0) * number(2) + number(1), formal(1) * number(1e20)})});
    for (const std::size_t threads : {1, 2, 8}) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        try {
            text_after(model, 16);
            FAIL("no error");
        } catch (const RunError& error) {
            CHECK(std::string(error.what()).find("in module A(32768,1e+300) at step 16") != std::string::npos);
        }
    }
}

TEST_CASE("values computed for many modules at once are named in the order of the string if they are not finite",
          "[lsystem]") {
    // Products wait until many are computed, scalings are written at once.
    const auto message = [](bool product_first) {
        ModelBuilder model;
        std::vector<ModuleTemplate>& axiom = model.system().axiom;
        for (int k = 0; k < 300; ++k) axiom.push_back(model.module("B", {number(1), number(k)}));
        axiom.push_back(model.module("B", {number(1e200), number(1e200)}));
        axiom.push_back(model.module("C", {number(1e300)}));
        if (!product_first) std::swap(axiom[300], axiom[301]);
        for (int k = 0; k < 300; ++k) axiom.push_back(model.module("C", {number(1)}));
        model.rule({{"B", 2}}, {model.module("B", {formal(0) * formal(1), formal(1)})});
        model.rule({{"C", 1}}, {model.module("C", {formal(0) * number(1e100)})});
        try {
            text_after(model, 1);
        } catch (const RunError& error) {
            return std::string(error.what());
        }
        return std::string("no error");
    };
    CHECK(message(true).find("in module B(1e+200,1e+200) at step 1") != std::string::npos);
    CHECK(message(false).find("in module C(1e+300) at step 1") != std::string::npos);
}
