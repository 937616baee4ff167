#include "analysis/fractal_dimension.h"

#include "espalier/geometry/plant_geometry.h"

#include "analysis/line_fit.h"
#include "analysis/voxels.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace espalier::analysis {

FractalDimension fractal_dimension(const BranchTree& tree) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    Box bounds;
    for (std::size_t i = 0; i < tree.size(); ++i) bounds.add(tree.bases[i]), bounds.add(tree.tips[i]);
    const glm::dvec3 extents = bounds.empty() ? glm::dvec3(0) : bounds.upper - bounds.lower;
    const double extent = std::max({extents.x, extents.y, extents.z});
    if (!(extent > 0) || !std::isfinite(extent)) return {nan, nan, nan, nan, {}};

    const double mean_length = total_length(tree) / static_cast<double>(tree.size());
    const int halvings = static_cast<int>(std::clamp(std::floor(std::log2(extent / mean_length)), 5.0, 10.0));
    // A little more than the extent, so that what lies on its far side is inside the last box.
    VoxelSet boxes(bounds.lower, extent * (1 + 1e-9) / std::exp2(halvings));
    for (std::size_t i = 0; i < tree.size(); ++i) boxes.add_segment(tree.bases[i], tree.tips[i]);

    FractalDimension result{0, 0, boxes.edge(), 0, {}};
    std::vector<double> scales, numbers;
    for (int halving = halvings; halving >= 2; --halving) {
        result.counts.push_back(boxes.count());
        result.largest_box = boxes.edge();
        scales.push_back(-std::log(boxes.edge()));
        numbers.push_back(std::log(static_cast<double>(boxes.count())));
        boxes.coarsen();
    }
    const LineFit fit = fit_line(scales, numbers);
    result.dimension = fit.slope;
    result.error = fit.error;
    return result;
}

}  // namespace espalier::analysis
