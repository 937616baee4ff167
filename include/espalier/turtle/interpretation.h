// Interpretation: a turtle walks the string and leaves geometry and queries. A function of its arguments.
#pragma once

#include "espalier/base/error.h"
#include "espalier/base/stations.h"
#include "espalier/geometry/field_values.h"
#include "espalier/geometry/plant_geometry.h"
#include "espalier/lsystem/derivation.h"
#include "espalier/turtle/query.h"
#include "espalier/turtle/turtle.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace espalier::turtle {

/// What one interpretation of one plant yields: the value that processes and recorders all read.
struct Interpretation {
    PlantGeometry geometry;
    QueryColumn queries;           ///< to processes, in string order
    Column<TurtleAnswer> answers;  ///< answers of the turtle itself, in string order
    std::vector<TurtleDirection> directions;

    void clear();
    bool asks() const { return !queries.empty() || !answers.empty() || !directions.empty(); }
};

/// What the turtle does with each letter of a model, looked up once per model. Thread safe to use.
class SymbolTable;
std::shared_ptr<const SymbolTable> symbol_table(const Model& model);

/// What strings said in vain in all walks with this table so far, a bit for each kind of thing.
unsigned ignored_by_turtle(const SymbolTable& symbols);
/// The same as warnings, in a fixed order.
std::vector<Diagnostic> warnings_of_ignored(unsigned ignored, const Model& model);

struct InterpretOptions {
    std::uint32_t plant = 0;
    /// What vector fields of the model read; null: nothing, and their vectors are 0.
    const FieldValues* fields = nullptr;
    /// Modules that a thread walks at least; 0: all in one piece. Changes the time it takes, not the result.
    std::size_t chunk = 8192;
};

/// The fields of processes that the vector fields of a model read.
std::vector<std::string> fields_read_by(const Model& model);

/// Walks `string` once. `derivation` gives modules their pictures (homomorphism); may be null.
/// `result`'s memory is reused. Throws RunError for a stack that is popped empty and for numbers that are none.
void interpret(const Model& model, const SymbolTable& symbols, const ModuleString& string,
               const TurtleSettings& settings, const Derivation* derivation, const InterpretOptions& options,
               Interpretation& result);

/// The one-off form.
Interpretation interpret(const Model& model, const ModuleString& string, const TurtleSettings& settings = {},
                         const Derivation* derivation = nullptr);

/// Writes the turtle's own answers into the string that asked.
void write_turtle_answers(const Interpretation& interpretation, ModuleString& string);
/// The same of some of them, all of which have parameters of their own.
void write_turtle_answers(std::span<const TurtleAnswer> answers, std::span<const TurtleDirection> directions,
                          ModuleString& string);

}  // namespace espalier::turtle
