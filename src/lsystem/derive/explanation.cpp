#include "lsystem/derive/explanation.h"

#include "lsystem/compile/compiled_model.h"
#include "lsystem/derive/matching.h"

#include <algorithm>
#include <map>

namespace espalier::lsystem {
namespace {

/// Keeps what is tried on modules of one symbol; decompositions are no matter of the step.
class Listener final : public MatchWatch {
public:
    Listener(const CompiledModel& model, SymbolId symbol) : model_(model), symbol_(symbol) {}

    void begins(const CompiledRules& rules, const Site& site) override {
        const bool rewrites = std::any_of(model_.systems.begin(), model_.systems.end(),
                                          [&](const auto& system) { return &system->rules == &rules; });
        now_ = nullptr;
        if (!rewrites || model_.source->alphabet.symbol_of(site.letter) != symbol_) return;
        now_ = &modules_[site.first];
        *now_ = {site.first, true, {}};
        for (std::uint32_t k = rules.first[site.letter]; k < rules.first[site.letter + 1]; ++k) {
            now_->productions.push_back({rules.productions[rules.candidates[k]].source, false, {}, 1, false});
        }
    }
    void tried(const CompiledProduction& production, const Trial& trial) override {
        if (ExplainedProduction* const told = told_of(&production)) {
            told->is_tried = true;
            told->trial = trial;
        }
    }
    void weighed(const CompiledProduction& production, double probability) override {
        if (ExplainedProduction* const told = told_of(&production)) told->probability = probability;
    }
    void chose(const CompiledProduction* production) override {
        if (ExplainedProduction* const told = told_of(production)) told->is_chosen = true;
        now_ = nullptr;
    }

    std::vector<ExplainedModule> told(const ModuleString& from) {
        std::vector<ExplainedModule> all;
        for (std::size_t i = 0; i < from.size(); ++i) {
            if (model_.source->alphabet.symbol_of(from.letters[i]) != symbol_) continue;
            const auto found = modules_.find(i);
            all.push_back(found == modules_.end() ? ExplainedModule{i, false, {}} : std::move(found->second));
        }
        return all;
    }

private:
    ExplainedProduction* told_of(const CompiledProduction* production) {
        if (!now_ || !production) return nullptr;
        for (ExplainedProduction& told : now_->productions) {
            if (told.production == production->source) return &told;
        }
        return nullptr;
    }

    const CompiledModel& model_;
    SymbolId symbol_;
    ExplainedModule* now_ = nullptr;
    std::map<std::size_t, ExplainedModule> modules_;
};

}  // namespace

std::vector<ExplainedModule> explain_step(const CompiledModel& model, Derivation& derivation, const ModuleString& from,
                                          SymbolId symbol) {
    Listener listener(model, symbol);
    ModuleString to;
    {
        const MatchWatch::Scope scope(listener);
        derivation.step(from, to);
    }
    return listener.told(from);
}

}  // namespace espalier::lsystem
