#include "environment/light/shade/leaves.h"

#include "base/vector_clones.h"

namespace espalier::environment {
namespace {

/// Which of a brick's voxels are shaded, and whether all of them are below `most_fast_shade`.
ESPALIER_VECTOR_CLONES
bool find_shaded(const Shade* sums, std::uint64_t* words) {
    std::uint64_t all = 0;
    for (std::size_t word = 0; word < ShadeBricks::voxels / 64; ++word) {
        std::uint64_t bits = 0;
        for (std::size_t bit = 0; bit < 64; ++bit) {
            const auto sum = static_cast<std::uint64_t>(sums[64 * word + bit]);
            all |= sum;
            bits |= ((0 - sum) >> 63) << bit;  // sums are not negative
        }
        words[word] = bits;
    }
    return all < most_fast_shade;
}

ESPALIER_VECTOR_CLONES
void write_lights(const Shade* sums, double full_light, float* to) {
    for (std::size_t i = 0; i < ShadeBricks::voxels; i += 8) {
        EightShades eight;
        std::memcpy(&eight, sums + i, sizeof eight);
        EightFloats lights;
        read_lights(full_light, eight, lights);
        std::memcpy(to + i, &lights, sizeof lights);
    }
}

ESPALIER_VECTOR_CLONES
void write_shades(const Shade* sums, float* to) {
    for (std::size_t i = 0; i < ShadeBricks::voxels; i += 8) {
        EightShades eight;
        std::memcpy(&eight, sums + i, sizeof eight);
        EightReals amounts;
        read_shades(eight, amounts);
        const EightFloats shades = __builtin_convertvector(amounts, EightFloats);
        std::memcpy(to + i, &shades, sizeof shades);
    }
}

/// Neighbours often have the same shade: the exponential is the dear part.
template <class ValueOf>
void write_one_by_one(const Shade* sums, float* to, const ValueOf& value_of) {
    Shade last = 0;
    auto value = static_cast<float>(value_of(last));
    for (std::size_t i = 0; i < ShadeBricks::voxels; ++i) {
        if (sums[i] != last) value = static_cast<float>(value_of(last = sums[i]));
        to[i] = value;
    }
}

}  // namespace

void write_light(const ShadeRule& rule, const Shade* sums, const ShadeLeaf& leaf) {
    if (find_shaded(sums, leaf.shaded) && !rule.attenuate) return write_lights(sums, rule.full_light, leaf.values);
    write_one_by_one(sums, leaf.values, [&](Shade sum) { return light_under(rule, sum); });
}

void write_shade(const Shade* sums, const ShadeLeaf& leaf) {
    if (find_shaded(sums, leaf.shaded)) return write_shades(sums, leaf.values);
    write_one_by_one(sums, leaf.values, [](Shade sum) { return shade_value(sum); });
}

}  // namespace espalier::environment
