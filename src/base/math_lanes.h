// The functions of base/math_columns.h by the instructions that the file is compiled for which includes this one. All
// that is not a template over Lanes is inlined, so that no other file gets code that its processor may not have.
#pragma once

#include "espalier/base/math.h"

#include "base/math_kernels.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace espalier::math {

/// A function of one column or two.
using OfColumn = void (*)(std::size_t count, const double* values, double* results);
using OfColumns = void (*)(std::size_t count, const double* first, const double* second, double* results);

struct ColumnFunctions {
    OfColumn sin, cos, exp, log;
    OfColumns atan2, pow;
};

extern const ColumnFunctions functions_of_512_bits, functions_of_256_bits;

/// All that this processor can run, the widest last.
std::vector<ColumnFunctions> functions_here();

/// Of one number, or lane by lane.
template <class Mask>
ESPALIER_INLINE Mask both(Mask a, Mask b) {
    if constexpr (std::is_same_v<Mask, bool>) {
        return a && b;
    } else {
        return a & b;
    }
}

// Each function as its kernel, the test of arguments that the kernel takes, and the function of one number, which
// takes all.

struct Sine {
    template <class T>
    ESPALIER_INLINE static T kernel(T x) {
        return sine(angle_of(x)).high;
    }
    template <class T>
    ESPALIER_INLINE static auto is_plain(T x) {
        return both(magnitude(x) >= small_angle, magnitude(x) < great_angle);
    }
    ESPALIER_INLINE static double one(double x) { return math::sin(x); }
};

struct Cosine : Sine {
    template <class T>
    ESPALIER_INLINE static T kernel(T x) {
        return sine(angle_of(x), 1).high;
    }
    ESPALIER_INLINE static double one(double x) { return math::cos(x); }
};

struct PowerOfE {
    template <class T>
    ESPALIER_INLINE static T kernel(T x) {
        return plain_exponential<T>({x, T{}});
    }
    template <class T>
    ESPALIER_INLINE static auto is_plain(T x) {
        return magnitude(x) <= greatest_exponent;
    }
    ESPALIER_INLINE static double one(double x) { return math::exp(x); }
};

struct NaturalLogarithm {
    template <class T>
    ESPALIER_INLINE static T kernel(T x) {
        return short_logarithm<T>(bits_of(x));
    }
    template <class T>
    ESPALIER_INLINE static auto is_plain(T x) {
        return is_normal_and_positive(x);
    }
    ESPALIER_INLINE static double one(double x) { return math::log(x); }
};

struct Power {
    template <class T>
    ESPALIER_INLINE static T kernel(T x, T y) {
        return plain_exponential(exponent_of_power(logarithm<T>(bits_of(x)), y));
    }
    template <class T>
    ESPALIER_INLINE static auto is_plain(T x, T y) {
        const T exponent = exponent_of_power(logarithm<T>(bits_of(x)), y).high;
        return both(is_normal_and_positive(x), magnitude(exponent) <= greatest_exponent);
    }
    ESPALIER_INLINE static double one(double x, double y) { return any_power(x, y); }
};

struct AngleOfLegs {
    template <class T>
    ESPALIER_INLINE static T kernel(T y, T x) {
        return arctangent_of_legs<T>({y, T{}}, {x, T{}});
    }
    template <class T>
    ESPALIER_INLINE static auto is_plain(T y, T x) {
        return both(both(magnitude(x) >= least_leg, magnitude(x) <= greatest_leg),
                    both(magnitude(y) >= least_leg, magnitude(y) <= greatest_leg));
    }
    ESPALIER_INLINE static double one(double y, double x) { return math::atan2(y, x); }
};

ESPALIER_INLINE Lanes lanes_of(const double* column) {
    Lanes values;
    std::memcpy(&values, column, sizeof values);
    return values;
}

template <class Mask>
ESPALIER_INLINE bool is_each(Mask is) {
    if constexpr (std::is_same_v<Mask, bool>) {
        return is;
    } else {
        std::int64_t each = -1;
        for (std::size_t lane = 0; lane < sizeof is / sizeof(double); ++lane) each &= is[lane];
        return each != 0;
    }
}

template <class Function, class T, class... Columns>
void in_lanes(std::size_t count, double* results, Columns... columns) {
    constexpr std::size_t lanes = sizeof(T) / sizeof(double);
    std::size_t k = 0;
    while (k < count) {
        const bool whole = k + lanes <= count;
        if (whole && is_each(Function::is_plain(lanes_of(columns + k)...))) {
            const T values = Function::kernel(lanes_of(columns + k)...);
            std::memcpy(results + k, &values, sizeof values);
            k += lanes;
        } else {
            const std::size_t end = whole ? k + lanes : count;
            for (; k < end; ++k) results[k] = Function::one(columns[k]...);
        }
    }
}

template <class Function, class T>
void of_column(std::size_t count, const double* values, double* results) {
    in_lanes<Function, T>(count, results, values);
}

template <class Function, class T>
void of_columns(std::size_t count, const double* first, const double* second, double* results) {
    in_lanes<Function, T>(count, results, first, second);
}

template <class T>
constexpr ColumnFunctions column_functions() {
    return {of_column<Sine, T>,         of_column<Cosine, T>, of_column<PowerOfE, T>, of_column<NaturalLogarithm, T>,
            of_columns<AngleOfLegs, T>, of_columns<Power, T>};
}

}  // namespace espalier::math
