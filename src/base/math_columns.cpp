#include "base/math_columns.h"

#include "espalier/base/math.h"

#include <algorithm>
#include <sleef.h>

// SLEEF's functions without fused multiply-add give the same bits for every width of vectors.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(_WIN32)
#define ESPALIER_WIDE_MATH
#include <immintrin.h>

#define ESPALIER_EIGHT __attribute__((target("avx512f")))
#define ESPALIER_FOUR __attribute__((target("avx")))
extern "C" {
#ifndef __AVX512F__
ESPALIER_EIGHT __m512d Sleef_cinz_sind8_u10avx512fnofma(__m512d);
ESPALIER_EIGHT __m512d Sleef_cinz_cosd8_u10avx512fnofma(__m512d);
ESPALIER_EIGHT __m512d Sleef_cinz_expd8_u10avx512fnofma(__m512d);
ESPALIER_EIGHT __m512d Sleef_cinz_logd8_u10avx512fnofma(__m512d);
ESPALIER_EIGHT __m512d Sleef_cinz_powd8_u10avx512fnofma(__m512d, __m512d);
#endif
#ifndef __AVX__
ESPALIER_FOUR __m256d Sleef_cinz_sind4_u10avx(__m256d);
ESPALIER_FOUR __m256d Sleef_cinz_cosd4_u10avx(__m256d);
ESPALIER_FOUR __m256d Sleef_cinz_expd4_u10avx(__m256d);
ESPALIER_FOUR __m256d Sleef_cinz_logd4_u10avx(__m256d);
ESPALIER_FOUR __m256d Sleef_cinz_powd4_u10avx(__m256d, __m256d);
#endif
}
#endif

namespace espalier::math {
namespace {

using One = double (*)(double);

#ifdef ESPALIER_WIDE_MATH
enum class Width { one, four, eight };

Width width() {
    static const Width widest = __builtin_cpu_supports("avx512f") ? Width::eight
                                : __builtin_cpu_supports("avx")   ? Width::four
                                                                  : Width::one;
    return widest;
}

using Eight = __m512d (*)(__m512d);
using Four = __m256d (*)(__m256d);

ESPALIER_EIGHT __mmask8 first_of_eight(std::size_t count) {
    return count >= 8 ? __mmask8{0xFF} : static_cast<__mmask8>((1u << count) - 1);
}

ESPALIER_EIGHT void in_eights(Eight function, std::span<const double> x, double* results) {
    for (std::size_t k = 0; k < x.size(); k += 8) {
        const __mmask8 mask = first_of_eight(x.size() - k);
        _mm512_mask_storeu_pd(results + k, mask, function(_mm512_maskz_loadu_pd(mask, x.data() + k)));
    }
}

ESPALIER_EIGHT void powers_in_eights(std::span<const double> x, const double* y, double* results) {
    for (std::size_t k = 0; k < x.size(); k += 8) {
        const __mmask8 mask = first_of_eight(x.size() - k);
        const __m512d bases = _mm512_maskz_loadu_pd(mask, x.data() + k), exponents = _mm512_maskz_loadu_pd(mask, y + k);
        _mm512_mask_storeu_pd(results + k, mask, Sleef_cinz_powd8_u10avx512fnofma(bases, exponents));
    }
}

/// Returns how many there were in whole fours.
ESPALIER_FOUR std::size_t in_fours(Four function, std::span<const double> x, double* results) {
    std::size_t k = 0;
    for (; k + 4 <= x.size(); k += 4) _mm256_storeu_pd(results + k, function(_mm256_loadu_pd(x.data() + k)));
    return k;
}

ESPALIER_FOUR std::size_t powers_in_fours(std::span<const double> x, const double* y, double* results) {
    std::size_t k = 0;
    for (; k + 4 <= x.size(); k += 4) {
        const __m256d powers = Sleef_cinz_powd4_u10avx(_mm256_loadu_pd(x.data() + k), _mm256_loadu_pd(y + k));
        _mm256_storeu_pd(results + k, powers);
    }
    return k;
}

void each(Eight eight, Four four, One one, std::span<const double> x, double* results) {
    if (width() == Width::eight) return in_eights(eight, x, results);
    std::size_t k = width() == Width::four ? in_fours(four, x, results) : 0;
    for (; k < x.size(); ++k) results[k] = one(x[k]);
}

void any_powers(std::span<const double> x, const double* y, double* results) {
    if (width() == Width::eight) return powers_in_eights(x, y, results);
    std::size_t k = width() == Width::four ? powers_in_fours(x, y, results) : 0;
    for (; k < x.size(); ++k) results[k] = any_power(x[k], y[k]);
}

#define ESPALIER_EACH(name) \
    each(Sleef_cinz_##name##d8_u10avx512fnofma, Sleef_cinz_##name##d4_u10avx, static_cast<One>(math::name), x, results)
#else
void each(One one, std::span<const double> x, double* results) {
    for (std::size_t k = 0; k < x.size(); ++k) results[k] = one(x[k]);
}

void any_powers(std::span<const double> x, const double* y, double* results) {
    for (std::size_t k = 0; k < x.size(); ++k) results[k] = any_power(x[k], y[k]);
}

#define ESPALIER_EACH(name) each(static_cast<One>(math::name), x, results)
#endif

/// pow() has no need of logarithms for some bases.
bool may_be_easy(double exponent) {
    return exponent == 1 || exponent == 2 || exponent == 3 || exponent == 4 || exponent == 0.5;
}

}  // namespace

void sin(std::span<const double> x, double* results) {
    ESPALIER_EACH(sin);
}

void cos(std::span<const double> x, double* results) {
    ESPALIER_EACH(cos);
}

void exp(std::span<const double> x, double* results) {
    ESPALIER_EACH(exp);
}

void log(std::span<const double> x, double* results) {
    ESPALIER_EACH(log);
}

void pow(std::span<const double> bases, std::span<const double> exponents, double* powers) {
    const auto easy = std::count_if(exponents.begin(), exponents.end(), may_be_easy);
    if (easy < static_cast<std::ptrdiff_t>(bases.size())) any_powers(bases, exponents.data(), powers);
    for (std::size_t k = 0; easy > 0 && k < bases.size(); ++k) {
        if (may_be_easy(exponents[k])) powers[k] = math::pow(bases[k], exponents[k]);
    }
}

}  // namespace espalier::math
