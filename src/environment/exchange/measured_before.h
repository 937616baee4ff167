// What processes that stand before another one in the scene measure of organs.
#pragma once

#include "espalier/environment/environment.h"

#include <algorithm>
#include <string>
#include <vector>

namespace espalier::environment {

/// Whether the process `other` stands before `self` and measures this quantity.
inline bool measures_before(const Environment& environment, const std::string& self, const std::string& other,
                            const std::string& quantity) {
    const auto at = environment.find(other), own = environment.find(self);
    if (!at || !own || *at >= *own) return false;
    const std::vector<OrganQuantity> all = environment.organ_quantities();
    return std::any_of(all.begin(), all.end(),
                       [&](const OrganQuantity& one) { return one.name == other + "." + quantity; });
}

}  // namespace espalier::environment
