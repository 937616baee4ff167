// What can be known of a stretch of the string before it is walked: how much it draws, and what of it the turtle at its
// end still depends on.
#pragma once

#include "turtle/walk/letter_counts.h"
#include "turtle/walk/string_walk.h"

#include <vector>

namespace espalier::turtle {

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

}  // namespace espalier::turtle
