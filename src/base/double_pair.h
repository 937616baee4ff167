// Sums and products of doubles without loss: what a double cannot hold of a result stands in a second one (Dekker 1971,
// "A floating-point technique for extending the available precision"; Knuth 1997, The Art of Computer Programming 2,
// 4.2.2). T is a double, or a vector of doubles whose lanes know nothing of each other. No operation may be contracted
// to a fused multiply-add.
#pragma once

#include <cstdint>

#ifdef _MSC_VER
#define ESPALIER_INLINE __forceinline
#else
#define ESPALIER_INLINE [[gnu::always_inline]] inline
#endif

namespace espalier::math {

/// The number high + low, where low is below the last digit of high.
template <class T>
struct Pair {
    T high{}, low{};
};

/// a + b where |a| >= |b| or a = 0.
template <class T>
ESPALIER_INLINE constexpr Pair<T> sum_in_order(T a, T b) {
    const T sum = a + b;
    return {sum, (a - sum) + b};
}

template <class T>
ESPALIER_INLINE constexpr Pair<T> sum(T a, T b) {
    const T sum = a + b, part = sum - a;
    return {sum, (a - (sum - part)) + (b - part)};
}

/// `a` in halves of 26 bits; |a| below 2^996.
template <class T>
ESPALIER_INLINE constexpr Pair<T> halves(T a) {
    const T wide = a * 0x1.0000002p27, high = wide - (wide - a);
    return {high, a - high};
}

template <class T>
ESPALIER_INLINE constexpr Pair<T> product(Pair<T> a, Pair<T> b) {
    const T whole = (a.high + a.low) * (b.high + b.low);
    return {whole, ((a.high * b.high - whole) + a.high * b.low + a.low * b.high) + a.low * b.low};
}

/// a * b; between 2^-900 and 2^996.
template <class T>
ESPALIER_INLINE constexpr Pair<T> product(T a, T b) {
    return product(halves(a), halves(b));
}

// Arithmetic of pairs, to about 100 bits.

constexpr Pair<double> plus(Pair<double> a, Pair<double> b) {
    const Pair<double> high = sum(a.high, b.high);
    return sum_in_order(high.high, high.low + (a.low + b.low));
}

constexpr Pair<double> times(Pair<double> a, Pair<double> b) {
    const Pair<double> high = product(a.high, b.high);
    return sum_in_order(high.high, high.low + (a.high * b.low + a.low * b.high));
}

constexpr Pair<double> over(Pair<double> a, Pair<double> b) {
    const double quotient = a.high / b.high;
    const Pair<double> whole = product(quotient, b.high);
    const double rest = ((a.high - whole.high) - whole.low) + (a.low - quotient * b.low);
    return sum_in_order(quotient, rest / b.high);
}

}  // namespace espalier::math
