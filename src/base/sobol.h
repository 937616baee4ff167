// Low-discrepancy numbers: samples that are spread more evenly than chance spreads them.
#pragma once

#include <array>
#include <cstdint>

namespace espalier {

/// Four numbers in [0, 1): sample `index` of the first four dimensions of Sobol's sequence (direction numbers of Joe &
/// Kuo 2008), shuffled and Owen-scrambled by `seed` (Burley 2020, Practical hash-based Owen scrambling). Each seed
/// gives an independent randomisation; 2^k samples from a multiple of 2^k on are evenly spread.
std::array<double, 4> scrambled_sobol(std::uint32_t index, std::uint32_t seed);

/// Four numbers that have nothing to do with each other, nor with those of other indices: plain Monte Carlo.
std::array<double, 4> independent_numbers(std::uint32_t index, std::uint32_t seed);

}  // namespace espalier
