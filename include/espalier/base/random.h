// Counter-based random numbers (Philox 4x32-10; Salmon, Moraes, Dror & Shaw 2011).
// A sample depends on what asks for it and when, never on the order of execution.
#pragma once

#include <cstdint>
#include <span>

namespace espalier {

/// What samples are for. Streams never disturb each other.
enum class Stream : std::uint32_t {
    derivation = 1,
    homomorphism = 2,
    blocks = 3,
    process = 4,
    placement = 5,
    stage = 6
};

/// Mixes 64 bits so that neighbouring inputs give unrelated outputs (SplitMix64's finalizer).
constexpr std::uint64_t mix(std::uint64_t value) {
    value += 0x9E3779B97F4A7C15u;
    value = (value ^ (value >> 30)) * 0xBF58476D1CE4E5B9u;
    value = (value ^ (value >> 27)) * 0x94D049BB133111EBu;
    return value ^ (value >> 31);
}
/// A hash of two values, not symmetric.
constexpr std::uint64_t mix(std::uint64_t a, std::uint64_t b) {
    return mix(mix(a) ^ (b + 0x632BE59BD9B4E019u));
}

/// The key of a stream: scene seed, plant, purpose. `salt` separates users of one stream (a process's name, say).
class RandomKey {
public:
    RandomKey() = default;
    RandomKey(std::uint64_t seed, std::uint32_t plant, Stream stream, std::uint64_t salt = 0);
    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0;
};

/// Samples for one owner (a module's identity, say) in one step, numbered from 0 as they are taken.
class RandomSamples {
public:
    RandomSamples(RandomKey key, std::uint64_t owner, std::uint32_t step, std::uint32_t first = 0)
        : key_(key), owner_(owner), step_(step), next_(first) {}

    /// Uniform in [0, 1), 53 bits.
    double uniform();
    /// Standard normal deviate (Box-Muller, two uniforms a call).
    double normal();
    /// Beta deviate with shapes a, b > 0 (Marsaglia & Tsang 2000 gammas).
    double beta(double a, double b);
    /// Number of successes in n tosses of probability p.
    double binomial(double n, double p);

    std::uint32_t taken() const { return next_; }

private:
    double log_gamma(double shape);

    RandomKey key_;
    std::uint64_t owner_;
    std::uint32_t step_;
    std::uint32_t next_;
};

/// The first samples of many owners in one step, several at a time: samples[i] is 2^53 times what
/// RandomSamples(key, owners[i], step).uniform() gives.
void first_samples(RandomKey key, std::uint32_t step, std::span<const std::uint64_t> owners, std::uint64_t* samples);

}  // namespace espalier
