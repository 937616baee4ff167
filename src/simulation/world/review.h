// What is odd about a world, and keeps it from nothing.
#pragma once

#include "espalier/environment/environment.h"
#include "espalier/simulation/ranks.h"
#include "espalier/simulation/scene.h"

#include "simulation/plant/growing_plant.h"

#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace espalier::simulation {

/// Warnings, each once, and the models that they are about.
class Review {
public:
    /// A model of the scene, each once.
    void add(const Model& model, std::shared_ptr<const SymbolTable> symbols) {
        models_.push_back({&model, std::move(symbols)});
    }
    void warn(Diagnostic warning);
    void warn(std::string message) { warnings.push_back({Diagnostic::Severity::warning, Place(), message, ""}); }

    /// Processes that nothing asks. `fields_read`: by turtles.
    void warn_of_unasked(const Scene& scene, const Environment& environment,
                         const std::vector<std::string>& fields_read);
    /// What turtles ignored so far.
    void warn_of_ignored();
    /// On all ranks: the same of the plants on other ranks.
    void warn_of_ignored_elsewhere(Ranks* ranks);

    /// What a whole run has shown, on all ranks. `is_seen`: turtles walked.
    struct WholeRun {
        const Scene& scene;
        const Environment& environment;
        std::span<const GrowingPlant> plants;
        Ranks* ranks;
        int steps;
        bool is_seen;
    };
    void review(const WholeRun& run);

    std::vector<Diagnostic> warnings;  ///< it only grows, and stays where it is

private:
    struct KnownModel {
        const Model* model;
        std::shared_ptr<const SymbolTable> symbols;
        unsigned ignored = 0;  ///< by turtles, and told
    };

    std::set<std::size_t> may_be_asked(const Environment& environment) const;
    void warn_of_undrawn(const WholeRun& run);
    void warn_of_never_asked(const WholeRun& run);

    std::vector<KnownModel> models_;
    std::set<std::string> told_;  ///< what warn() has said
};

}  // namespace espalier::simulation
