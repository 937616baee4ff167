#include "environment/light/shade/sweep.h"

#include "base/parallel.h"
#include "base/vector_clones.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <tuple>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace espalier::environment {
namespace {

constexpr int edge = ShadeBricks::edge;
constexpr int stretch_bricks = 8;           // long enough that beginning one costs little, short enough to share out
constexpr std::size_t most_kept = 1 << 20;  // pyramids, 16 MiB of them, for which memory is kept between two runs
constexpr int slice_bricks = 64;            // along z; eight running rows fit into the first cache

/// A sweep as the loops over single voxels see it.
struct Pass {
    std::span<const ShadeFront> fronts;
    const ShadeWidths& widths;
    const Shade* weights;
    ShadeRows rows;
};

inline void add_layer(const Pass& pass, const ShadeFront& front, const ShadeCast& cast, int q, Shade sign) {
    const int deep = pass.widths.deep[static_cast<std::size_t>(q)];
    Shade* row = pass.rows.rows + static_cast<std::size_t>((front.y - q) & 7) * pass.rows.length;
    const Shade weight = sign * pass.weights[cast.row + static_cast<std::uint32_t>(q)];
    const int first = std::max(cast.apex.z - deep, pass.rows.lower),
              last = std::min(cast.apex.z + deep, pass.rows.upper);
    if (first > last) return;
    row[first - pass.rows.begin] += weight;
    row[last + 1 - pass.rows.begin] -= weight;
}

// The layers with a half-width of `away`.
inline void add_layers(const Pass& pass, const ShadeFront& front, const ShadeCast& cast, int away, Shade sign) {
    const int* first = pass.widths.first_of_width.data() + away;
    const int last = std::min(first[1] - 1, front.lower_layer);
    for (int q = std::max(first[0], front.upper_layer); q <= last; ++q) add_layer(pass, front, cast, q, sign);
}

// What covers x - 1 as well as x, or begins before it at any rate.
ESPALIER_VECTOR_CLONES
void begin(const Pass& pass, int x) {
    for (const ShadeFront& front : pass.fronts) {
        for (int q = front.upper_layer; q <= front.lower_layer; ++q) {
            const int width = pass.widths.wide[static_cast<std::size_t>(q)];
            for (std::uint32_t i = front.first[x - width - pass.rows.base]; i < front.first[x + width - pass.rows.base];
                 ++i) {
                add_layer(pass, front, front.casts[i], q, 1);
            }
        }
    }
}

// Takes in what begins and ends at x.
ESPALIER_VECTOR_CLONES
void advance(const Pass& pass, int x, bool ends) {
    for (const ShadeFront& front : pass.fronts) {
        const std::uint32_t* first = front.first + (x - pass.rows.base);
        for (std::uint32_t i = first[front.nearest]; i < first[front.farthest + 1]; ++i) {
            const ShadeCast& cast = front.casts[i];
            add_layers(pass, front, cast, cast.apex.x - x, 1);
        }
        if (!ends) continue;
        for (std::uint32_t i = first[-1 - front.farthest]; i < first[-front.nearest]; ++i) {
            const ShadeCast& cast = front.casts[i];
            add_layers(pass, front, cast, x - 1 - cast.apex.x, -1);
        }
    }
}

// Past the caches: nothing is looked at again before all has gone through. `to` is aligned as new memory is.
template <class Vector, class Value>
inline void store(Value* to, const Vector& values) {
#ifdef __SSE2__
    static_assert(__STDCPP_DEFAULT_NEW_ALIGNMENT__ >= sizeof(__m128i));
    __m128i parts[sizeof(Vector) / sizeof(__m128i)];
    std::memcpy(parts, &values, sizeof values);
    for (std::size_t i = 0; i < std::size(parts); ++i) _mm_stream_si128(reinterpret_cast<__m128i*>(to) + i, parts[i]);
#else
    std::memcpy(to, &values, sizeof values);
#endif
}

/// Sums of the first 1, 2, ... 8 numbers.
inline void sum_along(EightShades& v) {
    const EightShades none{};
    v += __builtin_shufflevector(none, v, 0, 8, 9, 10, 11, 12, 13, 14);
    v += __builtin_shufflevector(none, v, 0, 0, 8, 9, 10, 11, 12, 13);
    v += __builtin_shufflevector(none, v, 0, 0, 0, 0, 8, 9, 10, 11);
}

/// Or of all eight.
inline std::uint64_t any_of(const EightShades& of) {
    EightShades v = of | __builtin_shufflevector(of, of, 4, 5, 6, 7, 0, 1, 2, 3);
    v |= __builtin_shufflevector(v, v, 2, 3, 0, 1, 6, 7, 4, 5);
    return v[0] | v[1];
}

/// What becomes light of the 64 sums at one x of a brick.
struct LightOfTarget {
    float* to;
    double full_light;
    EightShades all{}, shaded{};

    LightOfTarget(const ShadeTarget& target, int x, double full)
        : to(target.leaf.values + (x & 7) * edge * edge), full_light(full) {}
    [[gnu::always_inline]] void take(const EightShades& sums, int y) {
        constexpr EightShades bits{1, 2, 4, 8, 16, 32, 64, 128};
        all |= sums;
        shaded |= sums != 0 ? bits << (edge * y) : EightShades{};
        EightFloats lights;
        read_lights(full_light, sums, lights);
        store(to + edge * y, lights);
    }
    [[gnu::always_inline]] void finish(ShadeTarget& target, int x) const {
        target.all |= any_of(all);
        target.leaf.shaded[x & 7] = any_of(shaded);
    }
};
struct NoLight {
    NoLight(const ShadeTarget&, int, double) {}
    void take(const EightShades&, int) {}
    void finish(ShadeTarget&, int) const {}
};

// The sums at x, of brick after brick along z. Between bricks that do not follow each other nothing is shaded.
template <class Light>
[[gnu::always_inline]] inline void write_with(std::span<ShadeTarget> targets, const ShadeRows& rows, int x,
                                              double full_light) {
    std::uint64_t before[edge] = {};
    std::size_t next = 0;
    for (ShadeTarget& target : targets) {
        if (target.at != next) std::fill(before, before + edge, 0);
        next = target.at + edge;
        Shade* to = target.sums + (x & 7) * edge * edge;
        const Shade* from = rows.rows + target.at;
        Light light(target, x, full_light);
        for (int y = 0; y < edge; ++y, to += edge, from += rows.length) {
            EightShades sums;
            std::memcpy(&sums, from, sizeof sums);
            sum_along(sums);
            sums += before[y];
            before[y] = sums[edge - 1];
            store(to, sums);
            light.take(sums, y);
        }
        light.finish(target, x);
    }
}

ESPALIER_VECTOR_CLONES
void write(std::span<ShadeTarget> targets, const ShadeRows& rows, int x) {
    write_with<NoLight>(targets, rows, x, 0);
}

ESPALIER_VECTOR_CLONES
void write_and_light(std::span<ShadeTarget> targets, const ShadeRows& rows, int x, double full_light) {
    write_with<LightOfTarget>(targets, rows, x, full_light);
}

void clear(std::span<const ShadeTarget> targets, int x, double full_light) {
    const std::ptrdiff_t at = (x & 7) * edge * edge;
    for (const ShadeTarget& target : targets) {
        std::fill_n(target.sums + at, edge * edge, 0);
        if (target.leaf.values == nullptr) continue;
        std::fill_n(target.leaf.values + at, edge * edge, static_cast<float>(full_light));
        target.leaf.shaded[x & 7] = 0;
    }
}

/// Of the apices of pyramids in a box around them, which may stand above what it was cut to.
std::size_t heights_of(const ShadeCasts& casts, const VoxelBox& box) {
    return static_cast<std::size_t>(std::int64_t{box.upper.y} - box.lower.y + casts.rule().depth + 1);
}

}  // namespace

// Each stretch of bricks is summed by one thread; sums of whole numbers do not depend on their order.
void ShadeSweep::run(const ShadeCasts& casts, const VoxelBox& box, ShadeBricks& bricks, const Leaves& leaves) {
    bricks.cover(ShadeBricks::brick_of(box.lower), ShadeBricks::brick_of(box.upper));
    measure(casts);
    sort(casts, box, bricks.first().z);
    count(casts, bricks);
    bricks.set_reach(counts_);
    list_stretches(bricks);
    leaves_ = leaves ? leaves() : std::span<const ShadeLeaf>();
    for_in_parallel(std::size_t{0}, stretches_.size(), [&](std::size_t i) { sweep(casts, stretches_[i], bricks); });
    if (sorted_.capacity() > most_kept) sorted_ = Column<ShadeCast>();  // frees its memory; = {} would not
}

std::size_t ShadeSweep::bytes(const ShadeCasts& casts, const VoxelBox& box) {
    if (casts.casts().empty()) return 0;
    const auto depth = static_cast<std::size_t>(casts.rule().depth);
    const auto wide = static_cast<std::size_t>(casts.half_width(casts.rule().depth));
    const auto deep = static_cast<std::size_t>(casts.thickness(casts.rule().depth));
    const std::size_t slices = 1 + (2 * deep + edge * slice_bricks - 1) / (edge * slice_bricks);
    const std::size_t rows = edge * edge * (slice_bricks + 1) * sizeof(Shade);
    const std::size_t fronts = std::min(edge + depth, casts.casts().size()) *
                               (sizeof(ShadeFront) + (edge * stretch_bricks + 2 * wide + 4) * sizeof(std::uint32_t));
    const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
    const std::size_t slices_of_box = std::size_t(box.upper.z - std::int64_t{box.lower.z}) / (edge * slice_bricks) + 2;
    return slices * casts.casts().size() * sizeof(ShadeCast) + threads * (rows + fronts) +
           slices_of_box * heights_of(casts, box) * sizeof(std::size_t);
}

void ShadeSweep::measure(const ShadeCasts& casts) {
    if (!widths_.deep.empty()) return;
    for (int q = 0; q <= casts.rule().depth; ++q) {
        widths_.wide.push_back(casts.half_width(q));
        widths_.deep.push_back(casts.thickness(q));
        widths_.first_of_width.resize(static_cast<std::size_t>(casts.half_width(q)) + 1, q);
    }
    widths_.first_of_width.push_back(casts.rule().depth + 1);
}

// Counted by slice and height, then sorted along x. Those at one x may stand in any order.
void ShadeSweep::sort(const ShadeCasts& casts, const VoxelBox& box, int first_z) {
    const int deep = casts.thickness(casts.rule().depth), least = box.lower.y;
    const std::size_t heights = heights_of(casts, box);
    const auto slice_of = [&](int z) { return ((z >> 3) - first_z) / slice_bricks; };
    const int first_slice = slice_of(box.lower.z), slices = slice_of(box.upper.z) - first_slice + 1;
    const auto for_places = [&](const auto& visit) {
        for (const ShadeCast& cast : casts.casts()) {
            const int last = slice_of(std::min(cast.apex.z + deep, box.upper.z));
            for (int slice = slice_of(std::max(cast.apex.z - deep, box.lower.z)); slice <= last; ++slice) {
                visit(static_cast<std::size_t>(slice - first_slice) * heights +
                          static_cast<std::size_t>(cast.apex.y - least),
                      cast);
            }
        }
    };
    std::vector<std::size_t> ends(static_cast<std::size_t>(slices) * heights + 1);
    for_places([&](std::size_t layer, const ShadeCast&) { ++ends[layer + 1]; });
    for (std::size_t i = 1; i < ends.size(); ++i) ends[i] += ends[i - 1];
    sorted_.resize(ends.back());
    for_places([&](std::size_t layer, const ShadeCast& cast) { sorted_[ends[layer]++] = cast; });
    list_layers(first_slice, least, heights, ends);
    for_in_parallel(std::size_t{0}, layers_.size(), [&](std::size_t i) {
        const auto at = [&](std::size_t place) { return sorted_.begin() + static_cast<std::ptrdiff_t>(place); };
        std::sort(at(layers_[i].begin), at(layers_[i].end),
                  [](const ShadeCast& a, const ShadeCast& b) { return a.apex.x < b.apex.x; });
    });
}

void ShadeSweep::list_layers(int first_slice, int least_y, std::size_t heights, std::span<const std::size_t> ends) {
    layers_.clear();
    std::size_t begin = 0;
    for (std::size_t i = 0; begin < sorted_.size(); ++i) {
        if (ends[i] == begin) continue;
        layers_.push_back(
            {first_slice + static_cast<int>(i / heights), least_y + static_cast<int>(i % heights), begin, ends[i]});
        begin = ends[i];
    }
}

std::span<const ShadeSweep::Layer> ShadeSweep::layers_over(int slice, int lower, int upper, int depth) const {
    const auto below = [slice](const Layer& layer, int y) {
        return std::tie(layer.slice, layer.y) < std::tie(slice, y);
    };
    const auto begin = std::lower_bound(layers_.begin(), layers_.end(), lower, below);
    const auto end = std::lower_bound(begin, layers_.end(), upper + depth + 1, below);
    const auto first = static_cast<std::size_t>(begin - layers_.begin());
    return std::span(layers_).subspan(first, static_cast<std::size_t>(end - begin));
}

void ShadeSweep::count(const ShadeCasts& casts, const ShadeBricks& bricks) {
    counts_.resize(bricks.places());
    const int first = bricks.first().y;
    for_in_parallel(first, first + static_cast<int>(bricks.size().y), [&](int y) { count_layer(casts, bricks, y); });
}

// Squares of bricks are added up from their corners, as pyramids are from their edges.
void ShadeSweep::count_layer(const ShadeCasts& casts, const ShadeBricks& bricks, int y) {
    const glm::ivec3 first = bricks.first(), size(bricks.size());
    const auto length = static_cast<std::size_t>(size.z) + 1;
    std::vector<std::uint32_t> changes((static_cast<std::size_t>(size.x) + 1) * length, 0);
    const int lower = std::max(y * edge, casts.clip().lower.y);
    const int upper = std::min(y * edge + edge - 1, casts.clip().upper.y);
    for (int slice = 0; lower <= upper && slice <= (size.z - 1) / slice_bricks; ++slice) {
        const int back = first.z + slice * slice_bricks, front = back + slice_bricks - 1;
        for (const Layer& layer : layers_over(slice, lower, upper, casts.rule().depth)) {
            for (std::size_t i = layer.begin; i < layer.end; ++i) {
                const BrickSquare square = reached_bricks(casts, sorted_[i].apex, y);
                if (square.front < back || square.back > front) continue;
                const auto z = static_cast<std::size_t>(std::max(square.back, back) - first.z);
                const auto end_z = static_cast<std::size_t>(std::min(square.front, front) + 1 - first.z);
                std::uint32_t* begins = changes.data() + static_cast<std::size_t>(square.left - first.x) * length;
                std::uint32_t* ends = changes.data() + static_cast<std::size_t>(square.right + 1 - first.x) * length;
                ++begins[z];
                --begins[end_z];
                --ends[z];
                ++ends[end_z];
            }
        }
    }
    std::vector<std::uint32_t> sums(length, 0);
    for (int x = 0; x < size.x; ++x) {
        std::uint32_t sum = 0;
        std::uint32_t* counts = counts_.data() + bricks.place({first.x + x, y, first.z});
        for (std::size_t z = 0; z < length - 1; ++z) {
            sums[z] += changes[static_cast<std::size_t>(x) * length + z];
            counts[z] = sum += sums[z];
        }
    }
}

void ShadeSweep::list_stretches(const ShadeBricks& bricks) {
    stretches_.clear();
    const glm::ivec3 first = bricks.first(), size(bricks.size());
    const auto is_empty = [&](int slice, int x, int y) {
        const int z = slice * slice_bricks;
        const std::uint32_t* row = counts_.data() + bricks.place({x, y, first.z + z});
        return std::all_of(row, row + std::min(slice_bricks, size.z - z), [](std::uint32_t n) { return n == 0; });
    };
    for (int y = first.y; y < first.y + size.y; ++y) {
        for (int slice = 0; slice <= (size.z - 1) / slice_bricks; ++slice) {
            Stretch stretch{slice, y, 0, 0};
            for (int x = first.x; x < first.x + size.x; ++x) {
                if (is_empty(slice, x, y)) continue;
                const bool goes_on = stretch.end == x && x - stretch.begin < stretch_bricks;
                if (stretch.begin < stretch.end && !goes_on) stretches_.push_back(stretch);
                if (stretch.begin == stretch.end || !goes_on) stretch.begin = x;
                stretch.end = x + 1;
            }
            if (stretch.begin < stretch.end) stretches_.push_back(stretch);
        }
    }
}

// For apices from `base` on and before `end`. `first` holds what the fronts point to.
std::vector<ShadeFront> ShadeSweep::fronts_of(const ShadeCasts& casts, const Stretch& stretch, int base, int end,
                                              Column<std::uint32_t>& first) const {
    const int lower = std::max(stretch.y * edge, casts.clip().lower.y);
    const int upper = std::min(stretch.y * edge + edge - 1, casts.clip().upper.y);
    const std::span<const Layer> layers = layers_over(stretch.slice, lower, upper, casts.rule().depth);
    const auto places = static_cast<std::size_t>(end - base) + 1;
    first.resize(layers.size() * places);
    std::vector<ShadeFront> fronts;
    for (const Layer& layer : layers) {
        std::uint32_t* entry = first.data() + fronts.size() * places;
        const ShadeCast *begin = sorted_.data() + layer.begin, *last = sorted_.data() + layer.end;
        const auto below = [](const ShadeCast& cast, int x) { return cast.apex.x < x; };
        const ShadeCast* next = std::lower_bound(begin, last, base, below);
        for (int x = base; x <= end; ++x) {
            while (next != last && next->apex.x < x) ++next;
            entry[x - base] = static_cast<std::uint32_t>(next - begin);
        }
        const int upper_layer = std::max(0, layer.y - upper),
                  lower_layer = std::min(casts.rule().depth, layer.y - lower);
        fronts.push_back({begin, entry, layer.y, upper_layer, lower_layer, casts.half_width(upper_layer),
                          casts.half_width(lower_layer)});
    }
    return fronts;
}

void ShadeSweep::sweep(const ShadeCasts& casts, const Stretch& stretch, ShadeBricks& bricks) const {
    const VoxelBox& clip = casts.clip();
    const int first_z = bricks.first().z + stretch.slice * slice_bricks;
    const int end_z = std::min(first_z + slice_bricks, bricks.first().z + static_cast<int>(bricks.size().z));
    const int first_x = std::max(stretch.begin * edge, clip.lower.x);
    const int last_x = std::min(stretch.end * edge - 1, clip.upper.x);
    const int reach = casts.half_width(casts.rule().depth) + 1;
    const auto length = static_cast<std::size_t>(end_z - first_z + 1) * edge;  // room for what ends behind the last
    Column<Shade> running(edge * length, 0);
    Column<std::uint32_t> first;
    const std::vector<ShadeFront> fronts = fronts_of(casts, stretch, first_x - reach, last_x + reach + 1, first);
    const Pass pass{fronts,
                    widths_,
                    casts.layers(),
                    {running.data(), length, first_z * edge, std::max(clip.lower.z, first_z * edge),
                     std::min(clip.upper.z, end_z * edge - 1), first_x - reach}};
    begin(pass, first_x);
    const ShadeRule& rule = casts.rule();
    const bool with_light = !leaves_.empty() && !rule.attenuate;
    std::vector<ShadeTarget> targets;
    for (int brick = stretch.begin; brick < stretch.end; ++brick) {
        list_targets(bricks, {brick, stretch.y, first_z}, end_z, targets);
        for (int x = brick * edge; x < (brick + 1) * edge; ++x) {
            if (x < first_x || x > last_x) {
                clear(targets, x, rule.full_light);
                continue;
            }
            advance(pass, x, x > first_x);
            if (with_light)
                write_and_light(targets, pass.rows, x, rule.full_light);
            else
                write(targets, pass.rows, x);
        }
        if (leaves_.empty()) continue;
        for (const ShadeTarget& target : targets) {
            if (!with_light || target.all >= most_fast_shade) write_light(rule, target.sums, target.leaf);
        }
    }
    std::atomic_thread_fence(std::memory_order_seq_cst);  // what went past the caches is there for other threads
}

// The bricks from `first` on along z.
void ShadeSweep::list_targets(ShadeBricks& bricks, const glm::ivec3& first, int end_z,
                              std::vector<ShadeTarget>& targets) const {
    targets.clear();
    for (glm::ivec3 brick = first; brick.z < end_z; ++brick.z) {
        const std::int32_t found = bricks.find(brick);
        if (found == ShadeBricks::none) continue;
        const auto number = static_cast<std::size_t>(found);
        targets.push_back({bricks.sums(number), static_cast<std::size_t>(brick.z - first.z) * edge,
                           leaves_.empty() ? ShadeLeaf() : leaves_[number]});
    }
}

}  // namespace espalier::environment
