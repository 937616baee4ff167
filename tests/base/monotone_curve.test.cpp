#include "base/monotone_curve.h"

#include "catch.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

using namespace espalier;

TEST_CASE("a monotone curve goes through its values and stays between neighbours", "[base]") {
    const std::vector<double> values{0, 3, 3.1, -1, -1, 7};
    for (const bool closed : {false, true}) {
        for (std::size_t k = 0; k + 1 < values.size(); ++k) {
            CHECK(monotone_curve(values, double(k), closed) == Approx(values[k]));
            const auto [low, high] = std::minmax(values[k], values[k + 1]);
            double before = values[k];
            for (double t = 0.05; t < 1; t += 0.05) {
                const double y = monotone_curve(values, double(k) + t, closed);
                CHECK(y >= low - 1e-12);
                CHECK(y <= high + 1e-12);
                CHECK((y - before) * (values[k + 1] - values[k]) >= -1e-12);
                before = y;
            }
        }
    }
}

TEST_CASE("an open curve keeps to its ends, a closed one goes round", "[base]") {
    const std::vector<double> values{1, 2, 5, 3};
    CHECK(monotone_curve(values, -4, false) == 1);
    CHECK(monotone_curve(values, 9, false) == 3);
    CHECK(monotone_curve(values, 4, true) == 1);
    for (double x = 0; x < 4; x += 0.1) {
        CHECK(monotone_curve(values, x, true) == Approx(monotone_curve(values, x + 4, true)));
        CHECK(monotone_curve(values, x, true) == Approx(monotone_curve(values, x - 8, true)));
    }
}

TEST_CASE("straight lines and constants are reproduced", "[base]") {
    for (double x = 0; x <= 3; x += 0.125) {
        CHECK(monotone_curve(std::vector<double>{1, 3, 5, 7}, x, false) == Approx(1 + 2 * x));
        CHECK(monotone_curve(std::vector<double>{4}, x, false) == 4);
        CHECK(monotone_curve(std::vector<double>{4}, x, true) == 4);
        CHECK(monotone_curve(std::vector<double>{1, 7}, x / 3, false) == Approx(1 + 2 * x));
    }
    CHECK(monotone_curve({}, 1, true) == 0);
}

TEST_CASE("a monotone curve has no corners", "[base]") {
    const std::vector<double> values{0, 3, 3.1, -1, -1, 7};
    constexpr double h = 1e-6;
    for (int k = 0; k < 6; ++k) {
        const auto y = [&](double x) { return monotone_curve(values, k + x, true); };
        CHECK(std::abs((y(h) - y(0)) - (y(0) - y(-h))) / h < 1e-3);
    }
}

TEST_CASE("more values bring the curve nearer to the function they are taken from", "[base]") {
    double before = 10;
    for (const int count : {4, 8, 16, 32, 64}) {
        std::vector<double> values;
        for (int k = 0; k < count; ++k) values.push_back(std::sin(2 * std::numbers::pi * k / count + 0.3));
        double error = 0;
        for (double t = 0; t < 1; t += 0.001) {
            const double wanted = std::sin(2 * std::numbers::pi * t + 0.3);
            error = std::max(error, std::abs(monotone_curve(values, t * count, true) - wanted));
        }
        CHECK(error < before / 1.5);
        before = error;
    }
}
