#include "archive/meshes/limbs.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace espalier::archive {

LimbDistance distance_to(const LimbPiece& piece, const glm::dvec3& point) {
    const glm::dvec3 axis = piece.tip - piece.base, from_base = point - piece.base;
    const double length = glm::length(axis);
    const glm::dvec3 along = axis / length;
    const double taper = (piece.base_radius - piece.tip_radius) / length;  // the sine of half the cone's opening
    const double ahead = glm::dot(from_base, along);
    const double aside = glm::length(from_base - ahead * along);
    // The least of |point - centre| - radius over all centres.
    double centre = taper > 0 ? 0 : length;
    if (std::abs(taper) < 1) centre = std::clamp(ahead - aside * taper / std::sqrt(1 - taper * taper), 0.0, length);
    const glm::dvec3 outward = from_base - centre * along;
    const double off = glm::length(outward);
    LimbDistance result{off - piece.base_radius + centre * taper, off > 0 ? outward / off : along,
                        piece.base_radius - centre * taper, centre / length};
    if (piece.flat_base && -ahead > result.distance) {
        result.distance = -ahead;
        result.gradient = -along;
    }
    return result;
}

double LimbUnion::reach(const LimbPiece& piece) const {
    return blend_ * std::max(piece.base_radius, piece.tip_radius);
}

void LimbUnion::nearest(const glm::dvec3& point, std::span<const std::uint32_t> near,
                        std::vector<Nearest>& found) const {
    found.clear();
    for (const std::uint32_t number : near) {
        const LimbPiece& piece = pieces_[number];
        const LimbDistance here = distance_to(piece, point);
        if (found.empty() || pieces_[found.back().piece].limb != piece.limb) {
            found.push_back({number, here});
        } else if (here.distance < found.back().at.distance) {
            found.back() = {number, here};
        }
    }
}

double LimbUnion::distance(std::span<const Nearest> limbs) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Nearest& limb : limbs) least = std::min(least, limb.at.distance);
    for (std::size_t i = 0; i < limbs.size(); ++i) {
        for (std::size_t k = i + 1; k < limbs.size(); ++k) {
            const LimbDistance &a = limbs[i].at, &b = limbs[k].at;
            const double parallel = std::max(0.0, glm::dot(a.gradient, b.gradient));
            const double width = blend_ * std::min(a.radius, b.radius) * (1 - parallel * parallel * parallel * parallel);
            const double overlap = width - std::abs(a.distance - b.distance);
            if (overlap <= 0) continue;
            least = std::min(least, std::min(a.distance, b.distance) - overlap * overlap / (4 * width));
        }
    }
    return least;
}

}  // namespace espalier::archive
