// The elementary functions where their arguments are plain: by a table and a short polynomial, for one double or for a
// vector of them, with the same operations in the same order. base/math.cpp treats all other arguments. The tables'
// sizes and the splitting of arguments follow Tang (1989 to 1991, "Table-driven implementation of ... functions in
// IEEE floating-point arithmetic") and the routines that C libraries took from Nagy (2018, ARM optimized routines),
// but without fused multiply-add.
#pragma once

#include "base/math_tables.h"

#include <cstddef>
#include <cstdint>
#include <type_traits>

#ifdef __AVX2__
#include <immintrin.h>
#endif

namespace espalier::math {

// A double, or as many as the instructions that this file is compiled for have side by side.
#ifdef __AVX512F__
using Lanes = double __attribute__((vector_size(64)));
using WholeLanes = std::uint64_t __attribute__((vector_size(64)));
#elif defined(__AVX2__)
using Lanes = double __attribute__((vector_size(32)));
using WholeLanes = std::uint64_t __attribute__((vector_size(32)));
#else
using Lanes = double;
using WholeLanes = std::uint64_t;
#endif

template <class T>
using Whole = std::conditional_t<std::is_same_v<T, double>, std::uint64_t, WholeLanes>;

template <class T>
ESPALIER_INLINE Whole<T> bits_of(T x) {
    return __builtin_bit_cast(Whole<T>, x);
}

template <class T>
ESPALIER_INLINE T of_bits(Whole<T> bits) {
    return __builtin_bit_cast(T, bits);
}

/// What stands in `table` at each index.
template <class T>
ESPALIER_INLINE T look_up(const double* table, Whole<T> index) {
    if constexpr (std::is_same_v<T, double>) {
        return table[index];
    } else {
#ifdef __AVX512F__
        const __m512d none = _mm512_setzero_pd();  // GCC 12 warns about the form without it
        return _mm512_mask_i64gather_pd(none, 0xff, __builtin_bit_cast(__m512i, index), table, sizeof(double));
#elif defined(__AVX2__)
        return _mm256_i64gather_pd(table, __builtin_bit_cast(__m256i, index), sizeof(double));
#endif
    }
}

template <class T>
ESPALIER_INLINE T magnitude(T x) {
    return of_bits<T>(bits_of(x) & 0x7fffffffffffffff);
}

/// x without its last 27 bits.
template <class T>
ESPALIER_INLINE T upper_half(T x) {
    return of_bits<T>(bits_of(x) & 0xfffffffff8000000);
}

/// A number that has been added to this one stands in its last bits, rounded to a whole one.
inline constexpr double to_whole = 0x1.8p52;

// ---- logarithms

template <class T>
ESPALIER_INLINE auto is_normal_and_positive(T x) {
    return bits_of(x) - 0x0010000000000000 < 0x7fe0000000000000;
}

/// log(x) = about + r_low - r^2/2 + r^3 series + rest, where r = x inverse - 1.
template <class T>
struct LogarithmOfPart {
    T about, r_high, r_low, r, r2, series, rest;
};

/// Of the bits of a positive x; its exponent may be as small as one likes.
template <class T>
ESPALIER_INLINE LogarithmOfPart<T> logarithm_of_part(Whole<T> bits) {
    const Whole<T> from_first = bits - first_logarithm;
    const Whole<T> at = width_of_logarithm * ((from_first >> 45) & (logarithms - 1));
    const T exponent = of_bits<T>(((from_first + 0x4410000000000000) >> 52) | 0x4330000000000000) - (0x1p52 + 1089);
    const T x = of_bits<T>(bits - (from_first & 0xfff0000000000000));
    const double* const row = logarithm_table.numbers;
    const T inverse = look_up<T>(row, at), log_high = look_up<T>(row + 1, at), log_low = look_up<T>(row + 2, at);

    // The first digits of x alone, times ten bits: both parts of r are exact, and what is added to log_high.
    constexpr double ln2_high = table::rounded(ln2.high, -42), ln2_low = (ln2.high - ln2_high) + ln2.low;
    const T x_high = (x + 0x1.8p30) - 0x1.8p30;
    const T r_high = x_high * inverse - 1, r_low = (x - x_high) * inverse, r = r_high + r_low, r2 = r * r;
    const T series = (1.0 / 3 - r * (1.0 / 4)) +
                     r2 * ((1.0 / 5 - r * (1.0 / 6)) + r2 * ((1.0 / 7 - r * (1.0 / 8)) + r2 * (1.0 / 9)));
    return {(exponent * ln2_high + log_high) + r_high, r_high, r_low, r, r2, series, exponent * ln2_low + log_low};
}

/// To the last place of a double.
template <class T>
ESPALIER_INLINE T short_logarithm(Whole<T> bits) {
    const LogarithmOfPart<T> of = logarithm_of_part<T>(bits);
    return of.about + ((of.r_low + of.rest) + of.r2 * (of.r * of.series - 0.5));
}

/// To about 65 bits.
template <class T>
ESPALIER_INLINE Pair<T> logarithm(Whole<T> bits) {
    const LogarithmOfPart<T> of = logarithm_of_part<T>(bits);
    const Pair<T> first = sum_in_order<T>(of.about, -0.5 * of.r_high * of.r_high);  // the square is exact
    const Pair<T> second = sum_in_order(first.high, of.r_low);
    const T cubic = of.r * of.r2 * of.series - 0.5 * of.r_low * (of.r_high + of.r);
    return sum_in_order(second.high, of.rest + (first.low + second.low) + cubic);
}

// ---- powers

/// Powers of e up to here, and their last digits, are normal numbers.
inline constexpr double greatest_exponent = 700;

/// e^x = scale (1 + more) 2^floor(k/128).
template <class T>
struct Exponential {
    Whole<T> k;  ///< in its last bits
    T scale, more;
};

/// e^x for |x| below 1024.
template <class T>
ESPALIER_INLINE Exponential<T> exponential(Pair<T> x) {
    constexpr double step = ln2.high / powers_of_two;
    constexpr double step_high = table::rounded(step, -42), step_low = (step - step_high) + ln2.low / powers_of_two;
    const T shifted = x.high * (1 / step) + to_whole, k = shifted - to_whole;
    const T r = ((x.high - k * step_high) - k * step_low) + x.low, r2 = r * r;
    const Whole<T> at = width_of_power * (bits_of(shifted) & (powers_of_two - 1));
    const T scale = look_up<T>(power_table.numbers, at), rest = look_up<T>(power_table.numbers + 1, at);
    return {bits_of(shifted), scale, (rest + r) + r2 * ((0.5 + r * (1.0 / 6)) + r2 * (1.0 / 24 + r * (1.0 / 120)))};
}

/// The same as a number, |x| at most greatest_exponent.
template <class T>
ESPALIER_INLINE T plain_exponential(Pair<T> x) {
    const Exponential<T> parts = exponential(x);
    const T scale = of_bits<T>(bits_of(parts.scale) + ((parts.k - (parts.k & (powers_of_two - 1))) << 45));
    return scale + scale * parts.more;
}

/// y log(x).
template <class T>
ESPALIER_INLINE Pair<T> exponent_of_power(Pair<T> log, T y) {
    const T y_high = upper_half(y), log_high = upper_half(log.high);
    return {y_high * log_high, (y - y_high) * log_high + y * ((log.high - log_high) + log.low)};
}

// ---- sines

/// From here, angles go through more digits of pi.
inline constexpr double great_angle = 0x1p16, small_angle = 0x1p-27;

/// An angle as `part` parts of a turn (its last seven bits) and a rest of at most half a part.
template <class T>
struct Angle {
    Whole<T> part;
    Pair<T> rest;
};

/// A part of a turn, pi/64, in four pieces of 32 bits and more.
inline constexpr double part_1 = table::rounded(pi.high / 64, -36), part_left = pi.high / 64 - part_1;
inline constexpr double part_2 = table::rounded(part_left + pi.low / 64, -68);
inline constexpr double part_left_low = (part_left - part_2) + pi.low / 64;
inline constexpr double part_3 = table::rounded(part_left_low, -100);
inline constexpr double part_4 = (part_left_low - part_3) + pi_below / 64;

/// Cody & Waite (1980): |x| below great_angle.
template <class T>
ESPALIER_INLINE Angle<T> angle_of(T x) {
    const T shifted = x * (64 / pi.high) + to_whole, k = shifted - to_whole;
    const Pair<T> first = sum(x - k * part_1, -(k * part_2));
    const Pair<T> second = sum(first.high, -(k * part_3));
    return {bits_of(shifted), sum_in_order(second.high, second.low + (first.low - k * part_4))};
}

/// sin(a + r) = sin a + cos a r + cos a (sin r - r) + sin a (cos r - 1).
template <class T>
ESPALIER_INLINE Pair<T> sine(const Angle<T>& angle, unsigned quarters = 0) {
    const Whole<T> at = width_of_sine * ((angle.part + parts_of_turn / 4 * quarters) & (parts_of_turn - 1));
    const double* const row = sine_table.numbers;
    const T s = look_up<T>(row, at), s_low = look_up<T>(row + 1, at);
    const T c_high = look_up<T>(row + 2, at), c_low = look_up<T>(row + 3, at);
    const T r = angle.rest.high, r2 = r * r, r_high = upper_half(r), c = c_high + c_low;
    const T sine_less = r * r2 * (-1.0 / 6 + r2 * (1.0 / 120 - r2 * (1.0 / 5040)));
    const T cosine_less = r2 * (-0.5 + r2 * (1.0 / 24 - r2 * (1.0 / 720)));
    const Pair<T> first = sum_in_order(s, c_high * r_high);
    const T small = (s_low + c_low * r_high) + c * ((r - r_high) + (angle.rest.low + sine_less)) + s * cosine_less;
    return sum_in_order(first.high, first.low + small);
}

// ---- arctangents

/// Bounds of both arguments within which none of the products below is lost.
inline constexpr double least_leg = 0x1p-400, greatest_leg = 0x1p400;

/// a * b for an `a` of at most 26 bits.
template <class T>
ESPALIER_INLINE Pair<T> product_of_short(T a, T b) {
    const T high = upper_half(b);
    return {a * high, a * (b - high)};
}

/// arctan(b/a) for 0 < b <= a, both as pairs.
template <class T>
ESPALIER_INLINE Pair<T> arctangent(Pair<T> b, Pair<T> a) {
    const T shifted = b.high / a.high * 64 + to_whole, c = (shifted - to_whole) * (1.0 / 64);
    const Whole<T> at = width_of_arctangent * (bits_of(shifted) & 127);
    const Pair<T> ca = product_of_short(c, a.high), cb = product_of_short(c, b.high);
    const Pair<T> above = sum(b.high - ca.high, (b.low - c * a.low) - ca.low), first = sum_in_order(a.high, cb.high);
    const Pair<T> below = sum_in_order(first.high, first.low + (cb.low + (a.low + c * b.low)));

    const T u = above.high / below.high, u2 = u * u;
    const Pair<T> whole = product(u, below.high);
    const T rest = ((above.high - whole.high) - whole.low) + (above.low - u * below.low);
    const T series = u * u2 * (-1.0 / 3 + u2 * (1.0 / 5 - u2 * (1.0 / 7)));
    const double* const row = arctangent_table.numbers;
    const T known = look_up<T>(row, at), known_low = look_up<T>(row + 1, at);
    const Pair<T> high = sum_in_order(known, u);
    return {high.high, high.low + (known_low + (rest / below.high + series))};
}

/// The angle of (x, y) from the axis of x, of magnitudes within the bounds.
template <class T>
ESPALIER_INLINE T arctangent_of_legs(Pair<T> y, Pair<T> x) {
    const T zero{}, width = magnitude(x.high), height = magnitude(y.high);
    const T width_low = x.high < zero ? -x.low : x.low, height_low = y.high < zero ? -y.low : y.low;
    const auto steep = height > width;
    const Pair<T> angle = arctangent<T>({steep ? width : height, steep ? width_low : height_low},
                                        {steep ? height : width, steep ? height_low : width_low});
    // 0 + angle, pi/2 - angle, pi/2 + angle or pi - angle.
    const auto left = x.high < zero;
    const T base = (steep ? zero + 0.5 : left ? zero + 1 : zero), sign = (steep != left) ? zero - 1 : zero + 1;
    const Pair<T> high = sum_in_order<T>(base * pi.high, sign * angle.high);
    const T result = high.high + (high.low + (base * pi.low + sign * angle.low));
    return of_bits<T>(bits_of(result) | (bits_of(y.high) & 0x8000000000000000));
}

}  // namespace espalier::math
