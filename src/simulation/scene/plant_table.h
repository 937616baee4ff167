// The [[plant]] tables of a scene: individuals and stands, and the models they grow from.
#pragma once

#include "espalier/simulation/scene.h"

#include "simulation/scene/keyframes.h"

#include <cstdint>
#include <map>
#include <vector>

namespace espalier::simulation {

/// Collects the mistakes of several places, so that the user reads them all at once.
class Mistakes {
public:
    template <class Action>
    void attempt(const Action& action) {
        try {
            action();
        } catch (const UserError& error) {
            diagnostics_.insert(diagnostics_.end(), error.diagnostics().begin(), error.diagnostics().end());
        }
    }
    void throw_if_any() const {
        if (!diagnostics_.empty()) throw UserError(diagnostics_);
    }

private:
    std::vector<Diagnostic> diagnostics_;
};

/// Replacements of a model's #defines: the table `define` of a plant.
Defines read_defines(const Settings& table);

/// Reads every plant of the scene, in order. Plants with the same model, defines and view share one CompiledModel.
/// `dt`: from one step to the next, for keyframes; `keyframes`: of the scene, by table.
std::vector<Plant> read_plants(const Settings& root, std::uint64_t seed, double dt, Mistakes& mistakes,
                               SceneNotes& notes, const std::vector<std::vector<Keyframes>>& keyframes = {});

}  // namespace espalier::simulation
