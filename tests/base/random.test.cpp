#include "espalier/base/random.h"

#include "base/math_columns.h"
#include "base/philox.h"
#include "catch.h"

#include <cmath>
#include <set>
#include <vector>

using namespace espalier;

TEST_CASE("the generator is Philox 4x32-10, by its published known answers", "[base]") {
    constexpr std::uint32_t ones = 0xffffffff;
    CHECK(philox::bits({0, 0, 0, 0}, {0, 0}) == philox::Counter{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8});
    CHECK(philox::bits({ones, ones, ones, ones}, {ones, ones}) ==
          philox::Counter{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd});
    CHECK(philox::bits({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}) ==
          philox::Counter{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1});
}

TEST_CASE("a sample depends on seed, plant, stream, owner, step and number, and on nothing else", "[base]") {
    const RandomKey key(7, 0, Stream::derivation);
    const double value = RandomSamples(key, 11, 3).uniform();
    CHECK(RandomSamples(RandomKey(7, 0, Stream::derivation), 11, 3).uniform() == value);
    std::set<double> others = {value,
                               RandomSamples(RandomKey(8, 0, Stream::derivation), 11, 3).uniform(),
                               RandomSamples(RandomKey(7, 1, Stream::derivation), 11, 3).uniform(),
                               RandomSamples(RandomKey(7, 0, Stream::homomorphism), 11, 3).uniform(),
                               RandomSamples(key, 12, 3).uniform(),
                               RandomSamples(key, 11, 4).uniform(),
                               RandomSamples(key, 11, 3, 1).uniform()};
    CHECK(others.size() == 7);
}

TEST_CASE("uniform samples fill [0,1) evenly: chi-square over 100 bins", "[base]") {
    std::vector<int> bins(100);
    for (std::uint64_t owner = 0; owner < 100000; ++owner) {
        const double u = RandomSamples(RandomKey(1, 2, Stream::derivation), owner, 0).uniform();
        REQUIRE(u >= 0);
        REQUIRE(u < 1);
        ++bins[static_cast<std::size_t>(u * 100)];
    }
    double chi = 0;
    for (int count : bins) chi += (count - 1000.0) * (count - 1000.0) / 1000;
    CHECK(chi < 134.6);  // 99th percentile of chi-square with 99 degrees of freedom
    CHECK(chi > 69.2);   // 1st percentile
}

TEST_CASE("normal, beta and binomial deviates have the moments of their distributions", "[base]") {
    RandomSamples samples(RandomKey(5, 0, Stream::derivation), 1, 0);
    double sum = 0, squares = 0, beta = 0, tosses = 0;
    const int n = 100000;
    for (int i = 0; i < n; ++i) {
        const double x = samples.normal();
        sum += x;
        squares += x * x;
        beta += samples.beta(2, 3);
        tosses += samples.binomial(10, 0.3);
    }
    CHECK(std::abs(sum / n) < 0.012);
    CHECK(std::abs(squares / n - 1) < 0.02);
    CHECK(std::abs(beta / n - 0.4) < 0.003);
    CHECK(std::abs(tosses / n - 3) < 0.02);
}

TEST_CASE("beta deviates of tiny shapes lie at both ends, never beside them", "[base]") {
    // For shapes a = b -> 0 the distribution becomes two points of probability 1/2.
    int high = 0;
    for (std::uint64_t owner = 0; owner < 10'000; ++owner) {
        const double value = RandomSamples(RandomKey(1, 0, Stream::derivation), owner, 0).beta(1e-4, 1e-4);
        REQUIRE((value >= 0 && value <= 1));
        high += value > 0.5;
    }
    CHECK(std::abs(high - 5000) < 200);  // 4 standard deviations
}

TEST_CASE("samples of many owners at once are those of each alone", "[base]") {
    const RandomKey key(3, 4, Stream::derivation, 5);
    for (const std::size_t count : {0, 1, 7, 8, 9, 100}) {
        std::vector<std::uint64_t> owners, samples(count);
        for (std::size_t k = 0; k < count; ++k) owners.push_back(mix(k, count));
        first_samples(key, 0xFFFFFFFE, owners, samples.data());
        for (std::size_t k = 0; k < count; ++k) {
            REQUIRE(static_cast<double>(samples[k]) == 0x1p53 * RandomSamples(key, owners[k], 0xFFFFFFFE).uniform());
        }
        std::vector<std::uint32_t> numbers(count);
        for (std::size_t k = 0; k < count; ++k) numbers[k] = 0x80000000 + static_cast<std::uint32_t>(k * k);
        samples_of(key, 7, owners, numbers.data(), samples.data());
        for (std::size_t k = 0; k < count; ++k) {
            REQUIRE(static_cast<double>(samples[k]) == 0x1p53 * RandomSamples(key, owners[k], 7, numbers[k]).uniform());
        }
    }
}
