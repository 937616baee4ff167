#include "environment/light/shade/field.h"

#include "espalier/base/error.h"

#include "base/prefetch.h"
#include "base/vector_clones.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include <array>
#include <cstring>

namespace espalier::environment {
namespace {

using Casts = std::span<const ShadeCast>;
static_assert(sizeof(ShadeCast) == 16, "compared as bytes");

constexpr std::size_t block = 64;     // compared at once
constexpr std::size_t near = 16;      // births and deaths among neighbours
constexpr std::size_t far = 1 << 13;  // births and deaths in a whole plant
constexpr std::size_t far_searches = 16;

/// How many pyramids both begin with.
std::size_t common(Casts a, Casts b) {
    const std::size_t most = std::min(a.size(), b.size());
    std::size_t same = 0;
    while (same + block <= most && std::memcmp(&a[same], &b[same], block * sizeof(ShadeCast)) == 0) same += block;
    while (same < most && a[same] == b[same]) ++same;
    return same;
}

struct Skip {
    std::size_t before = 0, now = 0;
};

/// The fewest pyramids to pass over on either side until both go on alike; 1 and 1 if nothing is found.
Skip skip_near(Casts before, Casts now) {
    for (std::size_t by = 1; by <= near; ++by) {
        if (by < now.size() && now[by] == before[0]) return {0, by};
        if (by < before.size() && before[by] == now[0]) return {by, 0};
        if (by < before.size() && by < now.size() && before[by] == now[by]) return {by, by};
    }
    return {1, 1};
}

std::size_t find_far(Casts in, const ShadeCast& cast) {
    const Casts part = in.first(std::min(in.size(), far));
    return static_cast<std::size_t>(std::find(part.begin(), part.end(), cast) - part.begin());
}

Skip skip_far(Casts before, Casts now) {
    const std::size_t gone = find_far(before, now[0]), come = find_far(now, before[0]);
    if (gone < std::min(before.size(), far) && gone <= come) return {gone, 0};
    if (come < std::min(now.size(), far)) return {0, come};
    return {1, 1};
}

// 2^36 voxels: beyond it even an index of the bricks is too large to be meant.
constexpr double most_voxels = 68719476736.0;
/// How many changes take about as long as a rebuild. With a row of a pyramid's layer as the unit, 12 to 38 ns by how
/// far away its memory is, a rebuild takes 8 for a brick and 2/5 for a layer of a pyramid. Measured with 2 threads,
/// depths of 4 to 16, 1,000 to 400,000 pyramids in 30^3 to 256^3 voxels: true within a factor of 3.5.
std::size_t changes_like_rebuild(const ShadeCasts& casts, std::size_t bricks) {
    std::size_t rows = 0;
    for (int q = 0; q <= casts.rule().depth; ++q) rows += 2 * static_cast<std::size_t>(casts.half_width(q)) + 1;
    const std::size_t layers = casts.casts().size() * (static_cast<std::size_t>(casts.rule().depth) + 1);
    return (8 * bricks + layers * 2 / 5) / rows;
}

constexpr int brick_edge = ShadeBricks::edge;

// Parts whose memory is on its way before the first of them is added.
constexpr std::size_t most_listed = 256;

/// Voxels of a layer; with corners as seen from a brick only those in it.
struct Square {
    int left, right, back, front;

    static Square around(const glm::ivec3& apex, int width, int deep) {
        return {apex.x - width, apex.x + width, apex.z - deep, apex.z + deep};
    }
    bool empty() const { return left > right || back > front; }
    Square within(const Square& other) const {
        return {std::max(left, other.left), std::min(right, other.right), std::max(back, other.back),
                std::min(front, other.front)};
    }
    Square seen_from(const glm::ivec3& origin) const {
        return Square{left - origin.x, right - origin.x, back - origin.z, front - origin.z}.within(
            {0, brick_edge - 1, 0, brick_edge - 1});
    }
    /// What lies to the left of `other`, to its right, behind it and before it.
    std::array<Square, 4> without(const Square& other) const {
        const Square both = within(other);
        if (both.empty()) return {*this, nothing(), nothing(), nothing()};
        return {Square{left, both.left - 1, back, front}, Square{both.right + 1, right, back, front},
                Square{both.left, both.right, back, both.back - 1},
                Square{both.left, both.right, both.front + 1, front}};
    }
    static Square nothing() { return {0, -1, 0, -1}; }
};

ESPALIER_VECTOR_CLONES
void add_parts(std::span<const ShadePart> parts) {
    for (const ShadePart& part : parts) {
        Shade row[brick_edge];
        for (int z = 0; z < brick_edge; ++z) row[z] = z >= part.back && z <= part.front ? part.weight : 0;
        for (int x = part.left; x <= part.right; ++x) {
            Shade* sums = part.layer + x * brick_edge * brick_edge;
            for (int z = 0; z < brick_edge; ++z) sums[z] += row[z];
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
    for (const ShadeCast& cast : casts) {
        extremes.lower = glm::min(extremes.lower, cast.apex);
        extremes.upper = glm::max(extremes.upper, cast.apex);
    }
    for (const ShadeCast& cast : casts) {
        extremes.at_lower += glm::ivec3(glm::equal(cast.apex, extremes.lower));
        extremes.at_upper += glm::ivec3(glm::equal(cast.apex, extremes.upper));
    }
    return extremes;
}

// Every pyramid is as large as any other, so that the box of the apices gives theirs.
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
    bricks_.reserve_bytes(casts.bytes() + ShadeSweep::bytes(casts, box));
    extremes_ = extremes;
    box_ = box;
}

bool ShadeField::show(const ShadeCasts& casts, const ShadeSweep::Leaves& leaves) {
    const bool known = shown_ == casts.before().size();
    const std::size_t most = changes_like_rebuild(casts, bricks_.end());
    if (known && find_changes(casts.before(), casts.casts(), most, changes_)) {
        if (changes_.gone.empty() && changes_.come.empty()) return false;
        if (update(casts, changes_)) return true;
    }
    rebuild(casts, leaves);
    return true;
}

void ShadeField::rebuild(const ShadeCasts& casts, const ShadeSweep::Leaves& leaves) {
    enclose(casts, extremes_of(casts.casts()));
    shown_ = casts.casts().size();
    if (shown_ == 0)
        bricks_.clear();
    else
        sweep_.run(casts, box_, bricks_, leaves);
}

bool ShadeField::update(const ShadeCasts& casts, const ShadeChanges& changes) {
    if (casts.casts().empty()) return false;
    Extremes extremes = extremes_;
    bool known = true;
    for (const ShadeCast& cast : changes.come) extremes.add(cast.apex);
    for (const ShadeCast& cast : changes.gone) known = extremes.remove(cast.apex) && known;
    enclose(casts, known ? extremes : extremes_of(casts.casts()));
    if (!bricks_.cover_also(ShadeBricks::brick_of(box_.lower), ShadeBricks::brick_of(box_.upper))) return false;
    add(casts, changes.come, changes.gone, 1);
    add(casts, changes.gone, changes.come, -1);  // last: a brick that goes is not needed again
    add_listed();
    shown_ = casts.casts().size();
    return true;
}

// A pyramid that moved sideways, as a growing organ's does from step to step, is beside itself in the other list: what
// both cover stays as it is.
void ShadeField::add(const ShadeCasts& casts, std::span<const ShadeCast> some, std::span<const ShadeCast> others,
                     Shade sign) {
    for (std::size_t i = 0; i < some.size(); ++i) {
        const bool moved = i < others.size() && some[i].row == others[i].row && some[i].apex.y == others[i].apex.y;
        list(casts, some[i], moved ? &others[i] : nullptr, sign);
        if (parts_.size() >= most_listed) add_listed();
    }
}

void ShadeField::add_listed() {
    add_parts(parts_);
    parts_.clear();
}

// Lists the parts of one pyramid, brick after brick, without what `except` covers, and has them fetched meanwhile.
void ShadeField::list(const ShadeCasts& casts, const ShadeCast& cast, const ShadeCast* except, Shade sign) {
    const glm::ivec3& apex = cast.apex;
    const VoxelBox bounds = casts.bounds(apex).within(casts.clip());
    const Shade* weights = casts.weights(cast);
    const auto list_part = [&](Shade* layer, const Square& part, Shade weight) {
        if (part.empty()) return;
        for (int x = part.left; x <= part.right; ++x) prefetch(layer + x * brick_edge * brick_edge);
        parts_.push_back({layer, part.left, part.right, part.back, part.front, weight});
    };
    const auto list_brick = [&](const glm::ivec3& brick) {
        const std::int32_t number = sign > 0 ? bricks_.retain(brick) : bricks_.find(brick);
        if (sign < 0) bricks_.release(number);
        Shade* sums = bricks_.sums(static_cast<std::size_t>(number));
        const glm::ivec3 origin = brick * brick_edge;
        const Square whole = Square{bounds.lower.x, bounds.upper.x, bounds.lower.z, bounds.upper.z}.seen_from(origin);
        for (int y = std::max(bounds.lower.y, origin.y); y <= std::min(bounds.upper.y, origin.y + brick_edge - 1);
             ++y) {
            const int q = apex.y - y, width = casts.half_width(q), deep = casts.thickness(q);
            Shade* layer = sums + (y - origin.y) * brick_edge;
            const Square part = Square::around(apex, width, deep).seen_from(origin).within(whole);
            if (except == nullptr) {
                list_part(layer, part, sign * weights[q]);
                continue;
            }
            const Square other = Square::around(except->apex, width, deep).seen_from(origin);
            for (const Square& rest : part.without(other)) list_part(layer, rest, sign * weights[q]);
        }
    };
    for (int y = bounds.lower.y >> 3; y <= bounds.upper.y >> 3; ++y) {
        const BrickSquare square = reached_bricks(casts, apex, y);
        for (int x = square.left; x <= square.right; ++x) {
            for (int z = square.back; z <= square.front; ++z) list_brick({x, y, z});
        }
    }
}

bool find_changes(Casts before, Casts now, std::size_t most, ShadeChanges& changes) {
    changes.gone.clear();
    changes.come.clear();
    std::size_t searches = 0;
    while (true) {
        const std::size_t same = common(before, now);
        before = before.subspan(same);
        now = now.subspan(same);
        Skip skip{before.size(), now.size()};
        const bool last = before.empty() || now.empty();
        if (!last) {
            skip = skip_near(before, now);
            const bool lost =
                skip.before == 1 && skip.now == 1 && !(before.size() > 1 && now.size() > 1 && before[1] == now[1]);
            if (lost && searches++ < far_searches) skip = skip_far(before, now);
        }
        if (changes.gone.size() + changes.come.size() + skip.before + skip.now > most) return false;
        changes.gone.insert(changes.gone.end(), before.begin(),
                            before.begin() + static_cast<std::ptrdiff_t>(skip.before));
        changes.come.insert(changes.come.end(), now.begin(), now.begin() + static_cast<std::ptrdiff_t>(skip.now));
        if (last) return true;
        before = before.subspan(skip.before);
        now = now.subspan(skip.now);
    }
}

}  // namespace espalier::environment
