// Reads a whole model: declarations, L-systems, their headers and sections.
#pragma once

#include "espalier/lsystem/lsystem.h"

#include "language/preprocessor/preprocessor.h"

namespace espalier::language {

/// Fills `model` from preprocessed text. Mistakes are collected; TooManyMistakes ends the reading.
void parse_model(const Preprocessed& source, const Sources& sources, Mistakes& mistakes, Model& model);

}  // namespace espalier::language
