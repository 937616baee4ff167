#include "espalier/base/random.h"

#include "espalier/base/math.h"
#include "espalier/base/stop.h"

#include "base/math_columns.h"
#include "base/philox.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#if defined(__x86_64__) && defined(__GNUC__)
#define ESPALIER_WIDE_SAMPLES
#include <immintrin.h>
#endif

namespace espalier {
namespace {

constexpr int resolution = 53;  // bits of a sample, as many as a double holds

std::uint64_t sample_bits(std::uint64_t key, std::uint64_t owner, std::uint32_t step, std::uint32_t sample) {
    const philox::Counter bits =
        philox::bits({static_cast<std::uint32_t>(owner), static_cast<std::uint32_t>(owner >> 32), step, sample},
                     {static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32)});
    return ((static_cast<std::uint64_t>(bits[1]) << 32) | bits[0]) >> (64 - resolution);
}

#ifdef ESPALIER_WIDE_SAMPLES
constexpr std::size_t samples_at_once = 8;

/// The same of eight owners: counter words in the lower halves of 64-bit
/// lanes, whose upper halves the multiplication does not see.
__attribute__((target("avx2"))) void sample_eight(std::uint64_t key, std::uint32_t step, const std::uint64_t* owners,
                                                  const std::uint32_t* numbers, std::uint64_t* samples) {
    constexpr int vectors = 2, lanes = 4;
    const __m256i multiplier0 = _mm256_set1_epi64x(philox::multiplier0),
                  multiplier1 = _mm256_set1_epi64x(philox::multiplier1);
    __m256i counter[4][vectors];
    for (int v = 0; v < vectors; ++v) {
        counter[0][v] = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(owners + lanes * v));
        counter[1][v] = _mm256_srli_epi64(counter[0][v], 32);
        counter[2][v] = _mm256_set1_epi64x(step);
        const auto* const number = reinterpret_cast<const __m128i*>(numbers + lanes * v);
        counter[3][v] = _mm256_cvtepu32_epi64(_mm_loadu_si128(number));
    }
    auto key0 = static_cast<std::uint32_t>(key), key1 = static_cast<std::uint32_t>(key >> 32);
    for (int round = 0; round < philox::rounds; ++round, key0 += philox::step0, key1 += philox::step1) {
        const __m256i round_key0 = _mm256_set1_epi64x(key0), round_key1 = _mm256_set1_epi64x(key1);
        for (int v = 0; v < vectors; ++v) {
            const __m256i product0 = _mm256_mul_epu32(counter[0][v], multiplier0);
            const __m256i product1 = _mm256_mul_epu32(counter[2][v], multiplier1);
            const __m256i high0 = _mm256_srli_epi64(product0, 32), high1 = _mm256_srli_epi64(product1, 32);
            counter[0][v] = _mm256_xor_si256(_mm256_xor_si256(high1, counter[1][v]), round_key0);
            counter[1][v] = product1;
            counter[2][v] = _mm256_xor_si256(_mm256_xor_si256(high0, counter[3][v]), round_key1);
            counter[3][v] = product0;
        }
    }
    const __m256i low = _mm256_set1_epi64x(0xFFFFFFFF);
    for (int v = 0; v < vectors; ++v) {
        const __m256i word =
            _mm256_or_si256(_mm256_slli_epi64(counter[1][v], 32), _mm256_and_si256(counter[0][v], low));
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(samples + lanes * v), _mm256_srli_epi64(word, 64 - resolution));
    }
}
#endif

}  // namespace

RandomKey::RandomKey(std::uint64_t seed, std::uint32_t plant, Stream stream, std::uint64_t salt)
    : value_(mix(mix(mix(seed, plant), static_cast<std::uint64_t>(stream)), salt)) {}

double RandomSamples::uniform() {
    return static_cast<double>(sample_bits(key_.value(), owner_, step_, next_++)) * 0x1p-53;
}

void samples_of(RandomKey key, std::uint32_t step, std::span<const std::uint64_t> owners, const std::uint32_t* numbers,
                std::uint64_t* samples) {
    std::size_t k = 0;
#ifdef ESPALIER_WIDE_SAMPLES
    static const bool wide = __builtin_cpu_supports("avx2");
    if (wide) {
        for (; k + samples_at_once <= owners.size(); k += samples_at_once) {
            sample_eight(key.value(), step, owners.data() + k, numbers + k, samples + k);
        }
    }
#endif
    for (; k < owners.size(); ++k) samples[k] = sample_bits(key.value(), owners[k], step, numbers[k]);
}

void first_samples(RandomKey key, std::uint32_t step, std::span<const std::uint64_t> owners, std::uint64_t* samples) {
    constexpr std::size_t at_once = 64;
    static constexpr std::array<std::uint32_t, at_once> first{};
    for (std::size_t k = 0; k < owners.size(); k += at_once) {
        samples_of(key, step, owners.subspan(k, std::min(at_once, owners.size() - k)), first.data(), samples + k);
    }
}

double RandomSamples::normal() {
    const double radius = std::sqrt(-2 * math::log(1 - uniform()));
    return radius * math::cos(2 * std::numbers::pi * uniform());
}

// Marsaglia & Tsang (2000), "A simple method for generating gamma variables". Small shapes give numbers that only
// their logarithms can hold.
double RandomSamples::log_gamma(double shape) {
    if (shape < 1) {
        const double boost = math::log(1 - uniform()) / shape;
        return log_gamma(shape + 1) + boost;
    }
    const double d = shape - 1.0 / 3;
    const double c = 1 / std::sqrt(9 * d);
    while (true) {
        const double x = normal();
        const double v = math::pow(1 + c * x, 3);
        if (v <= 0) continue;
        if (math::log(1 - uniform()) < 0.5 * x * x + d - d * v + d * math::log(v)) return math::log(d) + math::log(v);
    }
}

double RandomSamples::beta(double a, double b) {
    const double x = log_gamma(a);
    const double y = log_gamma(b);
    return 1 / (1 + math::exp(y - x));
}

double RandomSamples::binomial(double n, double p) {
    double successes = 0;
    StopCheck<4096> check_stop;
    for (double toss = 0; toss < n; ++toss) {
        check_stop();
        successes += uniform() < p ? 1 : 0;
    }
    return successes;
}

}  // namespace espalier
