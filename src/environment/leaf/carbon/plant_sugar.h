// What a plant's internodes hold of sugar from step to step, by their identities.
#pragma once

#include "espalier/environment/environment_process.h"

#include "environment/leaf/carbon/sugar_transport.h"

#include <cstdint>
#include <map>
#include <vector>

namespace espalier::environment::carbon {

/// How wood holds and leads sugar.
struct SugarWays {
    double conductivity = 2000;  ///< of the cross-section of an internode, cm2/d
    double storage = 0.1;        ///< share of an internode's volume that holds sugar
};

/// The internodes of one plant as nodes, of which the first stands on none. A plant without internodes is one node.
struct SugarTree {
    std::vector<SugarNode> nodes;
    std::vector<std::uint32_t> internodes_of_module;  ///< node of each module's last internode, or `none`
    std::vector<std::uint64_t> identities;            ///< of each node; 0 for the plant itself

    static constexpr std::uint32_t none = 0xFFFFFFFF;
};

SugarTree sugar_tree(const PlantView& plant, const SugarWays& ways);
/// The whole plant as one node of 1 cm3.
SugarTree sugar_pool(const PlantView& plant);

/// Grams of carbon by identity; the seed's and what a plant without internodes holds stands at 0.
class PlantSugar {
public:
    explicit PlantSugar(double seed = 0) : grams_{{0, seed}} {}

    double total() const;
    /// Gives the nodes what their modules hold. A module that is gone leaves it to those that were born of it; what
    /// nobody inherits is returned.
    double put_into(SugarTree& tree, const PlantView& plant) const;
    void take_from(const SugarTree& tree, const std::vector<double>& concentrations);

    void save(std::ostream& out) const;
    void restore(std::istream& in);

private:
    std::map<std::uint64_t, double> grams_;
};

}  // namespace espalier::environment::carbon
