#include "environment/light/canopy/canopy_space.h"

#include "environment/exchange/covering.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace espalier::environment {

CanopySpace::CanopySpace(const Settings& settings, const std::optional<Box>& domain, double usual_voxel)
    : edge_(read_voxel(settings, usual_voxel)),
      edge_place_(settings.place("voxel")),
      ground_(settings.number_or("ground", 0)) {
    if (!settings.flag_or("periodic", false)) return;
    if (!domain) {
        throw UserError(settings.place("periodic"),
                        "a periodic canopy needs the scene's domain, whose sides are its period");
    }
    period_ = *domain;
    for (const int axis : {0, 2}) {
        const double voxels = (period_->upper[axis] - period_->lower[axis]) / edge_;
        if (std::abs(voxels - std::round(voxels)) < 1e-6 * voxels) continue;
        throw UserError(settings.place("voxel"),
                        fmt::format("a whole number of voxels must make up the period of {:g} m: voxel = {:g}",
                                    voxels * edge_, voxels * edge_ / std::max(1.0, std::round(voxels))));
    }
}

CanopySpace::Extent CanopySpace::over(Box box) const {
    box.lower.y = std::min(box.lower.y, ground_ + 1e-9 * edge_);
    Extent over;
    over.first = glm::floor(box.lower / edge_);
    over.size = glm::floor(box.upper / edge_) + 1.0 - over.first;
    for (const int axis : {0, 2}) {
        if (!period_) continue;
        over.first[axis] = period_->lower[axis] / edge_;
        over.size[axis] = std::round((period_->upper[axis] - period_->lower[axis]) / edge_);
    }
    return over;
}

CanopyVoxels CanopySpace::voxels(const Extent& extent) const {
    return {extent.first * edge_, glm::ivec3(extent.size), edge_, period_.has_value()};
}

}  // namespace espalier::environment
