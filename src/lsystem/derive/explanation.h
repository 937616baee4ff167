// Why a step replaced a module as it did.
#pragma once

#include "espalier/lsystem/derivation.h"

#include "lsystem/derive/match_watch.h"

#include <string>
#include <vector>

namespace espalier::lsystem {

struct ExplainedProduction {
    const Production* production = nullptr;
    bool is_tried = false;  ///< false: one before it applied
    Trial trial;
    double probability = 1;  ///< probability of being drawn from those that apply
    bool is_chosen = false;
};

struct ExplainedModule {
    std::size_t module = 0;  ///< its index in the old string
    /// False: it was cut off, or replaced together with a module before it.
    bool is_rewritten = false;
    /// All that begin with its letter, in the order of the file.
    std::vector<ExplainedProduction> productions;
};

/// Derives a step from `from`, and tells of all modules of a symbol. The derivation is one that replaces one module
/// after the other (DerivationSettings::one_by_one). Throws RunError as its step() does.
std::vector<ExplainedModule> explain_step(const CompiledModel& model, Derivation& derivation, const ModuleString& from,
                                          SymbolId symbol);

}  // namespace espalier::lsystem
