// Contexts and choices against a plain reading of the language: every neighbour is searched for, every production
// tried.
#include "catch.h"
#include "lsystem/contexts/neighbours.h"
#include "lsystem/model_builder.h"

#include <tbb/global_control.h>

#include <bit>
#include <random>

using namespace espalier;
using namespace espalier::lsystem;
using namespace espalier::test;

namespace {

const std::string symbols = "ABC+-[]";

int arity_of(char symbol) {
    return symbol == 'A' ? 1 : symbol == 'C' ? 2 : 0;
}

struct Module {
    char symbol = 0;
    std::vector<double> values;

    bool operator==(const Module&) const = default;
};
using Modules = std::vector<Module>;

/// Tests whether a formal is less than a number or than another formal.
struct Less {
    int left, right;  ///< a negative right stands for the number
    double number;
};

struct Rule {
    std::string left, right;
    char strict = 'A';
    std::optional<Less> condition;
    std::optional<double> weight;
    std::string successor;
    std::vector<int> arguments;  ///< formals; negative: a constant
};

struct Plain {
    std::string ignored;
    bool ring = false, stochastic = false;
    std::vector<Rule> rules;

    static constexpr long none = -1;

    bool ignores(char symbol) const { return ignored.find(symbol) != std::string::npos; }
    static long partner(const Modules& string, long bracket);
    static long end_of_branch(const Modules& string, long at);
    bool match_left(const Modules& string, long at, std::string pattern, std::vector<double>& formals) const;
    bool match_right(const Modules& string, long at, const std::string& pattern, std::vector<double>& formals) const;
    bool applies(const Modules& string, long at, const Rule& rule, std::vector<double>& formals) const;
    Modules step(const Modules& string, const std::function<double(std::size_t)>& uniform) const;
};

long Plain::partner(const Modules& string, long bracket) {
    const int direction = string[bracket].symbol == '[' ? 1 : -1;
    long depth = 0;
    for (long i = bracket; i >= 0 && i < long(string.size()); i += direction) {
        if (string[i].symbol == '[') depth += 1;
        if (string[i].symbol == ']') depth -= 1;
        if (depth == 0) return i;
    }
    return none;
}

bool Plain::match_left(const Modules& string, long at, std::string pattern, std::vector<double>& formals) const {
    bool wrapped = !ring;
    for (--at; !pattern.empty(); --at) {
        if (at < 0) {
            if (wrapped) return false;
            wrapped = true;
            at = long(string.size()) - 1;
        }
        const char symbol = string[at].symbol;
        if (symbol == pattern.back() && (symbol == '[' || symbol == ']' || !ignores(symbol))) {
            formals.insert(formals.begin(), string[at].values.begin(), string[at].values.end());
            pattern.pop_back();
        } else if (symbol == ']') {
            at = partner(string, at);
            if (at == none) return false;
        } else if (symbol != '[' && !ignores(symbol)) {
            return false;
        }
    }
    return true;
}

long Plain::end_of_branch(const Modules& string, long at) {
    const long size = long(string.size());
    while (at < size && string[at].symbol == '[') {
        if (partner(string, at) == none) return size;
        at = partner(string, at) + 1;
    }
    if (at >= size || string[at].symbol == ']') return at;
    long depth = 0;
    for (; at < size; ++at) {
        depth += string[at].symbol == '[' ? 1 : string[at].symbol == ']' ? -1 : 0;
        if (depth < 0) return partner(string, at) == none ? size : at;
    }
    return size;
}

bool Plain::match_right(const Modules& string, long at, const std::string& pattern,
                        std::vector<double>& formals) const {
    const long size = long(string.size());
    bool wrapped = !ring;
    std::size_t k = 0;
    for (++at; k < pattern.size(); ++at) {
        if (pattern[k] == '=') {
            at = end_of_branch(string, at) - 1;
            ++k;
            continue;
        }
        if (at == size) {
            if (wrapped) return false;
            wrapped = true;
            at = 0;
        }
        const char symbol = string[at].symbol;
        if (ignores(symbol)) continue;
        if (symbol == pattern[k]) {
            formals.insert(formals.end(), string[at].values.begin(), string[at].values.end());
            ++k;
        } else if (symbol == '[' && partner(string, at) != none) {
            at = partner(string, at);
        } else {
            return false;
        }
    }
    return true;
}

bool Plain::applies(const Modules& string, long at, const Rule& rule, std::vector<double>& formals) const {
    std::vector<double> left, right;
    if (string[at].symbol != rule.strict || !match_left(string, at, rule.left, left) ||
        !match_right(string, at, rule.right, right)) {
        return false;
    }
    formals = left;
    formals.insert(formals.end(), string[at].values.begin(), string[at].values.end());
    formals.insert(formals.end(), right.begin(), right.end());
    if (!rule.condition) return true;
    const Less& less = *rule.condition;
    return formals[less.left] < (less.right < 0 ? less.number : formals[less.right]);
}

Modules Plain::step(const Modules& string, const std::function<double(std::size_t)>& uniform) const {
    Modules next;
    for (std::size_t i = 0; i < string.size(); ++i) {
        std::vector<std::pair<const Rule*, std::vector<double>>> pool;
        double sum = 0;
        for (const Rule& rule : rules) {
            std::vector<double> formals;
            if (!applies(string, long(i), rule, formals)) continue;
            pool.emplace_back(&rule, formals);
            sum += rule.weight.value_or(1);
            if (!stochastic) break;
        }
        const std::pair<const Rule*, std::vector<double>>* chosen = nullptr;
        double left = stochastic && sum > 0 ? uniform(i) * sum : 0;
        for (const auto& candidate : pool) {
            if (stochastic && candidate.first->weight.value_or(1) == 0) continue;
            chosen = &candidate;
            left -= candidate.first->weight.value_or(1);
            if (left < 0) break;
        }
        if (!chosen) {
            next.push_back(string[i]);
            continue;
        }
        std::size_t argument = 0;
        for (const char symbol : chosen->first->successor) {
            Module module{symbol, {}};
            for (int k = 0; k < arity_of(symbol); ++k) {
                const int formal = chosen->first->arguments[argument++];
                module.values.push_back(formal < 0 ? -formal : chosen->second[formal]);
            }
            next.push_back(std::move(module));
        }
    }
    return next;
}

class Randomly {
public:
    explicit Randomly(unsigned seed) : generator_(seed) {}

    int below(int n) { return std::uniform_int_distribution(0, n - 1)(generator_); }
    bool once_in(int n) { return below(n) == 0; }
    /// Mostly with matching brackets.
    std::string word(std::size_t length, const std::string& of) {
        std::string word;
        int depth = 0;
        while (word.size() < length) {
            const char symbol = of[below(int(of.size()))];
            if (symbol == ']' && depth == 0 && !once_in(50)) continue;
            depth += symbol == '[' ? 1 : symbol == ']' ? -1 : 0;
            word += symbol;
        }
        while (depth-- > 0 && !once_in(50)) word += ']';
        return word;
    }
    Plain model();

private:
    std::string right_pattern();
    Rule rule(bool stochastic);

    std::mt19937 generator_;
};

std::string Randomly::right_pattern() {
    const char* const patterns[] = {"", "A", "B", "C", "AB", "[A]B", "[B=]C", "[=]A", "[[A=]=]", "]", "=]B", "["};
    return once_in(3) ? word(below(4), symbols) : patterns[below(12)];
}

Rule Randomly::rule(bool stochastic) {
    Rule made;
    made.left = once_in(2) ? "" : word(1 + below(3), once_in(8) ? symbols : "ABC");
    made.right = right_pattern();
    made.strict = symbols[below(once_in(10) ? 7 : 3)];
    int formals = arity_of(made.strict);
    for (const char symbol : made.left + made.right) formals += arity_of(symbol);
    if (formals > 0 && once_in(3))
        made.condition = Less{below(formals), once_in(2) ? below(formals) : -1, double(below(9))};
    const double weights[] = {0, 0.1, 1, 2, 1.0 / 3};
    if (stochastic && !once_in(3)) made.weight = weights[below(5)];
    made.successor = word(below(4), "ABC+");
    for (const char symbol : made.successor) {
        for (int k = 0; k < arity_of(symbol); ++k) {
            made.arguments.push_back(formals > 0 && !once_in(3) ? below(formals) : -1 - below(8));
        }
    }
    return made;
}

Plain Randomly::model() {
    Plain model;
    const char* const filters[] = {"", "+-", "+-[]", "A+", "[", "]", "-", "BC"};
    model.ignored = filters[below(8)];
    model.ring = once_in(4);
    model.stochastic = once_in(3);
    for (int k = 1 + below(5); k > 0; --k) model.rules.push_back(rule(model.stochastic));
    return model;
}

std::vector<Pattern> patterns_of(const std::string& word) {
    std::vector<Pattern> patterns;
    for (const char symbol : word) patterns.push_back({std::string(1, symbol), arity_of(symbol)});
    return patterns;
}

ModelBuilder built(const Plain& plain, const Modules& axiom) {
    ModelBuilder model;
    const auto module = [&](char symbol, const std::vector<Expression>& arguments) {
        return model.module(std::string(1, symbol), arguments);
    };
    LSystem& system = model.system();
    for (const Module& of : axiom) {
        std::vector<Expression> values;
        for (const double value : of.values) values.push_back(number(value));
        system.axiom.push_back(module(of.symbol, values));
    }
    system.ring = plain.ring;
    if (!plain.ignored.empty()) system.filter = LSystem::Filter::ignore;
    for (const char symbol : plain.ignored)
        system.filtered.push_back(model.model().alphabet.symbol(std::string(1, symbol)));
    if (plain.stochastic) system.seed = number(1);
    for (const Rule& rule : plain.rules) {
        std::vector<ModuleTemplate> successor;
        std::size_t argument = 0;
        for (const char symbol : rule.successor) {
            std::vector<Expression> arguments;
            for (int k = 0; k < arity_of(symbol); ++k, ++argument) {
                const int index = rule.arguments[argument];
                arguments.push_back(index < 0 ? number(-index) : formal(std::uint32_t(index)));
            }
            successor.push_back(module(symbol, arguments));
        }
        Production production =
            model.make(patterns_of(rule.left), patterns_of({rule.strict}), patterns_of(rule.right), successor);
        if (rule.condition) {
            const Less& less = *rule.condition;
            production.condition = formal(std::uint32_t(less.left)) <
                                   (less.right < 0 ? number(less.number) : formal(std::uint32_t(less.right)));
        }
        if (rule.weight) production.weight = number(*rule.weight);
        model.add(std::move(production));
    }
    return model;
}

Modules modules_of(const ModuleString& string, const Alphabet& alphabet) {
    Modules modules;
    const double* value = string.parameters.data();
    for (const LetterId letter : string.letters) {
        const int arity = alphabet.arity(letter);
        modules.push_back({alphabet.name(letter)[0], {value, value + arity}});
        value += arity;
    }
    return modules;
}

Modules valued(Randomly& random, const std::string& word) {
    Modules modules;
    for (const char symbol : word) {
        modules.push_back({symbol, {}});
        for (int k = arity_of(symbol); k > 0; --k) modules.back().values.push_back(random.below(9));
    }
    return modules;
}

/// True if a step of the engine, with so many threads, makes the plain reading's string.
bool agrees(const Plain& plain, const Modules& axiom, std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    ModelBuilder model = built(plain, axiom);
    const DerivationSettings settings = with_lineage(7);
    Derivation derivation(model.compiled(), settings);
    ModuleString string, next;
    derivation.start(string);
    derivation.step(string, next);
    const RandomKey key(7, 0, Stream::derivation, std::bit_cast<std::uint64_t>(1.0));
    const auto uniform = [&](std::size_t i) { return RandomSamples(key, string.identity(i), 1).uniform(); };
    return modules_of(next, model.model().alphabet) == plain.step(axiom, uniform);
}

}  // namespace

TEST_CASE("random contexts, conditions and weights mean what a plain matcher says", "[lsystem]") {
    for (unsigned seed = 0; seed < 4000; ++seed) {
        Randomly random(seed);
        const Plain model = random.model();
        const Modules axiom = valued(random, random.word(std::size_t(random.below(60)), symbols));
        INFO("seed " << seed);
        REQUIRE(agrees(model, axiom, 1));
    }
}

TEST_CASE("contexts reach from thread to thread", "[lsystem]") {
    for (unsigned seed = 0; seed < 12; ++seed) {
        Randomly random(seed);
        const Plain model = random.model();
        const Modules axiom = valued(random, random.word(20'000, "AABBC+-[[]]"));
        INFO("seed " << seed);
        for (const std::size_t threads : {1, 2, 8}) REQUIRE(agrees(model, axiom, threads));
    }
}

namespace {

/// Brackets and five other letters.
ModuleString short_string(Randomly& random) {
    ModuleString string;
    for (const char symbol : random.word(std::size_t(random.below(80)), symbols)) {
        string.append(symbol == '[' ? 0 : symbol == ']' ? 1 : static_cast<LetterId>(2 + symbol % 5));
    }
    return string;
}

}  // namespace

TEST_CASE("neighbours do not depend on the parts that a string is looked at in", "[lsystem]") {
    for (unsigned seed = 0; seed < 2000; ++seed) {
        Randomly random(seed);
        const ModuleString string = short_string(random);
        ContextSides sides;
        sides.ring = random.once_in(2);
        for (ContextSide* side : {&sides.left, &sides.right, &sides.next}) {
            side->wanted = true;
            for (std::uint16_t letter = 0; letter < 7; ++letter) {
                side->codes.push_back(random.once_in(3) ? ContextSide::ignored : letter);
            }
        }
        sides.next.branches = false;
        sides.left.codes[Alphabet::open_bracket] = ContextSide::ignored;
        for (const bool positions : {false, true}) {
            sides.positions = positions;
            Neighbours whole;
            whole.find(sides, string);
            for (const std::size_t grain : {1, 2, 3, 7}) {
                Neighbours parts(grain);
                parts.find(sides, string);
                INFO("seed " << seed << ", grain " << grain);
                REQUIRE(parts.left == whole.left);
                REQUIRE(parts.right == whole.right);
                REQUIRE(parts.next == whole.next);
                REQUIRE(parts.left_classes == whole.left_classes);
                REQUIRE(parts.right_classes == whole.right_classes);
            }
        }
    }
}

TEST_CASE("both sides seen at once are those that are looked for one after the other", "[lsystem]") {
    for (unsigned seed = 0; seed < 2000; ++seed) {
        Randomly random(seed);
        const ModuleString string = short_string(random);
        ContextSides sides;
        sides.left.wanted = sides.right.wanted = true;
        for (std::uint16_t letter = 0; letter < 7; ++letter) {
            const bool keeps = letter > Alphabet::close_bracket && random.once_in(3);
            sides.left.codes.push_back(keeps ? ContextSide::ignored : letter);
            sides.right.codes.push_back(keeps ? ContextSide::ignored : static_cast<std::uint16_t>(10 + letter));
        }
        sides.left.codes[Alphabet::open_bracket] = ContextSide::ignored;
        Neighbours expected;
        expected.find(sides, string);
        sides.at_once = true;
        for (const std::size_t grain : {1, 2, 3, 7, 100}) {
            Neighbours found(grain);
            found.find(sides, string);
            INFO("seed " << seed << ", grain " << grain);
            REQUIRE(found.left_classes == expected.left_classes);
            for (std::size_t i = 0; i < string.size(); ++i) {
                const LetterId letter = string.letters[i];
                const bool asks = letter > Alphabet::close_bracket && sides.right.codes[letter] != ContextSide::ignored;
                if (asks) REQUIRE(found.right_classes[i] == expected.right_classes[i]);
            }
        }
    }
}
