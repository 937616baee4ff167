// Water in a shoot: potentials and flows between the collar and the leaves.
#pragma once

#include "environment/soil/roots/hydraulic_tree.h"
#include "environment/soil/shoot/vulnerability.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace espalier::environment {

/// An internode with its tip, or a leaf. Centimetres and days; heads are pressure heads.
struct ShootNode {
    static constexpr std::uint32_t collar = 0xFFFFFFFF;

    std::uint32_t bearer = collar;  ///< which comes before it
    double conductance = 0;         ///< between the bearer and it, if nothing is lost, cm2/d
    Vulnerability conduits;
    double height = 0;    ///< cm
    double capacity = 0;  ///< of the water that it gives as its head falls, cm2
    bool is_leaf = false;
};

/// What flows and how dry it is, by the rows of the nodes.
struct ShootFlow {
    double collar_head = 0;      ///< pressure head, cm
    double intake = 0;           ///< through the collar, cm3/d
    std::vector<double> head;    ///< pressure head, cm
    std::vector<double> flow;    ///< from the bearer, cm3/d
    std::vector<double> stored;  ///< that goes into what it stores, cm3/d
    std::vector<double> loss;    ///< that it gives to the air, cm3/d
    double residual = 0;         ///< of the balance of the worst node, of the largest flow
};

/// What the leaves, in the order of their nodes, give at pressure heads in cm: cm3/d, and how that changes, cm2/d.
struct LossOfHead {
    double rate = 0, by_head = 0;
};
using ShootLosses = std::function<void(std::span<const double> heads, std::span<LossOfHead> losses)>;

/// What storage knows of the time before, by the rows of the nodes.
struct ShootPast {
    std::vector<double> head;    ///< at the beginning of the substep, cm
    std::vector<double> stored;  ///< rate over the substep before, cm3/d
};

/// Each node gets from its bearer what it passes on, stores and gives to the air. A flow is the conductance times the
/// mean share that its conduits have left (Neufeld et al. 1992) times the difference of total heads. Newton's method,
/// whose steps solve the tree by elimination from the leaves to the collar and back; a head that would turn back moves
/// half as far. More supply or less loss raises all heads, so that there is one solution.
class ShootNetwork {
public:
    ShootNetwork(std::vector<ShootNode> nodes, double collar_height);

    const std::vector<ShootNode>& nodes() const { return nodes_; }
    const ShootFlow& flow() const { return flow_; }
    double collar_height() const { return collar_height_; }
    /// How what it takes through the collar changes with the head there, by the last of Newton's steps, cm2/d.
    double by_collar_head() const { return by_collar_head_; }
    /// Everything at rest with this total head, cm.
    void rest_at(double total_head);
    /// With roots that supply water as `supply` says. `days`: of the substep, 0 for a moment in which nothing is
    /// stored; of the rate over it, the new one is the part `weight`. Begins where it ended the last time.
    void solve(const CollarView& supply, const ShootLosses& losses, const ShootPast& past, double days, double weight);

private:
    struct Row {
        double flow = 0, by_bearer = 0, by_own = 0;  ///< from the bearer
        double rest = 0, diagonal = 0;
    };

    double measure(const CollarView& supply, const ShootLosses& losses, const ShootPast& past, double days,
                   double weight);
    void find_flows();
    double head_below(const ShootNode& node) const;
    void eliminate(const CollarView& supply);
    void move();
    /// Of all that water comes from, total, cm.
    double highest(const CollarView& supply, const ShootPast& past, double days) const;
    /// What a balance may miss.
    double allowed() const;

    std::vector<ShootNode> nodes_;
    double collar_height_;
    std::vector<std::size_t> leaves_;  ///< rows of the leaves
    ShootFlow flow_;
    std::vector<Row> rows_;
    std::vector<double> change_, reach_, rest_, before_, leaf_heads_;
    std::vector<LossOfHead> losses_;
    double collar_rest_ = 0, collar_change_ = 0, collar_reach_ = 0, collar_before_ = 0, scale_ = 0, driven_ = 0,
           highest_ = 0, by_collar_head_ = 0;
};

}  // namespace espalier::environment
