// The registered part that a table names.
#pragma once

#include "espalier/base/registry.h"
#include "espalier/base/settings.h"

#include "base/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace espalier {

/// The part whose name is the text of `key`. Throws UserError for a name that is none, with those there are; `what`
/// says what they are.
template <class Kind>
const Kind& registered_part(const Settings& settings, const char* key, const char* what) {
    const std::string name = settings.text(key);
    const auto& parts = registered<Kind>();
    const auto found = parts.find(name);
    if (found != parts.end()) return *found->second;
    std::vector<std::string> names;
    for (const auto& part : parts) names.push_back(part.first);
    throw UserError(settings.place(key), fmt::format("there is no {} '{}'{}; there are: {}", what, name,
                                                     did_you_mean(name, names), fmt::join(names, ", ")));
}

}  // namespace espalier
