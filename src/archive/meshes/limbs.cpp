#include "archive/meshes/limbs.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace espalier::archive {
namespace {

/// The width of a joint by the fillet it is like: so far from a corner does the smooth minimum begin.
constexpr double width_by_fillet = 1.5;

/// The larger of a number and 0, with a smooth bend.
double positive(double x, double softness) {
    if (x > softness) return x;
    return x < -softness ? 0 : (x + softness) * (x + softness) / (4 * softness);
}

}  // namespace

double distance_to(const LimbPiece& piece, const glm::dvec3& point) {
    const glm::dvec3 axis = piece.tip - piece.base, from_base = point - piece.base;
    const double length = glm::length(axis);
    const glm::dvec3 along = axis / length;
    const double taper = (piece.base_radius - piece.tip_radius) / length;  // the sine of half the cone's opening
    const double ahead = glm::dot(from_base, along);
    const double aside = glm::length(from_base - ahead * along);
    // The least of |point - centre| - radius over all centres.
    double centre = taper > 0 ? 0 : length;
    if (std::abs(taper) < 1) centre = std::clamp(ahead - aside * taper / std::sqrt(1 - taper * taper), 0.0, length);
    const double distance = std::hypot(ahead - centre, aside) - piece.base_radius + centre * taper;
    return piece.is_flat ? std::max(distance, -ahead) : distance;
}

double LimbUnion::reach(const LimbPiece& piece) const {
    return width_by_fillet * std::numbers::sqrt2 * blend_ * std::max(piece.base_radius, piece.tip_radius);
}

void LimbUnion::nearest(const glm::dvec3& point, std::span<const std::uint32_t> near,
                        std::vector<Nearest>& found) const {
    found.clear();
    for (const std::uint32_t number : near) {
        const double here = distance_to(pieces_[number], point);
        if (found.empty() || pieces_[found.back().piece].limb != pieces_[number].limb) {
            found.push_back({number, here});
        } else if (here < found.back().distance) {
            found.back() = {number, here};
        }
    }
}

// Between the planes across the ends of a piece, because nearest points jump where a limb tapers or bends.
LimbUnion::Outward LimbUnion::outward_at(std::uint32_t number, const glm::dvec3& point) const {
    const auto before = [&] { return glm::dot(point - pieces_[number].base, pieces_[number].base_tangent); };
    const auto behind = [&] { return glm::dot(pieces_[number].tip - point, pieces_[number].tip_tangent); };
    while (!pieces_[number].is_first && before() < 0) --number;
    while (!pieces_[number].is_last && behind() < 0) ++number;
    const LimbPiece& piece = pieces_[number];
    const double passed = piece.is_first ? positive(before(), 0.5 * piece.base_radius) : std::max(before(), 0.0);
    const double left = piece.is_last ? positive(behind(), 0.5 * piece.tip_radius) : std::max(behind(), 0.0);
    const double share = passed + left > 0 ? passed / (passed + left) : 0.5;
    const glm::dvec3 off = point - (piece.base + share * (piece.tip - piece.base));
    const double length = glm::length(off);
    return {length > 0 ? off / length : piece.base_tangent,
            piece.base_radius + share * (piece.tip_radius - piece.base_radius)};
}

/// How much nearer the surface is where two limbs meet.
double LimbUnion::fill(const glm::dvec3& point, const Nearest& a, const Nearest& b) const {
    const double apart = std::abs(a.distance - b.distance);
    if (apart >= std::min(reach(pieces_[a.piece]), reach(pieces_[b.piece]))) return 0;
    const Outward from_a = outward_at(a.piece, point), from_b = outward_at(b.piece, point);
    const double parallel = std::max(0.0, glm::dot(from_a.direction, from_b.direction));
    const double thinner =
        std::numbers::sqrt2 * from_a.radius * from_b.radius / std::hypot(from_a.radius, from_b.radius);
    const double width = width_by_fillet * blend_ * thinner * (1 - parallel * parallel * parallel * parallel);
    if (apart >= width) return 0;
    const double overlap = 1 - apart / width;
    return width / 6 * overlap * overlap * overlap;
}

double LimbUnion::distance(const glm::dvec3& point, std::span<const Nearest> limbs) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < limbs.size(); ++i) {
        least = std::min(least, limbs[i].distance);
        for (std::size_t k = 0; blend_ > 0 && k < i; ++k) {
            least = std::min(least, std::min(limbs[i].distance, limbs[k].distance) - fill(point, limbs[i], limbs[k]));
        }
    }
    return least;
}

}  // namespace espalier::archive
