#include "environment/soil/shoot/plant_shoot.h"

#include "base/bytes.h"
#include "environment/soil/hydraulics/heads.h"
#include "turtle/internode_bearers.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace espalier::environment {
namespace {

constexpr double centimetres = 100;
constexpr double least_radius = 1e-3;  ///< cm: also a line without width conducts

std::uint64_t identity_of(const ModuleString& string, std::uint32_t module) {
    return string.has_lineage() ? string.identity(module) : module + std::uint64_t{1};
}

class Growing {
public:
    Growing(const PlantView& plant, double soil_surface, const ShootKind& kind)
        : string_(*plant.string),
          geometry_(plant.interpretation->geometry),
          surface_(soil_surface),
          kind_(kind),
          bearers_(turtle::internode_bearers(geometry_, string_)) {
        tree_.modules_in_string = string_.size();
        tree_.rows_of_internodes.assign(geometry_.internodes.size(), ShootNode::collar);
    }

    void add_internodes() {
        for (std::uint32_t i = 0; i < geometry_.internodes.size(); ++i) {
            const Internode& internode = geometry_.internodes[i];
            if (!(0.5 * (internode.base.y + internode.tip.y) >= surface_)) continue;
            const double length = std::max(centimetres * glm::length(internode.tip - internode.base), 1e-6);
            const double base = std::max(centimetres * internode.base_radius, least_radius);
            const double tip = std::max(centimetres * internode.tip_radius, least_radius);
            ShootNode node;
            node.bearer = row_of(bearers_[i]);
            // A cone conducts as a cylinder of the section pi base tip.
            node.conductance = kind_.stem_conductivity * std::numbers::pi * base * tip / length;
            node.conduits = kind_.stem;
            node.height = centimetres * internode.tip.y;
            node.capacity =
                kind_.stem_capacity * std::numbers::pi / 3 * (base * base + base * tip + tip * tip) * length;
            tree_.rows_of_internodes[i] = add(node, internode.module);
        }
    }

    void add_leaves(std::span<const DrawingLeaf> leaves) {
        const turtle::OrganBearers organs(geometry_, string_);
        const std::vector<glm::dvec3> places = places_of_modules();
        for (const DrawingLeaf& leaf : leaves) {
            const double area = 1e4 * leaf.area;
            ShootNode node;
            node.bearer = row_of(organs.of(leaf.module, places[leaf.module]));
            node.conductance = kind_.leaf_conductance * area;
            node.conduits = kind_.leaf;
            node.height = centimetres * places[leaf.module].y;
            node.capacity = kind_.leaf_capacity * area;
            node.is_leaf = true;
            add(node, leaf.module);
        }
    }

    ShootTree tree() { return std::move(tree_); }

private:
    std::uint32_t row_of(std::uint32_t internode) const {
        return internode < tree_.rows_of_internodes.size() ? tree_.rows_of_internodes[internode] : ShootNode::collar;
    }

    std::uint32_t add(const ShootNode& node, std::uint32_t module) {
        tree_.nodes.push_back(node);
        tree_.modules.push_back(module);
        // A leaf and an internode of one module are two organs.
        tree_.identities.push_back(identity_of(string_, module) ^ (node.is_leaf ? 0x9E3779B97F4A7C15ULL : 0));
        return static_cast<std::uint32_t>(tree_.nodes.size() - 1);
    }

    /// Where the picture of each module begins.
    std::vector<glm::dvec3> places_of_modules() const {
        std::vector<glm::dvec3> places(string_.size(), glm::dvec3(0));
        std::vector<bool> is_known(string_.size(), false);
        const auto say = [&](std::uint32_t module, const glm::dvec3& place) {
            if (module < places.size() && !is_known[module]) places[module] = place, is_known[module] = true;
        };
        for (const Organ& organ : geometry_.organs) say(organ.module, organ.pose.position);
        for (const Polygon& polygon : geometry_.polygons) say(polygon.module, geometry_.vertices[polygon.first]);
        for (const MeshPiece& piece : geometry_.mesh.pieces) {
            say(piece.module, geometry_.mesh.vertices[geometry_.mesh.triangles[piece.first]].position);
        }
        return places;
    }

    const ModuleString& string_;
    const PlantGeometry& geometry_;
    double surface_;
    const ShootKind& kind_;
    std::vector<std::uint32_t> bearers_;
    ShootTree tree_;
};

/// A quantity of each node, by its row; where several nodes are one module, their mean.
struct ShootQuantity {
    OrganQuantity told;
    double (*of)(const PlantShoot&, std::size_t row);
};

const std::vector<ShootQuantity>& known() {
    static const std::vector<ShootQuantity> all{
        {{"head", "cm", "pressure head at its tip"},
         [](const PlantShoot& shoot, std::size_t row) { return shoot.network().flow().head[row]; }},
        {{"flow", "cm3/d", "water that rises into it"},
         [](const PlantShoot& shoot, std::size_t row) { return shoot.network().flow().flow[row]; }},
        {{"plc", "%", "loss of the conductance of its conduits"},
         [](const PlantShoot& shoot, std::size_t row) { return 100 * shoot.lost(row); }}};
    return all;
}

}  // namespace

ShootTree shoot_tree(const PlantView& plant, std::span<const DrawingLeaf> leaves, double soil_surface,
                     const ShootKind& kind) {
    Growing growing(plant, soil_surface, kind);
    growing.add_internodes();
    growing.add_leaves(leaves);
    return growing.tree();
}

PlantShoot::PlantShoot(std::uint32_t plant, ShootTree tree, double collar_height, LeafWater& leaves,
                       const StoredHeads& held)
    : plant_(plant), tree_(std::move(tree)), network_(tree_.nodes, collar_height), leaves_(leaves) {
    const std::size_t count = tree_.nodes.size();
    past_.stored.assign(count, 0);
    past_.head.assign(count, 0);
    const auto of_collar = held.find(0);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t bearer = tree_.nodes[i].bearer;
        const auto own = held.find(tree_.identities[i]);
        past_.head[i] = own != held.end()             ? own->second
                        : bearer != ShootNode::collar ? past_.head[bearer]
                        : of_collar != held.end()     ? of_collar->second
                                                      : 0;
        stored_at_first_ += tree_.nodes[i].capacity * past_.head[i];
    }
    const std::size_t drawing = leaves.leaves(plant).size();
    potentials_.assign(drawing, 0);
    of_leaves_.resize(drawing);
    leaves_.lose(plant_, potentials_, of_leaves_);
    for (const LeafLoss& leaf : of_leaves_) demand_ += leaf.rate;
}

void PlantShoot::set_substep(double days, double weight) {
    days_ = days;
    weight_ = weight;
}

void PlantShoot::ask_leaves(std::span<const double> heads, std::span<LossOfHead> losses) {
    bool is_asked = true;  // at these potentials
    for (std::size_t l = 0; l < heads.size(); ++l) {
        const double potential = heads[l] / cm_per_megapascal;
        is_asked = is_asked && potential == potentials_[l];
        potentials_[l] = potential;
    }
    if (!is_asked) leaves_.lose(plant_, potentials_, of_leaves_);
    for (std::size_t l = 0; l < heads.size(); ++l) {
        losses[l] = {of_leaves_[l].rate, of_leaves_[l].by_potential / cm_per_megapascal};
    }
}

double PlantShoot::meet(const CollarView& supply) {
    if (!begun_) network_.rest_at(supply.head);
    begun_ = true;
    const auto losses = [this](std::span<const double> heads, std::span<LossOfHead> all) { ask_leaves(heads, all); };
    network_.solve(supply, losses, past_, days_, weight_);
    return network_.flow().collar_head + network_.collar_height();
}

double PlantShoot::loss() const {
    const std::vector<double>& loss = network_.flow().loss;
    return std::accumulate(loss.begin(), loss.end(), 0.0);
}

void PlantShoot::pass() {
    const ShootFlow& flow = network_.flow();
    for (std::size_t i = 0; i < tree_.nodes.size(); ++i) {
        past_.stored[i] = weight_ * flow.stored[i] + (1 - weight_) * past_.stored[i];
        past_.head[i] = flow.head[i];
    }
    mean_loss_ = weight_ * loss() + (1 - weight_) * mean_loss_;
    leaves_.pass(plant_, days_, weight_);
}

double PlantShoot::stored() const {
    double sum = 0;
    for (std::size_t i = 0; i < tree_.nodes.size(); ++i) sum += tree_.nodes[i].capacity * past_.head[i];
    return sum;
}

StoredHeads PlantShoot::held() const {
    StoredHeads heads{{0, network_.flow().collar_head}};
    for (std::size_t i = 0; i < tree_.nodes.size(); ++i) {
        if (tree_.nodes[i].capacity > 0) heads[tree_.identities[i]] = past_.head[i];
    }
    return heads;
}

double PlantShoot::lost(std::size_t row) const {
    const ShootNode& node = tree_.nodes[row];
    const std::vector<double>& heads = network_.flow().head;
    const double below = node.bearer == ShootNode::collar ? network_.flow().collar_head : heads[node.bearer];
    return 1 - mean_left(node.conduits, below, heads[row]).mean;
}

double PlantShoot::greatest_loss() const {
    double greatest = 0;
    for (std::size_t row = 0; row < tree_.nodes.size(); ++row) greatest = std::max(greatest, lost(row));
    return greatest;
}

std::optional<double> PlantShoot::head_in(std::uint32_t internode) const {
    if (internode >= tree_.rows_of_internodes.size()) return std::nullopt;
    const std::uint32_t row = tree_.rows_of_internodes[internode];
    return row == ShootNode::collar ? std::nullopt : std::optional(network_.flow().head[row]);
}

std::vector<OrganQuantity> shoot_quantities() {
    std::vector<OrganQuantity> all;
    for (const ShootQuantity& quantity : known()) all.push_back(quantity.told);
    return all;
}

bool write_shoot_values(const PlantShoot& shoot, const std::string& name, std::vector<float>& values) {
    const auto quantity =
        std::find_if(known().begin(), known().end(), [&](const ShootQuantity& one) { return one.told.name == name; });
    if (quantity == known().end()) return false;
    std::vector<double> sums(values.size(), 0), counts(values.size(), 0);
    for (std::size_t row = 0; row < shoot.tree().nodes.size(); ++row) {
        const std::uint32_t module = shoot.tree().modules[row];
        sums[module] += quantity->of(shoot, row);
        counts[module] += 1;
    }
    for (std::size_t m = 0; m < values.size(); ++m) {
        if (counts[m] > 0) values[m] = static_cast<float>(sums[m] / counts[m]);
    }
    return true;
}

void save_heads(const StoredHeads& heads, std::ostream& out) {
    put(out, static_cast<std::uint64_t>(heads.size()));
    for (const auto& [identity, head] : heads) {
        put(out, identity);
        put(out, head);
    }
}

StoredHeads restored_heads(std::istream& in) {
    StoredHeads heads;
    for (auto left = get<std::uint64_t>(in); left > 0; --left) {
        const auto identity = get<std::uint64_t>(in);
        heads[identity] = get<double>(in);
    }
    return heads;
}

}  // namespace espalier::environment
