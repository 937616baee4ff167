#include "environment/light/canopy/medium.h"

#include "catch.h"

#include <glm/geometric.hpp>
#include <tbb/global_control.h>

#include <cmath>
#include <numeric>

using namespace espalier;
using namespace espalier::environment;

namespace {

glm::dvec3 from_zenith(double zenith, double round) {
    return {std::sin(zenith) * std::cos(round), std::cos(zenith), std::sin(zenith) * std::sin(round)};
}

/// Leaf area here and there, the same for the same number.
std::vector<double> scattered_leaves(std::size_t count) {
    std::vector<double> depth(count);
    for (std::size_t i = 0; i < count; ++i) depth[i] = (i * 2654435761u >> 7) % 3 ? 0 : double(i * 40503u % 97) / 10;
    return depth;
}

double met_by_voxels(const CanopyVoxels& voxels, std::span<const double> depth, const BeamLight& light) {
    double sum = 0;
    for (std::size_t v = 0; v < depth.size(); ++v) sum += depth[v] * light.flux[v];
    return sum * voxels.edge * voxels.edge * voxels.edge;
}

}  // namespace

TEST_CASE("an even periodic canopy lets exp(-depth / cos zenith) through, whatever its voxels", "[canopy]") {
    for (const double edge : {0.5, 0.3, 0.1}) {
        const int high = int(std::round(3 / edge));
        const CanopyVoxels voxels{{0, 0, 0}, {7, high, 4}, edge, true};
        const std::vector<double> depth(voxels.count(), 0.5f);
        for (const double zenith : {0.0, 0.3, 0.8, 1.2, 1.45}) {
            const BeamLight light = send_beams(voxels, depth, from_zenith(zenith, 0.4), 2);
            const double exact = std::exp(-0.5 * high * edge / std::cos(zenith));
            CHECK(light.passed == Approx(exact).epsilon(1e-6).margin(1e-9));
            // Each layer meets what the layer takes away.
            const double k = 0.5 * edge / std::cos(zenith);
            for (int y = 0; y < high; ++y) {
                const double above = std::exp(-k * (high - 1 - y));
                const std::size_t v = std::size_t(y) * 7;
                CHECK(light.flux[v] == Approx(above * (1 - std::exp(-k)) / k).epsilon(1e-6).margin(1e-9));
            }
        }
    }
}

TEST_CASE("what leaves meet is what the beams lose", "[canopy]") {
    for (const bool periodic : {false, true}) {
        const CanopyVoxels voxels{{-3, 0.5, 2}, {9, 6, 5}, 0.4, periodic};
        const std::vector<double> depth = scattered_leaves(voxels.count());
        for (const double zenith : {0.0, 0.5, 1.2, 1.5}) {
            for (const double round : {0.0, 1.0, 3.7}) {
                const BeamLight light = send_beams(voxels, depth, from_zenith(zenith, round), 3);
                CHECK(met_by_voxels(voxels, depth, light) == Approx(light.met).epsilon(1e-8));
                CHECK(light.passed >= 0);
                CHECK(light.passed < 1);
            }
        }
    }
}

TEST_CASE("few leaves meet all of the light, in every voxel and from every side", "[canopy]") {
    const CanopyVoxels voxels{{0, 0, 0}, {5, 4, 6}, 0.25, false};
    const std::vector<double> depth(voxels.count(), 1e-6f);
    for (const double zenith : {0.2, 0.9, 1.5}) {
        for (const double round : {0.1, 2.0, 4.0}) {
            for (const double flux : send_beams(voxels, depth, from_zenith(zenith, round), 1).flux) {
                CHECK(flux == Approx(1).epsilon(1e-5));
            }
        }
    }
}

TEST_CASE("a single voxel of leaves shades the voxel behind it and no other", "[canopy]") {
    const CanopyVoxels voxels{{0, 0, 0}, {3, 4, 3}, 1, false};
    std::vector<double> depth(voxels.count(), 0);
    const std::size_t dense = voxels.number_of({1.5, 2.5, 1.5});
    depth[dense] = 2;
    const BeamLight light = send_beams(voxels, depth, {0, 1, 0}, 2);
    CHECK(light.flux[voxels.number_of({1.5, 0.5, 1.5})] == Approx(std::exp(-2)));
    CHECK(light.flux[dense] == Approx((1 - std::exp(-2)) / 2));
    CHECK(light.flux[voxels.number_of({0.5, 0.5, 1.5})] == Approx(1));
    CHECK(light.flux[voxels.number_of({1.5, 3.5, 1.5})] == Approx(1));
    CHECK(light.met == Approx(1 - std::exp(-2)));
}

TEST_CASE("beams leave the same light with one thread and with many", "[canopy]") {
    const CanopyVoxels voxels{{0, 0, 0}, {20, 15, 18}, 0.2, true};
    const std::vector<double> depth = scattered_leaves(voxels.count());
    const auto sent = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return send_beams(voxels, depth, from_zenith(0.9, 0.5), 2);
    };
    CHECK(sent(1).flux == sent(8).flux);
    CHECK(sent(1).passed == sent(8).passed);
}

TEST_CASE("a line of more voxels than are passed at once, thick and thin, keeps exp(-depth) of each beam", "[canopy]") {
    for (const int length : {63, 64, 65, 150}) {
        const CanopyVoxels voxels{{0, 0, 0}, {length, 2, 1}, 0.5, true};
        std::vector<double> depth(voxels.count());
        for (std::size_t v = 0; v < depth.size(); ++v)
            depth[v] = std::pow(10.0, double(v * 7 % 15) - 12);  // to 100 / m
        const BeamLight light = send_beams(voxels, depth, {0, 1, 0}, 1);
        for (std::size_t x = 0; x < std::size_t(length); ++x) {
            const double upper = 0.5 * depth[std::size_t(length) + x], lower = 0.5 * depth[x];
            CHECK(light.flux[std::size_t(length) + x] == Approx(-std::expm1(-upper) / upper).epsilon(1e-10));
            CHECK(light.flux[x] == Approx(std::exp(-upper) * -std::expm1(-lower) / lower).epsilon(1e-10).margin(1e-15));
            CHECK(light.arrived[x] == Approx(std::exp(-upper - lower)).epsilon(1e-10).margin(1e-15));
        }
    }
}

TEST_CASE("light from straight above, along faces and through edges of voxels crosses all of them once", "[canopy]") {
    const CanopyVoxels voxels{{0, 0, 0}, {4, 4, 4}, 1, true};
    const std::vector<double> depth(voxels.count(), 1);
    for (const glm::dvec3& towards :
         {glm::dvec3(0, 1, 0), glm::dvec3(1, 1, 0), glm::dvec3(-1, 1, 1), glm::dvec3(0, 2, -1)}) {
        const glm::dvec3 unit = glm::normalize(towards);
        CHECK(send_beams(voxels, depth, unit, 1).passed == Approx(std::exp(-4 / unit.y)).epsilon(1e-6));
    }
}
