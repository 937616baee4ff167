// Replaces one module at a time, decomposing what comes of it depth first.
#pragma once

#include "matching.h"
#include "rewriting.h"

#include <vector>

namespace espalier {

/// Life of one module: who it is, who bore it, when.
struct Lineage {
    Identity identity = 0;
    Identity parent = 0;
    std::uint32_t birth = 0;
};

/// A stack of modules that wait to be replaced, with their values; no memory is taken per module once it is warm.
class ModuleStack {
public:
    struct Entry {
        LetterId letter = no_letter;
        std::uint16_t arity = 0;
        std::uint32_t depth = 0;
        Lineage lineage;
    };

    bool empty() const { return entries_.empty(); }
    void clear() {
        entries_.clear();
        values_.clear();
    }
    void push(const Entry& entry, const double* values) {
        entries_.push_back(entry);
        values_.insert(values_.end(), values, values + entry.arity);
    }
    /// Takes the last entry; its values stay valid until the next call.
    Entry pop(std::vector<double>& values) {
        const Entry entry = entries_.back();
        entries_.pop_back();
        const auto first = values_.end() - entry.arity;
        values.assign(first, values_.end());
        values_.erase(first, values_.end());
        return entry;
    }

private:
    std::vector<Entry> entries_;
    std::vector<double> values_;
};

/// Applies one set of rules to modules, over and over down to its maximum depth.
class Expansion {
public:
    Expansion(const CompiledRules& rules, Matcher& matcher, Machine& machine)
        : rules_(rules), matcher_(matcher), machine_(machine) {}

    /// Replaces what is on the stack until nothing is left, handing each finished module to `emit`.
    /// Contexts are those of the module at `origin`. Throws EvaluationError; `letter` and `values` then tell whose.
    template <class Emitter>
    void run(ModuleStack& stack, const Site& origin, std::uint32_t step, Emitter&& emit);

    /// Takes the last module from the stack and pushes what replaces it. Returns the module if nothing does.
    const ModuleStack::Entry* replace(ModuleStack& stack, const Site& origin, std::uint32_t step);

    /// Evaluates the successor of a production whose formals are bound and pushes it, last module first.
    void push_successor(const CompiledProduction& production, const Lineage* strict, std::uint32_t step,
                        std::uint32_t depth, ModuleStack& stack);

    bool reached_limit() const { return reached_limit_; }
    /// The module that was replaced last.
    LetterId letter() const { return letter_; }
    const double* values() const { return values_.data(); }

private:
    const CompiledRules& rules_;
    Matcher& matcher_;
    Machine& machine_;
    std::vector<double> values_, successor_;
    ModuleStack::Entry entry_;
    LetterId letter_ = no_letter;
    bool reached_limit_ = false;
};

template <class Emitter>
void Expansion::run(ModuleStack& stack, const Site& origin, std::uint32_t step, Emitter&& emit) {
    while (!stack.empty()) {
        if (const ModuleStack::Entry* finished = replace(stack, origin, step)) emit(*finished, values_.data());
    }
}

}  // namespace espalier
