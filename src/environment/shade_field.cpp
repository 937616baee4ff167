#include "environment/shade_field.h"

#include "espalier/base/error.h"
#include "espalier/base/vector_clones.h"

#include <fmt/format.h>

#include <array>
#include <cstring>

namespace espalier {
namespace {

// 2^36 voxels: beyond it even an index of the bricks is too large to be meant.
constexpr double most_voxels = 68719476736.0;
// A change costs about as much as this many voxels of a rebuild, and as this many of its pyramids (measured).
constexpr std::size_t voxels_per_change = 1000, casts_per_change = 8;

constexpr int edge = ShadeBricks::edge;

ESPALIER_VECTOR_CLONES
void add_parts(std::span<const ShadePart> parts) {
    for (const ShadePart& part : parts) {
        Shade row[edge];
        for (int z = 0; z < edge; ++z) row[z] = z >= part.back && z <= part.front ? part.weight : 0;
        for (int x = part.left; x <= part.right; ++x) {
            Shade* sums = part.layer + x * edge * edge;
            for (int z = 0; z < edge; ++z) sums[z] += row[z];
        }
    }
}

}  // namespace

void ShadeField::Extremes::add(const glm::ivec3& apex) {
    for (int axis = 0; axis < 3; ++axis) {
        if (apex[axis] < lower[axis]) at_lower[axis] = 0;
        if (apex[axis] > upper[axis]) at_upper[axis] = 0;
        lower[axis] = std::min(lower[axis], apex[axis]);
        upper[axis] = std::max(upper[axis], apex[axis]);
        at_lower[axis] += apex[axis] == lower[axis];
        at_upper[axis] += apex[axis] == upper[axis];
    }
}

bool ShadeField::Extremes::remove(const glm::ivec3& apex) {
    bool known = true;
    for (int axis = 0; axis < 3; ++axis) {
        at_lower[axis] -= apex[axis] == lower[axis];
        at_upper[axis] -= apex[axis] == upper[axis];
        known = known && at_lower[axis] > 0 && at_upper[axis] > 0;
    }
    return known;
}

ShadeField::Extremes ShadeField::extremes_of(std::span<const ShadeCast> casts) {
    Extremes extremes;
    for (const ShadeCast& cast : casts) extremes.add(cast.apex);
    return extremes;
}

// Every pyramid is as large as any other, so that the box of the apices tells theirs.
void ShadeField::enclose(const ShadeCasts& casts, const Extremes& extremes) {
    VoxelBox box;
    if (!casts.casts().empty()) {
        box = {casts.bounds(extremes.lower).lower, casts.bounds(extremes.upper).upper};
        box = box.within(casts.clip());
    }
    if (box.voxels() > most_voxels) {
        throw RunError(
            fmt::format("the shadows spread over {:.3g} voxels; take larger voxels, or a fixed domain", box.voxels()));
    }
    extremes_ = extremes;
    box_ = box;
}

bool ShadeField::show(const ShadeCasts& casts) {
    const bool known = shown_ == casts.before().size();
    const std::size_t most =
        bricks_.end() * ShadeBricks::voxels / voxels_per_change + casts.casts().size() / casts_per_change;
    if (known && find_changes(casts.before(), casts.casts(), most, changes_)) {
        if (changes_.gone.empty() && changes_.come.empty()) return false;
        if (update(casts, changes_)) return true;
    }
    rebuild(casts);
    return true;
}

void ShadeField::rebuild(const ShadeCasts& casts) {
    enclose(casts, extremes_of(casts.casts()));
    shown_ = casts.casts().size();
    if (shown_ == 0)
        bricks_.clear();
    else
        sweep_.run(casts, box_, bricks_);
}

bool ShadeField::update(const ShadeCasts& casts, const ShadeChanges& changes) {
    if (casts.casts().empty()) return false;
    Extremes extremes = extremes_;
    bool known = true;
    for (const ShadeCast& cast : changes.come) extremes.add(cast.apex);
    for (const ShadeCast& cast : changes.gone) known = extremes.remove(cast.apex) && known;
    enclose(casts, known ? extremes : extremes_of(casts.casts()));
    if (!bricks_.cover_also(ShadeBricks::brick_of(box_.lower), ShadeBricks::brick_of(box_.upper))) return false;
    for (const ShadeCast& cast : changes.come) add(casts, cast, 1);
    for (const ShadeCast& cast : changes.gone) add(casts, cast, -1);
    shown_ = casts.casts().size();
    return true;
}

// Lists the parts of one pyramid, brick after brick, and fetches them meanwhile.
void ShadeField::add(const ShadeCasts& casts, const ShadeCast& cast, Shade sign) {
    const glm::ivec3& apex = cast.apex;
    const VoxelBox bounds = casts.bounds(apex).within(casts.clip());
    const Shade* weights = casts.weights(cast);
    parts_.clear();
    const auto list = [&](const glm::ivec3& brick) {
        const std::int32_t number = sign > 0 ? bricks_.reach(brick) : bricks_.find(brick);
        if (sign < 0) bricks_.leave(number);
        Shade* sums = bricks_.sums(static_cast<std::size_t>(number));
        const glm::ivec3 origin = brick * edge;
        for (int y = std::max(bounds.lower.y, origin.y); y <= std::min(bounds.upper.y, origin.y + edge - 1); ++y) {
            const int q = apex.y - y, width = casts.half_width(q), deep = casts.thickness(q);
            const ShadePart part{sums + (y - origin.y) * edge,
                                 std::max({apex.x - width, bounds.lower.x, origin.x}) - origin.x,
                                 std::min({apex.x + width, bounds.upper.x, origin.x + edge - 1}) - origin.x,
                                 std::max(apex.z - deep, bounds.lower.z) - origin.z,
                                 std::min(apex.z + deep, bounds.upper.z) - origin.z,
                                 sign * weights[q]};
            for (int x = part.left; x <= part.right; ++x) prefetch(part.layer + x * edge * edge);
            if (part.left <= part.right) parts_.push_back(part);
        }
    };
    for (int y = bounds.lower.y >> 3; y <= bounds.upper.y >> 3; ++y) visit_bricks(casts, apex, y, list);
    add_parts(parts_);
}

}  // namespace espalier
