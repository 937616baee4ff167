#include "analysis/plant_analysis.h"

#include "analysis/water.h"

#include <algorithm>
#include <limits>

namespace espalier::analysis {

double PlantAnalysis::leaf_area_index() const {
    return crown.projection > 0 ? leaf_area / crown.projection : std::numeric_limits<double>::quiet_NaN();
}

PlantAnalysis analyse(std::uint32_t plant, const BranchTree& tree, const Leaves& leaves,
                      const AnalysisOptions& options) {
    PlantAnalysis result;
    result.plant = plant;
    result.internodes = tree.size();
    result.length = total_length(tree);
    result.surface = total_surface(tree);
    result.volume = total_volume(tree);
    result.counts = count_branching(tree);
    const StrahlerOrders orders = strahler_orders(tree);
    result.strahler = orders.highest;
    result.streams = streams(tree, orders);
    result.horton = horton_ratios(result.streams);
    result.ramification = ramification_matrix(tree, orders);
    result.widths = fork_widths(tree);
    result.fractal = fractal_dimension(tree);
    result.leaves = leaves.leaves.size();
    result.leaf_area = total_area(leaves);
    result.crown = measure_crown(tree, leaves, options.voxel);
    result.shadow = shadow_of(tree);
    result.layers = layers(tree, leaves, options.layer > 0 ? options.layer : part_of_thickness(tree, leaves));
    result.lengths = length_distribution(tree);
    result.height = std::max(result.crown.top, 0.0);
    result.depth_in_ground = std::max(-result.crown.base, 0.0);
    for (std::size_t i = 0; i < tree.size(); ++i) {
        result.height = std::max(result.height, tree.tips[i].y - tree.bases[0].y);
        result.depth_in_ground = std::max(result.depth_in_ground, tree.bases[0].y - tree.tips[i].y);
    }
    return result;
}

std::vector<PlantAnalysis> analyse(const FrameGeometry& geometry, std::span<const std::uint32_t> plants,
                                   const AnalysisOptions& options, const std::filesystem::path& run) {
    const std::vector<FrameInternode> internodes = internodes_of(geometry);
    const std::vector<BranchTree> trees = branch_trees(internodes, plants, uptakes_of(geometry, internodes));
    const std::vector<Leaves> leaves = leaves_of(geometry, plants, options.leaf_symbols, run);
    std::vector<PlantAnalysis> result;
    for (std::size_t i = 0; i < plants.size(); ++i) result.push_back(analyse(plants[i], trees[i], leaves[i], options));
    return result;
}

namespace {

std::vector<Measure> all_measures() {
    using P = PlantAnalysis;
    return {
        {{"internodes", "", "internodes"}, [](const P& p) -> double { return p.internodes; }},
        {{"tips", "", "tips"}, [](const P& p) -> double { return p.counts.tips; }},
        {{"forks", "", "forks"}, [](const P& p) -> double { return p.counts.forks; }},
        {{"depth", "", "most forks up to a tip"}, [](const P& p) -> double { return p.counts.depth; }},
        {{"longest_path", "m", "longest path to a tip"}, [](const P& p) -> double { return p.counts.longest_path; }},
        {{"length", "m", "total length"}, [](const P& p) -> double { return p.length; }},
        {{"surface", "m2", "surface of the internodes, as truncated cones"},
         [](const P& p) -> double { return p.surface; }},
        {{"volume", "m3", "volume of the internodes, as truncated cones"},
         [](const P& p) -> double { return p.volume; }},
        {{"height", "m", "height"}, [](const P& p) -> double { return p.height; }},
        {{"depth_in_ground", "m", "depth below the foot"}, [](const P& p) -> double { return p.depth_in_ground; }},
        {{"strahler", "", "Strahler order"}, [](const P& p) -> double { return p.strahler; }},
        {{"branching_ratio", "", "branching ratio"}, [](const P& p) -> double { return p.horton.branching; }},
        {{"length_ratio", "", "length ratio"}, [](const P& p) -> double { return p.horton.length; }},
        {{"diameter_ratio", "", "diameter ratio"}, [](const P& p) -> double { return p.horton.diameter; }},
        {{"pipe_exponent", "", "pipe-model exponent"}, [](const P& p) -> double { return p.widths.exponent; }},
        {{"pipe_exponent_median", "", "median pipe-model exponent"},
         [](const P& p) -> double { return p.widths.median_exponent; }},
        {{"pipe_forks", "", "forks with an exponent"},
         [](const P& p) -> double { return p.widths.forks_with_exponent; }},
        {{"area_ratio", "", "areas above / below a fork"}, [](const P& p) -> double { return p.widths.area_ratio; }},
        {{"area_error", "", "largest error of da Vinci's rule"},
         [](const P& p) -> double { return p.widths.largest_area_error; }},
        {{"fractal_dimension", "", "fractal dimension"}, [](const P& p) -> double { return p.fractal.dimension; }},
        {{"fractal_error", "", "its standard error"}, [](const P& p) -> double { return p.fractal.error; }},
        {{"smallest_box", "m", "smallest box counted"}, [](const P& p) -> double { return p.fractal.smallest_box; }},
        {{"largest_box", "m", "largest box counted"}, [](const P& p) -> double { return p.fractal.largest_box; }},
        {{"leaves", "", "leaves"}, [](const P& p) -> double { return p.leaves; }},
        {{"leaf_area", "m2", "leaf area"}, [](const P& p) -> double { return p.leaf_area; }},
        {{"leaf_area_index", "", "leaf area index"}, [](const P& p) -> double { return p.leaf_area_index(); }},
        {{"crown_base", "m", "height of the crown's base"}, [](const P& p) -> double { return p.crown.base; }},
        {{"crown_top", "m", "height of the crown's top"}, [](const P& p) -> double { return p.crown.top; }},
        {{"crown_width_x", "m", "crown width along x"}, [](const P& p) -> double { return p.crown.width_x; }},
        {{"crown_width_z", "m", "crown width along z"}, [](const P& p) -> double { return p.crown.width_z; }},
        {{"crown_volume", "m3", "crown volume (convex hull)"}, [](const P& p) -> double { return p.crown.volume; }},
        {{"crown_projection", "m2", "crown projection"}, [](const P& p) -> double { return p.crown.projection; }},
        {{"crown_occupied", "m3", "volume of the crown's voxels"},
         [](const P& p) -> double { return p.crown.occupied; }},
        {{"crown_voxel", "m", "edge of the voxels"}, [](const P& p) -> double { return p.crown.voxel; }},
        {{"asymmetry_x", "", "asymmetry along x"}, [](const P& p) -> double { return p.crown.asymmetry_x; }},
        {{"asymmetry_z", "", "asymmetry along z"}, [](const P& p) -> double { return p.crown.asymmetry_z; }},
        {{"internode_least", "m", "shortest internode"}, [](const P& p) -> double { return p.lengths.least; }},
        {{"internode_median", "m", "median internode"}, [](const P& p) -> double { return p.lengths.median; }},
        {{"internode_mean", "m", "mean internode"}, [](const P& p) -> double { return p.lengths.mean; }},
        {{"internode_deviation", "m", "standard deviation of internodes"},
         [](const P& p) -> double { return p.lengths.deviation; }},
        {{"internode_greatest", "m", "longest internode"}, [](const P& p) -> double { return p.lengths.greatest; }},
    };
}

}  // namespace

const std::vector<Measure>& measures() {
    static const std::vector<Measure> all = all_measures();
    return all;
}

}  // namespace espalier::analysis
