// Everything `espalier analyse` measures of a plant in a frame.
#pragma once

#include "espalier/analysis/run_analysis.h"

#include "analysis/branching.h"
#include "analysis/crown.h"
#include "analysis/fractal_dimension.h"
#include "analysis/profile.h"
#include "analysis/widths.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace espalier::analysis {

struct PlantAnalysis {
    std::uint32_t plant = 0;
    std::size_t internodes = 0;
    double length = 0, surface = 0, volume = 0;
    double height = 0, depth_in_ground = 0;  ///< highest and lowest point above and below the foot, m
    BranchingCounts counts;
    int strahler = 0;
    std::vector<StreamOrder> streams;
    HortonRatios horton{};
    RamificationMatrix ramification;
    ForkWidths widths;
    FractalDimension fractal;
    std::size_t leaves = 0;
    double leaf_area = 0;
    Crown crown;
    double shadow = 0;  ///< from straight above, m2
    std::vector<Layer> layers;
    LengthDistribution lengths;

    /// Leaf area over the crown's projection; NaN if that is 0.
    double leaf_area_index() const;
};

PlantAnalysis analyse(std::uint32_t plant, const BranchTree& tree, const Leaves& leaves,
                      const AnalysisOptions& options = {});

/// Analyses each of `plants`, in their order. `run` is the folder whence textures of leaves are found.
std::vector<PlantAnalysis> analyse(const FrameGeometry& geometry, std::span<const std::uint32_t> plants,
                                   const AnalysisOptions& options = {}, const std::filesystem::path& run = {});

/// One figure of a plant: a column of analysis.csv.
struct Measure {
    MeasureDescription description;
    double (*value)(const PlantAnalysis&);
};
const std::vector<Measure>& measures();

}  // namespace espalier::analysis
