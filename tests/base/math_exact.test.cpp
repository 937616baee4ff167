// How far base/math.h is from the truth: beside MPFR, which rounds correctly with any number of digits.
#include "espalier/base/math.h"
#include "espalier/base/random.h"

#include "catch.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <mpfr.h>
#include <numbers>
#include <string>
#include <vector>

using namespace espalier;

namespace {

/// The error that base/math.h promises, in units in the last place.
constexpr double promised = 0.76;

/// A number of MPFR, with enough digits to judge the last of a double.
class Exact {
public:
    Exact() { mpfr_init2(value_, 160); }
    explicit Exact(double value) : Exact() { mpfr_set_d(value_, value, MPFR_RNDN); }
    Exact(const Exact&) = delete;
    Exact& operator=(const Exact&) = delete;
    ~Exact() { mpfr_clear(value_); }

    mpfr_ptr value() { return value_; }
    double rounded() const { return mpfr_get_d(value_, MPFR_RNDN); }

    /// How far `number` is from this one, in units in the last place of this one as a double.
    double units_to(double number) const {
        const double nearest = rounded();
        if (std::isnan(nearest) || std::isinf(nearest) || std::isinf(number) || std::isnan(number)) {
            // Where the greatest doubles end, both roundings are within the promise.
            const bool at_the_end = std::abs(nearest) == std::numeric_limits<double>::max() && std::isinf(number);
            return number == nearest || (std::isnan(number) && std::isnan(nearest)) || at_the_end
                       ? 0
                       : std::numeric_limits<double>::infinity();
        }
        const int last = nearest == 0 ? -1074 : std::max(std::ilogb(nearest), -1022) - 52;
        Exact apart(number);
        mpfr_sub(apart.value_, apart.value_, value_, MPFR_RNDN);
        mpfr_mul_2si(apart.value_, apart.value_, -last, MPFR_RNDN);
        return std::abs(apart.rounded());
    }

private:
    mpfr_t value_;
};

/// Arguments that are the same on every machine.
class Arguments {
public:
    std::uint64_t bits() { return mix(++count_, 77); }
    double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
    double between(double low, double high) { return low + (high - low) * unit(); }
    double power_of_two(double low, double high) { return std::exp2(between(low, high)); }
    double signed_power(double low, double high) { return power_of_two(low, high) * (bits() % 2 == 0 ? 1 : -1); }
    double any() { return std::bit_cast<double>(bits()); }
    double beside_one(double low, double high) { return 1 + signed_power(low, high); }
    double multiple(double of, int most) { return static_cast<double>(static_cast<int>(between(-most, most))) * of; }

private:
    std::uint64_t count_ = 0;
};

struct OfOne {
    const char* name;
    double (*ours)(double);
    int (*exact)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);
    std::vector<std::function<double(Arguments&)>> arguments;
};

struct OfTwo {
    const char* name;
    double (*ours)(double, double);
    int (*exact)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t);
    std::vector<std::function<std::pair<double, double>(Arguments&)>> arguments;
};

std::function<double(Arguments&)> between(double low, double high) {
    return [=](Arguments& of) { return of.between(low, high); };
}

std::function<double(Arguments&)> of_size(double low, double high) {
    return [=](Arguments& of) { return of.signed_power(low, high); };
}

double any(Arguments& of) {
    return of.any();
}

/// All angles, and those next to whole quarters of a turn, whose sine or cosine is the hardest.
std::vector<std::function<double(Arguments&)>> angles() {
    constexpr double half = std::numbers::pi / 2;
    return {between(-7, 7),
            between(-70000, 70000),
            of_size(-40, 60),
            any,
            [](Arguments& of) { return of.multiple(half, 40000); },
            [](Arguments& of) { return std::nextafter(of.multiple(half, 900000), 0.0); }};
}

std::vector<std::function<double(Arguments&)>> sines() {
    return {between(-1, 1), of_size(-60, 0), [](Arguments& of) { return 1 - of.power_of_two(-53, -2); },
            [](Arguments& of) { return of.power_of_two(-53, -2) - 1; }};
}

const std::vector<OfOne>& functions_of_one() {
    static const std::vector<OfOne> all{
        {"sin", math::sin, mpfr_sin, angles()},
        {"cos", math::cos, mpfr_cos, angles()},
        {"tan", math::tan, mpfr_tan, angles()},
        {"sine of both", [](double x) { return math::sine_and_cosine(x).sine; }, mpfr_sin, angles()},
        {"cosine of both", [](double x) { return math::sine_and_cosine(x).cosine; }, mpfr_cos, angles()},
        {"asin", math::asin, mpfr_asin, sines()},
        {"acos", math::acos, mpfr_acos, sines()},
        {"atan", math::atan, mpfr_atan, {between(-3, 3), of_size(-80, 80), any}},
        {"exp", math::exp, mpfr_exp, {between(-10, 10), between(-750, 712), between(-746, -700), of_size(-60, 9), any}},
        {"log",
         math::log,
         mpfr_log,
         {between(0, 10), [](Arguments& of) { return of.beside_one(-53, -3); },
          [](Arguments& of) { return of.power_of_two(-1074, 1024); }, any}},
        {"log1p",
         math::log1p,
         mpfr_log1p,
         {between(-1, 1), of_size(-70, 0), [](Arguments& of) { return of.power_of_two(-60, 1023); }, any}},
        {"cbrt", math::cbrt, mpfr_cbrt, {between(-9, 9), of_size(-1074, 1023), any}},
    };
    return all;
}

const std::vector<OfTwo>& functions_of_two() {
    using Two = std::pair<double, double>;
    static const std::vector<OfTwo> all{
        {"atan2",
         math::atan2,
         mpfr_atan2,
         {[](Arguments& of) {
              return Two{of.between(-1, 1), of.between(-1, 1)};
          },
          [](Arguments& of) {
              return Two{of.signed_power(-20, 20), of.signed_power(-20, 20)};
          },
          [](Arguments& of) {
              return Two{of.signed_power(-1074, 1023), of.signed_power(-1074, 1023)};
          },
          [](Arguments& of) {
              return Two{of.any(), of.any()};
          }}},
        {"hypot",
         math::hypot,
         mpfr_hypot,
         {[](Arguments& of) {
              return Two{of.between(-9, 9), of.between(-9, 9)};
          },
          [](Arguments& of) {
              return Two{of.signed_power(-40, 40), of.signed_power(-40, 40)};
          },
          [](Arguments& of) {
              return Two{of.signed_power(-1074, -1000), of.signed_power(-1074, -1000)};
          },
          [](Arguments& of) {
              return Two{of.any(), of.any()};
          }}},
        {"pow",
         math::any_power,
         mpfr_pow,
         {[](Arguments& of) {
              return Two{of.between(0, 10), of.between(-5, 5)};
          },
          [](Arguments& of) {
              return Two{of.power_of_two(-30, 30), of.between(-40, 40)};
          },
          [](Arguments& of) {
              return Two{of.beside_one(-40, -4), of.signed_power(0, 45)};
          },
          [](Arguments& of) {
              return Two{of.power_of_two(-10, -1), of.between(0, 1100)};
          },
          [](Arguments& of) {
              return Two{of.power_of_two(-1074, 1024), of.signed_power(-12, 3)};
          },
          [](Arguments& of) {
              return Two{of.between(-9, 9), of.multiple(1, 60)};
          },
          [](Arguments& of) {
              return Two{of.any(), of.any()};
          }}},
    };
    return all;
}

/// The greatest error of a function for `count` arguments of each kind.
template <class Function>
double greatest_error(const Function& function, int count,
                      double (*error_at)(const Function&, Arguments&, std::size_t)) {
    double greatest = 0;
    for (std::size_t kind = 0; kind < function.arguments.size(); ++kind) {
        Arguments arguments;
        for (int k = 0; k < count; ++k) greatest = std::max(greatest, error_at(function, arguments, kind));
    }
    return greatest;
}

double error_of_one(const OfOne& function, Arguments& arguments, std::size_t kind) {
    const double x = function.arguments[kind](arguments);
    Exact argument(x), exact;
    function.exact(exact.value(), argument.value(), MPFR_RNDN);
    return exact.units_to(function.ours(x));
}

double error_of_two(const OfTwo& function, Arguments& arguments, std::size_t kind) {
    const auto [x, y] = function.arguments[kind](arguments);
    Exact first(x), second(y), exact;
    function.exact(exact.value(), first.value(), second.value(), MPFR_RNDN);
    return exact.units_to(function.ours(x, y));
}

void check_errors(int count) {
    for (const OfOne& function : functions_of_one()) {
        const double error = greatest_error<OfOne>(function, count, error_of_one);
        CAPTURE(function.name, error);
        CHECK(error < promised);
    }
    for (const OfTwo& function : functions_of_two()) {
        const double error = greatest_error<OfTwo>(function, count, error_of_two);
        CAPTURE(function.name, error);
        CHECK(error < promised);
    }
}

}  // namespace

TEST_CASE("functions are within 0.76 units in the last place of the truth", "[base][math]") {
    check_errors(4000);
}

// For whoever changes them: ten million arguments each, ten minutes.
TEST_CASE("functions are within 0.76 units for ten million arguments", "[.][math-long]") {
    check_errors(2'500'000);
}
