#include "environment/space/neighbours/disc_overlap.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace espalier::environment {

DiscOverlap::DiscOverlap(std::span<const glm::dvec3> centres, std::span<const double> radii)
    : centres_(centres), radii_(radii) {
    double largest = 0;
    for (const double radius : radii) largest = std::max(largest, radius);
    // Below a millionth of the largest all are small alike.
    const int lowest = largest > 0 ? std::ilogb(largest) - 20 : 0;
    std::map<int, std::vector<std::uint32_t>> classes;
    for (std::uint32_t i = 0; i < radii.size(); ++i) {
        classes[radii[i] > 0 ? std::max(std::ilogb(radii[i]), lowest) : lowest].push_back(i);
    }
    for (auto& [size, members] : classes) {
        const double end = std::ldexp(1.0, size + 1);
        std::stable_sort(members.begin(), members.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return radii[a] > radii[b]; });
        levels_.push_back({largest > 0 ? end : 0, PointGrid(centres, members, end)});
    }
}

}  // namespace espalier::environment
