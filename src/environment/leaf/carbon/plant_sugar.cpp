#include "environment/leaf/carbon/plant_sugar.h"

#include "base/bytes.h"
#include "turtle/internode_bearers.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <numbers>
#include <set>

namespace espalier::environment::carbon {
namespace {

constexpr double least_volume = 1e-9;  ///< cm3: also a line without width holds something
constexpr double centimetres = 100;

/// Of a module of the string; a string without lineage has numbers instead.
std::uint64_t identity_of(const ModuleString& string, std::uint32_t module) {
    return string.has_lineage() ? string.identity(module) : module + std::uint64_t{1};
}

/// Two halves of internodes, one after the other.
double conductance_between(double first, double second) {
    return first > 0 && second > 0 ? 2 / (1 / first + 1 / second) : 0;
}

}  // namespace

SugarTree sugar_pool(const PlantView& plant) {
    SugarTree tree;
    tree.nodes.emplace_back().volume = 1;
    tree.internodes_of_module.assign(plant.string->size(), SugarTree::none);
    tree.identities.push_back(0);
    return tree;
}

SugarTree sugar_tree(const PlantView& plant, const SugarWays& ways) {
    const PlantGeometry& geometry = plant.interpretation->geometry;
    if (geometry.internodes.empty()) return sugar_pool(plant);
    SugarTree tree;
    tree.internodes_of_module.assign(plant.string->size(), SugarTree::none);
    const std::vector<std::uint32_t> bearers = turtle::internode_bearers(geometry, *plant.string);
    std::vector<double> own(geometry.internodes.size());
    for (std::uint32_t i = 0; i < geometry.internodes.size(); ++i) {
        const Internode& internode = geometry.internodes[i];
        const double length = centimetres * glm::length(internode.tip - internode.base);
        const double base = centimetres * internode.base_radius, tip = centimetres * internode.tip_radius;
        // A cone conducts as a cylinder of the section pi base tip.
        own[i] = ways.conductivity * std::numbers::pi * base * tip / std::max(length, 1e-6);
        SugarNode node;
        const double volume = std::numbers::pi / 3 * (base * base + base * tip + tip * tip) * length;
        node.volume = std::max(least_volume, ways.storage * volume);
        if (i > 0) {
            // What stands on no internode stands on the collar, where the first one begins.
            node.bearer = bearers[i] == turtle::no_bearer ? 0 : bearers[i];
            node.conductance = conductance_between(own[i], own[node.bearer]);
        }
        tree.nodes.push_back(node);
        tree.identities.push_back(identity_of(*plant.string, internode.module));
        tree.internodes_of_module[internode.module] = i;
    }
    return tree;
}

double PlantSugar::total() const {
    double sum = 0;
    for (const auto& [identity, grams] : grams_) sum += grams;
    return sum;
}

double PlantSugar::put_into(SugarTree& tree, const PlantView& plant) const {
    const std::set<std::uint64_t> here(tree.identities.begin(), tree.identities.end());
    std::vector<std::uint64_t> from(tree.nodes.size(), 0);
    std::map<std::uint64_t, double> volumes;
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
        from[i] = tree.identities[i];
        if (from[i] != 0 && !grams_.contains(from[i]) && plant.string->has_lineage()) {
            const std::uint64_t parent = plant.string->parent(plant.interpretation->geometry.internodes[i].module);
            if (!here.contains(parent)) from[i] = parent;
        }
        if (from[i] != 0 && grams_.contains(from[i])) volumes[from[i]] += tree.nodes[i].volume;
    }
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
        const auto held = volumes.find(from[i]);
        if (held != volumes.end()) {
            tree.nodes[i].sugar = grams_.at(from[i]) * tree.nodes[i].volume / held->second;
        }
    }
    double lost = 0;
    for (const auto& [identity, grams] : grams_) {
        if (identity == 0) {
            tree.nodes.front().sugar += grams;
        } else if (!volumes.contains(identity)) {
            lost += grams;
        }
    }
    return lost;
}

void PlantSugar::take_from(const SugarTree& tree, const std::vector<double>& concentrations) {
    grams_.clear();
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
        grams_[tree.identities[i]] += tree.nodes[i].volume * concentrations[i];
    }
}

void PlantSugar::save(std::ostream& out) const {
    put(out, static_cast<std::uint64_t>(grams_.size()));
    for (const auto& [identity, grams] : grams_) {
        put(out, identity);
        put(out, grams);
    }
}

void PlantSugar::restore(std::istream& in) {
    grams_.clear();
    for (auto left = get<std::uint64_t>(in); left > 0; --left) {
        const auto identity = get<std::uint64_t>(in);
        grams_[identity] = get<double>(in);
    }
}

}  // namespace espalier::environment::carbon
