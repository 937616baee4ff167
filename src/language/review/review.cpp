// What is legal in a model and yet probably not meant.
#include "espalier/language/reader.h"

#include "language/review/parts.h"

namespace espalier::language {

std::vector<Diagnostic> review(const Model& model, const ReviewOptions& options) {
    Findings findings;
    const ModelUses uses(model, options.inserted);
    ModuleReview modules(uses, options.turtle, findings);
    review_words(uses, findings);
    const auto review_set = [&](const std::vector<Production>& productions, bool stochastic) {
        review_rules(productions, stochastic, uses, findings);
        for (const Production& production : productions) modules.review_successor(production);
    };
    for (const LSystem& system : model.systems) {
        review_set(system.decomposition.productions, false);
        review_set(system.homomorphism.productions, false);
        review_set(system.productions, system.seed.has_value());
        review_filter(system, uses, findings);
        review_homomorphism(system.homomorphism, uses, findings);
        modules.review_axiom(system.axiom);
        review_statements(system, findings);
        modules.review_symbol_parts(system);
    }
    modules.review_ends();
    modules.review_numbers_of_parameters();
    review_processes(uses, findings);
    review_calls(uses, findings);
    return findings.in_order();
}

}  // namespace espalier::language
