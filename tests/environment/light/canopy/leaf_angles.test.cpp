#include "environment/light/canopy/leaf_angles.h"

#include "catch.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <functional>
#include <numbers>

using namespace espalier;
using namespace espalier::environment;

namespace {

using std::numbers::pi;

/// The mean over all leaves of |normal . direction|, one leaf after the other.
double by_leaves(const std::function<double(double)>& density, double zenith) {
    double sum = 0, weights = 0;
    for (int i = 0; i < 900; ++i) {
        const double inclination = (i + 0.5) / 900 * pi / 2, weight = density(inclination);
        for (int j = 0; j < 400; ++j) {
            const double round = (j + 0.5) / 400 * 2 * pi;
            const double cosine =
                std::sin(inclination) * std::cos(round) * std::sin(zenith) + std::cos(inclination) * std::cos(zenith);
            sum += weight * std::abs(cosine);
            weights += weight;
        }
    }
    return sum / weights;
}

}  // namespace

TEST_CASE("G of each distribution is the mean shadow of its leaves", "[canopy]") {
    const std::pair<const char*, std::function<double(double)>> distributions[] = {
        {"spherical", [](double a) { return std::sin(a); }},
        {"planophile", [](double a) { return 1 + std::cos(2 * a); }},
        {"erectophile", [](double a) { return 1 - std::cos(2 * a); }},
        {"plagiophile", [](double a) { return 1 - std::cos(4 * a); }},
        {"extremophile", [](double a) { return 1 + std::cos(4 * a); }},
        {"uniform", [](double) { return 1.0; }}};
    for (const auto& [name, density] : distributions) {
        INFO(name);
        for (const double zenith : {0.0, 0.35, 0.9, 1.3, 1.5}) {
            CHECK(LeafAngles(std::string(name)).projection(std::cos(zenith)) ==
                  Approx(by_leaves(density, zenith)).epsilon(1e-4));
        }
    }
    CHECK(LeafAngles(std::string("horizontal")).projection(0.3) == 0.3);
    CHECK(LeafAngles(std::string("vertical")).projection(0.6) == Approx(2 / pi * 0.8));
}

TEST_CASE("ellipsoidal leaves of ratio 1 are spherical; flat ones are horizontal, high ones vertical", "[canopy]") {
    for (const double cosine : {0.1, 0.5, 0.9}) {
        CHECK(LeafAngles(1.0).projection(cosine) == Approx(0.5));
        CHECK(LeafAngles(1.0001).projection(cosine) == Approx(0.5).epsilon(1e-3));
        CHECK(LeafAngles(0.9999).projection(cosine) == Approx(0.5).epsilon(1e-3));
        CHECK(LeafAngles(100.0).projection(cosine) == Approx(cosine).epsilon(0.01).margin(0.005));
        CHECK(LeafAngles(0.01).projection(cosine) == Approx(2 / pi * std::sqrt(1 - cosine * cosine)).epsilon(0.01));
    }
    // Every distribution's shadow, averaged over all directions, is half of its area (Cauchy).
    for (const double ratio : {0.4, 2.5}) {
        double mean = 0;
        for (int i = 0; i < 2000; ++i) mean += LeafAngles(ratio).projection((i + 0.5) / 2000) / 2000;
        CHECK(mean == Approx(0.5).epsilon(1e-5));
    }
}
