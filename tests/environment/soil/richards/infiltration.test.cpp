// Water that enters soil: exact solutions, travelling waves, a fine reference.
#include "catch.h"
#include "environment/soil/richards/column.h"
#include "environment/soil/richards/reference.h"

#include <cmath>
#include <numbers>

namespace espalier::test {
namespace {

/// Srivastava & Yeh (1991, equations 8 to 11): K / Ks at z cm over the water table and t hours after the flux changed.
double srivastava_yeh(double z, double hours) {
    const double alpha = 0.1, ks = 1, before = 0.1, after = 0.9;
    const double height = alpha * z, whole = alpha * 100, time = alpha * ks * hours / 0.34;
    double sum = 0;
    for (int i = 1; i <= 300; ++i) {  // tan(whole x) + 2 x = 0
        double low = (i - 0.5) * std::numbers::pi / whole + 1e-12, high = i * std::numbers::pi / whole;
        for (int k = 0; k < 100; ++k) {
            const double x = 0.5 * (low + high);
            (std::tan(whole * x) + 2 * x < 0 ? low : high) = x;
        }
        const double root = low;
        sum += std::sin(root * height) * std::sin(root * whole) * std::exp(-root * root * time) /
               (1 + whole / 2 + 2 * root * root * whole);
    }
    return after - (after - 1) * std::exp(-height) -
           4 * (after - before) * std::exp((whole - height) / 2 - time / 4) * sum;
}

double exact_head(double z, double hours) {
    return std::log(srivastava_yeh(z, hours)) / 0.1;
}

SoilBlock srivastava_column(double voxel, double accuracy) {
    return SoilBlock(
        column_of(1, voxel,
                  fmt::format("soil = {{ model = \"gardner\", theta_r = 0.06, theta_s = 0.40, alpha = 0.1, ks = 24 }}\n"
                              "boundaries = {{ top = {{ flux = 24 }}, bottom = {{ head = 0 }} }}\naccuracy = {}",
                              accuracy)));
}

/// The largest error of the head above the table, cm, five hours after the flux has changed from 0.1 to 0.9 cm/h.
double error_of_srivastava(double voxel, double accuracy) {
    SoilBlock column = srivastava_column(voxel, accuracy);
    column.advance(300);
    column.parameters.surface.flux.set(216);
    column.advance(5.0 / 24);
    double worst = 0;
    for (int y = 0; y < column.height(); ++y) {
        worst = std::max(worst, std::abs(column.head(y) - exact_head(100 - column.depth(y), 5)));
    }
    return worst;
}

double speed_of_front(const std::string& soil, double voxel, double first, double second) {
    SoilBlock column(column_of(2, voxel,
                               "soil = " + soil +
                                   "\ninitial = { head = -400 }\n"
                                   "boundaries = { top = { rain = 1000 }, bottom = \"free-drainage\" }"));
    const SoilHydraulics& kind = column.layout.kind(column.grid.cell({0, 0, 0}));
    column.advance(first);
    const double middle = 0.5 * (kind.at(-400).content + column.content(column.height() - 1));
    const double before = column.front(middle);
    column.advance(second - first);
    return (column.front(middle) - before) / (second - first);
}

}  // namespace

TEST_CASE("the exact solution of Srivastava and Yeh has its published value", "[environment][soil]") {
    CHECK(exact_head(60, 5) == Approx(-19.544).epsilon(2e-5));
    CHECK(srivastava_yeh(60, 1e-4) == Approx(0.1 + 0.9 * std::exp(-6.0)).epsilon(1e-4));
}

TEST_CASE("a transient in a Gardner soil is the exact solution to a thousandth", "[environment][soil]") {
    SoilBlock column = srivastava_column(0.01, 0.0002);
    column.advance(300);
    for (const double depth : {10.0, 50.0, 90.0}) {
        CHECK(column.head_at_depth(depth) == Approx(exact_head(100 - depth, 1e-4)).epsilon(5e-4));
    }
    column.parameters.surface.flux.set(216);
    for (const double hours : {1.0, 2.5, 5.0, 10.0, 30.0}) {
        column.advance(hours / 24 - (column.soil.day() - 300));
        for (const double depth : {5.0, 23.0, 40.0, 71.0, 96.0}) {
            CHECK(column.head_at_depth(depth) == Approx(exact_head(100 - depth, hours)).epsilon(1e-3).margin(0.004));
        }
    }
}

TEST_CASE("the error falls with the second power of the voxel and the first of the accuracy", "[environment][soil]") {
    const double coarse = error_of_srivastava(0.1, 2e-5), middle = error_of_srivastava(0.05, 2e-5),
                 fine = error_of_srivastava(0.025, 2e-5);
    CHECK(std::log2(coarse / middle) > 1.6);
    CHECK(std::log2(middle / fine) > 1.6);
    CHECK(error_of_srivastava(0.01, 0.004) / error_of_srivastava(0.01, 0.0002) > 4);
}

TEST_CASE("a front into loam travels at the speed of its shape", "[environment][soil]") {
    // Vanderborght et al. (2005): (K+ - K-) / (theta+ - theta-).
    const SoilHydraulics loam({SoilKind::Model::van_genuchten, 0.08, 0.43, 0.04, 1.6, 50, 0.5});
    const double speed = (50 - loam.at(-400).conductivity) / (0.43 - loam.at(-400).content);
    CHECK(speed == Approx(176.07).epsilon(1e-4));
    CHECK(speed_of_front(test_loam, 0.02, 0.5, 0.8) == Approx(speed).epsilon(0.01));
    CHECK(speed_of_front(test_loam, 0.1, 0.5, 0.8) == Approx(speed).epsilon(0.03));
}

TEST_CASE("sand takes all of the rain, clay ponds: both fronts have their speed", "[environment][soil]") {
    const SoilHydraulics sand({SoilKind::Model::van_genuchten, 0.045, 0.43, 0.15, 3, 1000, 0.5});
    const SoilPoint dry = sand.at(-400), wet = sand.at(sand.head_of_conductivity(100));
    const double speed = (100 - dry.conductivity) / (wet.content - dry.content);
    for (const double voxel : {0.01, 0.05}) {
        CHECK(speed_of_front(test_sand, voxel, 0.1, 0.35) == Approx(speed).epsilon(0.01));
    }
    const SoilHydraulics clay({SoilKind::Model::van_genuchten, 0.1, 0.4, 0.01, 1.1, 10, 0.5});
    const double slow = (10 - clay.at(-400).conductivity) / (0.4 - clay.at(-400).content);
    CHECK(speed_of_front(test_clay, 0.02, 0.4, 0.5) == Approx(slow).epsilon(0.06));
}

TEST_CASE("fronts into other textures of the library have their speed, whatever the voxels", "[environment][soil]") {
    struct Texture {
        const char* name;
        SoilKind kind;
        double first, second;
    };
    using enum SoilKind::Model;
    const Texture textures[] = {{"sandy loam", {van_genuchten, 0.065, 0.41, 0.075, 1.89, 106.1, 0.5}, 0.1, 0.4},
                                {"sandy clay loam", {van_genuchten, 0.1, 0.39, 0.059, 1.48, 31.44, 0.5}, 0.3, 0.8},
                                {"silt loam", {van_genuchten, 0.067, 0.45, 0.02, 1.41, 10.8, 0.5}, 0.8, 1.6}};
    for (const Texture& texture : textures) {
        const SoilHydraulics soil(texture.kind);
        const double flux = std::min(100.0, texture.kind.conductivity);
        const double wet = flux < 100 ? texture.kind.saturated : soil.at(soil.head_of_conductivity(flux)).content;
        const double speed = (flux - soil.at(-400).conductivity) / (wet - soil.at(-400).content);
        for (const double voxel : {0.015, 0.04}) {
            const double measured =
                speed_of_front(fmt::format("\"{}\"", texture.name), voxel, texture.first, texture.second);
            INFO(texture.name << ", voxels of " << voxel << " m: " << measured << " cm/d, expected " << speed);
            CHECK(measured == Approx(speed).epsilon(0.005));
        }
    }
}

TEST_CASE("the front in loam is as wide as its travelling wave", "[environment][soil]") {
    const SoilHydraulics loam({SoilKind::Model::van_genuchten, 0.08, 0.43, 0.04, 1.6, 50, 0.5});
    const SoilPoint dry = loam.at(-400);
    const double speed = (50 - dry.conductivity) / (0.43 - dry.content);
    const auto head_of = [&](double part) { return loam.head_at(dry.content + part * (0.43 - dry.content)); };
    // dz = K dh / (speed (theta - theta-) - (K - K-)), from nine tenths to one tenth of the rise.
    double width = 0;
    const double from = head_of(0.9), to = head_of(0.1);
    for (int i = 0; i < 4000; ++i) {
        const SoilPoint at = loam.at(from + (i + 0.5) / 4000 * (to - from));
        width += (from - to) / 4000 * at.conductivity /
                 (speed * (at.content - dry.content) - (at.conductivity - dry.conductivity));
    }
    SoilBlock column(column_of(2, 0.01,
                               "soil = " + test_loam +
                                   "\ninitial = { head = -400 }\n"
                                   "boundaries = { top = { head = 0 }, bottom = \"free-drainage\" }"));
    column.advance(0.6);
    const auto depth_of = [&](double part) { return column.front(dry.content + part * (0.43 - dry.content)); };
    // Half a voxel.
    CHECK(depth_of(0.1) - depth_of(0.9) == Approx(width).margin(0.5));
}

TEST_CASE("Celia's column is as a fine reference has it", "[environment][soil]") {
    ReferenceColumn reference({0.102, 0.368, 0.0335, 2, 796.608}, 100, 200, -1000);
    reference.top_head = -75;
    reference.bottom_head = -1000;
    reference.advance(1, 800);
    SoilBlock column(column_of(
        1, 0.02,
        "soil = { theta_r = 0.102, theta_s = 0.368, alpha = 0.0335, n = 2, ks = 796.608 }\ninitial = { head = -1000 }\n"
        "boundaries = { top = { head = -75 }, bottom = { head = -1000 } }"));
    column.advance(1);
    CHECK(column.flown().top == Approx(reference.passed).epsilon(0.01));
    for (const double depth : {10.0, 20.0, 30.0, 40.0}) {
        CHECK(column.head_at_depth(depth) == Approx(reference.h[static_cast<std::size_t>(2 * depth)]).epsilon(0.01));
    }
    CHECK(column.front(0.15) == Approx(48.0).epsilon(0.1));
    CHECK(std::abs(column.soil.balance().relative_error()) < 1e-12);
}

}  // namespace espalier::test
