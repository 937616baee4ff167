#include "base/decimal.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

// printf rounds the exact value to the nearest decimal number, halves to even, and reading it rounds that to the
// nearest double. Both take one operation each where the decimal number is n / 10^k with n and 10^|k| exact doubles.
namespace espalier {
namespace {

constexpr double impossible = std::numeric_limits<double>::quiet_NaN();
constexpr int most_digits = 15;
constexpr double exact_halves = 1e15;  ///< below it, doubles are multiples of 1/8
constexpr int greatest_exponent = 22;  ///< 10^22 is the last power that is an exact double
constexpr std::array<double, greatest_exponent + 1> powers{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                           1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                           1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/// 10^exponent times a number, rounded once.
inline double scaled(double number, int exponent) {
    return exponent >= 0 ? number * powers[static_cast<std::size_t>(exponent)]
                         : number / powers[static_cast<std::size_t>(-exponent)];
}

/// The leading half of a number's digits (Veltkamp 1968).
double leading(double number) {
    const double large = 134217729 * number;  // 2^27 + 1
    return large - (large - number);
}

/// What a product loses when it is rounded, exactly (Dekker 1971).
double lost(double a, double b, double product) {
    const double a_leads = leading(a), b_leads = leading(b), a_rest = a - a_leads, b_rest = b - b_leads;
    return a_leads * b_leads - product + a_leads * b_rest + a_rest * b_leads + a_rest * b_rest;
}

/// The sign of the exact 10^exponent * number less `made`, what scaled() made of it.
double sign_of_lost(double number, int exponent, double made) {
    const double power = powers[static_cast<std::size_t>(std::abs(exponent))];
    if (exponent >= 0) return lost(number, power, made);
    const double product = made * power;
    return number - product - lost(made, power, product);
}

/// The whole number nearest to the exact 10^exponent * number, which is not negative; `near` is what scaled() made of
/// it. What that lost is less than the distance between doubles, so it decides only where `near` is a half itself.
inline double nearest_whole(double number, int exponent, double near) {
    const auto below = static_cast<std::int64_t>(near);
    const auto floor = static_cast<double>(below);
    const double over = near - floor - 0.5;
    if (over != 0) return floor + static_cast<double>(over > 0);  // no branch: it would be as good as random
    const double rest = sign_of_lost(number, exponent, near);
    if (rest != 0) return rest > 0 ? floor + 1 : floor;
    return below % 2 == 0 ? floor : floor + 1;
}

inline double rounded_at(double number, int exponent, double near) {
    return std::copysign(scaled(nearest_whole(std::abs(number), exponent, near), -exponent), number);
}

/// The exponent of the greatest power of ten that is not above a positive number, or one less.
int decimal_exponent(double number) {
    const int binary = static_cast<int>(std::bit_cast<std::uint64_t>(number) >> 52) - 1023;
    return binary * 1233 >> 12;  // log10(2), close enough for all that are taken here
}

}  // namespace

double rounded_to_digits(double number, int digits) {
    const double size = std::abs(number);
    const bool is_short = digits <= most_digits && size < powers[static_cast<std::size_t>(digits)];
    if (is_short && static_cast<double>(static_cast<std::int64_t>(number)) == number) return number;
    if (!(size > 1e-20 && size < 1e20) || digits > most_digits) return impossible;
    int exponent = digits - 1 - decimal_exponent(size);
    if (exponent > greatest_exponent) return impossible;
    double near = scaled(size, exponent);
    // Where the exact value lies on the other side of a power of ten, both exponents lead to that power.
    if (near >= powers[static_cast<std::size_t>(digits)]) near = scaled(size, --exponent);
    return rounded_at(number, exponent, near);
}

double rounded_to_decimals(double number, int decimals) {
    if (decimals > greatest_exponent) return impossible;
    const double near = scaled(std::abs(number), decimals);
    if (!(near < exact_halves)) return impossible;
    return rounded_at(number, decimals, near);
}

}  // namespace espalier
