#include "base/decimal.h"

#include "espalier/base/random.h"

#include "catch.h"

#include <fmt/format.h>
#include <fmt/printf.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

using namespace espalier;

namespace {

double read(const std::string& text) {
    return std::strtod(text.c_str(), nullptr);
}

std::uint64_t bits(double number) {
    return std::bit_cast<std::uint64_t>(number);
}

/// Numbers of all sizes, halves of decimal units, whole numbers and the neighbours of powers of ten among them.
std::vector<double> numbers(std::uint64_t seed) {
    std::vector<double> all{0.0, -0.0, 0.5, 1.5, 2.5, 0.125, 0.375, 9.9999995, 999999.5, 1e15, 1e20, 1e22, 1e300};
    for (std::uint64_t k = 0; k < 20'000; ++k) {
        const double whole = static_cast<double>(mix(seed, k) % 2000), part = static_cast<double>(mix(k, seed) >> 11);
        const int exponent = static_cast<int>(k % 36) - 17;
        const double power = read(fmt::format("1e{}", exponent));
        all.push_back((part * 0x1p-53 - 0.5) * 10 * power);
        all.push_back((whole + 0.5) * power);
        all.push_back(-whole / 64);
        all.push_back(std::nextafter(power, k % 2 ? 0 : 1e30));
    }
    return all;
}

}  // namespace

TEST_CASE("numbers are rounded to digits and decimals as printing and reading does", "[base]") {
    std::size_t rounded = 0, all = 0;
    for (const double number : numbers(GENERATE(1, 2, 3))) {
        for (const int places : {1, 3, 6, 7, 15}) {
            const double digits = rounded_to_digits(number, places), decimals = rounded_to_decimals(number, places - 1);
            const bool has_digits = !std::isnan(digits), has_decimals = !std::isnan(decimals);
            if (has_digits) REQUIRE(bits(digits) == bits(read(fmt::sprintf("%.*g", places, number))));
            if (has_decimals) REQUIRE(bits(decimals) == bits(read(fmt::sprintf("%.*f", places - 1, number))));
            rounded += has_digits + has_decimals;
            all += 2;
        }
    }
    CHECK(rounded > 0.8 * static_cast<double>(all));
    CHECK(std::isnan(rounded_to_digits(1e-30, 6)));
    CHECK(std::isnan(rounded_to_digits(1.5, 16)));
    CHECK(std::isnan(rounded_to_decimals(1e16, 2)));
}
