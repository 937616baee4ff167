#include "analysis/profile.h"

#include "espalier/base/error.h"

#include "analysis/convex_hull.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace espalier::analysis {
namespace {

/// Heights between which everything lies.
struct HeightRange {
    double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();

    void add(double height) { low = std::min(low, height), high = std::max(high, height); }
};

HeightRange range_of(const BranchTree& tree, const Leaves& leaves) {
    HeightRange range;
    for (std::size_t i = 0; i < tree.size(); ++i) range.add(tree.bases[i].y), range.add(tree.tips[i].y);
    for (const Leaf& leaf : leaves.leaves) range.add(leaf.position.y);
    return range;
}

double power_of_ten_below(double extent) {
    return std::pow(10.0, std::floor(std::log10(extent / 20)));
}

double density_of(double length, double thickness, double area) {
    return area > 0 ? length / (thickness * area) : std::numeric_limits<double>::quiet_NaN();
}

/// Shares an internode among the layers it passes, by length.
void share(const BranchTree& tree, std::size_t internode, double thickness, std::vector<Layer>& layers) {
    double low = tree.bases[internode].y, high = tree.tips[internode].y;
    if (low > high) std::swap(low, high);
    const double surface = std::numbers::pi * (tree.base_radii[internode] + tree.radii[internode]);
    const auto index = [&](double height) {
        const double at = std::floor((height - layers.front().from) / thickness);
        return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(layers.size() - 1)));
    };
    const std::size_t first = index(low), last = index(high);
    for (std::size_t i = first; i <= last; ++i) {
        const double from = i == first ? low : layers[i].from, to = i == last ? high : layers[i].to;
        const double part = first == last ? 1 : (to - from) / (high - low);
        layers[i].length += part * tree.lengths[internode];
        layers[i].surface += part * tree.lengths[internode] * surface;
        if (!tree.uptakes.empty()) layers[i].uptake += part * tree.uptakes[internode];
    }
}

}  // namespace

double convenient_thickness(double extent) {
    if (!(extent > 0)) return 1;
    const double power = power_of_ten_below(extent);
    // The lowest and the highest layer may be filled in part only, so that 19 whole ones lie between them.
    for (const double factor : {1.0, 2.0, 5.0, 10.0}) {
        if (factor * power * 19 >= extent) return factor * power;
    }
    return 20 * power;
}

double part_of_thickness(const BranchTree& tree, const Leaves& leaves) {
    const HeightRange range = range_of(tree, leaves);
    constexpr double least = 1e-6;
    return range.low < range.high ? std::max(power_of_ten_below(range.high - range.low), least) : least;
}

double shadow_of(const BranchTree& tree) {
    std::vector<glm::dvec2> points;
    for (std::size_t i = 0; i < tree.size(); ++i) {
        points.emplace_back(tree.bases[i].x, tree.bases[i].z);
        points.emplace_back(tree.tips[i].x, tree.tips[i].z);
    }
    return convex_hull_area(points);
}

std::vector<Layer> merged_layers(const std::vector<Layer>& parts, double thickness, double low, double high,
                                 double shadow, double ground) {
    const double first = std::floor(low / thickness + 1e-9);
    const double count = std::max(std::ceil(high / thickness - 1e-9) - first, 1.0);
    std::vector<Layer> result(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < result.size(); ++i) {
        result[i].from = (first + static_cast<double>(i)) * thickness;
        result[i].to = (first + static_cast<double>(i + 1)) * thickness;
    }
    for (const Layer& part : parts) {
        const double at = std::floor((part.from + part.to) / 2 / thickness) - first;
        Layer& whole = result[static_cast<std::size_t>(std::clamp(at, 0.0, count - 1))];
        whole.length += part.length;
        whole.surface += part.surface;
        whole.leaf_area += part.leaf_area;
        whole.uptake += part.uptake;
    }
    // NaN in any: nothing was recorded of this plant.
    const bool has_uptake =
        std::none_of(parts.begin(), parts.end(), [](const Layer& part) { return std::isnan(part.uptake); });
    for (Layer& layer : result) {
        if (!has_uptake) layer.uptake = std::numeric_limits<double>::quiet_NaN();
        layer.density = density_of(layer.length, thickness, shadow);
        layer.ground_density = density_of(layer.length, thickness, ground);
    }
    return result;
}

std::vector<Layer> layers(const BranchTree& tree, const Leaves& leaves, double thickness) {
    const HeightRange range = range_of(tree, leaves);
    if (!(range.low <= range.high)) return {};
    if (!(thickness > 0)) thickness = convenient_thickness(range.high - range.low);
    const double first = std::floor(range.low / thickness);
    const double count = std::max(std::ceil(range.high / thickness) - first, 1.0);
    if (!(count <= 100000)) {
        throw UserError(fmt::format("--layer {}: a plant {} m high would have more than 100,000 layers", thickness,
                                    range.high - range.low));
    }
    std::vector<Layer> result(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < result.size(); ++i) {
        result[i].from = (first + static_cast<double>(i)) * thickness;
        result[i].to = (first + static_cast<double>(i + 1)) * thickness;
    }
    for (std::size_t i = 0; i < tree.size(); ++i) share(tree, i, thickness, result);
    for (const Leaf& leaf : leaves.leaves) {
        const double at = std::floor(leaf.position.y / thickness) - first;
        result[static_cast<std::size_t>(std::clamp(at, 0.0, count - 1))].leaf_area += leaf.area;
    }
    const double shadow = shadow_of(tree);
    for (Layer& layer : result) {
        layer.density = density_of(layer.length, thickness, shadow);
        if (tree.uptakes.empty()) layer.uptake = std::numeric_limits<double>::quiet_NaN();
    }
    return result;
}

LengthDistribution length_distribution(const BranchTree& tree) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    if (tree.size() == 0) return {nan, nan, nan, nan, nan, {}};
    std::vector<double> sorted = tree.lengths;
    std::sort(sorted.begin(), sorted.end());
    const std::size_t n = sorted.size();
    LengthDistribution result{sorted.front(), (sorted[(n - 1) / 2] + sorted[n / 2]) / 2, sorted.back(), 0, 0, {}};
    for (const double length : sorted) result.mean += length / static_cast<double>(n);
    for (const double length : sorted) result.deviation += std::pow(length - result.mean, 2) / static_cast<double>(n);
    result.deviation = std::sqrt(result.deviation);
    constexpr std::size_t bins = 16;
    for (std::size_t i = 0; i < bins; ++i) {
        result.bins.push_back(
            {result.greatest * static_cast<double>(i) / bins, result.greatest * static_cast<double>(i + 1) / bins, 0});
    }
    for (const double length : sorted) {
        const double at = std::floor(length / result.greatest * bins);
        ++result.bins[static_cast<std::size_t>(std::clamp(at, 0.0, bins - 1.0))].internodes;
    }
    return result;
}

}  // namespace espalier::analysis
