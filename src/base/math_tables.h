// The tables of base/math_kernels.h, computed by the compiler with pairs of doubles: no digits to copy.
#pragma once

#include "base/double_pair.h"

#include <bit>
#include <cstdint>

namespace espalier::math {

using Digits = Pair<double>;

inline constexpr Digits ln2{0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56},
    pi{0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};
inline constexpr double pi_below = -0x1.f1976b7ed8fbcp-109;  ///< what both digits of pi leave

namespace table {

/// The multiple of 2^`place` next to x, with |x| below 2^(51 + place).
constexpr double rounded(double x, int place) {
    const double shift = std::bit_cast<double>(static_cast<std::uint64_t>(1023 + 52 + place) << 52) * 1.5;
    return (x + shift) - shift;
}

constexpr Digits exponential(Digits x) {
    Digits term{1}, total{1};
    for (int n = 1; n < 30; ++n) {
        term = over(times(term, x), {static_cast<double>(n)});
        total = plus(total, term);
    }
    return total;
}

/// log(m) = 2 artanh((m - 1) / (m + 1)).
constexpr Digits logarithm(Digits m) {
    const Digits ratio = over(plus(m, {-1}), plus(m, {1})), square = times(ratio, ratio);
    Digits power = ratio, total = ratio;
    for (int n = 3; n < 50; n += 2) {
        power = times(power, square);
        total = plus(total, over(power, {static_cast<double>(n)}));
    }
    return times({2}, total);
}

constexpr Digits sine(Digits angle) {
    const Digits square = times(angle, angle);
    Digits term = angle, total = angle;
    for (int n = 2; n < 34; n += 2) {
        term = over(times(term, square), {-static_cast<double>(n) * (n + 1)});
        total = plus(total, term);
    }
    return total;
}

/// Euler's series, which converges for all arguments.
constexpr Digits arctangent(double x) {
    const Digits square{x * x}, beside = plus({1}, square), ratio = over(square, beside);
    Digits term = over({x}, beside), total = term;
    for (int n = 1; n < 120; ++n) {
        term = times(times(term, ratio), over({2.0 * n}, {2.0 * n + 1}));
        total = plus(total, term);
    }
    return total;
}

}  // namespace table

/// Entries of numbers that stand side by side: those of entry j from j times the `width` of an entry.
template <int count>
struct Row {
    double numbers[count]{};
};

/// 2^(j/128) = value (1 + rest): value, rest.
inline constexpr int powers_of_two = 128, width_of_power = 2;

constexpr Row<powers_of_two * width_of_power> make_powers_of_two() {
    Row<powers_of_two * width_of_power> row{};
    for (int j = 0; j < powers_of_two; ++j) {
        const Digits power = table::exponential(times(ln2, {j / static_cast<double>(powers_of_two)}));
        row.numbers[width_of_power * j] = power.high;
        row.numbers[width_of_power * j + 1] = power.low / power.high;
    }
    return row;
}

/// Of the numbers about a centre c: a short inverse of about 1/c, and -log(inverse) in two parts, of which the first is
/// a multiple of 2^-42, and nothing. The numbers from about 0.69 to 1.39 are 128 intervals by the first seven digits
/// of their fraction; that about 1 has the inverse 1.
inline constexpr int logarithms = 128, below_one = 78, width_of_logarithm = 4;
/// The bits of the lower end of the first interval: half of an interval before its centre.
inline constexpr std::uint64_t first_logarithm =
    std::bit_cast<std::uint64_t>(1 - below_one / 256.0) - (std::uint64_t{1} << 44);

constexpr Row<logarithms * width_of_logarithm> make_logarithms() {
    Row<logarithms * width_of_logarithm> row{};
    for (int j = 0; j < logarithms; ++j) {
        const int from_one = j - below_one;
        const double centre = from_one < 0 ? 1 + from_one / 256.0 : 1 + from_one / 128.0;
        const double inverse = table::rounded(1 / centre, from_one < 0 ? -9 : -10);
        const Digits logarithm = table::logarithm({inverse});
        const double high = table::rounded(-logarithm.high, -42);
        row.numbers[width_of_logarithm * j] = inverse;
        row.numbers[width_of_logarithm * j + 1] = high;
        row.numbers[width_of_logarithm * j + 2] = (-logarithm.high - high) - logarithm.low;
    }
    return row;
}

/// The sine of 2 pi j/128 in two parts, and its cosine in two parts, the first of 26 bits.
inline constexpr int parts_of_turn = 128, width_of_sine = 4;

constexpr Row<parts_of_turn * width_of_sine> make_sines() {
    constexpr int quarter = parts_of_turn / 4;
    Digits sines[parts_of_turn]{};
    for (int j = 0; j <= quarter; ++j) {
        const Digits sine = j == quarter ? Digits{1} : table::sine(times(pi, {2.0 * j / parts_of_turn}));
        sines[j] = sine;
        sines[2 * quarter - j] = sine;
        if (j > 0) sines[2 * quarter + j] = {-sine.high, -sine.low};
        if (j > 0) sines[4 * quarter - j] = {-sine.high, -sine.low};
    }
    Row<parts_of_turn * width_of_sine> row{};
    for (int j = 0; j < parts_of_turn; ++j) {
        const Digits cosine = sines[(j + quarter) % parts_of_turn], parts = halves(cosine.high);
        row.numbers[width_of_sine * j] = sines[j].high;
        row.numbers[width_of_sine * j + 1] = sines[j].low;
        row.numbers[width_of_sine * j + 2] = parts.high;
        row.numbers[width_of_sine * j + 3] = parts.low + cosine.low;
    }
    return row;
}

/// arctan(j/64) in two parts.
inline constexpr int arctangents = 65, width_of_arctangent = 2;

constexpr Row<arctangents * width_of_arctangent> make_arctangents() {
    Row<arctangents * width_of_arctangent> row{};
    for (int j = 1; j < arctangents; ++j) {
        const Digits angle = table::arctangent(j / 64.0);
        row.numbers[width_of_arctangent * j] = angle.high;
        row.numbers[width_of_arctangent * j + 1] = angle.low;
    }
    return row;
}

inline constexpr auto power_table = make_powers_of_two();
inline constexpr auto logarithm_table = make_logarithms();
inline constexpr auto sine_table = make_sines();
inline constexpr auto arctangent_table = make_arctangents();

}  // namespace espalier::math
