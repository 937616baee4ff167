// Where the nodes of a table over many orders of magnitude lie.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

namespace espalier {

/// 64 parts of each octave from 2^lowest to 2^highest, evenly spaced within it: the first bits of a number tell its
/// part.
template <int lowest, int highest>
struct OctaveTable {
    static constexpr int parts_bits = 6, shift = 52 - parts_bits;
    static constexpr std::uint64_t first_bits = std::uint64_t(1023 + lowest) << parts_bits;
    static constexpr std::size_t node_count = (std::size_t(highest - lowest) << parts_bits) + 1;

    static double node(std::size_t i) { return std::bit_cast<double>((first_bits + i) << shift); }
    /// The node below a number within the table.
    static std::size_t part_of(double number) { return (std::bit_cast<std::uint64_t>(number) >> shift) - first_bits; }
};

}  // namespace espalier
