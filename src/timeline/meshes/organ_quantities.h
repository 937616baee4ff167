// What processes know of organs and a scene wants recorded: `organs = ["light.absorbed"]`.
#pragma once

#include "espalier/base/settings.h"
#include "espalier/timeline/frame.h"

#include <span>
#include <string>
#include <vector>

namespace espalier::timeline {

class OrganQuantities {
public:
    /// Reads the key `organs` of [timeline].
    explicit OrganQuantities(const Settings& timeline);

    const std::vector<std::string>& names() const { return names_; }
    std::size_t size() const { return names_.size(); }
    /// Looks them up, once, among those of the frame's environment. Throws UserError naming the nearest.
    void find(const Frame& frame);
    /// Once they are found.
    std::span<const OrganQuantity> known() const { return known_; }
    /// "light.absorbed: mol", one for each.
    std::vector<std::string> units() const;

private:
    std::vector<std::string> names_;
    Place place_;
    std::vector<OrganQuantity> known_;
};

}  // namespace espalier::timeline
