#include "turtle/walk/plan.h"

#include <algorithm>

namespace espalier::turtle {
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

}  // namespace espalier::turtle
