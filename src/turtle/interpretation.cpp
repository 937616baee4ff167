// One interpretation: in parallel where that gives the same, else in one piece.
#include "espalier/turtle/interpretation.h"

#include "language/vector_field.h"
#include "turtle/walk/parallel_walk.h"

#include <set>

namespace espalier::turtle {

void Interpretation::clear() {
    geometry.clear();
    queries.clear();
    answers.clear();
    directions.clear();
}

// A text of a label that reads like such a field is taken for one.
std::vector<std::string> fields_read_by(const Model& model) {
    std::set<std::string> names;
    for (const std::string& text : model.texts) {
        if (VectorField::length_of_reading(text) != text.size()) continue;
        const VectorField field = VectorField::parse(text);
        names.insert(field.fields().begin(), field.fields().end());
    }
    return {names.begin(), names.end()};
}

void interpret(const Model& model, const SymbolTable& symbols, const ModuleString& string,
               const TurtleSettings& settings, const Derivation* derivation, const InterpretOptions& options,
               Interpretation& result) {
    const bool pictured = derivation && derivation->has_homomorphism();
    const WalkInput input{model,         symbols,       string, settings, pictured ? derivation : nullptr,
                          options.plant, options.fields};
    result.clear();
    if (walk_in_parallel(input, options.chunk, result)) return;
    const PooledWalk walk(input, result);
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
