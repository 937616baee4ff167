#include "turtle/walk_plan.h"

#include <algorithm>

namespace espalier {
namespace {

// Fields of a packed count. 64 modules fill none of them; the depth, which may fall, is the highest.
constexpr int internodes_at = 24, queries_at = 32, beginnings_at = 40, depth_at = 48;

std::size_t field(std::uint64_t packed, int at, int bits) {
    return (packed >> at) & ((std::uint64_t{1} << bits) - 1);
}

/// Of packed counts: all of them, and the least of all sums from the first on. The depth decides which is less.
struct Sum {
    std::uint64_t all = 0;
    std::int64_t least = 0;

    void add(std::uint64_t count) {
        all += count;
        least = std::min(least, static_cast<std::int64_t>(all));
    }
    void add(const Sum& next) {
        least = std::min(least, static_cast<std::int64_t>(all) + next.least);
        all += next.all;
    }
};

Sum sum_of(const LetterId* letters, std::size_t count, const std::uint64_t* counts) {
    Sum sum;
    for (std::size_t i = 0; i < count; ++i) sum.add(counts[letters[i]]);
    return sum;
}

/// The same of a whole block, in lanes that need not wait for each other.
Sum sum_of_block(const LetterId* letters, const std::uint64_t* counts) {
    constexpr std::size_t length = WalkPlan::block_size / 4;
    Sum sum, second, third, fourth;
    for (std::size_t i = 0; i < length; ++i) {
        sum.add(counts[letters[i]]);
        second.add(counts[letters[i + length]]);
        third.add(counts[letters[i + 2 * length]]);
        fourth.add(counts[letters[i + 3 * length]]);
    }
    sum.add(second);
    sum.add(third);
    sum.add(fourth);
    return sum;
}

}  // namespace

WalkCounts& WalkCounts::operator+=(const WalkCounts& other) {
    parameters += other.parameters;
    internodes += other.internodes;
    queries += other.queries;
    return *this;
}

LetterCounts::LetterCounts(const SymbolTable& symbols) {
    using enum Symbol::Effect;
    for (std::size_t letter = 0; letter < symbols.levels[0].size(); ++letter) {
        const LetterMeaning& meaning = symbols.levels[0][letter];
        std::uint64_t packed = meaning.arity;
        if (meaning.level) {
            packed += std::uint64_t{1} << beginnings_at;
        } else {
            packed += std::uint64_t{meaning.effect == draws} << internodes_at;
            packed += std::uint64_t{meaning.effect == asks} << queries_at;
            packed += std::uint64_t{letter == Alphabet::open_bracket} << depth_at;
            packed -= std::uint64_t{letter == Alphabet::close_bracket} << depth_at;
        }
        of.push_back(packed);
    }
}

void WalkPlan::read(const WalkInput& input, const LetterCounts& letter_counts) {
    const LetterId* const letters = input.string.letters.data();
    const std::uint64_t* const counts = letter_counts.of.data();
    blocks_.reserve((end_ - begin_) / block_size + 1);
    std::size_t symbols_end = begin_;  // of those of several modules
    for (std::size_t first = begin_; first < end_; first += block_size) {
        const std::size_t last = std::min(end_, first + block_size);
        const Sum block = last - first == block_size ? sum_of_block(letters + first, counts)
                                                     : sum_of(letters + first, last - first, counts);
        blocks_.push_back({counts_.parameters, depth_, depth_ + (block.least >> depth_at)});
        depth_ += static_cast<std::int64_t>(block.all) >> depth_at;
        counts_.parameters += field(block.all, 0, internodes_at);
        counts_.internodes += field(block.all, internodes_at, 8);
        counts_.queries += field(block.all, queries_at, 8);
        if (field(block.all, beginnings_at, 8) > 0 || symbols_end > first) {
            symbols_end = correct_rows(input, counts, {first, last}, symbols_end);
        }
    }
    find_runs(input);
}

/// The modules of a block were counted one by one: counts symbols of several modules that begin there as what they are.
/// Returns where the last of them ends.
std::size_t WalkPlan::correct_rows(const WalkInput& input, const std::uint64_t* counts, Range block,
                                   std::size_t symbols_end) {
    const LetterId* const letters = input.string.letters.data();
    const auto take_back = [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < std::min(end, block.end); ++i) {
            counts_.internodes -= field(counts[letters[i]], internodes_at, 1);
            counts_.queries -= field(counts[letters[i]], queries_at, 1);
        }
    };
    take_back(block.begin, symbols_end);
    for (std::size_t i = std::max(block.begin, symbols_end); i < block.end; ++i) {
        if (field(counts[letters[i]], beginnings_at, 1) == 0) continue;
        const SymbolMatch match = input.symbols.match(input.string, i);
        counts_.internodes += match.meaning.effect == Symbol::Effect::draws;
        counts_.queries += match.meaning.effect == Symbol::Effect::asks;
        symbols_end = match.module + 1;
        take_back(i + 1, symbols_end);
        i = match.module;
    }
    return symbols_end;
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
            std::int64_t least = 0;
            for (const Block& block : blocks_) least = std::min(least, block.least);
            pops_ = static_cast<std::size_t>(-least);
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
    const LentWalk walk(input, scratch);
    walk->state() = state;
    for (std::size_t pop = 0; pop < pops_; ++pop) walk->walk().pop();
    for (auto run = runs_.rbegin(); run != runs_.rend(); ++run) {
        walk->run(run->begin, run->end, parameters + run->parameters);
    }
    state = walk->state();
}

}  // namespace espalier
