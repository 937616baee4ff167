// The states that turtles have at the borders of stretches are predicted: they depend only on modules of branches that
// are still open there, which are few. Every walk must then arrive, to the last bit, where the next one began;
// so the result is that of one walk whatever was predicted.
#include "turtle/walk/parallel_walk.h"

#include "espalier/base/error.h"

#include "base/parallel.h"
#include "turtle/walk/letter_counts.h"
#include "turtle/walk/string_walk.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <deque>
#include <iterator>
#include <optional>
#include <vector>

namespace espalier::turtle {
namespace {

/// Modules [begin, end) of the string, bounded by brackets, so that no symbol reaches across.
class WalkPlan {
public:
    WalkPlan(std::size_t begin, std::size_t end) : begin_(begin), end_(end) {}

    /// Reads the letters. May run beside others.
    void read(const WalkInput& input, const LetterCounts& counts);

    /// Moves `state` from the beginning of this stretch to its end; `parameters` stand before it. Walks only what is in
    /// no branch that ends within the stretch; what that draws goes to `scratch`.
    void advance(const WalkInput& input, std::size_t parameters, WalkState& state, Interpretation& scratch) const;

    std::size_t begin() const { return begin_; }
    std::size_t end() const { return end_; }
    const WalkCounts& counts() const { return counts_; }
    /// Modules that advance() walks.
    std::size_t kept() const;

private:
    static constexpr std::size_t block_size = LetterCounts::block_size;
    /// So many modules: the parameters before them, the depth before them and the least depth behind one of them, all
    /// counted from the beginning of the stretch.
    struct Block {
        std::size_t parameters;
        std::int64_t depth, least;
    };
    /// A run of modules that advance() walks.
    struct Run {
        std::size_t begin, end, parameters;
    };

    bool add_up(const WalkInput& input, const LetterCounts& counts);
    void count_rows(const WalkInput& input);
    void find_runs(const WalkInput& input);
    std::size_t opening_of(const ModuleString& string, std::size_t closing, std::int64_t depth) const;
    std::size_t parameters_before(const WalkInput& input, std::size_t module) const;

    std::size_t begin_, end_;
    WalkCounts counts_;
    std::vector<Block> blocks_;
    std::int64_t depth_ = 0;  ///< at the end
    std::size_t pops_ = 0;    ///< branches that began before this stretch and end in it
    std::vector<Run> runs_;   ///< last one first
};

void WalkPlan::read(const WalkInput& input, const LetterCounts& counts) {
    if (!add_up(input, counts)) count_rows(input);
    find_runs(input);
}

/// False if there are symbols of which more than two modules must be seen.
bool WalkPlan::add_up(const WalkInput& input, const LetterCounts& counts) {
    const LetterId* const letters = input.string.letters.data();
    bool clear = true;
    blocks_.reserve((end_ - begin_) / block_size + 1);
    for (std::size_t first = begin_; first < end_; first += block_size) {
        // No symbol reaches into a stretch. A module that formed one with its like would be unclear.
        const LetterId before = letters[std::max(first, begin_ + 1) - 1];
        const LetterSum block = counts.sum(letters + first, std::min(block_size, end_ - first), before);
        blocks_.push_back({counts_.parameters, depth_, depth_ + block.least});
        depth_ += block.depth;
        counts_ += block.counts;
        clear &= block.clear;
    }
    return clear;
}

/// Symbol by symbol.
void WalkPlan::count_rows(const WalkInput& input) {
    const std::size_t parameters = counts_.parameters;
    counts_ = {};
    counts_.parameters = parameters;
    for (std::size_t i = begin_; i < end_; ++i) {
        const SymbolMatch match = input.symbols.match(input.string, i);
        counts_.add(match.meaning.effect);
        i = match.module;
    }
}

// Backwards from the end, over each branch that ends here to where it began.
void WalkPlan::find_runs(const WalkInput& input) {
    const ModuleString& string = input.string;
    std::int64_t depth = depth_;
    std::size_t end = end_, i = end_;
    const auto keep_from = [&](std::size_t begin) {
        if (begin < end) runs_.push_back({begin, end, parameters_before(input, begin)});
    };
    while (i > begin_) {
        const LetterId letter = string.letters[--i];
        if (letter == Alphabet::open_bracket) --depth;
        if (letter != Alphabet::close_bracket) continue;
        const std::size_t opening = opening_of(string, i, depth);
        keep_from(i + 1);
        if (opening == end_) {
            pops_ = static_cast<std::size_t>(-depth);  // nowhere is it less: branches behind this module are whole
            return;
        }
        end = i = opening;
    }
    keep_from(begin_);
}

/// The bracket that opens what the one at `closing` closes, `depth` being that behind it; the end if there is none.
std::size_t WalkPlan::opening_of(const ModuleString& string, std::size_t closing, std::int64_t depth) const {
    std::int64_t inside = depth + 1;  // before module i
    for (std::size_t i = closing; i > begin_;) {
        const Block& block = blocks_[(i - 1 - begin_) / block_size];
        const std::size_t first = begin_ + (i - 1 - begin_) / block_size * block_size;
        if (i - first == block_size && block.least > depth) {
            i = first;
            inside = block.depth;
            continue;
        }
        const LetterId letter = string.letters[--i];
        if (letter == Alphabet::close_bracket) ++inside;
        if (letter == Alphabet::open_bracket && --inside == depth) return i;
    }
    return end_;
}

std::size_t WalkPlan::parameters_before(const WalkInput& input, std::size_t module) const {
    const std::size_t block = std::min((module - begin_) / block_size, blocks_.size() - 1);
    std::size_t sum = blocks_[block].parameters;
    for (std::size_t i = begin_ + block * block_size; i < module; ++i) {
        sum += input.symbols.levels[0][input.string.letters[i]].arity;
    }
    return sum;
}

std::size_t WalkPlan::kept() const {
    std::size_t sum = pops_;
    for (const Run& run : runs_) sum += run.end - run.begin;
    return sum;
}

void WalkPlan::advance(const WalkInput& input, std::size_t parameters, WalkState& state,
                       Interpretation& scratch) const {
    const std::uint32_t axes = scratch.geometry.axes;
    scratch.clear();
    scratch.geometry.axes = axes;
    const PooledWalk walk(input, scratch);
    walk->state() = state;
    for (std::size_t pop = 0; pop < pops_; ++pop) walk->walk().pop();
    for (auto run = runs_.rbegin(); run != runs_.rend(); ++run) {
        walk->run(run->begin, run->end, parameters + run->parameters);
    }
    state = walk->state();
}

constexpr std::size_t chunks_per_thread = 4;

/// Finds where stretches can begin.
class Borders {
public:
    explicit Borders(const WalkInput& input)
        : string_(input.string),
          alphabet_(input.model.alphabet),
          opening_(alphabet_.find_symbol("{")),
          closing_(alphabet_.find_symbol("}")) {}

    /// A bracket at or behind `from` that seems not to stand within a polygon; the string's end if there is none near.
    std::size_t find(std::size_t from) const {
        constexpr std::size_t widest = 1024;
        const std::size_t last = std::min(string_.size(), from + widest);
        std::size_t found = last;
        for (std::size_t i = from; i < last; ++i) {
            const LetterId letter = string_.letters[i];
            if (letter <= Alphabet::close_bracket) {
                found = std::min(found, i);
                if (!closing_) break;
            } else if (const SymbolId symbol = alphabet_.symbol_of(letter); symbol == opening_) {
                break;
            } else if (symbol == closing_) {
                found = last;
            }
        }
        return found < last ? found : string_.size();
    }

private:
    const ModuleString& string_;
    const Alphabet& alphabet_;
    std::optional<SymbolId> opening_, closing_;  ///< symbols of polygons
};

/// Axes that a stretch takes over from those before it are numbered from here until all of them are known.
constexpr std::uint32_t taken_over = 0x80000000;

/// One stretch of the string.
struct Stretch {
    WalkPlan plan;
    WalkCounts before;
    WalkState start, end;
    Interpretation rest;            ///< what was not counted before
    std::uint32_t axes_before = 0;  ///< stays 0 if numbered
    bool as_predicted = false;
    std::atomic<bool> numbered = false;  ///< walked as predicted, with the numbers that axes have in the whole plant

    explicit Stretch(const WalkPlan& plan_) : plan(plan_) {}
    std::span<Internode> internodes(Interpretation& result) const {
        return std::span(result.geometry.internodes).subspan(before.internodes, plan.counts().internodes);
    }
    /// Goes on from the end of the one before it if that one is numbered by then: then there is nothing to number
    /// afterwards. `last` is null for the first.
    void walk(const WalkInput& input, const Stretch* last, Interpretation& result);
    /// The number of an axis in the whole plant.
    std::uint32_t axis(std::uint32_t number, const std::vector<std::uint32_t>& known) const {
        return number >= taken_over ? known[number - taken_over] : axes_before + number;
    }
};

void Stretch::walk(const WalkInput& input, const Stretch* last, Interpretation& result) {
    const Walk::Room room{internodes(result), std::span(result.queries).subspan(before.queries, plan.counts().queries),
                          std::span(result.answers).subspan(before.answers, plan.counts().answers)};
    try {
        const PooledWalk walk(input, rest, &room);
        const bool goes_on = last && last->numbered;
        walk->state() = goes_on ? last->end : start;
        if (goes_on) rest.geometry.axes = last->rest.geometry.axes;
        walk->run(plan.begin(), plan.end(), before.parameters);
        end = walk->state();
        as_predicted = walk->filled_room() && end.is_between_drawings();
        numbered = as_predicted && (goes_on || !last);
    } catch (const WrongPlan&) {
    } catch (const RunError&) {  // the walk in one piece meets it too, if it is one
    }
}

std::deque<Stretch> cut(const WalkInput& input, std::size_t chunk) {
    using tbb::global_control;
    const std::size_t threads = global_control::active_value(global_control::max_allowed_parallelism);
    const std::size_t size = input.string.size();
    const std::size_t count = threads < 2 ? 1 : std::min(size / chunk, threads * chunks_per_thread);
    const Borders borders(input);
    std::deque<Stretch> stretches;
    for (std::size_t begin = 0, k = 1; begin < size; ++k) {
        const std::size_t end = k < count ? borders.find(std::max(begin + 1, size / count * k)) : size;
        stretches.emplace_back(WalkPlan(begin, end));
        begin = end;
    }
    return stretches;
}

/// States and counts at the borders; false if there is too much to walk ahead.
bool predict(const WalkInput& input, std::deque<Stretch>& stretches) {
    constexpr std::size_t least_share = 8;  // what one thread walks ahead must be little
    std::size_t ahead = 0;
    for (std::size_t k = 0; k + 1 < stretches.size(); ++k) ahead += stretches[k].plan.kept();
    if (ahead > input.string.size() / least_share) return false;
    Interpretation scratch;
    stretches[0].start = PooledWalk(input, scratch)->state();
    scratch.geometry.axes = taken_over;
    try {
        for (std::size_t k = 1; k < stretches.size(); ++k) {
            const Stretch& last = stretches[k - 1];
            WalkState state = last.start;
            last.plan.advance(input, last.before.parameters, state, scratch);
            stretches[k].start = std::move(state);
            stretches[k].before = last.before;
            stretches[k].before += last.plan.counts();
        }
    } catch (const RunError&) {
        return false;
    }
    return true;
}

/// True if every stretch came to where the next one began. Then says how axes are numbered: `known` are those that
/// stretches took over.
bool connect(std::deque<Stretch>& stretches, std::vector<std::uint32_t>& known) {
    const auto learn = [&](const Stretch& stretch, std::uint32_t predicted, std::uint32_t number) {
        if (predicted < taken_over) return;
        known.resize(std::max<std::size_t>(known.size(), predicted - taken_over + 1));
        known[predicted - taken_over] = stretch.axis(number, known);
    };
    for (std::size_t k = 0; k < stretches.size(); ++k) {
        const Stretch& stretch = stretches[k];
        if (!stretch.as_predicted) return false;
        if (k + 1 == stretches.size()) break;
        Stretch& next = stretches[k + 1];
        if (!stretch.end.stands_like(next.start)) return false;
        if (!next.numbered) next.axes_before = stretch.axes_before + stretch.rest.geometry.axes;
        const TurtleState* end = stretch.end.turtles.begin();
        for (const TurtleState& start : next.start.turtles) learn(stretch, start.axis, (end++)->axis);
    }
    return true;
}

template <class Row>
void append(std::vector<Row>& rows, std::vector<Row>& more) {
    rows.insert(rows.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
    std::vector<Row>().swap(more);
}

/// For the rows of all stretches at once: growing bit by bit, they would be there three times for a moment.
template <class Row>
void make_room(std::vector<Row> PlantGeometry::*rows, const std::deque<Stretch>& stretches, PlantGeometry& geometry) {
    std::size_t count = 0;
    for (const Stretch& stretch : stretches) count += (stretch.rest.geometry.*rows).size();
    if ((geometry.*rows).capacity() < count) (geometry.*rows).reserve(count + count / 8);
}

// Surfaces of cylinders and patches are never there: they carry from stretch to stretch.
void append(PlantGeometry& geometry, PlantGeometry& more, std::size_t internodes_before) {
    for (Polygon& polygon : more.polygons) polygon.first += static_cast<std::uint32_t>(geometry.vertices.size());
    append(geometry.polygons, more.polygons);
    append(geometry.vertices, more.vertices);
    append(geometry.organs, more.organs);
    append(geometry.labels, more.labels);
    if (!more.textures.empty()) geometry.textures.resize(internodes_before);
    append(geometry.textures, more.textures);
    geometry.bounds.add(more.bounds);
}

}  // namespace

bool walk_in_parallel(const WalkInput& input, std::size_t chunk, Interpretation& result) {
    // What a picture draws is not known before.
    if (chunk == 0 || input.string.size() < 2 * chunk || input.derivation || input.symbols.unpredictable) return false;
    std::deque<Stretch> stretches = cut(input, chunk);
    if (stretches.size() < 2) return false;
    const auto for_all = [&](const auto& action) {
        for_in_parallel(
            std::size_t(0), stretches.size(),
            [&](std::size_t k) { action(stretches[k], k > 0 ? &stretches[k - 1] : nullptr); }, tbb::auto_partitioner());
    };
    bool as_predicted = false;
    // The caller may work on other plants side by side: this thread is not to take up one of those in between.
    tbb::this_task_arena::isolate([&] {
        const LetterCounts letters(input.symbols);
        for_all([&](Stretch& stretch, const Stretch*) { stretch.plan.read(input, letters); });
        if (!predict(input, stretches)) return;
        WalkCounts total = stretches.back().before;
        total += stretches.back().plan.counts();
        result.geometry.internodes.resize(total.internodes);
        result.queries.resize(total.queries);
        result.answers.resize(total.answers);
        for_all([&](Stretch& stretch, const Stretch* last) { stretch.walk(input, last, result); });
        std::vector<std::uint32_t> known;
        as_predicted = connect(stretches, known);
        if (!as_predicted) return;
        for_all([&](const Stretch& stretch, const Stretch*) {
            if (stretch.numbered) return;
            for (Internode& internode : stretch.internodes(result))
                internode.axis = stretch.axis(internode.axis, known);
        });
    });
    if (!as_predicted) {
        input.symbols.unpredictable = true;
        result.clear();
        return false;
    }
    result.geometry.shapes = input.settings.shapes;
    result.geometry.in_pixels = input.settings.line_style == LineStyle::pixel;
    result.geometry.axes = stretches.back().axes_before + stretches.back().rest.geometry.axes;
    make_room(&PlantGeometry::organs, stretches, result.geometry);
    make_room(&PlantGeometry::polygons, stretches, result.geometry);
    make_room(&PlantGeometry::vertices, stretches, result.geometry);
    for (Stretch& stretch : stretches) {
        append(result.geometry, stretch.rest.geometry, stretch.before.internodes);
        append(result.directions, stretch.rest.directions);
    }
    return true;
}

}  // namespace espalier::turtle
