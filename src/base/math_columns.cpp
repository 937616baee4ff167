#include "base/math_columns.h"

#include "base/math_lanes.h"

#include <algorithm>

namespace espalier::math {
namespace {

const ColumnFunctions& functions() {
    static const ColumnFunctions widest = functions_here().back();
    return widest;
}

/// pow() has no need of logarithms for some exponents.
bool may_be_easy(double exponent) {
    return exponent == 1 || exponent == 2 || exponent == 3 || exponent == 4 || exponent == 0.5;
}

}  // namespace

std::vector<ColumnFunctions> functions_here() {
    std::vector<ColumnFunctions> here{column_functions<double>()};
#ifdef ESPALIER_WIDE_MATH
    if (__builtin_cpu_supports("avx2")) here.push_back(functions_of_256_bits);
    if (__builtin_cpu_supports("avx512f")) here.push_back(functions_of_512_bits);
#endif
    return here;
}

void sin(std::span<const double> angles, double* sines) {
    functions().sin(angles.size(), angles.data(), sines);
}

void cos(std::span<const double> angles, double* cosines) {
    functions().cos(angles.size(), angles.data(), cosines);
}

void exp(std::span<const double> values, double* powers) {
    functions().exp(values.size(), values.data(), powers);
}

void log(std::span<const double> values, double* logarithms) {
    functions().log(values.size(), values.data(), logarithms);
}

void atan2(std::span<const double> y, std::span<const double> x, double* angles) {
    functions().atan2(y.size(), y.data(), x.data(), angles);
}

void pow(std::span<const double> bases, std::span<const double> exponents, double* powers) {
    const auto easy = std::count_if(exponents.begin(), exponents.end(), may_be_easy);
    if (easy < static_cast<std::ptrdiff_t>(bases.size())) {
        functions().pow(bases.size(), bases.data(), exponents.data(), powers);
    }
    for (std::size_t k = 0; easy > 0 && k < bases.size(); ++k) {
        if (may_be_easy(exponents[k])) powers[k] = math::pow(bases[k], exponents[k]);
    }
}

}  // namespace espalier::math
