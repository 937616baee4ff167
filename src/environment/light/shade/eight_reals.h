// Eight numbers at a time, in as many parts as the machine's vectors need. Parameters are references because widths of
// vectors differ between the clones of a function and its callers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace espalier::environment {

constexpr std::size_t lanes = 8;

using EightReals = double __attribute__((vector_size(64)));
using EightTruths = std::int64_t __attribute__((vector_size(64)));  ///< all bits, or none

__attribute__((always_inline)) inline void load(EightReals& reals, const double* from) {
    std::memcpy(&reals, from, sizeof reals);
}

__attribute__((always_inline)) inline void store(double* to, const EightReals& reals) {
    std::memcpy(to, &reals, sizeof reals);
}

/// Vectors only where errno is not kept: see the top CMakeLists.txt.
__attribute__((always_inline)) inline void take_roots(EightReals& reals) {
    double each[lanes];
    store(each, reals);
    for (std::size_t k = 0; k < lanes; ++k) each[k] = __builtin_sqrt(each[k]);
    load(reals, each);
}

}  // namespace espalier::environment
