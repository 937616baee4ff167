// What macros are worth as numbers, and whether those that are settings stay in their ranges.
#pragma once

#include "espalier/language/model_settings.h"

#include "language/preprocessor/preprocessor.h"
#include "language/text/source.h"

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::language {

/// The value of an expression in which names are macros. Throws SyntaxError if it has no finite value.
double value_of(std::string_view expression, const Preprocessed& source);

/// The names of all macros that an expression expands, in the order in which it meets them.
std::vector<std::string> macros_read_by(std::string_view expression, const Preprocessed& source);

/// The documented macros with their values. Those whose value is no number of their range are mistakes, but for those
/// that are functions of the step.
std::vector<ModelSetting> settings_of(const Preprocessed& source, const Sources& sources, Mistakes& mistakes,
                                      const std::set<std::string>& in_time = {});

}  // namespace espalier::language
