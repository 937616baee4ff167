#include "environment/soil/grid/grid.h"

#include "environment/exchange/covering.h"

#include <algorithm>
#include <cmath>

namespace espalier::environment {
namespace {

/// Two neighbouring voxels of one axis and the weight of each.
struct Between {
    int first = 0, second = 0;
    double first_weight = 1, second_weight = 0;
};

/// `distance`: from the middle of the axis, in voxels. Computed on one side of the middle and mirrored, so that
/// mirrored points get mirrored weights to the last bit.
Between between(double distance, int size) {
    const double half = 0.5 * (size - 1);
    const double from_first = std::abs(distance) + half;
    const int last = size - 1;
    const int lower = std::clamp(static_cast<int>(std::floor(from_first)), 0, last);
    const double part = lower == last ? 0 : from_first - lower;
    Between result{lower, std::min(lower + 1, last), 1 - part, part};
    if (std::signbit(distance)) {
        result = {last - result.second, last - result.first, result.second_weight, result.first_weight};
    }
    return result;
}

}  // namespace

double WaterGrid::voxels_needed(const Box& domain, double voxel, bool flat) {
    double product = 1;
    for (int axis = 0; axis < (flat ? 2 : 3); ++axis) {
        product *= voxels_across(domain.upper[axis] - domain.lower[axis], voxel);
    }
    return product;
}

WaterGrid::WaterGrid(const Box& domain, double voxel, bool flat)
    : voxel_(voxel), middle_(0.5 * (domain.lower + domain.upper)), flat_(flat) {
    for (int axis = 0; axis < (flat ? 2 : 3); ++axis) {
        size_[axis] = static_cast<int>(voxels_across(domain.upper[axis] - domain.lower[axis], voxel));
    }
}

glm::dvec3 WaterGrid::lower() const {
    return middle_ - 0.5 * voxel_ * glm::dvec3(size_);
}

glm::dvec3 WaterGrid::upper() const {
    return middle_ + 0.5 * voxel_ * glm::dvec3(size_);
}

glm::dvec3 WaterGrid::centre(const glm::ivec3& voxel) const {
    return middle_ + voxel_ * (glm::dvec3(voxel) - 0.5 * glm::dvec3(size_ - 1));
}

bool WaterGrid::contains(const glm::dvec3& point) const {
    const double tolerance = 1e-9 * voxel_;
    for (int axis = 0; axis < (flat_ ? 2 : 3); ++axis) {
        if (!(std::abs(point[axis] - middle_[axis]) <= 0.5 * voxel_ * size_[axis] + tolerance)) return false;
    }
    return true;
}

WaterStencil WaterGrid::stencil(const glm::dvec3& point) const {
    std::array<Between, 3> axes;
    for (int axis = 0; axis < (flat_ ? 2 : 3); ++axis) {
        axes[axis] = between((point[axis] - middle_[axis]) / voxel_, size_[axis]);
    }
    WaterStencil stencil;
    for (int corner = 0; corner < 8; ++corner) {
        double weight = 1;
        for (int axis = 0; axis < 3; ++axis) {
            const bool second = (corner >> axis & 1) != 0;
            stencil.voxel[corner][axis] = second ? axes[axis].second : axes[axis].first;
            weight *= second ? axes[axis].second_weight : axes[axis].first_weight;
        }
        stencil.weight[corner] = weight;
    }
    return stencil;
}

WaterFaces::WaterFaces(const WaterGrid& grid, const std::vector<std::uint8_t>& is_free)
    : bits_(grid.cells(), 0), plain_(grid.rows(), 1) {
    const glm::ivec3 size = grid.size();
    const auto free_at = [&](int x, int y, int z) {
        // Sides of the domain are open here: what crosses them is the boundary condition's affair.
        if (!grid.has({x, y, z})) return true;
        return is_free[(std::size_t(z) * size.y + y) * size.x + x] != 0;
    };
    std::vector<std::size_t> free_in_row(grid.rows(), 0);
    for_in_parallel(std::size_t{0}, grid.rows(), [&](std::size_t row) {
        const int y = grid.y_of(row), z = grid.z_of(row);
        std::uint8_t all = 127;
        for (int x = 0; x < size.x; ++x) {
            std::uint8_t bits = 0;
            if (free_at(x, y, z)) {
                const std::array<bool, 6> open = {free_at(x - 1, y, z), free_at(x + 1, y, z), free_at(x, y - 1, z),
                                                  free_at(x, y + 1, z), free_at(x, y, z - 1), free_at(x, y, z + 1)};
                bits = free_bit;
                for (int face = 0; face < 6; ++face) bits |= static_cast<std::uint8_t>(open[face] << face);
                ++free_in_row[row];
            }
            bits_[grid.cell({x, y, z})] = bits;
            all &= bits;
        }
        plain_[row] = all == 127;
    });
    for (const std::size_t free : free_in_row) free_voxels_ += free;
}

}  // namespace espalier::environment
