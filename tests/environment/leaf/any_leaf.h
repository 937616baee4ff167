// Leaves, light and air by chance, the same on every machine for a seed.
#pragma once

#include "environment/leaf/gas/gas_exchange.h"

#include <random>

namespace espalier::environment::leaf {

/// Anything that a leaf may meet.
struct AnyLeaf {
    explicit AnyLeaf(unsigned seed) : random(seed) {}
    double between(double lowest, double highest) { return std::uniform_real_distribution<>(lowest, highest)(random); }
    LeafKind kind() {
        LeafKind leaf;
        const int form = static_cast<int>(between(0, 3));
        leaf.stomata.form = static_cast<Stomata::Form>(form);
        leaf.stomata.least = between(0, 1) < 0.3 ? 0 : between(0, 0.02);
        leaf.stomata.slope = form == 0 ? between(1, 7) : between(4, 12);
        if (between(0, 1) < 0.3) leaf.photosynthesis = Photosynthesis::of_c4();
        leaf.photosynthesis.carboxylation.at_25 = between(10, 120);
        leaf.width = between(0.002, 0.2);
        return leaf;
    }
    LeafLight light() { return {between(0, 1) < 0.1 ? 0 : between(0, 2200), between(0, 300), between(500, 1000)}; }
    Air air() {
        const double t = between(-5, 45);
        return {t, saturation_pressure(t) * between(0.05, 1), between(0.1, 8), between(150, 1050), between(70, 102)};
    }
    std::mt19937 random;
};

}  // namespace espalier::environment::leaf
