// Finds the production that replaces a module: strict predecessor, contexts along the branches, conditions.
#pragma once

#include "lsystem/compile/compiled_model.h"
#include "lsystem/contexts/neighbours.h"
#include "lsystem/derive/match_watch.h"

#include <cstdint>
#include <span>
#include <string>

namespace espalier::lsystem {

/// A string as matching sees it. Without `neighbours` contexts are looked for step by step, with `partner`; what no
/// production needs may be null.
struct StringView {
    const ModuleString* string = nullptr;
    const std::uint32_t* partner = nullptr;  ///< BranchLinks::partner
    const std::size_t* offsets = nullptr;    ///< parameter offsets, or else `places`
    const Neighbours* neighbours = nullptr;  ///< by Choosing::sides
    const ParameterPlaces* places = nullptr;
};

/// The modules a production is tried on: first to last in the string, and the values of the strict predecessor.
/// `module` differs from the string's letter while a successor is being decomposed.
struct Site {
    std::size_t first = 0;
    std::size_t parameters_at = 0;  ///< where the parameters of `first` begin in the string
    LetterId letter = no_letter;
    const double* values = nullptr;
    Identity identity = 0;  ///< whose random numbers are taken
    std::size_t width = 0;  ///< modules replaced at once; 0: as many as the production's strict predecessor has
    /// Letters behind `letter`, where that is not the string's module `first`.
    const LetterId* following = nullptr;
    std::size_t followers = 0;
};

class Matcher {
public:
    Matcher(const CompiledSystem& model, Machine& machine) : model_(model), machine_(machine) {}
    Matcher(const CompiledSystem& model, const StringView& string, Machine& machine) : Matcher(model, machine) {
        view(string);
    }

    /// Says which string contexts are looked for in.
    void view(const StringView& string) {
        view_ = string;
        letters_ = string.string->letters.data();
        size_ = limit_ = string.string->size();
    }
    /// Strict predecessors end before this module: what stands beyond belongs to another L-system.
    void limit(std::size_t module) { limit_ = module; }

    /// Random numbers of tests are numbered from 0, those of successors from here.
    static constexpr std::uint32_t first_of_successor = 0x80000000;

    void set_random(RandomKey key, std::uint32_t step) {
        key_ = key;
        step_ = step;
    }

    /// The production that applies, with its formals bound; null if none does.
    const CompiledProduction* choose(const CompiledRules& rules, const Site& site);
    /// The same of some of the letter's candidates, if no other can apply.
    const CompiledProduction* choose(const CompiledRules& rules, std::span<const std::uint32_t> candidates,
                                     const Site& site);
    /// The letters of the strict predecessor stand at a site.
    bool match_strict(const CompiledProduction& production, const Site& site) const;
    /// Binds the formals again, as `choose` left them; contexts only if the successor reads them.
    void bind(const CompiledProduction& production, const Site& site);
    /// The same of the strict predecessor alone, whose parameters begin at `values`.
    void bind_strict(const CompiledProduction& production, const double* values) {
        double* const formals = machine_.formals();
        for (const CompiledPattern& pattern : production.strict) {
            for (std::uint32_t k = 0; k < pattern.arity; ++k) formals[pattern.first_formal + k] = *values++;
        }
    }
    /// Begins the random numbers of the successor.
    void begin_successor(const CompiledProduction& production, const Site& site);

private:
    bool applies(const CompiledProduction& production, const Site& site);
    Trial try_out(const CompiledProduction& production, const Site& site);
    const CompiledProduction* choose_first(const CompiledRules& rules, std::span<const std::uint32_t> candidates,
                                           const Site& site);
    const CompiledProduction* choose_by_weight(const CompiledRules& rules, std::span<const std::uint32_t> candidates,
                                               const Site& site);
    double weight(const CompiledProduction& production);
    bool match_left(const CompiledProduction& production, const Site& site);
    bool match_right(const CompiledProduction& production, const Site& site);
    std::size_t left_of(std::size_t module, LetterId sought) const;
    std::size_t right_from(std::size_t module, LetterId sought) const;
    std::size_t find_left(std::size_t module, LetterId sought) const;
    std::size_t find_right(std::size_t module, LetterId sought) const;
    void bind_context(const CompiledPattern& pattern, std::size_t module, const Site& site);
    std::size_t parameters_at(std::size_t module, const Site& site) const;
    std::size_t end_of_branch(std::size_t module) const;

    const CompiledSystem& model_;
    Machine& machine_;
    StringView view_;
    const LetterId* letters_ = nullptr;
    std::size_t size_ = 0, limit_ = 0;
    RandomKey key_;
    std::uint32_t step_ = 0;
    struct Weighted {
        const CompiledProduction* production;
        double weight;
    };
    std::vector<Weighted> pool_;
    MatchWatch* const watch_ = MatchWatch::current();
    const CompiledProduction* bound_ = nullptr;  ///< the production whose formals were bound last
};

/// Throws EvaluationError naming the first value of the successor that is NaN or infinite.
void require_finite(const CompiledProduction& production, const double* values);

/// Adds who suffered it to an error: "file:3:7: division by zero: 1 / 0, in module A(1,0) at step 4".
std::string describe(const EvaluationError& error, const Alphabet& alphabet, LetterId letter, const double* values,
                     std::uint32_t step);

}  // namespace espalier::lsystem
