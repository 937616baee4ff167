#include "base/sobol.h"

#include "catch.h"

#include <array>
#include <cmath>
#include <set>

using namespace espalier;

TEST_CASE("2^k samples have one in each of 2^k intervals of every dimension, whatever the seed", "[sobol]") {
    for (const std::uint32_t seed : {0u, 1u, 77u, 0xFFFFFFFFu}) {
        for (const std::uint32_t count : {16u, 1024u}) {
            for (int dimension = 0; dimension < 4; ++dimension) {
                std::set<int> intervals;
                for (std::uint32_t i = 0; i < count; ++i) {
                    const double value = scrambled_sobol(3 * count + i, seed)[dimension];
                    REQUIRE(value >= 0);
                    REQUIRE(value < 1);
                    intervals.insert(int(value * count));
                }
                CHECK(intervals.size() == count);
            }
        }
    }
}

TEST_CASE("pairs of dimensions are stratified, too: 256 samples, one in each of 16 x 16 squares", "[sobol]") {
    std::set<int> squares;
    for (std::uint32_t i = 0; i < 256; ++i) {
        const auto sample = scrambled_sobol(i, 5);
        squares.insert(int(sample[0] * 16) * 16 + int(sample[1] * 16));
    }
    CHECK(squares.size() == 256);
}

TEST_CASE("the mean of a smooth function comes nearer than by independent samples", "[sobol]") {
    // x y z w has the mean 1/16 and the variance 1/81 - 1/256.
    constexpr std::uint32_t count = 4096;
    const double independent = std::sqrt((1.0 / 81 - 1.0 / 256) / count);
    double squares = 0;
    for (std::uint32_t seed = 100; seed < 116; ++seed) {
        double sum = 0;
        for (std::uint32_t i = 0; i < count; ++i) {
            const auto [x, y, z, w] = scrambled_sobol(i, seed);
            sum += x * y * z * w;
        }
        squares += std::pow(sum / count - 1.0 / 16, 2) / 16;
    }
    CHECK(std::sqrt(squares) < independent / 5);
}

TEST_CASE("samples are what they were: recorded runs keep their bytes", "[sobol]") {
    const auto units = [](std::uint32_t index, std::uint32_t seed) {
        std::array<std::uint32_t, 4> numbers{};
        const std::array<double, 4> sample = scrambled_sobol(index, seed);
        for (int d = 0; d < 4; ++d) numbers[d] = static_cast<std::uint32_t>(sample[d] * 0x1p32);
        return numbers;
    };
    CHECK(units(0, 0) == std::array{283523004u, 2696933460u, 2622420803u, 3442351960u});
    CHECK(units(77, 5) == std::array{1387451204u, 3676181717u, 3877521716u, 94405318u});
    CHECK(units(123456789, 0xDEADBEEF) == std::array{490428316u, 257182805u, 2846729497u, 563742728u});
    CHECK(units(0xFFFFFFFF, 0) == std::array{3552294605u, 3073691818u, 359961938u, 38740733u});
}
