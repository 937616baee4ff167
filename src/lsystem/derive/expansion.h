// Replaces one module at a time, decomposing what comes of it depth first.
#pragma once

#include "espalier/base/stop.h"

#include "lsystem/derive/matching.h"
#include "lsystem/derive/step.h"

#include <vector>

namespace espalier::lsystem {

/// Who a module is.
struct Lineage {
    Identity identity = 0;
    Birth birth{0, 0};
};

/// Rows of siblings that a part of the new string adds behind those of the old one.
class AddedSiblings {
public:
    explicit AddedSiblings(std::size_t before) : before_(before) {}

    /// Returns the row.
    std::uint32_t add(const Siblings& born) {
        rows_.push_back(born);
        return static_cast<std::uint32_t>(before_ + rows_.size() - 1);
    }
    const Column<Siblings>& rows() const { return rows_; }

private:
    std::size_t before_;
    Column<Siblings> rows_;
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
    std::size_t size() const { return entries_.size(); }
    /// The entry so many places below the last.
    const Entry& below(std::size_t places) const { return entries_[entries_.size() - 1 - places]; }
    /// Appends the values of as many entries, from the last on.
    void copy_values(std::size_t count, std::vector<double>& values) const {
        auto end = values_.end();
        for (std::size_t k = 0; k < count; ++k) {
            const auto begin = end - below(k).arity;
            values.insert(values.end(), begin, end);
            end = begin;
        }
    }
    void drop(std::size_t count) {
        for (; count > 0; --count) {
            values_.resize(values_.size() - entries_.back().arity);
            entries_.pop_back();
        }
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
    /// Rows for those that are born are added to `siblings`, unless that is null.
    Expansion(const CompiledRules& rules, Matcher& matcher, Machine& machine, AddedSiblings* siblings)
        : rules_(rules), matcher_(matcher), machine_(machine), siblings_(siblings) {}

    /// Replaces what is on the stack until nothing is left, handing each finished module to `emit`.
    /// Contexts are those of the module at `origin`. Throws EvaluationError; `letter` and `values` are then of the
    /// module it is about.
    template <class Emitter>
    void run(ModuleStack& stack, const Site& origin, std::uint32_t step, Emitter&& emit);

    /// Takes the last module from the stack and pushes what replaces it. Returns the module if nothing does.
    const ModuleStack::Entry* replace(ModuleStack& stack, const Site& origin, std::uint32_t step);

    /// Evaluates the successor of a production whose formals are bound, those of the strict predecessor to `values`,
    /// and pushes it, last module first.
    void push_successor(const CompiledProduction& production, const double* values, const Lineage* strict,
                        std::uint32_t step, std::uint32_t depth, ModuleStack& stack);
    /// The same, but hands each module to `emit`, first module first: nothing decomposes them.
    template <class Emitter>
    void emit_successor(const CompiledProduction& production, const double* values, const Lineage* strict,
                        std::uint32_t step, Emitter&& emit);

    bool reached_limit() const { return reached_limit_; }
    /// The module that was replaced last.
    LetterId letter() const { return letter_; }
    const double* values() const { return values_.data(); }

private:
    const CompiledRules& rules_;
    Matcher& matcher_;
    Machine& machine_;
    const CompiledProduction* choose(const ModuleStack& stack, Site& site);
    void evaluate(const CompiledProduction& production, const double* values);
    void begin_births(const CompiledProduction& production, const Lineage* strict, std::uint32_t step,
                      std::uint32_t depth);
    /// Returns the lineage of a module of the successor.
    Lineage lineage(const Descent& descent, std::size_t k, const Lineage* strict) const {
        if (descent.carries[k] != Descent::none) return strict[descent.carries[k]];
        const std::uint32_t place = descent.births[k].place;
        return {mix(origin_ ^ place), {row_, place}};
    }

    AddedSiblings* siblings_;
    // Describes the modules that are born of the module at hand.
    std::uint64_t origin_ = 0;
    std::uint32_t row_ = 0;
    std::vector<double> values_, successor_;
    ModuleStack::Entry entry_;
    // For predecessors of several modules.
    std::vector<LetterId> following_;
    std::vector<Lineage> strict_;
    LetterId letter_ = no_letter;
    bool reached_limit_ = false;
    StopCheck<1024> check_stop_;
};

inline const ModuleStack::Entry* Expansion::replace(ModuleStack& stack, const Site& origin, std::uint32_t step) {
    check_stop_();
    entry_ = stack.pop(values_);
    letter_ = entry_.letter;
    if (!rules_.has(entry_.letter)) return &entry_;
    if (entry_.depth >= rules_.maximum_depth) {
        reached_limit_ |= entry_.depth > 0 && rules_.always[entry_.letter] >= 0;
        return &entry_;
    }
    Site site = origin;
    site.letter = entry_.letter;
    site.identity = mix(entry_.lineage.identity, entry_.depth + 1);
    const CompiledProduction* const production = choose(stack, site);
    if (!production) return &entry_;
    matcher_.begin_successor(*production, site);
    const std::size_t more = production->strict.size() - 1;
    strict_.assign(1, entry_.lineage);
    for (std::size_t k = 0; k < more; ++k) strict_.push_back(stack.below(k).lineage);
    stack.drop(more);
    push_successor(*production, values_.data(), strict_.data(), step, entry_.depth + 1, stack);
    return nullptr;
}

template <class Emitter>
void Expansion::emit_successor(const CompiledProduction& production, const double* values, const Lineage* strict,
                               std::uint32_t step, Emitter&& emit) {
    evaluate(production, values);
    begin_births(production, strict, step, 0);
    const double* at = successor_.data();
    for (std::size_t k = 0; k < production.length; ++k) {
        const std::uint16_t arity = production.arities[k];
        emit(production.letters[k], at, arity, lineage(production.descent, k, strict));
        at += arity;
    }
}

template <class Emitter>
void Expansion::run(ModuleStack& stack, const Site& origin, std::uint32_t step, Emitter&& emit) {
    while (!stack.empty()) {
        if (const ModuleStack::Entry* finished = replace(stack, origin, step)) emit(*finished, values_.data());
    }
}

}  // namespace espalier::lsystem
