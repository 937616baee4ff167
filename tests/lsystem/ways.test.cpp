// A step is done in one of several ways, as model and string ask for. All of them write what replacing one module after
// the other writes: the same modules, who are the same.
#include "catch.h"
#include "lsystem/compile/compiled_model.h"
#include "lsystem/derive/small_step.h"
#include "lsystem/derive/step.h"
#include "lsystem/model_builder.h"

#include <tbb/global_control.h>

#include <map>
#include <random>
#include <string>

using namespace espalier;
using namespace espalier::lsystem;
using namespace espalier::test;

namespace {

/// What a random model may have.
struct Traits {
    bool contexts = false, conditions = false, weights = false, several = false;
    bool nearest = false;  ///< contexts are one module, whose parameters nobody reads
    bool decomposition = false, cuts = false, blocks = false, sub_systems = false;
    bool cpfg = false;  ///< arithmetic
};

constexpr int letters = 5;

class ModelOfManyWays {
public:
    ModelOfManyWays(unsigned seed, const Traits& kind, int length) : random_(seed), kind_(kind) {
        for (int k = 0; k < letters; ++k) arities_.push_back(kind.nearest ? 0 : below(3));
        LSystem& system = builder.system();
        if (kind.cpfg) builder.model().arithmetic = Arithmetic::cpfg;
        if (kind.weights) system.seed = number(1);
        if (kind.contexts && below(2) == 0) {
            system.filter = LSystem::Filter::ignore;
            system.filtered.push_back(builder.model().alphabet.symbol("A"));
        }
        system.ring = kind.contexts && below(4) == 0;
        system.axiom = word(length, 0);
        for (int k = 3 + below(4); k > 0; --k) system.productions.push_back(production());
        if (kind.decomposition) decompose();
        if (kind.cuts) system.productions.back().successor.push_back(builder.module("%", {}));
        if (kind.blocks) count_uses();
        if (kind.sub_systems) nest();
    }

    ModelBuilder builder;

private:
    int below(int limit) { return std::uniform_int_distribution(0, limit - 1)(random_); }
    static std::string symbol(int letter) { return std::string(1, static_cast<char>('A' + letter)); }

    Pattern pattern() {
        const int letter = below(letters);
        return {symbol(letter), arities_[static_cast<std::size_t>(letter)]};
    }
    std::vector<Pattern> patterns(int most) {
        std::vector<Pattern> all;
        for (int k = below(most + 1); k > 0; --k) all.push_back(pattern());
        return all;
    }

    Production production() {
        const std::vector<Pattern> left = kind_.contexts ? patterns(kind_.nearest ? 1 : 2) : std::vector<Pattern>();
        const std::vector<Pattern> right = kind_.contexts ? patterns(kind_.nearest ? 1 : 2) : std::vector<Pattern>();
        std::vector<Pattern> strict{pattern()};
        if (kind_.several && below(3) == 0) strict.push_back(pattern());
        int formals = 0;
        for (const std::vector<Pattern>& part : {left, strict, right}) {
            for (const Pattern& each : part) formals += each.arity;
        }
        Production made = builder.make(left, strict, right, word(below(4), formals));
        if (kind_.conditions && formals > 0 && below(2) == 0) made.condition = value(formals) < value(formals);
        if (kind_.weights && below(3) > 0) made.weight = number(below(4) / 3.0);
        return made;
    }

    std::vector<ModuleTemplate> word(int length, int formals) {
        std::vector<ModuleTemplate> modules;
        int open = 0;
        for (int k = 0; k < length; ++k) {
            if (below(9) == 0) {
                modules.push_back(builder.module("[", {}));
                ++open;
            }
            std::vector<Expression> arguments;
            const int letter = below(letters);
            for (int a = 0; a < arities_[static_cast<std::size_t>(letter)]; ++a) arguments.push_back(value(formals));
            modules.push_back(builder.module(symbol(letter), std::move(arguments)));
            if (open > 0 && below(8) == 0) {
                modules.push_back(builder.module("]", {}));
                --open;
            }
        }
        for (; open > 0; --open) modules.push_back(builder.module("]", {}));
        return modules;
    }

    Expression value(int formals) {
        const double constant = (below(200) - 100) / 64.0;
        if (formals == 0) return number(constant);
        const Expression parameter = formal(static_cast<std::uint32_t>(below(formals)));
        switch (below(kind_.weights ? 5 : 4)) {
            case 0:
                return number(constant);
            case 1:
                return parameter;
            case 2:
                return parameter * number(0.5);
            case 3:
                return parameter * formal(static_cast<std::uint32_t>(below(formals))) * number(0.125);
            default:
                return call(Function::ran, {number(1)});
        }
    }

    void decompose() {
        RuleSet& rules = builder.system().decomposition;
        std::vector<Pattern> whole{pattern()};
        if (kind_.several && below(2) == 0) whole.push_back(pattern());
        int formals = 0;
        for (const Pattern& each : whole) formals += each.arity;
        rules.productions.push_back(builder.make({}, whole, {}, word(1 + below(2), formals)));
        rules.maximum_depth = number(1 + below(2));
    }
    void count_uses() {
        const std::uint32_t uses = builder.add_global("uses");
        for (Production& each : builder.system().productions) {
            each.after = {assign(global(uses), global(uses) + number(1))};
        }
    }
    /// Parts of the axiom belong to a second L-system, which has the same productions in another order.
    void nest() {
        LSystem inner = builder.system();
        builder.system().label = "1";
        inner.label = "2";
        std::reverse(inner.productions.begin(), inner.productions.end());
        std::vector<ModuleTemplate>& axiom = builder.system().axiom;
        const auto third = static_cast<std::ptrdiff_t>(axiom.size() / 3);
        axiom.insert(axiom.begin() + 2 * third, builder.module("$", {}));
        axiom.insert(axiom.begin() + third, builder.module("?", {number(2)}));
        builder.model().systems.push_back(std::move(inner));
    }

    std::mt19937 random_;
    Traits kind_;
    std::vector<int> arities_;
};

/// The way a step of such a string takes.
std::string way_of(const CompiledModel& model, const ModuleString& from) {
    const CompiledSystem& main = model.main();
    const std::string size = from.size() > grain ? ", in parts" : ", at once";
    if (model.nested) return "sub-L-systems" + size;
    if (main.serial()) return "in order" + size;
    if (!main.decomposition.empty()) return "decomposed" + size;
    ModuleString to;
    const bool may_be_simple = !model.uses_context && !main.may_cut;
    if (may_be_simple && rewrite_small(main, from, 1, std::size_t(-1), to)) return "in one pass, at once";
    if (main.plans.all_known) return "told by letters" + size;
    if (!model.uses_context) return (main.rules.stochastic ? "sampled" : "tested") + size;
    return (main.choosing.sides.positions ? "by neighbours" : "by neighbours' letters") + size;
}

/// Counts the steps that each way was taken for.
void compare(ModelOfManyWays& random, std::size_t threads, std::map<std::string, int>& ways) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    const auto compiled = random.builder.compiled();
    DerivationSettings settings = with_lineage(3);
    settings.printout = std::make_shared<Printout>([](const std::string&) {});
    Derivation derivation(compiled, settings);
    settings.one_by_one = true;
    Derivation reference(compiled, settings);
    ModuleString string, next, expected;
    derivation.start(string);
    reference.start(expected);
    for (int step = 1; step <= 5 && string.size() < 60'000; ++step) {
        INFO("step " << step << ", " << way_of(*compiled, string));
        ++ways[way_of(*compiled, string)];
        derivation.step(string, next);
        reference.step(string, expected);
        REQUIRE(same(next, expected));
        std::swap(string, next);
    }
}

}  // namespace

TEST_CASE("every way of doing a step writes what replacing one module after the other writes", "[lsystem]") {
    const Traits kinds[] = {{},
                            {.several = true},
                            {.conditions = true},
                            {.weights = true},
                            {.conditions = true, .weights = true, .several = true},
                            {.cpfg = true},
                            {.contexts = true, .conditions = true, .weights = true, .cpfg = true},
                            {.contexts = true},
                            {.contexts = true, .nearest = true},
                            {.contexts = true, .weights = true, .nearest = true},
                            {.contexts = true, .conditions = true},
                            {.contexts = true, .conditions = true, .weights = true, .several = true},
                            {.contexts = true, .weights = true, .cuts = true},
                            {.conditions = true, .decomposition = true},
                            {.conditions = true, .several = true, .decomposition = true},
                            {.contexts = true, .weights = true, .several = true, .decomposition = true, .cuts = true},
                            {.contexts = true, .conditions = true, .cuts = true, .blocks = true},
                            {.contexts = true, .weights = true, .decomposition = true, .sub_systems = true}};
    std::map<std::string, int> ways;
    for (const Traits& kind : kinds) {
        for (unsigned seed = 0; seed < 60; ++seed) {
            INFO("kind " << &kind - kinds << ", seed " << seed);
            ModelOfManyWays random(seed, kind, seed % 10 == 9 ? 25'000 : 40);
            compare(random, 1 + seed % 3, ways);
        }
    }
    std::string taken;
    for (const auto& [way, steps] : ways) taken += way + ": " + std::to_string(steps) + "\n";
    INFO(taken);
    CHECK(ways["in one pass, at once"] > 10);
    for (const char* way : {"told by letters", "sampled", "tested", "by neighbours", "by neighbours' letters",
                            "decomposed", "in order", "sub-L-systems"}) {
        for (const char* size : {", at once", ", in parts"}) {
            INFO(way << size);
            CHECK(ways[std::string(way) + size] > 10);
        }
    }
}
