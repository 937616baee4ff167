// A field of another process, which stands before this one in the scene.
#pragma once

#include "espalier/base/settings.h"
#include "espalier/geometry/field.h"

#include <fmt/format.h>

#include <string>

namespace espalier::environment {

/// The field `name`, of which `key` of the table speaks. Throws UserError that says what to write where there is none:
/// a process of the kind `process`.
inline const Field& needed_field(const Settings& settings, const char* key, const std::string& name,
                                 const Fields& fields, const char* process) {
    if (const Field* const found = fields.find(name)) return *found;
    throw UserError(settings.place(key), fmt::format("there is no {1} called '{0}' before this in the scene: write "
                                                     "[environment.{0}] with process = \"{1}\" above it",
                                                     name, process));
}

}  // namespace espalier::environment
