#include "environment/light/canopy/leaves.h"

#include "espalier/base/math.h"

#include "geometry/vectors.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace espalier::environment {
namespace {

constexpr std::uint16_t leaf_material = 0;

/// Three strips across the axis, each for two opposite sides of a prism with six: together they hide what it hides.
constexpr int strips = 3;

bool is_drawn(const Internode& internode) {
    return internode.tip != internode.base && internode.base_radius + internode.tip_radius > 0;
}

double parts_of(const Internode& internode, double longest) {
    return std::ceil(glm::distance(internode.base, internode.tip) / longest);
}

/// No triangle without a longer side is larger than the equilateral one.
double least_pieces(const DrawnFace& face, double longest) {
    return std::max(1.0, glm::length(face.area()) / (std::sqrt(3.0) / 4 * longest * longest));
}

/// Of a closed thing, half is turned away from any light.
double seen_share(LitKind kind) {
    return kind == LitKind::leaf ? 1 : 0.5;
}

}  // namespace

void CanopyLeaves::clear() {
    pieces_.clear();
    bounds_ = {};
}

void CanopyLeaves::add(const LeafPiece& piece) {
    check_stop_();
    pieces_.push_back(piece);
    bounds_.add(piece.middle);
}

void CanopyLeaves::add(const Owner& owner, const glm::dvec3& middle, const glm::dvec3& area) {
    add({owner.plant, owner.module, middle, {glm::vec3(area), false}, owner.material, owner.kind});
}

void CanopyLeaves::add(std::uint32_t plant, std::uint32_t module, const glm::dvec3& place, double area) {
    if (!(area > 0)) return;
    const OrientedArea leaf{{static_cast<float>(area), 0, 0}, true};
    add({plant, module, place, leaf, leaf_material, LitKind::leaf});
}

void CanopyLeaves::add(std::uint32_t plant, const PlantGeometry& geometry, double longest, const Optics& optics,
                       bool with_stems, const std::function<void(const ForeseenPieces&)>& require) {
    drawn_.clear();
    drawn_.add_leaves(plant, geometry);
    drawn_.add_bodies(plant, geometry);
    if (require) require(foresee(geometry, longest, with_stems));
    for (std::size_t i = 0; i < drawn_.size(); ++i) {
        const DrawnFace face = drawn_[i];
        const LitKind kind = lit_kind(face.owner.of);
        if (kind == LitKind::stem && !with_stems) continue;
        const std::uint16_t material = optics.require_material(kind, face.owner.colour, plant);
        add(face, {plant, face.owner.module, material, kind}, longest);
    }
    if (!with_stems) return;
    for (const Internode& internode : geometry.internodes) {
        const std::uint16_t material = optics.require_material(LitKind::stem, internode.colour, plant);
        add_stem({plant, internode.module, material, LitKind::stem}, internode, longest);
    }
}

// A corner, or the end of a stem, is nearer than `longest` to the middle of the piece that has it.
ForeseenPieces CanopyLeaves::foresee(const PlantGeometry& geometry, double longest, bool with_stems) const {
    ForeseenPieces foreseen;
    Box corners;
    for (std::size_t i = 0; i < drawn_.size(); ++i) {
        const DrawnFace face = drawn_[i];
        if (lit_kind(face.owner.of) == LitKind::stem && !with_stems) continue;
        foreseen.count += least_pieces(face, longest);
        for (const glm::dvec3& corner : face.corners) corners.add(corner);
    }
    for (const Internode& internode : geometry.internodes) {
        if (!with_stems || !is_drawn(internode)) continue;
        foreseen.count += strips * parts_of(internode, longest);
        corners.add(internode.base);
        corners.add(internode.tip);
    }
    foreseen.box = bounds_;
    if (!corners.empty()) {
        const glm::dvec3 middle = 0.5 * (corners.lower + corners.upper);
        foreseen.box.add(glm::min(corners.lower + longest, middle));
        foreseen.box.add(glm::max(corners.upper - longest, middle));
    }
    foreseen.count += static_cast<double>(pieces_.size());
    return foreseen;
}

void CanopyLeaves::add(const DrawnFace& face, const Owner& owner, double longest) {
    const glm::dvec3 middle = face.middle();
    const bool is_small = std::all_of(face.corners.begin(), face.corners.end(), [&](const glm::dvec3& corner) {
        return glm::distance(corner, middle) <= longest / 2;
    });
    if (is_small) return add(owner, middle, seen_share(owner.kind) * face.area());
    face.for_triangles(
        [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) { cut(owner, a, b, c, longest); });
}

// Halves the longest side until all are short.
void CanopyLeaves::cut(const Owner& owner, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                       double longest) {
    const double ab = glm::distance(a, b), bc = glm::distance(b, c), ca = glm::distance(c, a);
    if (std::max({ab, bc, ca}) <= longest) {
        add(owner, (a + b + c) / 3.0, seen_share(owner.kind) * 0.5 * glm::cross(b - a, c - a));
    } else if (ab >= bc && ab >= ca) {
        const glm::dvec3 middle = 0.5 * (a + b);
        cut(owner, a, middle, c, longest);
        cut(owner, middle, b, c, longest);
    } else {
        cut(owner, b, c, a, longest);
    }
}

void CanopyLeaves::add_stem(const Owner& owner, const Internode& internode, double longest) {
    const glm::dvec3 along = internode.tip - internode.base;
    const double length = glm::length(along);
    if (!is_drawn(internode)) return;
    const auto parts = static_cast<std::int64_t>(parts_of(internode, longest));
    const glm::dvec3 x = any_across(along / length), y = glm::cross(along / length, x);
    for (std::int64_t i = 0; i < parts; ++i) {
        const double t = (double(i) + 0.5) / double(parts);
        const double radius = (1 - t) * internode.base_radius + t * internode.tip_radius;
        const double strip = std::numbers::pi / strips * radius * length / double(parts);
        for (int side = 0; side < strips; ++side) {
            const auto [sine, cosine] = math::sine_and_cosine(std::numbers::pi / strips * side);
            add(owner, internode.base + t * along, strip * (cosine * x + sine * y));
        }
    }
}

void CanopyLeaves::sort_into(const CanopyVoxels& voxels) {
    for (LeafPiece& piece : pieces_) piece.voxel = voxels.number_of(piece.middle);
    std::stable_sort(pieces_.begin(), pieces_.end(),
                     [](const LeafPiece& a, const LeafPiece& b) { return a.voxel < b.voxel; });
    starts_.clear();
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
        if (i == 0 || pieces_[i].voxel != pieces_[i - 1].voxel) starts_.push_back(i);
    }
    starts_.push_back(pieces_.size());
}

std::vector<float> CanopyLeaves::densities(const CanopyVoxels& voxels) const {
    return per_volume(voxels, pieces(),
                      [&](std::size_t i) { return pieces_[i].kind == LitKind::leaf ? area_of(pieces_[i]) : 0.0; });
}

double area_of(const LeafPiece& piece) {
    return glm::length(glm::dvec3(piece.leaf.area));
}

LeavesSeen::LeavesSeen(const glm::dvec3& towards, const LeafAngles& angles, double clumping)
    : towards_(towards),
      above_(clumping * angles.seen_from_above(towards.y)),
      below_(clumping * angles.projection(std::abs(towards.y)) - above_),
      clumping_(clumping) {}

}  // namespace espalier::environment
