// How much letters draw, ask and answer, and how they branch, without walking along them.
#pragma once

#include "turtle/walk/symbol_table.h"

#include <array>
#include <vector>

namespace espalier::turtle {

/// Sums over stretches: parameters, and rows of result that are known from the letters.
struct WalkCounts {
    std::size_t parameters = 0, internodes = 0, queries = 0, answers = 0;

    /// The rows of one symbol.
    void add(Symbol::Effect effect);

    WalkCounts& operator+=(const WalkCounts& other);
};

/// Sums over a block of letters.
struct LetterSum {
    WalkCounts counts;
    std::int64_t depth;  ///< depth of branches behind the last letter, counted from that before the first
    std::int64_t least;  ///< least of the depths behind its letters, and 0
    bool clear;          ///< false: more than two modules of some symbol must be seen to count its rows
};

/// What every letter behind another adds to the counts and to the depth of branches.
class LetterCounts {
public:
    static constexpr std::size_t block_size = 64;

    explicit LetterCounts(const SymbolTable& symbols);

    /// Returns the sum over at most block_size letters, which stand behind the letter `before`.
    LetterSum sum(const LetterId* letters, std::size_t count, LetterId before) const;

private:
    /// Letters that can be looked up 32 at a time, each with a byte for its arity and a bit for its effect.
    struct Bytes {
        std::array<std::uint8_t, 32> arities, effects;
    };

    template <bool alone>
    LetterSum sum_one_by_one(const LetterId* letters, std::size_t count, LetterId before) const;
    static LetterSum sum_wide(const LetterId* letters, const Bytes& bytes);
    void find_bytes(const std::vector<LetterMeaning>& single);
    /// One row is for all: no symbol that these letters form has several modules.
    bool alone() const { return table_.size() == rows_.size(); }

    std::vector<std::uint64_t> table_;  // a row for letters behind those of equal meaning; packed
    std::vector<std::uint32_t> rows_;   // where the row begins that is for letters behind this one
    Bytes bytes_ = {};
    bool wide_ = false;
};

}  // namespace espalier::turtle
