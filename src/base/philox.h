// Philox 4x32-10: random bits as a function of a counter and a key (Salmon, Moraes, Dror & Shaw 2011, section 3.3).
#pragma once

#include <array>
#include <cstdint>

namespace espalier::philox {

inline constexpr int rounds = 10;
inline constexpr std::uint32_t multiplier0 = 0xD2511F53, multiplier1 = 0xCD9E8D57;
inline constexpr std::uint32_t step0 = 0x9E3779B9, step1 = 0xBB67AE85;  ///< of the key from round to round

using Counter = std::array<std::uint32_t, 4>;
using Key = std::array<std::uint32_t, 2>;

constexpr Counter bits(Counter counter, Key key) {
    for (int round = 0; round < rounds; ++round) {
        const std::uint64_t product0 = std::uint64_t{multiplier0} * counter[0];
        const std::uint64_t product1 = std::uint64_t{multiplier1} * counter[2];
        counter = {
            static_cast<std::uint32_t>(product1 >> 32) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(product1),
            static_cast<std::uint32_t>(product0 >> 32) ^ counter[3] ^ key[1], static_cast<std::uint32_t>(product0)};
        key = {key[0] + step0, key[1] + step1};
    }
    return counter;
}

}  // namespace espalier::philox
