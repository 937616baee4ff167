#include "timeline/meshes/organ_quantities.h"

#include "espalier/base/error.h"

#include "base/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace espalier::timeline {

OrganQuantities::OrganQuantities(const Settings& timeline)
    : names_(timeline.texts_or("organs", {})), place_(timeline.place("organs")) {}

void OrganQuantities::find(const Frame& frame) {
    if (known_.size() == names_.size()) return;
    const std::vector<OrganQuantity> there =
        frame.environment ? frame.environment->organ_quantities() : std::vector<OrganQuantity>();
    std::vector<std::string> names;
    for (const OrganQuantity& quantity : there) names.push_back(quantity.name);
    for (const std::string& name : names_) {
        const auto found = std::find(names.begin(), names.end(), name);
        if (found == names.end()) {
            throw UserError(place_, fmt::format("no process of the scene knows '{}' of organs{}; {}", name,
                                                did_you_mean(name, names),
                                                names.empty() ? "canopy-light and ray-light know what organs absorb"
                                                              : fmt::format("there are: {}", fmt::join(names, ", "))));
        }
        known_.push_back(there[static_cast<std::size_t>(found - names.begin())]);
    }
}

std::vector<std::string> OrganQuantities::units() const {
    std::vector<std::string> units;
    for (const OrganQuantity& quantity : known_) {
        units.push_back(quantity.name + ": " + (quantity.unit.empty() ? "1" : quantity.unit));
    }
    return units;
}

}  // namespace espalier::timeline
