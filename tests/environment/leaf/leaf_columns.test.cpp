// Leaves side by side against each alone, with every width of vectors that this processor has.
#include "environment/leaf/gas/leaf_columns.h"

#include "catch.h"
#include "environment/leaf/any_leaf.h"

#include <bit>
#include <vector>

using namespace espalier;
using namespace espalier::environment::leaf;

namespace {

/// Leaves of a kind that differ in all that they may differ in.
struct ManyLeaves {
    std::vector<double> photons, near_infrared, thermal, potential, v, jmax, rd, slope, width;
    std::vector<double> assimilation, transpiration, conductance, temperature, internal, deficit, sent, sloping,
        residual;

    ManyLeaves(AnyLeaf& any, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            const LeafLight light = any.light();
            photons.push_back(light.photons);
            near_infrared.push_back(light.near_infrared);
            thermal.push_back(light.thermal);
            potential.push_back(any.between(-8, 0));
            v.push_back(any.between(5, 150));
            jmax.push_back(any.between(10, 300));
            rd.push_back(any.between(0, 5));
            slope.push_back(any.between(1, 9));
            width.push_back(any.between(0.001, 0.3));
        }
        for (auto* of : {&assimilation, &transpiration, &conductance, &temperature, &internal, &deficit, &sent,
                         &sloping, &residual}) {
            of->assign(count, -1);
        }
    }
    LeafColumns columns() {
        return {photons.size(),     photons.data(),     near_infrared.data(), thermal.data(),
                potential.data(),   v.data(),           jmax.data(),          rd.data(),
                slope.data(),       width.data(),       assimilation.data(),  transpiration.data(),
                conductance.data(), temperature.data(), internal.data(),      deficit.data(),
                sent.data(),        sloping.data(),     residual.data()};
    }
    LeafKind own(LeafKind kind, std::size_t i) const {
        kind.photosynthesis.carboxylation.at_25 = v[i];
        kind.photosynthesis.electron_transport.at_25 = jmax[i];
        kind.photosynthesis.respiration.at_25 = rd[i];
        kind.stomata.slope = slope[i];
        kind.width = width[i];
        return kind;
    }
};

bool has_same_bits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

}  // namespace

TEST_CASE("leaves side by side have the bits of each alone, in vectors of any width", "[leaf][leaf-columns]") {
    AnyLeaf any(20261130);
    for (int round = 0; round < 60; ++round) {
        LeafKind kind = any.kind();
        if (round % 3 == 0) kind.stomata.sensitivity = 3;
        if (round % 7 == 0) kind.photosynthesis.phosphate_use = 6;
        const Air air = any.air();
        ManyLeaves leaves(any, std::size_t(1 + round));
        for (const SolveColumns solver : solvers_here()) {
            solver(kind, air, leaves.columns());
            for (std::size_t i = 0; i < leaves.v.size(); ++i) {
                const LeafKind own = leaves.own(kind, i);
                const LeafLight light{leaves.photons[i], leaves.near_infrared[i], leaves.thermal[i]};
                const SlopingExchange alone = sloping_gas_exchange(own, light, air, leaves.potential[i]);
                CHECK(has_same_bits(leaves.assimilation[i], alone.leaf.assimilation));
                CHECK(has_same_bits(leaves.transpiration[i], alone.leaf.transpiration));
                CHECK(has_same_bits(leaves.conductance[i], alone.leaf.conductance));
                CHECK(has_same_bits(leaves.temperature[i], alone.leaf.temperature));
                CHECK(has_same_bits(leaves.internal[i], alone.leaf.internal));
                CHECK(has_same_bits(leaves.deficit[i], alone.leaf.deficit));
                CHECK(has_same_bits(leaves.sent[i], alone.leaf.sent));
                CHECK(has_same_bits(leaves.sloping[i], alone.transpiration_by_potential));
                CHECK(leaves.residual[i] < 1e-10);
            }
        }
    }
}

TEST_CASE("one leaf of many that no air cools is named by its numbers", "[leaf][leaf-columns]") {
    AnyLeaf any(5);
    ManyLeaves leaves(any, 21);
    leaves.thermal[13] = 90000;
    CHECK_THROWS_WITH(solve({}, any.air(), leaves.columns()),
                      Catch::Contains("finds no temperature within 60 K") && Catch::Contains("W/m2"));
}
