// The plainest derivation there is, one module at a time: what every fast path must agree with.
#pragma once

#include "espalier/base/random.h"

#include "lsystem/model_builder.h"

#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

namespace espalier::test {

using namespace espalier::lsystem;

struct PlainModule {
    LetterId letter = no_letter;
    std::vector<double> values;
    Identity identity = 0, parent = 0;
    std::uint32_t birth = 0;
};

using PlainString = std::vector<PlainModule>;

/// Numbers, formals, + - * / % < && ||, and conditionals.
inline double plain_value(const Expression& expression, const std::vector<double>& formals) {
    const auto operand = [&](std::size_t k) { return plain_value(expression.operands[k], formals); };
    switch (expression.kind) {
        case Expression::Kind::number:
            return expression.value;
        case Expression::Kind::formal:
            return formals.at(expression.index);
        case Expression::Kind::conditional:
            return operand(operand(0) != 0 ? 1 : 2);
        default:
            break;
    }
    switch (expression.op) {
        case Operator::add:
            return operand(0) + operand(1);
        case Operator::subtract:
            return operand(0) - operand(1);
        case Operator::multiply:
            return operand(0) * operand(1);
        case Operator::divide:
            return operand(0) / operand(1);
        case Operator::remainder:
            return std::fmod(std::trunc(operand(0)), std::trunc(operand(1)));
        case Operator::logical_and:
            return operand(0) != 0 && operand(1) != 0;
        case Operator::logical_or:
            return operand(0) != 0 || operand(1) != 0;
        default:
            return operand(0) < operand(1);
    }
}

/// The productions in file order whose strict predecessors begin at a module and whose conditions hold.
inline std::vector<const Production*> plain_candidates(const LSystem& system, const PlainString& string,
                                                       std::size_t at) {
    std::vector<const Production*> candidates;
    std::vector<double> formals;
    for (const Production& production : system.productions) {
        const std::size_t width = production.strict.size();
        if (at + width > string.size()) continue;
        formals.clear();
        bool matches = true;
        for (std::size_t k = 0; k < width; ++k) {
            matches &= production.strict[k].letter == string[at + k].letter;
            formals.insert(formals.end(), string[at + k].values.begin(), string[at + k].values.end());
        }
        if (!matches || (production.condition && plain_value(*production.condition, formals) == 0)) continue;
        candidates.push_back(&production);
    }
    return candidates;
}

/// The first of them or, in a stochastic model (of scene seed 0 and plant 0), the one that is drawn by weight.
inline const Production* plain_choice(const LSystem& system, const PlainString& string, std::size_t at,
                                      std::uint32_t step) {
    const std::vector<const Production*> candidates = plain_candidates(system, string, at);
    if (candidates.empty() || !system.seed) return candidates.empty() ? nullptr : candidates.front();
    const auto weight = [](const Production& production) { return production.weight ? production.weight->value : 1; };
    double sum = 0;
    for (const Production* candidate : candidates) sum += weight(*candidate);
    const RandomKey key(0, 0, Stream::derivation, std::bit_cast<std::uint64_t>(system.seed->value));
    double left = RandomSamples(key, string[at].identity, step).uniform() * sum;
    const Production* chosen = nullptr;
    for (const Production* candidate : candidates) {
        if (weight(*candidate) == 0) continue;
        chosen = candidate;
        left -= weight(*candidate);
        if (left < 0) break;
    }
    return chosen;
}

/// What replaces modules from `at` on: the first of each strict module's symbol carries it on, the others are born.
inline void plain_successor(const Production& production, const Alphabet& alphabet, const PlainString& string,
                            std::size_t at, const std::vector<double>& formals, std::uint32_t step, PlainString& to) {
    const std::size_t first = to.size();
    std::vector<bool> carried(production.successor.size());
    for (const ModuleTemplate& module : production.successor) {
        PlainModule made;
        made.letter = module.letter;
        for (const Expression& argument : module.arguments) made.values.push_back(plain_value(argument, formals));
        to.push_back(made);
    }
    for (std::size_t s = 0; s < production.strict.size(); ++s) {
        for (std::size_t k = 0; k < carried.size(); ++k) {
            if (carried[k] || alphabet.symbol_of(to[first + k].letter) != alphabet.symbol_of(string[at + s].letter)) {
                continue;
            }
            carried[k] = true;
            to[first + k].identity = string[at + s].identity;
            to[first + k].parent = string[at + s].parent;
            to[first + k].birth = string[at + s].birth;
            break;
        }
    }
    std::uint64_t place = 0;
    for (std::size_t k = 0; k < carried.size(); ++k) {
        if (carried[k]) continue;
        to[first + k].identity = mix(mix(string[at].identity, step) ^ place++);
        to[first + k].parent = string[at].identity;
        to[first + k].birth = step;
    }
}

/// Ends early once it has more than `most` modules.
inline PlainString plain_step(const Model& model, const PlainString& string, std::uint32_t step,
                              std::size_t most = std::numeric_limits<std::size_t>::max()) {
    PlainString to;
    for (std::size_t i = 0; i < string.size() && to.size() <= most;) {
        const Production* const production = plain_choice(model.main(), string, i, step);
        if (!production) {
            to.push_back(string[i++]);
            continue;
        }
        std::vector<double> formals;
        for (std::size_t k = 0; k < production->strict.size(); ++k) {
            formals.insert(formals.end(), string[i + k].values.begin(), string[i + k].values.end());
        }
        plain_successor(*production, model.alphabet, string, i, formals, step, to);
        i += production->strict.size();
    }
    return to;
}

inline PlainString plain_copy(const ModuleString& string, const Alphabet& alphabet) {
    PlainString copy(string.size());
    const double* value = string.parameters.data();
    for (std::size_t i = 0; i < copy.size(); ++i) {
        copy[i].letter = string.letters[i];
        const int arity = alphabet.arity(copy[i].letter);
        copy[i].values.assign(value, value + arity);
        value += arity;
        if (!string.has_lineage()) continue;
        copy[i].identity = string.identity(i);
        copy[i].parent = string.parent(i);
        copy[i].birth = string.step_of_birth(i);
    }
    return copy;
}

/// Modules that differ, or more if the strings have not the same length.
inline std::size_t differences(const PlainString& expected, const PlainString& found, bool lineage) {
    if (expected.size() != found.size()) return std::max(expected.size(), found.size());
    std::size_t different = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const PlainModule &a = expected[i], &b = found[i];
        bool same = a.letter == b.letter && a.values == b.values;
        if (lineage) same &= a.identity == b.identity && a.parent == b.parent && a.birth == b.birth;
        different += !same;
    }
    return different;
}

}  // namespace espalier::test
