// Interpretation: a turtle walks the string and leaves geometry and queries. A function of its arguments.
#pragma once

#include "espalier/geometry/plant_geometry.h"
#include "espalier/lsystem/derivation.h"
#include "espalier/turtle/query.h"
#include "espalier/turtle/turtle.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace espalier {

/// What one interpretation of one plant yields: the value that processes and recorders all read.
struct Interpretation {
    PlantGeometry geometry;
    QueryColumn queries;  ///< in string order

    void clear();
};

/// What the turtle does with each letter of a model, looked up once per model. Thread safe to use.
class SymbolTable;
std::shared_ptr<const SymbolTable> symbol_table(const Model& model);

struct InterpretOptions {
    std::uint32_t plant = 0;
    /// Modules that a thread walks at least; 0: all in one piece. Changes the time it takes, not the result.
    std::size_t chunk = 8192;
};

/// Walks `string` once. `derivation` gives modules their pictures (homomorphism); may be null.
/// `result`'s memory is reused. Throws RunError for a stack that is popped empty and for numbers that are none.
void interpret(const Model& model, const SymbolTable& symbols, const ModuleString& string,
               const TurtleSettings& settings, const Derivation* derivation, const InterpretOptions& options,
               Interpretation& result);

/// The one-off form.
Interpretation interpret(const Model& model, const ModuleString& string, const TurtleSettings& settings = {},
                         const Derivation* derivation = nullptr);

/// Answers ?P ?H ?L ?U ?Q from the turtle's state; leaves a `communication` query alone.
void answer_from_turtle(const Query& query, Answer answer);

}  // namespace espalier
