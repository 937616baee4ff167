#include "environment/leaf/gas/photosynthesis.h"

#include "environment/leaf/gas/leaf_equations.h"

namespace espalier::environment::leaf {

double Response::at(double temperature) const {
    return Warmth<double>(temperature).of(*this);
}

Photosynthesis Photosynthesis::of_c4() {
    Photosynthesis leaf;
    leaf.pathway = Pathway::c4;
    leaf.carboxylation.at_25 = 60;
    leaf.electron_transport.at_25 = 400;
    leaf.respiration.at_25 = 0.6;
    leaf.quantum_yield = 0.425;  // of two photosystems, 15 % of photons being of no use
    leaf.curvature = 0.7;
    return leaf;
}

double electron_transport(const Photosynthesis& leaf, double photons, double temperature) {
    return electrons_of<double>(leaf, leaf.electron_transport.at(temperature), photons);
}

Limits limits_of(const Photosynthesis& leaf, double photons, double temperature, double pressure) {
    LeafInputs<double> in{};
    in.photons = photons;
    in.carboxylation = leaf.carboxylation.at_25;
    in.electron_transport = leaf.electron_transport.at_25;
    in.respiration = leaf.respiration.at_25;
    return leaf_limits<double>(leaf, in, temperature, pressure);
}

}  // namespace espalier::environment::leaf
