// The leaf against published figures, against a slow reference of its own, and against its own equations.
#include "environment/leaf/gas/gas_exchange.h"

#include "catch.h"
#include "environment/leaf/any_leaf.h"
#include "environment/leaf/gas/reference_evaporation.h"

#include <cmath>
#include <numbers>

using namespace espalier;
using namespace espalier::environment::leaf;

namespace {

const Air summer{25, 0.6 * saturation_pressure(25), 1.5, 400, sea_level};
const LeafLight noon{1200, 120, 790};

/// Net assimilation at a Ci as the papers write it, for C3 at sea level.
double farquhar(double v, double jmax, double rd, double q, double ci, double celsius) {
    const double t = celsius + 273.15, r = 8.314462618e-3;
    const auto k = [&](double k25, double ha) { return k25 * std::exp(ha * (t - 298.15) / (298.15 * r * t)); };
    const double gamma = k(42.75, 37.83), kc = k(404.9, 79.43), ko = k(278.4, 36.38);
    const double jm = k(jmax, 43.54), sum = 0.24 * q + jm;
    const double j = (sum - std::sqrt(sum * sum - 4 * 0.85 * 0.24 * q * jm)) / (2 * 0.85);
    const double ac = k(v, 65.33) * (ci - gamma) / (ci + kc * (1 + 210 / ko));
    const double aj = j / 4 * (ci - gamma) / (ci + 2 * gamma);
    return std::min(ac, aj) - k(rd, 46.39);
}

/// Halves an interval until nothing is left of it; `f` falls.
template <class Function>
double bisected(double lower, double upper, const Function& f) {
    for (int step = 0; step < 200; ++step) {
        const double middle = (lower + upper) / 2;
        (f(middle) > 0 ? lower : upper) = middle;
    }
    return (lower + upper) / 2;
}

}  // namespace

TEST_CASE("photosynthesis at 25 degrees has its published rates", "[leaf]") {
    const Limits limits = limits_of({}, 1500, 25);
    CHECK(limits.limits[0].at(280) == Approx(16.6862).margin(5e-5));
    CHECK(limits.limits[1].at(280) == Approx(20.1611).margin(5e-5));
    for (const double ci : {60.0, 150.0, 280.0, 700.0}) {
        for (const double t : {8.0, 25.0, 36.5}) {
            for (const double q : {50.0, 600.0, 1900.0}) {
                const double expected = farquhar(78.5, 150, 2.12, q, ci, t);
                CHECK(limits_of({}, q, t).at(ci) == Approx(expected).epsilon(1e-9));
            }
        }
    }
}

TEST_CASE("triose phosphates limit a leaf, and deactivation gives its rates a peak", "[leaf]") {
    Photosynthesis leaf;
    leaf.phosphate_use = 5;
    CHECK(limits_of(leaf, 2000, 25).at(900) == Approx(3 * 5 - 2.12));
    leaf.carboxylation.deactivation = 200e3;
    leaf.carboxylation.entropy = 640;
    CHECK(leaf.carboxylation.at(25) == Approx(78.5));
    CHECK(leaf.carboxylation.at(32) > leaf.carboxylation.at(25));
    CHECK(leaf.carboxylation.at(45) < leaf.carboxylation.at(32));
}

TEST_CASE("a leaf in a summer's noon finds its published state", "[leaf]") {
    const GasExchange found = gas_exchange({}, noon, summer);
    CHECK(found.temperature == Approx(26.3609).margin(5e-5));
    CHECK(found.assimilation == Approx(18.0243).margin(5e-5));
    CHECK(found.conductance == Approx(0.35923).margin(5e-6));
    CHECK(found.transpiration * 1000 == Approx(4.12193).margin(1e-5));
    CHECK(found.internal == Approx(297.814).margin(1e-3));
}

TEST_CASE("a C3 leaf is where nested bisections find it", "[leaf]") {
    AnyLeaf chance(7);
    for (int i = 0; i < 40; ++i) {
        const LeafLight light{chance.between(100, 2000), chance.between(20, 300), chance.between(600, 900)};
        Air air = summer;
        air.temperature = chance.between(10, 35);
        air.vapour_pressure = saturation_pressure(air.temperature) * chance.between(0.3, 0.8);
        LeafKind leaf;
        leaf.stomata.least = 0.01;
        const double gv = 1.4 * 0.147 * std::sqrt(air.wind / leaf.width),
                     gh = 1.4 * 0.135 * std::sqrt(air.wind / leaf.width);
        const auto vapour = [&](double t) { return saturation_pressure(t) - air.vapour_pressure; };
        const auto transpired = [&](double g, double t) { return vapour(t) / air.pressure / (1 / g + 1 / gv); };
        const auto temperature = [&](double g) {
            return bisected(air.temperature - 30, air.temperature + 30, [&](double t) {
                return light.photons / 4.57 + light.near_infrared + 0.97 * light.thermal -
                       2 * 0.97 * 5.670374419e-8 * std::pow(t + 273.15, 4) - 2 * gh * 29.3 * (t - air.temperature) -
                       (2.501e6 - 2370 * t) * 0.018015 * transpired(g, t);
            });
        };
        const auto rate = [&](double g, double t) {
            const double gc = 1 / (1.6 / g + 1.37 / gv);
            return bisected(-20, 80, [&](double a) {
                return farquhar(78.5, 150, 2.12, light.photons, air.carbon_dioxide - a / gc, t) - a;
            });
        };
        const double g = bisected(0.01, 5, [&](double trial) {
            const double t = temperature(trial), a = rate(trial, t), cs = air.carbon_dioxide - a * 1.37 / gv;
            const double deficit = transpired(trial, t) * air.pressure / trial;
            return 0.01 + (a > 0 ? 1.6 * (1 + 4 / std::sqrt(deficit)) * a / cs : 0) - trial;
        });
        const GasExchange found = gas_exchange(leaf, light, air);
        CHECK(found.conductance == Approx(g).epsilon(1e-8));
        CHECK(found.temperature == Approx(temperature(g)).epsilon(1e-8));
        CHECK(found.assimilation == Approx(rate(g, temperature(g))).epsilon(1e-7));
    }
}

TEST_CASE("all four equations hold for any leaf in any air", "[leaf]") {
    AnyLeaf chance(20261129);
    double worst = 0;
    for (int i = 0; i < 20000; ++i) {
        const LeafKind leaf = chance.kind();
        const LeafLight light = chance.light();
        const Air air = chance.air();
        const double potential = chance.between(-4, 0);
        const GasExchange found = gas_exchange(leaf, light, air, potential);
        worst = std::max(worst, residuals_of(found, leaf, light, air, potential).largest());
    }
    CHECK(worst < 1e-10);
}

TEST_CASE("a leaf in the dark breathes, and is as open as its least conductance", "[leaf]") {
    LeafKind leaf;
    leaf.stomata.least = 0.01;
    const GasExchange found = gas_exchange(leaf, {0, 0, 720}, summer);
    CHECK(found.conductance == 0.01);
    CHECK(found.assimilation == Approx(-leaf.photosynthesis.respiration.at(found.temperature)));
    leaf.stomata.least = 0;
    const GasExchange closed = gas_exchange(leaf, {0, 0, 720}, summer);
    CHECK(closed.transpiration == 0);
    CHECK(closed.latent == 0);
}

// In dim light the largest root of the equations without their maximum lies below the least conductance.
TEST_CASE("in dim light stomata stay at their least conductance", "[leaf]") {
    LeafKind leaf;
    leaf.stomata.least = 0.02;
    for (const double photons : {5.0, 15.0, 25.0}) {
        const GasExchange found = gas_exchange(leaf, {photons, 1, 760}, summer);
        CHECK(found.conductance >= 0.02);
        CHECK(residuals_of(found, leaf, {photons, 1, 760}, summer).largest() < 1e-10);
    }
}

TEST_CASE("stomata close where the leaf dries, by the published curve", "[leaf]") {
    LeafKind leaf;
    leaf.stomata.sensitivity = 3.2;
    leaf.stomata.reference = -1.9;
    CHECK(leaf.stomata.by_potential(0) == Approx(1));
    CHECK(leaf.stomata.by_potential(-1.9) == Approx((1 + std::exp(-3.2 * 1.9)) / 2));
    double before = 1;
    for (double potential = 0; potential > -5; potential -= 0.25) {
        const double now = gas_exchange(leaf, noon, summer, potential).transpiration;
        CHECK((now < before || now == 0));
        before = now;
    }
    CHECK(before == 0);  // what is left of the slope opens no leaf
}

TEST_CASE("a shut, dry leaf has the temperature at which it sends and warms the air alone", "[leaf]") {
    LeafKind leaf;
    leaf.stomata.slope = 0;
    leaf.stomata.least = 0;
    leaf.photosynthesis.carboxylation.at_25 = 1e-9;
    const GasExchange found = gas_exchange(leaf, noon, summer);
    const double heat = 1.4 * 0.135 * std::sqrt(1.5 / 0.05);
    const double expected = bisected(0, 80, [&](double t) {
        return 1200 / 4.57 + 120 + 0.97 * 790 - 2 * 0.97 * 5.670374419e-8 * std::pow(t + 273.15, 4) -
               2 * heat * 29.3 * (t - 25);
    });
    CHECK(found.temperature == Approx(expected).epsilon(1e-9));
}

// A leaf of maize saturates at low carbon dioxide, and keeps its stomata more shut than one of wheat.
TEST_CASE("a C4 leaf takes more carbon for its water", "[leaf]") {
    LeafKind c3, c4;
    c4.photosynthesis = Photosynthesis::of_c4();
    c4.stomata.slope = 1.6;
    const Limits limits = limits_of(c4.photosynthesis, 1500, 25);
    CHECK(limits.at(150) == Approx(limits.at(400)).epsilon(0.01));
    const GasExchange of_c3 = gas_exchange(c3, noon, summer), of_c4 = gas_exchange(c4, noon, summer);
    CHECK(of_c4.assimilation / of_c4.transpiration > 1.5 * of_c3.assimilation / of_c3.transpiration);
}

// Photosynthesis is concave in light: a mean of light gives more than the mean of what it gives.
TEST_CASE("a day's mean of light overrates a clear day", "[leaf]") {
    double hourly = 0;
    for (int hour = 0; hour < 12; ++hour) {
        const double photons = 1800 * std::sin(std::numbers::pi * (hour + 0.5) / 12);
        hourly += gas_exchange_at({}, {photons, 0, 790}, summer, 25).assimilation / 12;
    }
    const double mean = gas_exchange_at({}, {1800 * 2 / std::numbers::pi, 0, 790}, summer, 25).assimilation;
    CHECK(mean / hourly > 1.1);
    CHECK(mean / hourly < 1.3);
}

TEST_CASE("FAO-56: the lawn of Brussels on 6 July", "[leaf]") {
    const ReferenceEvaporation lawn = reference_evaporation({21.5, 12.3, 1.409, 2.078, 9.25, 50.80, 100, 187, {}});
    CHECK(lawn.net_radiation == Approx(13.28).margin(0.05));
    CHECK(lawn.evaporation == Approx(3.88).margin(0.01));
}

TEST_CASE("a leaf that no air cools is refused by its numbers", "[leaf]") {
    Air still = summer;
    still.wind = 1e-9;
    CHECK_THROWS_WITH(gas_exchange({}, {9000, 9000, 3000}, still), Catch::Contains("finds no temperature within 60 K"));
}
