// Whether a model asks anything of the turtle or of a process.
#pragma once

#include "espalier/turtle/interpretation.h"

#include <span>

namespace espalier::turtle {

/// True if the alphabet has a query: a symbol that begins with `?`, or its older name s.
bool has_queries(const Alphabet& alphabet);

/// What the model says of the first parameters of a query where no process answers it; empty: nothing.
std::span<const double> default_answer(const Model& model, const Query& query);
/// Writes these answers of queries, none of which a process answers, into the string that asked.
void write_default_answers(const Model& model, std::span<const Query> queries, ModuleString& string);

}  // namespace espalier::turtle
