// Blocks in LZ4's format, written for arrays whose tuples are alike or come in runs.
#pragma once

#include "espalier/base/column.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace espalier {

/// What a block of so many bytes takes at most.
constexpr std::size_t most_lz4_bytes(std::size_t bytes) {
    return bytes + bytes / 255 + 16;
}

/// A general compressor looks for repetitions at every byte; these look at whole tuples only, and know where runs end.
/// What they write, any LZ4 decompressor reads. Their memory serves from block to block.
class Lz4Blocks {
public:
    /// Compresses `bytes`, best if repetitions are `tuple_bytes` or multiples of it apart. Returns how many bytes it
    /// has written to `out`, which has room for the most.
    std::size_t compress(std::span<const unsigned char> bytes, std::size_t tuple_bytes, unsigned char* out);

    /// The same for tuples [first, last) of an array whose values are likely to repeat where one of these parts begins,
    /// and within a part from its beginning: only there anybody looks. `part` is that of the first tuple and moves on
    /// to that of the last's successor. Throws RunError for tuples of a width other than 4, 8 or 12.
    std::size_t compress_parts(const void* values, std::span<const std::uint32_t> ends, std::size_t tuple_bytes,
                               std::size_t first, std::size_t last, std::size_t& part, unsigned char* out);

    /// The same for tuples [first, last) of an array of runs: run r has the tuple values[r] and ends before ends[r].
    /// `run` is that of the first and moves on to that of the last's successor. Throws RunError for tuples of a width
    /// other than 1, 2, 3, 4 or 8.
    std::size_t compress_runs(const void* values, std::span<const std::uint32_t> ends, std::size_t tuple_bytes,
                              std::size_t first, std::size_t last, std::size_t& run, unsigned char* out);

private:
    template <std::size_t Unit>
    std::size_t compress_units(std::span<const unsigned char> bytes, unsigned char* out);
    template <std::size_t Unit>
    std::size_t compress_parts_of(std::span<const unsigned char> bytes, std::span<const std::uint32_t> ends,
                                  std::size_t first, std::size_t& part, unsigned char* out);
    template <std::size_t Width>
    std::size_t compress_runs_of(const void* values, std::span<const std::uint32_t> ends, std::size_t first,
                                 std::size_t last, std::size_t& run, unsigned char* out);

    /// The last run of a value.
    struct Seen {
        const unsigned char* value;
        std::uint32_t begin, bytes;
    };

    Column<std::uint32_t> units_;  ///< 1 + where a unit stood last, by its hash; 0 if nowhere
    Column<Seen> runs_;            ///< by the hash of the value; of no bytes if there is none
    Column<unsigned char> literals_;
};

}  // namespace espalier
