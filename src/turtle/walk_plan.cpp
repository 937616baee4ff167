#include "turtle/walk_plan.h"

#include <algorithm>

namespace espalier {
namespace {

// Fields of a packed count. 64 modules fill none of them; the depth, which may fall, is the highest.
constexpr int internodes_at = 24, queries_at = 31, answers_at = 38, unclear_at = 45, depth_at = 52;

std::size_t field(std::uint64_t packed, int at, int bits = 7) {
    return (packed >> at) & ((std::uint64_t{1} << bits) - 1);
}

std::uint64_t packed_rows(Symbol::Effect effect) {
    using enum Symbol::Effect;
    return std::uint64_t{effect == draws} << internodes_at | std::uint64_t{effect == asks} << queries_at |
           std::uint64_t{effect == answers} << answers_at;
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

/// Adds up modules, one behind the other.
template <bool alone>
class Lane {
public:
    /// `before`: the letter before the first one.
    Lane(const LetterCounts& counts, LetterId before)
        : rows_(counts.rows()), table_(counts.table()), row_(alone ? 0 : rows_[before]) {}

    void add(LetterId letter) {
        sum.add(table_[row_ + letter]);
        if constexpr (!alone) row_ = rows_[letter];
    }

    Sum sum;

private:
    const std::uint32_t* rows_;
    const std::uint64_t* table_;
    std::size_t row_;
};

template <bool alone>
Sum sum_of(const LetterId* letters, std::size_t count, LetterId before, const LetterCounts& counts) {
    Lane<alone> lane(counts, before);
    for (std::size_t i = 0; i < count; ++i) lane.add(letters[i]);
    return lane.sum;
}

/// The same of a whole block, in lanes that need not wait for each other.
template <bool alone>
Sum sum_of_block(const LetterId* letters, LetterId before, const LetterCounts& counts) {
    constexpr std::size_t length = WalkPlan::block_size / 4;
    Lane<alone> first(counts, before), second(counts, letters[length - 1]), third(counts, letters[2 * length - 1]),
        fourth(counts, letters[3 * length - 1]);
    for (std::size_t i = 0; i < length; ++i) {
        first.add(letters[i]);
        second.add(letters[i + length]);
        third.add(letters[i + 2 * length]);
        fourth.add(letters[i + 3 * length]);
    }
    first.sum.add(second.sum);
    first.sum.add(third.sum);
    first.sum.add(fourth.sum);
    return first.sum;
}

}  // namespace

void WalkCounts::add(Symbol::Effect effect) {
    internodes += effect == Symbol::Effect::draws;
    queries += effect == Symbol::Effect::asks;
    answers += effect == Symbol::Effect::answers;
}

WalkCounts& WalkCounts::operator+=(const WalkCounts& other) {
    parameters += other.parameters;
    internodes += other.internodes;
    queries += other.queries;
    answers += other.answers;
    return *this;
}

LetterCounts::LetterCounts(const SymbolTable& symbols) {
    const std::vector<LetterMeaning>& single = symbols.levels[0];
    const auto add_row = [&](const LetterMeaning* before) {
        for (std::size_t letter = 0; letter < single.size(); ++letter) {
            LetterMeaning meaning = single[letter];
            bool unclear = false;
            if (before && symbols.levels[before->level][letter].belongs) {
                meaning = symbols.levels[before->level][letter];
                unclear = meaning.level || single[letter].level || before->effect != Symbol::Effect::other;
            }
            std::uint64_t packed = meaning.arity + packed_rows(meaning.effect);
            packed += std::uint64_t{unclear} << unclear_at;
            packed += std::uint64_t{letter == Alphabet::open_bracket} << depth_at;
            packed -= std::uint64_t{letter == Alphabet::close_bracket} << depth_at;
            table_.push_back(packed);
        }
    };
    add_row(nullptr);
    for (const LetterMeaning& meaning : single) {
        rows_.push_back(meaning.level ? std::uint32_t(table_.size()) : 0);
        if (meaning.level) add_row(&meaning);
    }
}

void WalkPlan::read(const WalkInput& input, const LetterCounts& counts) {
    const bool clear = counts.alone() ? add_up<true>(input, counts) : add_up<false>(input, counts);
    if (!clear) count_rows(input);
    find_runs(input);
}

/// False if there are symbols of which more than two modules must be seen.
template <bool alone>
bool WalkPlan::add_up(const WalkInput& input, const LetterCounts& counts) {
    const LetterId* const letters = input.string.letters.data();
    bool clear = true;
    blocks_.reserve((end_ - begin_) / block_size + 1);
    for (std::size_t first = begin_; first < end_; first += block_size) {
        const std::size_t last = std::min(end_, first + block_size);
        // No symbol reaches into a stretch. A module that formed one with its like would be unclear.
        const LetterId before = letters[std::max(first, begin_ + 1) - 1];
        const Sum block = last - first == block_size ? sum_of_block<alone>(letters + first, before, counts)
                                                     : sum_of<alone>(letters + first, last - first, before, counts);
        blocks_.push_back({counts_.parameters, depth_, depth_ + (block.least >> depth_at)});
        depth_ += static_cast<std::int64_t>(block.all) >> depth_at;
        counts_.parameters += field(block.all, 0, internodes_at);
        counts_.internodes += field(block.all, internodes_at);
        counts_.queries += field(block.all, queries_at);
        counts_.answers += field(block.all, answers_at);
        clear &= field(block.all, unclear_at) == 0;
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
