#include "geometry/sky/radiance.h"

#include "catch.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

using namespace espalier;
using namespace espalier::geometry;

namespace {

using std::numbers::pi;

glm::dvec3 at(double zenith, double round) {
    return {std::sin(zenith) * std::cos(round), std::cos(zenith), std::sin(zenith) * std::sin(round)};
}

/// The mean cosine of the zenith angle of the light on level ground, by a plain sum over 400 x 400 directions.
double mean_cosine(const SkyRadiance& sky) {
    double sum = 0, weighted = 0;
    for (int i = 0; i < 400; ++i) {
        for (int j = 0; j < 400; ++j) {
            const double zenith = (i + 0.5) / 400 * pi / 2;
            const double light = sky(at(zenith, (j + 0.5) / 400 * 2 * pi)) * std::sin(zenith) * std::cos(zenith);
            sum += light;
            weighted += light * std::cos(zenith);
        }
    }
    return weighted / sum;
}

}  // namespace

TEST_CASE("the parts of a sky make up its solid angle, and their cosines pi, however few they are", "[sky]") {
    for (const int rings : {1, 2, 5, 33}) {
        for (const int around : {3, 8, 17}) {
            double angle = 0, cosines = 0;
            glm::dvec3 sideways(0);
            for (const SkyPart& part : sky_parts(rings, around)) {
                angle += part.solid_angle;
                cosines += part.solid_angle * part.towards.y;
                sideways += part.solid_angle * glm::dvec3(part.towards.x, 0, part.towards.z);
                CHECK(glm::length(part.towards) == Approx(1));
            }
            CHECK(angle == Approx(2 * pi).epsilon(1e-12));
            CHECK(cosines == Approx(pi).epsilon(1e-12));
            CHECK(glm::length(sideways) < 1e-12);
        }
    }
}

TEST_CASE("an overcast sky is three times as bright above as at the horizon", "[sky]") {
    const SkyRadiance sky = SkyRadiance::overcast();
    CHECK(sky({0, 1, 0}) == Approx(3 * sky({1, 0, 0})));
    CHECK(SkyRadiance::uniform()({0, 1, 0}) == SkyRadiance::uniform()(at(1.3, 2)));
    // 7/9 of the light of an overcast sky comes with the brightness of a uniform one, of mean cosine 2/3 ...
    CHECK(mean_cosine(sky) == Approx((2.0 / 3 + 2 * 2.0 / 4) / (1 + 2 * 2.0 / 3)).epsilon(1e-4));
}

TEST_CASE("the skies of the CIE: type 5 is uniform, type 1 overcast, type 12 brightest about the sun", "[sky]") {
    const glm::dvec3 sun = at(0.7, 1.1);
    const SkyRadiance uniform = SkyRadiance::cie(5, sun), overcast = SkyRadiance::cie(1, sun),
                      clear = SkyRadiance::cie(12, sun);
    CHECK(uniform(at(0.2, 3)) == Approx(uniform(at(1.4, 0))));
    // Type 1 was fitted to the overcast sky of Moon & Spencer.
    for (const double zenith : {0.3, 0.7, 1.1}) {
        CHECK(overcast(at(zenith, 0)) / overcast({0, 1, 0}) == Approx((1 + 2 * std::cos(zenith)) / 3).margin(0.03));
    }
    CHECK(clear(sun) > 5 * clear(at(0.7, 1.1 + pi)));
    // ISO 15469 by hand: gradation 1 - exp(-0.32 / cos Z), indicatrix 1 + 10 (exp(-3 c) - exp(-1.5 pi)) + 0.45 cos^2 c.
    const double apart = std::acos(glm::dot(at(1.0, 0.2), sun));
    const double by_hand =
        (1 - std::exp(-0.32 / std::cos(1.0))) *
        (1 + 10 * (std::exp(-3 * apart) - std::exp(-1.5 * pi)) + 0.45 * std::pow(std::cos(apart), 2));
    CHECK(clear(at(1.0, 0.2)) == Approx(by_hand).epsilon(1e-12));
}

TEST_CASE("Perez' sky is his formula, and by the rise and the angle to the sun the same as by direction", "[sky]") {
    const glm::dvec3 sun = at(0.5, 4);
    const SkyRadiance sky = SkyRadiance::perez({-1.2, -0.5, 6, -2.5, 0.3}, sun);
    for (const glm::dvec3& towards : {at(0.1, 0), at(0.9, 2), at(1.4, 5)}) {
        const double apart = std::acos(glm::dot(towards, sun));
        const double by_hand = (1 - 1.2 * std::exp(-0.5 / towards.y)) *
                               (1 + 6 * std::exp(-2.5 * apart) + 0.3 * std::cos(apart) * std::cos(apart));
        CHECK(sky(towards) == Approx(by_hand).epsilon(1e-12));
        CHECK(sky.at(towards.y, apart) == Approx(by_hand).epsilon(1e-12));
    }
}

TEST_CASE("directions like a sunflower's seeds lie evenly: their mean and their moments are those of the sphere",
          "[sky]") {
    constexpr int count = 1000;
    glm::dvec3 mean(0), squares(0);
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 towards = sunflower_direction(i, 1 - (2 * i + 1.0) / count);
        CHECK(glm::length(towards) == Approx(1).epsilon(1e-14));
        mean += towards / double(count);
        squares += towards * towards / double(count);
    }
    CHECK(glm::length(mean) < 1e-3);
    for (int axis = 0; axis < 3; ++axis) CHECK(squares[axis] == Approx(1.0 / 3).margin(1e-3));
}

TEST_CASE("the windows of a sky's parts cover it, and have the light of their parts on level ground", "[sky]") {
    for (const double gradient : {0.0, 2.0}) {
        for (const int rings : {1, 5, 20}) {
            const std::vector<SkyPart> parts = sky_parts(rings, 8, gradient);
            const auto shares =
                shares_on_ground(gradient > 0 ? SkyRadiance::overcast() : SkyRadiance::uniform(), parts);
            double above = 1;
            for (std::size_t i = 0; i < parts.size(); ++i) {
                const SkyWindow& window = parts[i].window;
                if (i % 8 == 0) {
                    CHECK(window.highest == above);
                    above = window.lowest;
                }
                CHECK(window.lowest < parts[i].towards.y);
                CHECK(parts[i].towards.y < window.highest);
                constexpr int steps = 1000;
                double light = 0, across = 0;
                for (int k = 0; k < steps; ++k) {
                    const double width = (window.highest - window.lowest) / steps,
                                 y = window.lowest + (k + 0.5) * width;
                    light += (1 + gradient * y) * y * width / 8 / (0.5 + gradient / 3);
                    across += (1 + gradient * y) * width / 8 / (0.5 + gradient / 3);
                }
                CHECK(shares[i] == Approx(light).epsilon(1e-5));
                CHECK(window.mean_rise() == Approx(light / across).epsilon(1e-5));
                CHECK(window.rise_on_ground(0) == Approx(window.lowest).margin(1e-12));
                CHECK(window.rise_on_ground(1) == Approx(window.highest));
                CHECK(window.rise_across(1) == Approx(window.highest));
                const glm::dvec3 edge = window.direction(parts[i].towards, window.lowest, 0);
                CHECK(glm::length(edge) == Approx(1));
                CHECK(edge.y == window.lowest);
            }
            CHECK(above == 0);
        }
    }
}

TEST_CASE("the shares of 5 x 8 parts give the mean cosine of the light of a sky", "[sky]") {
    const glm::dvec3 sun = at(0.9, 2.2);
    for (const SkyRadiance& sky : {SkyRadiance::uniform(), SkyRadiance::overcast(), SkyRadiance::cie(12, sun)}) {
        const std::vector<SkyPart> parts = sky_parts(5, 8);
        const std::vector<double> shares = shares_on_ground(sky, parts);
        double sum = 0, cosine = 0;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            sum += shares[i];
            cosine += shares[i] * parts[i].towards.y;
        }
        CHECK(sum == Approx(1));
        CHECK(cosine == Approx(mean_cosine(sky)).epsilon(0.02));
    }
}
