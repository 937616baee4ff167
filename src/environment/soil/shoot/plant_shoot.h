// The shoot of one plant: its internodes above the soil and its leaves as a network of water.
#pragma once

#include "espalier/environment/environment_process.h"

#include "environment/leaf/gas/leaf_water.h"
#include "environment/soil/roots/collar.h"
#include "environment/soil/shoot/parameters.h"
#include "environment/soil/shoot/shoot_network.h"

#include <iosfwd>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace espalier::environment {

/// What organs hold of water from step to step, by their identities: their pressure heads, cm.
using StoredHeads = std::map<std::uint64_t, double>;

/// The nodes of a plant, and the modules that they are.
struct ShootTree {
    std::vector<ShootNode> nodes;  ///< internodes as they are drawn, then leaves
    std::vector<std::uint32_t> modules;
    std::vector<std::uint64_t> identities;
    std::vector<std::uint32_t> rows_of_internodes;  ///< of the drawing; ShootNode::collar: in the soil
    std::size_t modules_in_string = 0;
};

/// Of the internodes whose middles are above `soil_surface`, m, and of leaves that stand on them or on the collar.
ShootTree shoot_tree(const PlantView& plant, std::span<const DrawingLeaf> leaves, double soil_surface,
                     const ShootKind& kind);

/// The shoot during a step, solved with the roots that bear it.
class PlantShoot final : public CollarEnd {
public:
    /// `held`: what organs held at the end of the step before; new ones begin as what bears them.
    PlantShoot(std::uint32_t plant, ShootTree tree, double collar_height, LeafWater& leaves, const StoredHeads& held);

    const ShootTree& tree() const { return tree_; }
    const ShootNetwork& network() const { return network_; }
    /// Of the substep that is solved next.
    void set_substep(double days, double weight);
    double meet(const CollarView& supply) override;
    double by_head() const override { return network_.by_collar_head(); }

    /// What all leaves would give of wet plants, cm3/d.
    double demand() const { return demand_; }
    /// What leaves give now, cm3/d.
    double loss() const;
    void pass();
    /// Means of the last substep, cm3/d.
    double mean_loss() const { return mean_loss_; }
    /// Water that organs hold less than full, cm3; negative.
    double stored() const;
    /// What they held when the step began.
    double stored_at_first() const { return stored_at_first_; }
    StoredHeads held() const;
    /// Share of the conductance that is lost on the way to each node.
    double lost(std::size_t row) const;
    double greatest_loss() const;
    /// At the tip of an internode of the drawing, cm; none in the soil.
    std::optional<double> head_in(std::uint32_t internode) const;

private:
    void ask_leaves(std::span<const double> heads, std::span<LossOfHead> losses);

    std::uint32_t plant_;
    ShootTree tree_;
    ShootNetwork network_;
    LeafWater& leaves_;
    ShootPast past_;
    bool begun_ = false;
    double days_ = 0, weight_ = 1, demand_ = 0, mean_loss_ = 0, stored_at_first_ = 0;
    std::vector<double> potentials_;
    std::vector<LeafLoss> of_leaves_;
};

/// What is known of each organ of a shoot.
std::vector<OrganQuantity> shoot_quantities();
/// Writes the values of one quantity, by modules, over `values`. False for an unknown one.
bool write_shoot_values(const PlantShoot& shoot, const std::string& name, std::vector<float>& values);

void save_heads(const StoredHeads& heads, std::ostream& out);
StoredHeads restored_heads(std::istream& in);

}  // namespace espalier::environment
