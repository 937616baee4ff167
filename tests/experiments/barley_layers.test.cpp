// Barley in layers of nitrate, after Drew 1975, with poor and rich soil as controls.
#include "catch.h"
#include "experiments/growth.h"

#include <glm/geometric.hpp>

#include <array>

using namespace espalier;

namespace {

constexpr int seeds = 6;

struct Layer {
    double laterals = 0, axes = 0;  ///< length, m
    int count = 0;                  ///< laterals that begin in it
};

/// Above, in and below the layer between 6 and 12 cm, which is rich in barley-layers.toml.
std::array<Layer, 3> layers_of(const std::string& scene, int seed) {
    SceneOptions options;
    options.seed = static_cast<std::uint64_t>(seed);
    const auto world = grown("environments/" + scene, options);
    std::array<Layer, 3> layers;
    std::vector<bool> begun;
    for (const Internode& internode : world->interpretation(0).geometry.internodes) {
        const double y = 0.5 * (internode.base.y + internode.tip.y);
        Layer& layer = layers[y > -0.06 ? 0 : y > -0.12 ? 1 : 2];
        const double length = glm::length(internode.tip - internode.base);
        const bool lateral = internode.base_radius < 0.0002;
        (lateral ? layer.laterals : layer.axes) += length;
        if (begun.size() <= internode.axis) begun.resize(internode.axis + 1);
        layer.count += lateral && !begun[internode.axis];
        begun[internode.axis] = true;
    }
    return layers;
}

}  // namespace

TEST_CASE("barley in layers: laterals in the layer rich in nitrate are more and longer than in poor soil", "[barley]") {
    for (int seed = 1; seed <= seeds; ++seed) {
        const auto patch = layers_of("barley-layers.toml", seed), poor = layers_of("barley-poor.toml", seed),
                   rich = layers_of("barley-rich.toml", seed);
        INFO("seed " << seed << ": middle layer " << patch[1].laterals << " m, poor " << poor[1].laterals << " m, rich "
                     << rich[1].laterals << " m; laterals " << patch[1].count << ", " << poor[1].count << ", "
                     << rich[1].count);
        CHECK(patch[1].laterals > 3 * poor[1].laterals);
        CHECK(patch[1].count > 1.5 * poor[1].count);
        CHECK(patch[1].laterals / patch[1].count > 1.5 * poor[1].laterals / poor[1].count);
        // As in soil that is rich everywhere, and above it as in poor soil but for laterals that cross: the response is
        // local.
        CHECK(patch[1].laterals == Approx(rich[1].laterals).epsilon(0.15));
        CHECK(patch[0].laterals < 1.35 * poor[0].laterals);
        CHECK(patch[0].axes + patch[1].axes + patch[2].axes ==
              Approx(poor[0].axes + poor[1].axes + poor[2].axes).epsilon(1e-9));
    }
}
