// Functions and random numbers for columns of values, several at a time: to the last bit what base/math.h and
// base/random.h give for each alone.
#pragma once

#include "espalier/base/random.h"

#include <cstdint>
#include <span>

namespace espalier::math {

// Results may be written over what they are of.
void sin(std::span<const double> angles, double* sines);
void cos(std::span<const double> angles, double* cosines);
void exp(std::span<const double> values, double* powers);
void log(std::span<const double> values, double* logarithms);

void atan2(std::span<const double> y, std::span<const double> x, double* angles);

/// Powers of each base to its own exponent, which are not written over.
void pow(std::span<const double> bases, std::span<const double> exponents, double* powers);

}  // namespace espalier::math

namespace espalier {

/// Of each owner the sample of a number of its own: samples[i] is 2^53 times the uniform() that comes `numbers[i]`
/// after the first of RandomSamples(key, owners[i], step).
void samples_of(RandomKey key, std::uint32_t step, std::span<const std::uint64_t> owners, const std::uint32_t* numbers,
                std::uint64_t* samples);

}  // namespace espalier
