// What the equations of leaves need of numbers that stand side by side: T is a double, or a vector of doubles whose
// lanes know nothing of each other. As in base/math_lanes.h all is inlined, so that no other file gets code that its
// processor may not have, and a lane is to the last bit what a double alone is.
#pragma once

#include "base/math_kernels.h"

#include <cstdint>
#include <type_traits>

namespace espalier::environment::leaf {

/// Which numbers something is true of.
template <class T>
using Truth = decltype(T{} < T{});

template <class T>
ESPALIER_INLINE T all_of(double x) {
    return T{} + x;
}

template <class T>
ESPALIER_INLINE T choose(Truth<T> is, T yes, T no) {
    return is ? yes : no;
}

template <class T>
ESPALIER_INLINE T larger(T a, T b) {
    return choose<T>(b > a, b, a);
}

template <class T>
ESPALIER_INLINE T smaller(T a, T b) {
    return choose<T>(b < a, b, a);
}

// Not && and !, which vectors do not have.
ESPALIER_INLINE bool both(bool a, bool b) {
    return a && b;
}
template <class Mask>
ESPALIER_INLINE Mask both(Mask a, Mask b) {
    return a & b;
}
ESPALIER_INLINE bool either(bool a, bool b) {
    return a || b;
}
template <class Mask>
ESPALIER_INLINE Mask either(Mask a, Mask b) {
    return a | b;
}
ESPALIER_INLINE bool opposite(bool a) {
    return !a;
}
template <class Mask>
ESPALIER_INLINE Mask opposite(Mask a) {
    return ~a;
}

ESPALIER_INLINE bool is_any(bool is) {
    return is;
}
template <class Mask>
ESPALIER_INLINE bool is_any(Mask is) {
    std::int64_t any = 0;
    for (std::size_t lane = 0; lane < sizeof is / sizeof(double); ++lane) any |= is[lane];
    return any != 0;
}

template <class T>
ESPALIER_INLINE T root_of(T x) {
    if constexpr (std::is_same_v<T, double>) {
        return __builtin_sqrt(x);
    } else {
#ifdef __AVX512F__
        return _mm512_maskz_sqrt_pd(0xff, x);  // GCC 12 warns about the form without a mask
#elif defined(__AVX2__)
        return _mm256_sqrt_pd(x);
#endif
    }
}

/// Beyond e^+-700, what these are.
template <class T>
ESPALIER_INLINE T power_of_e(T x) {
    const T most = all_of<T>(math::greatest_exponent);
    return math::plain_exponential<T>({larger<T>(smaller<T>(x, most), -most), T{}});
}

}  // namespace espalier::environment::leaf
