#include "espalier/base/math.h"

#include "espalier/base/random.h"

#include "base/math_columns.h"
#include "base/math_lanes.h"
#include "catch.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

using namespace espalier;

namespace {

using Wide = long double;  ///< with more digits than double, on most machines

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double greatest = std::numeric_limits<double>::max();
constexpr double smallest = std::numeric_limits<double>::denorm_min();
const double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Arguments that are the same on every machine: evenly from `low` to `high`.
std::vector<double> arguments(double low, double high, std::size_t count = 20000) {
    std::vector<double> values;
    for (std::uint64_t k = 0; k < count; ++k) {
        values.push_back(low + (high - low) * static_cast<double>(mix(k, 1) >> 11) * 0x1p-53);
    }
    return values;
}

bool are_same(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// How far `value` is from `exact`, in units of the last place.
double units_apart(double value, double exact) {
    if (are_same(value, exact) || (std::isnan(value) && std::isnan(exact))) return 0;
    const double unit = std::nextafter(std::abs(exact), infinite) - std::abs(exact);
    return std::abs(value - exact) / unit;
}

struct Case {
    const char* name;
    double (*ours)(double);
    Wide (*exact)(Wide);
    double low, high;
    std::uint64_t bits;  ///< all values for arguments from low to high, mixed
};

double power_of(double exponent, double x) {
    return math::pow(x, exponent);
}

const std::vector<Case>& cases() {
    static const std::vector<Case> all{
        {"sin", math::sin, [](Wide x) { return std::sin(x); }, -100, 100, 0x26cf99bb98ad1c48},
        {"cos", math::cos, [](Wide x) { return std::cos(x); }, -100, 100, 0xec4fe857837cfb20},
        {"tan", math::tan, [](Wide x) { return std::tan(x); }, -100, 100, 0x74161f7d4b35a020},
        {"asin", math::asin, [](Wide x) { return std::asin(x); }, -1, 1, 0xb6fd9c8d0e971a13},
        {"acos", math::acos, [](Wide x) { return std::acos(x); }, -1, 1, 0xdd083c3b60d78bcc},
        {"atan", math::atan, [](Wide x) { return std::atan(x); }, -9, 9, 0xfd79b94b158f2f09},
        {"atan2", [](double y) { return math::atan2(y, -0.7); }, [](Wide y) { return std::atan2(y, Wide(-0.7)); }, -9,
         9, 0x87cd2330e3a442ca},
        {"sine", [](double x) { return math::sine_and_cosine(x).sine; }, [](Wide x) { return std::sin(x); }, -100, 100,
         0x26cf99bb98ad1c48},
        {"cosine", [](double x) { return math::sine_and_cosine(x).cosine; }, [](Wide x) { return std::cos(x); }, -100,
         100, 0xec4fe857837cfb20},
        {"exp", math::exp, [](Wide x) { return std::exp(x); }, -700, 700, 0x1243990b8fb39c40},
        {"log", math::log, [](Wide x) { return std::log(x); }, 0, 10, 0x93df22fcf50b6e54},
        {"log1p", math::log1p, [](Wide x) { return std::log1p(x); }, -1, 1, 0x7a40d139993d913a},
        {"cbrt", math::cbrt, [](Wide x) { return std::cbrt(x); }, -9, 9, 0x9cfa5f90b855dcfd},
        {"hypot", [](double x) { return math::hypot(x, 0.7); }, [](Wide x) { return std::hypot(x, Wide(0.7)); }, -9, 9,
         0x82969fb922f8a35b},
        {"pow, 2.49", [](double x) { return power_of(2.49, x); }, [](Wide x) { return std::pow(x, Wide(2.49)); }, 0,
         100, 0xc2ec198d95e2d042},
        {"pow, -7", [](double x) { return power_of(-7, x); }, [](Wide x) { return std::pow(x, Wide(-7)); }, -9, 9,
         0xfb91a3cd6d316658},
        {"pow, 2", [](double x) { return power_of(2, x); }, [](Wide x) { return std::pow(x, Wide(2)); }, -9, 9,
         0x6cc78e57e27ca9d8},
        {"pow, 0.5", [](double x) { return power_of(0.5, x); }, [](Wide x) { return std::pow(x, Wide(0.5)); }, 0, 9,
         0x2cf25205c9248c8f},
    };
    return all;
}

}  // namespace

TEST_CASE("functions have the bits that they have on other machines", "[base][math]") {
    for (const Case& function : cases()) {
        std::uint64_t bits = 0;
        for (const double x : arguments(function.low, function.high)) {
            bits = mix(bits, std::bit_cast<std::uint64_t>(function.ours(x)));
        }
        INFO(function.name << " has " << std::hex << bits);
        CHECK(bits == function.bits);
    }
}

// With the arithmetic of cpfg a parameter is a 32-bit float: a model has the values that any good C library gave it
// there.
TEST_CASE("values are exact in 32-bit floats", "[base][math]") {
    for (const Case& function : cases()) {
        std::size_t others = 0;
        for (const double x : arguments(function.low, function.high)) {
            others += static_cast<float>(function.ours(x)) != static_cast<float>(function.exact(x));
        }
        INFO(function.name);
        CHECK(others == 0);
    }
}

TEST_CASE("powers by products and a root are those of the C library to 3.4e-16", "[base][math]") {
    for (const double exponent : {0.0, 0.5, 1.0, 2.0, 3.0, 4.0}) {
        for (const double x : arguments(0, 100)) {
            const double exact = std::pow(x, exponent);
            REQUIRE(std::abs(math::pow(x, exponent) - exact) <= 3.4e-16 * exact);
        }
    }
    for (double base = -300; base <= 300; ++base) {
        for (int exponent = 0; exponent <= 20; ++exponent) {
            const double exact = std::pow(base, exponent);
            if (std::abs(exact) > 0x1p53) break;
            REQUIRE(math::pow(base, exponent) == exact);  // whole numbers have whole powers
        }
    }
}

TEST_CASE("functions of a column have the bits that they have of each number", "[base][math]") {
    std::vector<double> x = arguments(-60, 60, 1000), y = arguments(-9, 9, 1000);
    const double ends[] = {0.0,       -0.0,         0.5,      1.0,      2.0,   3.0,    4.0, -1.0,   infinite,
                           -infinite, not_a_number, greatest, smallest, 700.1, -700.1, 1e5, 0x1p-28};
    for (const double a : ends) {
        for (const double b : ends) x.push_back(a), y.push_back(b);
    }
    for (std::uint64_t k = 0; k < 3000; ++k) {
        x.push_back(std::bit_cast<double>(mix(k, 2)));
        y.push_back(k % 3 ? 20 * static_cast<double>(mix(k, 3) >> 11) * 0x1p-53 : 0.5 * static_cast<double>(k % 10));
    }
    // Of every length, so that none depends on what stands beside it.
    for (std::size_t begin = 0, count = 0; begin < x.size(); begin += count, count = count % 19 + 1) {
        count = std::min(count, x.size() - begin);
        const std::span<const double> some(x.data() + begin, count), exponents(y.data() + begin, count);
        std::array<double, 20> sines{}, cosines{}, exponentials{}, logarithms{}, powers{}, angles{};
        math::sin(some, sines.data());
        math::cos(some, cosines.data());
        math::exp(some, exponentials.data());
        math::log(some, logarithms.data());
        math::atan2(some, exponents, angles.data());
        math::pow(some, exponents, powers.data());
        for (std::size_t k = 0; k < count; ++k) {
            REQUIRE(are_same(sines[k], math::sin(some[k])));
            REQUIRE(are_same(cosines[k], math::cos(some[k])));
            REQUIRE(are_same(exponentials[k], math::exp(some[k])));
            REQUIRE(are_same(logarithms[k], math::log(some[k])));
            REQUIRE(are_same(angles[k], math::atan2(some[k], exponents[k])));
            REQUIRE(are_same(powers[k], math::pow(some[k], exponents[k])));
        }
        REQUIRE(powers[count] == 0);
    }
}

TEST_CASE("columns have the same bits with any width of vectors", "[base][math]") {
    std::vector<double> x = arguments(-20, 20, 4001), y = arguments(-5, 5, 4001);
    for (std::size_t k = 0; k < 500; ++k) x[8 * k] = std::abs(x[8 * k]);
    std::vector<double> one(x.size()), wide(x.size());
    for (const math::ColumnFunctions& functions : math::functions_here()) {
        const auto compare = [&](math::OfColumn of_one, math::OfColumn of_lanes) {
            of_one(x.size(), x.data(), one.data());
            of_lanes(x.size(), x.data(), wide.data());
            CHECK(std::equal(one.begin(), one.end(), wide.begin(), are_same));
        };
        const math::ColumnFunctions plain = math::functions_here().front();
        compare(plain.sin, functions.sin);
        compare(plain.cos, functions.cos);
        compare(plain.exp, functions.exp);
        compare(plain.log, functions.log);
        for (const auto& [of_one, of_lanes] : {std::pair(plain.pow, functions.pow), {plain.atan2, functions.atan2}}) {
            of_one(x.size(), x.data(), y.data(), one.data());
            of_lanes(x.size(), x.data(), y.data(), wide.data());
            CHECK(std::equal(one.begin(), one.end(), wide.begin(), are_same));
        }
    }
}

TEST_CASE("powers of one base are as exact as their logarithms are small", "[base][math]") {
    for (const double base : {0.0, 0.25, 0.9, 1.0, 7.0}) {
        const math::PowersOf powers(base);
        CHECK(powers(0) == 1);
        for (const double exponent : arguments(0, 30, 2000)) {
            const double exact = std::pow(base, exponent);
            const double units = 2 + std::abs(exponent * std::log(std::max(base, 1e-300)));
            REQUIRE(std::abs(powers(exponent) - exact) <= units * 0x1p-52 * exact);
        }
    }
}

TEST_CASE("zeros, infinities and what is no number go in and come out as in C", "[base][math]") {
    const std::array<double, 24> ends{0.0,      -0.0,      1,
                                      -1,       2,         -2,
                                      3,        -3,        4,
                                      0.5,      -0.5,      7,
                                      1e10,     -5.5,      1e22,
                                      smallest, -smallest, 2.3e-308,
                                      infinite, -infinite, not_a_number,
                                      1e300,    -1e300,    std::numbers::pi / 2};
    for (const double x : ends) {
        INFO(x);
        CHECK(units_apart(math::sin(x), std::sin(x)) <= 1);
        CHECK(units_apart(math::cos(x), std::cos(x)) <= 1);
        CHECK(units_apart(math::sine_and_cosine(x).sine, std::sin(x)) <= 1);
        CHECK(units_apart(math::asin(x), std::asin(x)) <= 1);
        CHECK(units_apart(math::acos(x), std::acos(x)) <= 1);
        CHECK(units_apart(math::atan(x), std::atan(x)) <= 1);
        CHECK(units_apart(math::exp(x), std::exp(x)) <= 1);
        CHECK(units_apart(math::log(x), std::log(x)) <= 1);
        CHECK(units_apart(math::tan(x), std::tan(x)) <= 1);
        CHECK(units_apart(math::log1p(x), std::log1p(x)) <= 1);
        for (const double y : ends) {
            INFO(y);
            CHECK(units_apart(math::pow(x, y), std::pow(x, y)) <= 1);
            CHECK(units_apart(math::atan2(x, y), std::atan2(x, y)) <= 1);
            CHECK(units_apart(math::hypot(x, y), std::hypot(x, y)) <= 1);
        }
    }
}

TEST_CASE("the ends of the range", "[base][math]") {
    CHECK(math::pow(0, 0) == 1);
    CHECK(math::pow(not_a_number, 0) == 1);
    CHECK(math::pow(1, not_a_number) == 1);
    CHECK(std::isnan(math::pow(-2, 0.5)));
    CHECK(are_same(math::pow(-0.0, 0.5), 0));
    CHECK(math::pow(-infinite, 0.5) == infinite);
    CHECK(math::pow(greatest, 1) == greatest);
    CHECK(math::pow(2, -1074) == smallest);
    CHECK(math::pow(2, 1023) == 0x1p1023);
    CHECK(math::exp(709.78) == Approx(std::exp(709.78)).epsilon(1e-15));
    CHECK(math::exp(709.79) == infinite);
    CHECK(math::exp(-745.1) == smallest);
    CHECK(math::exp(-746) == 0);
    CHECK(math::log(smallest) == Approx(-744.4400719213812).epsilon(1e-15));
    CHECK(math::hypot(1e300, 1e300) == Approx(std::numbers::sqrt2 * 1e300).epsilon(1e-15));
    CHECK(math::sin(1e22) == Approx(-0.8522008497671888).epsilon(1e-15));
}
