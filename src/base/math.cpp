#include "espalier/base/math.h"

#include "base/math_kernels.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace espalier::math {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity(), none = std::numeric_limits<double>::quiet_NaN();

// ---- logarithms

/// A denormal number has its digits where others have them, and an exponent that no double can hold.
std::uint64_t bits_with_any_exponent(double x) {
    return is_normal_and_positive(x) ? bits_of(x) : bits_of(x * 0x1p52) - (std::uint64_t{52} << 52);
}

/// Of a positive, finite x.
Pair<double> logarithm_of(double x) {
    return logarithm<double>(bits_with_any_exponent(x));
}

// ---- powers

/// A power that may be greater than all numbers, or denormal: then it is rounded where its digits end.
double exponential_near_the_ends(Pair<double> x) {
    if (x.high > 1024) return infinite;
    if (x.high < -1024) return 0;
    const Exponential<double> parts = exponential(x);
    const int exponent = static_cast<int>(static_cast<std::int64_t>(parts.k << 32) >> (32 + 7));
    if (exponent > 0) return std::ldexp(parts.scale + parts.scale * parts.more, exponent);
    const double scale = std::ldexp(parts.scale, exponent + 1022), rest = scale * parts.more;
    double power = scale + rest;
    if (power < 1) {
        const Pair<double> in_steps = sum_in_order(1.0, power);
        const double lost = in_steps.low + ((scale - power) + rest);
        power = (in_steps.high + lost) - 1;
    }
    return power * 0x1p-1022;
}

double any_exponential(Pair<double> x) {
    return std::abs(x.high) <= greatest_exponent ? plain_exponential(x) : exponential_near_the_ends(x);
}

bool is_odd(double y) {
    return std::fmod(y, 2) == 1 || std::fmod(y, 2) == -1;
}

double power_of_infinite(double x, double y) {
    const double power = std::isinf(x) == (y > 0) ? infinite : 0;
    return std::signbit(x) && is_odd(y) ? -power : power;
}

double unusual_power(double x, double y) {
    if (y == 0 || x == 1) return 1;
    if (std::isnan(x) || std::isnan(y)) return none;
    if (std::isinf(y)) return std::abs(x) == 1 ? 1 : (std::abs(x) > 1) == (y > 0) ? infinite : 0;
    if (x == 0 || std::isinf(x)) return power_of_infinite(x, y);
    if (x < 0 && y != std::trunc(y)) return none;
    const double power = any_exponential(exponent_of_power(logarithm_of(std::abs(x)), y));
    return x < 0 && is_odd(y) ? -power : power;
}

// ---- sines

bool is_plain_angle(double x) {
    return std::abs(x) >= small_angle && std::abs(x) < great_angle;
}

/// The bits of 1 / (2 pi) after its point, behind 64 zeros.
constexpr std::uint64_t turns_of_a_radian[]{
    0x0000000000000000, 0x28be60db9391054a, 0x7f09d5f47d4d3770, 0x36d8a5664f10e410, 0x7f9458eaf7aef158,
    0x6dc91b8e909374b8, 0x01924bba82746487, 0x3f877ac72c4a69cf, 0xba208d7d4baed121, 0x3a671c09ad17df90,
    0x4e64758e60d4ce7d, 0x272117e2ef7e4a0e, 0xc7fe25fff7816603, 0xfbcbc462d6829b47, 0xdb4d9fb3c9f2c26d,
    0xd3d18fd9a797fa8b, 0x5d49eeb1faf97c5e, 0xcf41ce7de294a4ba, 0x9afed7ec47e35742, 0x1580cc11bf1edaea,
    0xfc33ef0826bd0d87, 0x6a78e45857b986c2, 0x19666157c5281a10,
};

std::uint64_t upper_word(std::uint64_t a, std::uint64_t b) {
    const std::uint64_t low = 0xffffffff, a0 = a & low, a1 = a >> 32, b0 = b & low, b1 = b >> 32;
    const std::uint64_t middle = a1 * b0 + (a0 * b0 >> 32), other = a0 * b1 + (middle & low);
    return a1 * b1 + (middle >> 32) + (other >> 32);
}

/// Payne & Hanek (1983): the digits of 1 / (2 pi) that make whole turns are left out.
Angle<double> angle_of_many_turns(double x) {
    const std::uint64_t bits = bits_of(std::abs(x));
    const std::uint64_t digits = (bits & 0x000fffffffffffff) | 0x0010000000000000, place = (bits >> 52) - 1075 + 64;
    std::uint64_t turn[4], carry = 0;  // the fraction of a turn, its greatest word first
    for (int word = 3; word >= 0; --word) {
        const std::uint64_t* const at = turns_of_a_radian + place / 64 + word;
        const std::uint64_t shift = place % 64, factor = shift == 0 ? at[0] : at[0] << shift | at[1] >> (64 - shift);
        turn[word] = digits * factor + carry;
        carry = upper_word(digits, factor) + (turn[word] < carry ? 1 : 0);
    }
    const std::uint64_t part = (turn[0] + (std::uint64_t{1} << 56)) >> 57;
    turn[0] -= part << 57;
    const bool negative = turn[0] >> 63 != 0;
    Pair<double> rest;
    double unit = 0x1p-32;
    for (int word = 0; word < 3; ++word) {
        const std::uint64_t left = negative ? ~turn[word] : turn[word];
        for (const std::uint64_t half : {left >> 32, left & 0xffffffff}) {
            rest = plus(rest, {static_cast<double>(half) * unit});
            unit *= 0x1p-32;
        }
    }
    rest = times(rest, {2 * pi.high, 2 * pi.low});
    return negative ? Angle<double>{part, {-rest.high, -rest.low}} : Angle<double>{part, rest};
}

/// Of a finite angle that is not small. Inline, so that the parts of most angles stay in registers.
ESPALIER_INLINE Angle<double> any_angle(double x) {
    if (is_plain_angle(x)) [[likely]]
        return angle_of(x);
    Angle<double> angle = angle_of_many_turns(x);
    if (x < 0) angle = {std::uint64_t{} - angle.part, {-angle.rest.high, -angle.rest.low}};
    return angle;
}

// ---- arctangents

bool is_plain_leg(double x) {
    return std::abs(x) >= least_leg && std::abs(x) <= greatest_leg;
}

/// The angle of (x, y) where one of both is zero, infinite or no number, or both are far apart.
double arctangent_of_ends(double y, double x) {
    if (std::isnan(x) || std::isnan(y)) return none;
    if (std::isinf(x) && std::isinf(y)) return std::copysign(x > 0 ? pi.high / 4 : 0x1.2d97c7f3321d2p+1, y);
    if (std::isinf(y) || (x == 0 && y != 0)) return std::copysign(pi.high / 2, y);
    if (std::isinf(x) || y == 0) return std::copysign(std::signbit(x) ? pi.high : 0, y);
    const int width = std::ilogb(x), height = std::ilogb(y), greater = std::max(width, height);
    if (height - width > 300) return std::copysign(pi.high / 2, y);
    if (width - height > 300) return x > 0 ? y / x : std::copysign(pi.high, y);
    return arctangent_of_legs<double>({std::ldexp(y, -greater)}, {std::ldexp(x, -greater)});
}

Pair<double> square_root(Pair<double> x) {
    const double root = std::sqrt(x.high);
    const Pair<double> whole = product(root, root);
    return {root, (((x.high - whole.high) - whole.low) + x.low) / (2 * root)};
}

/// sqrt(1 - x^2) for |x| < 1.
Pair<double> other_leg(double x) {
    const Pair<double> square = product(x, x), left = sum_in_order(1.0, -square.high);
    return square_root({left.high, left.low - square.low});
}

}  // namespace

double sin(double angle) {
    if (std::abs(angle) < small_angle) return angle;
    return std::isfinite(angle) ? sine(any_angle(angle)).high : none;
}

double cos(double angle) {
    if (std::abs(angle) < small_angle) return 1;
    return std::isfinite(angle) ? sine(any_angle(angle), 1).high : none;
}

double tan(double angle) {
    if (std::abs(angle) < small_angle) return angle;
    if (!std::isfinite(angle)) return none;
    const Angle<double> parts = any_angle(angle);
    return over(sine(parts), sine(parts, 1)).high;
}

SineAndCosine sine_and_cosine(double angle) {
    if (std::abs(angle) < small_angle) return {angle, 1};
    if (!std::isfinite(angle)) return {none, none};
    const Angle<double> parts = any_angle(angle);
    return {sine(parts).high, sine(parts, 1).high};
}

double asin(double sine) {
    if (std::abs(sine) < small_angle) return sine;
    if (std::abs(sine) < 1) return arctangent_of_legs({sine}, other_leg(sine));
    return std::abs(sine) == 1 ? std::copysign(pi.high / 2, sine) : none;
}

double acos(double cosine) {
    if (std::abs(cosine) < 0x1p-60) return pi.high / 2;
    if (std::abs(cosine) < 1) return arctangent_of_legs(other_leg(cosine), {cosine});
    return cosine == 1 ? 0 : cosine == -1 ? pi.high : none;
}

double atan(double tangent) {
    if (is_plain_leg(tangent)) return arctangent_of_legs<double>({tangent}, {1.0});
    if (std::abs(tangent) < 1) return tangent;
    return std::isnan(tangent) ? none : std::copysign(pi.high / 2, tangent);
}

double atan2(double y, double x) {
    return is_plain_leg(x) && is_plain_leg(y) ? arctangent_of_legs<double>({y}, {x}) : arctangent_of_ends(y, x);
}

double exp(double x) {
    return std::isnan(x) ? none : any_exponential({x});
}

double log(double x) {
    if (is_normal_and_positive(x)) return short_logarithm<double>(bits_of(x));
    if (x > 0) return x == infinite ? x : short_logarithm<double>(bits_with_any_exponent(x));
    return x == 0 ? -infinite : none;
}

double log1p(double x) {
    if (std::abs(x) < 0x1p-54) return x;
    if (!(x > -1)) return x == -1 ? -infinite : none;
    if (x == infinite) return x;
    const Pair<double> beside_one = sum(1.0, x), logarithm = logarithm_of(beside_one.high);
    return logarithm.high + (logarithm.low + beside_one.low / beside_one.high);
}

double cbrt(double x) {
    if (x == 0 || std::isinf(x)) return x;
    if (std::isnan(x)) return none;
    const int exponent = std::ilogb(x), third = (exponent + 3000) / 3 - 1000;
    const double cube = std::ldexp(std::abs(x), -3 * third);
    const double root = exp(logarithm_of(cube).high * (1.0 / 3));
    const Pair<double> square = product(root, root), whole = times(square, {root});
    const double rest = (cube - whole.high) - whole.low;
    return std::copysign(std::ldexp(root + rest / (3 * square.high), third), x);
}

double hypot(double x, double y) {
    if (std::isinf(x) || std::isinf(y)) return infinite;
    if (std::isnan(x) || std::isnan(y)) return none;
    double greater = std::max(std::abs(x), std::abs(y)), less = std::min(std::abs(x), std::abs(y));
    if (less <= greater * 0x1p-60) return greater;
    const int scale = is_plain_leg(greater) && is_plain_leg(less) ? 0 : std::ilogb(greater);
    if (scale != 0) greater = std::ldexp(greater, -scale), less = std::ldexp(less, -scale);
    const Pair<double> a = product(greater, greater), b = product(less, less), both = sum_in_order(a.high, b.high);
    const Pair<double> root = square_root({both.high, both.low + (a.low + b.low)});
    const double length = root.high + root.low;
    return scale == 0 ? length : std::ldexp(length, scale);
}

double any_power(double x, double y) {
    if (is_normal_and_positive(x)) {
        const Pair<double> exponent = exponent_of_power(logarithm<double>(bits_of(x)), y);
        if (std::abs(exponent.high) <= greatest_exponent) return plain_exponential(exponent);
    }
    return unusual_power(x, y);
}

}  // namespace espalier::math
