// One interpretation: in parallel where that gives the same, else in one piece.
#include "espalier/turtle/interpretation.h"

#include "turtle/walk/parallel_walk.h"

namespace espalier::turtle {

void Interpretation::clear() {
    geometry.clear();
    queries.clear();
    answers.clear();
    directions.clear();
}

void interpret(const Model& model, const SymbolTable& symbols, const ModuleString& string,
               const TurtleSettings& settings, const Derivation* derivation, const InterpretOptions& options,
               Interpretation& result) {
    const bool pictured = derivation && derivation->has_homomorphism();
    const WalkInput input{model, symbols, string, settings, pictured ? derivation : nullptr, options.plant};
    result.clear();
    if (walk_in_parallel(input, options.chunk, result)) return;
    const LentWalk walk(input, result);
    walk->run(0, string.size(), 0);
    walk->finish();
}

Interpretation interpret(const Model& model, const ModuleString& string, const TurtleSettings& settings,
                         const Derivation* derivation) {
    Interpretation result;
    interpret(model, *symbol_table(model), string, settings, derivation, {}, result);
    return result;
}

}  // namespace espalier::turtle
