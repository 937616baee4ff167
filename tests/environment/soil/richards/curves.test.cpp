// A soil's curves, and the flux between two points of it.
#include "catch.h"
#include "environment/soil/hydraulics/bernoulli.h"
#include "environment/soil/hydraulics/texture_library.h"
#include "environment/soil/richards/column.h"
#include "environment/soil/richards/reference.h"

#include <cmath>

namespace espalier::test {
namespace {

const SoilKind sand{SoilKind::Model::van_genuchten, 0.045, 0.43, 0.15, 3, 1000, 0.5};
const SoilKind loam{SoilKind::Model::van_genuchten, 0.08, 0.43, 0.04, 1.6, 50, 0.5};
const SoilKind clay{SoilKind::Model::van_genuchten, 0.1, 0.4, 0.01, 1.1, 10, 0.5};
const SoilKind gardner{SoilKind::Model::gardner, 0.06, 0.4, 0.1, 1, 24, 0.5};
const SoilKind brooks_corey{SoilKind::Model::brooks_corey, 0.05, 0.4, 1 / 15.0, 0.6, 30, 0.5};

/// Heads from -0.002 cm to -1e5 cm, none of them a node of the table.
std::vector<double> heads() {
    std::vector<double> heads;
    for (double h = 0.00217; h < 1e5; h *= 1.0371) heads.push_back(-h);
    return heads;
}

/// Steady downward flow: the flux q for which dz = dh / (q / K - 1) adds up to the distance, by trying.
double steady_flow(const SoilHydraulics& soil, double upper, double lower, double distance) {
    const auto length = [&](double q) {  // in equal ratios of the head
        double z = 0;
        const int parts = 4000;
        for (int i = 0; i < parts; ++i) {
            const double from = lower * std::pow(upper / lower, double(i) / parts);
            const double to = lower * std::pow(upper / lower, double(i + 1) / parts);
            z += (to - from) / (q / soil.at(0.5 * (from + to)).conductivity - 1);
        }
        return z;
    };
    const bool down = upper > lower;
    double low = down ? soil.at(upper).conductivity : -1e5, high = down ? 1e5 : soil.at(upper).conductivity;
    for (int i = 0; i < 100; ++i) {
        const double q = 0.5 * (low + high);
        (down == (length(q) > distance) ? low : high) = q;
    }
    return low;
}

}  // namespace

TEST_CASE("the table of a soil's curves is the published formulae", "[environment][soil]") {
    for (const SoilKind& kind : {sand, loam, clay, gardner}) {
        const SoilHydraulics soil(kind);
        const ReferenceSoil printed{kind.residual, kind.saturated, kind.alpha, kind.n, kind.conductivity};
        for (const double h : heads()) {
            const SoilPoint at = soil.at(h);
            CHECK(
                at.content ==
                Approx(kind.residual + (kind.saturated - kind.residual) * effective_saturation(kind, h)).epsilon(1e-7));
            if (at.conductivity < 1e-25 * kind.conductivity) continue;
            CHECK(at.conductivity == Approx(conductivity(kind, h)).epsilon(1e-3));
            if (kind.model != SoilKind::Model::van_genuchten) continue;
            CHECK(effective_saturation(kind, h) == Approx(printed.saturation(h)).epsilon(1e-10));
            // The formula as printed loses its digits in dry soil.
            if (at.conductivity > 1e-9) CHECK(conductivity(kind, h) == Approx(printed.conductivity(h)).epsilon(1e-4));
            CHECK(at.capacity == Approx(printed.capacity(h)).epsilon(2e-3));
        }
    }
    // A clay with n = 1.1 conducts 5.6 cm/d at -1e-4 cm, and 10 when it is full.
    CHECK(conductivity(clay, -1e-4) == Approx(5.607).epsilon(1e-3));
    CHECK(SoilHydraulics(clay).at(0).conductivity == 10);
}

TEST_CASE("the matric flux potential is the integral of the conductivity, full or not", "[environment][soil]") {
    for (const SoilKind& kind : {sand, loam, clay, brooks_corey, gardner}) {
        const SoilHydraulics soil(kind);
        for (const double h : {-3000.0, -177.0, -16.0, -0.9}) {
            const double to = h / 2;
            double sum = 0;
            const int parts = 20000;
            for (int i = 0; i < parts; ++i) sum += conductivity(kind, h + (i + 0.5) / parts * (to - h));
            sum *= (to - h) / parts;
            if (sum < 1e-12) continue;
            CHECK(soil.at(to).potential - soil.at(h).potential == Approx(sum).epsilon(1e-4));
        }
        CHECK(soil.at(10).potential - soil.at(0).potential == Approx(10 * kind.conductivity));
    }
    CHECK(SoilHydraulics(gardner).at(-20).potential == Approx(24 * std::exp(-2.0) / 0.1).epsilon(1e-6));
}

TEST_CASE("a content has the head that has this content", "[environment][soil]") {
    for (const SoilKind& kind : {sand, loam, clay, gardner}) {
        const SoilHydraulics soil(kind);
        for (const double h : heads()) {
            const SoilPoint at = soil.at(h);
            if (at.content < kind.residual + 1e-9 || at.content > kind.saturated - 1e-9) continue;
            CHECK(soil.at(soil.head_at(at.content)).content == Approx(at.content).epsilon(1e-12));
            CHECK(soil.head_of_conductivity(at.conductivity) == Approx(h).epsilon(1e-6));
            // A guess changes how soon it is found, and nothing else.
            for (const double guess : {0.0, -1e-5, 0.99 * h, 1.3 * h, -77.0, -1e12}) {
                CHECK(soil.head_at(at.content, guess) == soil.head_at(at.content));
                CHECK(soil.head_of_conductivity(at.conductivity, guess) == soil.head_of_conductivity(at.conductivity));
            }
        }
        CHECK(soil.head_at(kind.saturated) == 0);
        CHECK(soil.head_at(0) < -9e8);
    }
}

TEST_CASE("an air-entry head leaves no overshoot in the table", "[environment][soil]") {
    const SoilHydraulics soil(brooks_corey);
    for (const double h : heads()) {
        CHECK(soil.at(h).content <= 0.4);
        CHECK(soil.at(h).content >= 0.05);
        CHECK(soil.at(h).capacity >= 0);
        CHECK(soil.at(h).slope >= 0);
    }
    CHECK(soil.at(-14.9).content == Approx(0.4).epsilon(1e-6));
    CHECK(soil.at(-30).content == Approx(0.05 + 0.35 * std::pow(0.5, 0.6)).epsilon(1e-6));
    CHECK(soil.at(-30).conductivity == Approx(30 * std::pow(0.5, 0.6 * 3 + 2)).epsilon(1e-5));
}

TEST_CASE("the library has the means of Carsel and Parrish and of Rosetta, and the classes of HYPRES",
          "[environment][soil]") {
    CHECK(texture_library().size() == 34);
    for (const NamedSoil& named : texture_library()) {
        const SoilHydraulics soil(named.soil);
        double before = named.soil.conductivity;
        for (const double h : heads()) {  // every one falls with suction
            CHECK(soil.at(h).conductivity <= before * (1 + 1e-12));
            before = soil.at(h).conductivity;
        }
    }
    CHECK(texture_library()[3].soil == SoilKind{SoilKind::Model::van_genuchten, 0.078, 0.43, 0.036, 1.56, 24.96, 0.5});
}

TEST_CASE("the function of Bernoulli and its inverse", "[environment][soil]") {
    CHECK(bernoulli(0).value == 1);
    for (double x = -90; x < 40; x += 0.317) {
        CHECK(bernoulli(x).value == Approx(x / std::expm1(x)).epsilon(1e-12));
        CHECK(inverse_bernoulli(bernoulli(x).value).value == Approx(x).epsilon(1e-8).margin(1e-8));
        const double slope = (bernoulli(x + 1e-5).value - bernoulli(x - 1e-5).value) / 2e-5;
        CHECK(bernoulli(x).slope == Approx(slope).epsilon(1e-5).margin(1e-9));
    }
}

TEST_CASE("nothing flows in hydrostatic soil, whatever the soil and the size of the voxels", "[environment][soil]") {
    for (const SoilKind& kind : {sand, loam, clay, gardner}) {
        const SoilHydraulics soil(kind);
        for (const double distance : {0.1, 1.0, 10.0, 50.0}) {
            for (const double h : {-800.0, -95.0, -31.0, -4.0, 3.0}) {
                const SoilPoint upper = soil.at(h - distance);
                CHECK(std::abs(flux_down(upper, soil.at(h), distance).flux) < 1e-6 * upper.conductivity);
            }
        }
    }
}

TEST_CASE("the flux between two points of a Gardner soil is that of steady flow between them", "[environment][soil]") {
    const SoilHydraulics soil(gardner);
    const auto exact = [&](double upper, double lower, double distance) {
        const double fall = std::exp(-0.1 * distance);
        return 24 * (std::exp(0.1 * upper) - std::exp(0.1 * lower) * fall) / (1 - fall);
    };
    for (const double distance : {0.5, 5.0, 20.0}) {
        for (const double upper : {-60.0, -25.0, -2.0}) {
            for (const double lower : {-70.0, -24.0, -1.0}) {
                const double flux = flux_down(soil.at(upper), soil.at(lower), distance).flux;
                CHECK(flux == Approx(exact(upper, lower, distance)).epsilon(1e-4));
            }
        }
    }
}

TEST_CASE("in voxels of one and ten centimetres the flux is near that of steady flow", "[environment][soil]") {
    // Arithmetic means are wrong by a factor of two and more on the same pairs.
    const SoilHydraulics soil(loam);
    for (const double distance : {1.0, 10.0}) {
        for (const auto& [upper, lower] :
             {std::pair{-10.0, -300.0}, {-100.0, -1000.0}, {-2.0, -40.0}, {-500.0, -50.0}}) {
            const double exact = steady_flow(soil, upper, lower, distance);
            CHECK(flux_down(soil.at(upper), soil.at(lower), distance).flux == Approx(exact).epsilon(0.12));
        }
    }
}

TEST_CASE("the flux changes with the heads as its derivatives say", "[environment][soil]") {
    for (const SoilKind& kind : {sand, loam, clay}) {
        const SoilHydraulics soil(kind);
        for (const double upper : {-900.0, -77.0, -13.0, -0.6, 4.0}) {
            for (const double lower : {-700.0, -60.0, -9.0, -0.3, 6.0}) {
                const SoilFlux flux = flux_down(soil.at(upper), soil.at(lower), 3);
                const auto change = [&](double by_upper, double by_lower) {
                    return flux_down(soil.at(upper + by_upper), soil.at(lower + by_lower), 3).flux;
                };
                const double du = 1e-5 * std::abs(upper), dl = 1e-5 * std::abs(lower);
                const double size = std::abs(flux.by_first) + std::abs(flux.by_second);
                CHECK(flux.by_first == Approx((change(du, 0) - change(-du, 0)) / (2 * du)).margin(2e-3 * size));
                CHECK(flux.by_second == Approx((change(0, dl) - change(0, -dl)) / (2 * dl)).margin(2e-3 * size));
            }
        }
    }
}

TEST_CASE("between two soils the same flux passes both halves", "[environment][soil]") {
    const SoilHydraulics above(loam), below(sand);
    for (const bool down : {true, false}) {
        for (const auto& [first, second] : {std::pair{-50.0, -200.0}, {-300.0, -20.0}, {-5.0, 3.0}}) {
            const SoilPoint a = above.at(first), b = below.at(second);
            const SoilFlux flux = flux_between_soils(above, a, below, b, 2, down);
            const auto half = [&](const SoilPoint& from, const SoilPoint& to) {
                return down ? flux_down(from, to, 1).flux : flux_across(from, to, 1).flux;
            };
            // The head at the border, found by trying.
            double low = -1e4, high = 1e3;
            for (int i = 0; i < 100; ++i) {
                const double h = 0.5 * (low + high);
                (half(a, above.at(h)) > half(below.at(h), b) ? low : high) = h;
            }
            CHECK(flux.flux == Approx(half(a, above.at(low))).epsilon(1e-6).margin(1e-9));
            CHECK(flux.by_first > 0);
            CHECK(flux.by_second < 0);
        }
    }
    // One soil on both sides: what flows without a border.
    const SoilPoint a = above.at(-50), b = above.at(-52);
    CHECK(flux_between_soils(above, a, above, b, 2, true).flux == Approx(flux_down(a, b, 2).flux).epsilon(1e-4));
}

}  // namespace espalier::test
