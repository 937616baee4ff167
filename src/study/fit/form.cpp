#include "study/fit/form.h"

#include "espalier/base/error.h"

#include "analysis/branch_tree.h"
#include "analysis/leaves.h"
#include "base/text.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace espalier::study {
namespace {

constexpr std::size_t orders = 4;
constexpr double not_there = std::numeric_limits<double>::quiet_NaN();
constexpr double degrees = 180 / std::numbers::pi;

struct Figure {
    const char *name, *unit;
};
constexpr std::array figures{Figure{"height", "m"}, Figure{"depth", "m"},     Figure{"width", "m"},
                             Figure{"length", "m"}, Figure{"surface", "m2"},  Figure{"volume", "m3"},
                             Figure{"leaves", ""},  Figure{"leaf_area", "m2"}};

std::vector<double> figures_of(const BranchTree& tree, const Leaves& leaves) {
    glm::dvec3 low(0), high(0);
    const auto reach = [&](const glm::dvec3& place) {
        low = glm::min(low, place - tree.bases.front());
        high = glm::max(high, place - tree.bases.front());
    };
    for (std::size_t i = 0; i < tree.size(); ++i) {
        reach(tree.bases[i]);
        reach(tree.tips[i]);
    }
    return {high.y,
            -low.y,
            (high.x - low.x + high.z - low.z) / 2,
            total_length(tree),
            total_surface(tree),
            total_volume(tree),
            static_cast<double>(leaves.leaves.size()),
            total_area(leaves)};
}

/// The axes of one order of a plant.
struct AxesOfOrder {
    double count = 0, length = 0, angle = 0, angles = 0;
};
using AxesOfPlant = std::array<AxesOfOrder, orders>;

glm::dvec3 direction(const FrameInternode& internode) {
    return glm::dvec3(internode.tip) - glm::dvec3(internode.base);
}

/// An axis begins at an internode of a higher order than that which bears it, and at a plant's first.
std::vector<AxesOfPlant> axes_of(const std::vector<FrameInternode>& internodes, std::size_t plants) {
    std::vector<AxesOfPlant> found(plants);
    for (const FrameInternode& internode : internodes) {
        if (internode.plant >= plants || internode.order >= orders) continue;
        AxesOfOrder& axes = found[internode.plant][internode.order];
        axes.length += glm::length(direction(internode));
        const FrameInternode* bearer = internode.bearer.is_none() ? nullptr : &internodes[internode.bearer.row()];
        if (bearer && bearer->order >= internode.order) continue;
        axes.count += 1;
        if (!bearer) continue;
        const glm::dvec3 from = direction(*bearer), to = direction(internode);
        const double lengths = glm::length(from) * glm::length(to);
        if (!(lengths > 0)) continue;
        axes.angle += degrees * std::acos(std::clamp(glm::dot(from, to) / lengths, -1.0, 1.0));
        axes.angles += 1;
    }
    return found;
}

void add_axes(std::vector<double>& row, const AxesOfPlant& plant) {
    for (const AxesOfOrder& axes : plant) row.push_back(axes.count);
    for (const AxesOfOrder& axes : plant) row.push_back(axes.count > 0 ? axes.length / axes.count : not_there);
    for (std::size_t order = 1; order < orders; ++order) {
        row.push_back(plant[order].angles > 0 ? plant[order].angle / plant[order].angles : not_there);
    }
}

}  // namespace

const std::vector<std::string>& form_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const Figure& figure : figures) all.emplace_back(figure.name);
        for (std::size_t order = 0; order < orders; ++order) all.push_back(fmt::format("axes.{}", order));
        for (std::size_t order = 0; order < orders; ++order) all.push_back(fmt::format("axis_length.{}", order));
        for (std::size_t order = 1; order < orders; ++order) all.push_back(fmt::format("axis_angle.{}", order));
        return all;
    }();
    return names;
}

const char* unit_of_form(const std::string& name) {
    for (const Figure& figure : figures) {
        if (figure.name == name) return figure.unit;
    }
    const auto& names = form_names();
    if (std::find(names.begin(), names.end(), name) == names.end()) {
        throw UserError(fmt::format("plants have no '{}'{}", name, did_you_mean(name, names)));
    }
    return name.starts_with("axis_length") ? "m" : name.starts_with("axis_angle") ? "degrees" : "";
}

std::vector<std::vector<double>> forms_of(const Grown& world) {
    const FrameGeometry& geometry = *world.geometry;
    const std::vector<FrameInternode> internodes = internodes_of(geometry);
    const std::vector<AxesOfPlant> axes =
        axes_of(internodes, world.plants.empty() ? 0 : *std::max_element(world.plants.begin(), world.plants.end()) + 1);
    const std::vector<BranchTree> trees = branch_trees(internodes, world.plants);
    const std::vector<Leaves> leaves = leaves_of(geometry, world.plants);
    std::vector<std::vector<double>> rows;
    for (std::size_t i = 0; i < world.plants.size(); ++i) {
        rows.push_back(figures_of(trees[i], leaves[i]));
        add_axes(rows.back(), axes[world.plants[i]]);
    }
    return rows;
}

}  // namespace espalier::study
