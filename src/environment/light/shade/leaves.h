// Sums of a brick as the values of a leaf of OpenVDB, eight voxels at a time.
#pragma once

#include "environment/light/shade/bricks.h"
#include "environment/light/shade/eight_reals.h"

#include <cstring>

namespace espalier::environment {

/// Whole numbers below 2^52 are the bits of a double above 2^52: every width of vectors can read them so.
constexpr std::uint64_t most_fast_shade = std::uint64_t(1) << 52;

/// Where the values of a leaf are, and a bit for each that is active, 64 to a word. Both null: nowhere.
struct ShadeLeaf {
    float* values = nullptr;
    std::uint64_t* shaded = nullptr;
};

using EightShades = std::uint64_t __attribute__((vector_size(64), may_alias));
using EightFloats = float __attribute__((vector_size(32)));

/// shade_value of eight sums below `most_fast_shade`.
inline void read_shades(const EightShades& sums, EightReals& amounts) {
    constexpr std::uint64_t exponent_52 = 0x4330000000000000;
    const EightShades bits = sums | exponent_52;
    std::memcpy(&amounts, &bits, sizeof amounts);
    amounts = (amounts - 4503599627370496.0) * (1 / shade_steps_per_unit);
}

/// light_under eight sums below `most_fast_shade`, where shadows add up.
inline void read_lights(double full_light, const EightShades& sums, EightFloats& lights) {
    EightReals left;
    read_shades(sums, left);
    left = full_light - left;
    left = left < 0.0 ? EightReals{} : left;
    lights = __builtin_convertvector(left, EightFloats);
}

/// Writes the light, or the shade, of a whole brick. A voxel is active where it is shaded.
void write_light(const ShadeRule& rule, const Shade* sums, const ShadeLeaf& leaf);
void write_shade(const Shade* sums, const ShadeLeaf& leaf);

}  // namespace espalier::environment
