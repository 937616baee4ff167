#include "base/sobol.h"

#include "espalier/base/random.h"

namespace espalier {
namespace {

using Directions = std::array<std::uint32_t, 32>;

/// From a primitive polynomial of the degree `degree` with inner coefficients `inner`, and the first odd numbers.
constexpr Directions directions(int degree, std::uint32_t inner, const std::array<std::uint32_t, 3>& first) {
    Directions v{};
    for (int k = 0; k < 32; ++k) {
        if (k < degree) {
            v[k] = first[k] << (31 - k);
            continue;
        }
        v[k] = v[k - degree] ^ (v[k - degree] >> degree);
        for (int j = 1; j < degree; ++j) {
            if ((inner >> (degree - 1 - j) & 1) != 0) v[k] ^= v[k - j];
        }
    }
    return v;
}

constexpr Directions van_der_corput() {
    Directions v{};
    for (int k = 0; k < 32; ++k) v[k] = std::uint32_t{1} << (31 - k);
    return v;
}

constexpr std::array<Directions, 4> all_directions{van_der_corput(), directions(1, 0, {1, 0, 0}),
                                                   directions(2, 1, {1, 3, 0}), directions(3, 1, {1, 3, 1})};

constexpr std::uint32_t reversed(std::uint32_t x) {
    x = (x & 0x55555555u) << 1 | (x >> 1 & 0x55555555u);
    x = (x & 0x33333333u) << 2 | (x >> 2 & 0x33333333u);
    x = (x & 0x0F0F0F0Fu) << 4 | (x >> 4 & 0x0F0F0F0Fu);
    x = (x & 0x00FF00FFu) << 8 | (x >> 8 & 0x00FF00FFu);
    return x << 16 | x >> 16;
}

using OfDimensions = std::array<std::uint32_t, 4>;
using ByBytes = std::array<std::array<OfDimensions, 256>, 4>;

/// What each byte of a reversed index adds to the reversed numbers of all dimensions: four looks into tables are
/// Sobol's sequence, and scrambling begins and ends with reversed numbers.
constexpr ByBytes tables_by_bytes() {
    ByBytes tables{};
    for (int byte = 0; byte < 4; ++byte) {
        for (std::uint32_t value = 0; value < 256; ++value) {
            for (std::uint32_t d = 0; d < 4; ++d) {
                for (int bit = 0; bit < 8; ++bit) {
                    if ((value >> bit & 1) == 0) continue;
                    tables[byte][value][d] ^= reversed(all_directions[d][31 - (8 * byte + bit)]);
                }
            }
        }
    }
    return tables;
}

constexpr ByBytes by_bytes = tables_by_bytes();

/// Each bit of a reversed number is turned as those below it and the seed say (Laine & Karras 2011, with Burley's
/// constants).
std::uint32_t scrambled(std::uint32_t x, std::uint32_t seed) {
    x += seed;
    x ^= x * 0x6C50B47Cu;
    x ^= x * 0xB82F1E52u;
    x ^= x * 0xC7AFE638u;
    x ^= x * 0x8D22F6E6u;
    return x;
}

}  // namespace

std::array<double, 4> scrambled_sobol(std::uint32_t index, std::uint32_t seed) {
    const std::uint32_t shuffled = scrambled(reversed(index), seed);
    OfDimensions numbers{};
    for (int byte = 0; byte < 4; ++byte) {
        const OfDimensions& added = by_bytes[byte][shuffled >> 8 * byte & 0xFF];
        for (int d = 0; d < 4; ++d) numbers[d] ^= added[d];
    }
    std::array<double, 4> sample;
    for (std::uint32_t d = 0; d < 4; ++d) {
        const auto own = static_cast<std::uint32_t>(mix(seed, d + 1));
        sample[d] = reversed(scrambled(numbers[d], own)) * 0x1p-32;
    }
    return sample;
}

std::array<double, 4> independent_numbers(std::uint32_t index, std::uint32_t seed) {
    RandomSamples samples(RandomKey(seed, 0, Stream::process, 0x70617468), index, 0);
    std::array<double, 4> numbers;
    for (double& number : numbers) number = samples.uniform();
    return numbers;
}

}  // namespace espalier
