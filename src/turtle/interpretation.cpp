// One interpretation: in parallel where that gives the same, else in one piece.
#include "espalier/turtle/interpretation.h"

#include "language/parser/vector_field.h"
#include "turtle/walk/parallel_walk.h"
#include "turtle/walk/symbol_table.h"

#include <set>

namespace espalier::turtle {

void Interpretation::clear() {
    geometry.clear();
    queries.clear();
    answers.clear();
    directions.clear();
}

unsigned ignored_by_turtle(const SymbolTable& symbols) {
    return symbols.ignored;
}

std::vector<Diagnostic> warnings_of_ignored(unsigned ignored, const Model& model) {
    struct Sentence {
        Ignored what;
        const char* text;
    };
    constexpr Sentence sentences[] = {
        {Ignored::up_vector,
         "@R is given an up vector that is not perpendicular to its heading, within 1e-9, or not whole: it has no "
         "effect, and the turtle twists least"},
        {Ignored::tropism,
         "@Ts, @Ti, @Td or @T names a tropism that there is not: it has no effect. They are numbered from 1 in the "
         "order of the view file or of the scene"},
    };
    std::vector<Diagnostic> warnings;
    for (const Sentence& sentence : sentences) {
        if (!(ignored & static_cast<unsigned>(sentence.what))) continue;
        const Place place{model.path.empty() ? model.name : model.path.string()};
        warnings.push_back({Diagnostic::Severity::warning, place, sentence.text, "", /*insistent=*/true});
    }
    return warnings;
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
