#include "environment/soil/linear/diffusion.h"

#include "base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace espalier::environment {
namespace {

/// A share of the stability limit, where dt times the sum of a voxel's conductances is 1 (von Neumann:
/// D dt / h^2 <= 1 / (2 dim)). At one half a single wet voxel spreads without ripples.
constexpr double part_of_limit = 0.5;

/// A row and those around it; a row beyond the domain is the row itself, from which nothing flows.
struct Rows {
    const double *c, *below, *above, *back, *front;
};

Rows rows_around(const WaterGrid& grid, WaterBrick& contents, std::size_t row) {
    const int y = grid.y_of(row), z = grid.z_of(row);
    double* c = contents.data() + grid.row_begin(row);
    c[-1] = c[0];
    c[grid.size().x] = c[grid.size().x - 1];
    const std::size_t slab = grid.stride() * grid.size().y;
    return {c, y > 0 ? c - grid.stride() : c, y + 1 < grid.size().y ? c + grid.stride() : c, z > 0 ? c - slab : c,
            z + 1 < grid.size().z ? c + slab : c};
}

struct Conductances {
    double x, down, up, z;
};

// In both loops below the terms of opposite faces stand in pairs, so that a mirrored field stays mirrored to the bit.

void spread_plain(const Rows& rows, double* __restrict to, int n, const Conductances& k) {
    const double* c = rows.c;
    for (int i = 0; i < n; ++i) {
        const double own = c[i];
        const double x = k.x * ((c[i - 1] - own) + (c[i + 1] - own));
        const double y = k.down * (rows.below[i] - own) + k.up * (rows.above[i] - own);
        const double z = k.z * ((rows.back[i] - own) + (rows.front[i] - own));
        to[i] = own + ((x + y) + z);
    }
}

double open(std::uint8_t bits, int face) {
    return static_cast<double>(bits >> face & 1);
}

void spread_among_obstacles(const Rows& rows, const std::uint8_t* faces, double* __restrict to, int n,
                            const Conductances& k) {
    const double* c = rows.c;
    for (int i = 0; i < n; ++i) {
        const double own = c[i];
        const std::uint8_t f = faces[i];
        const double x = k.x * (open(f, 0) * (c[i - 1] - own) + open(f, 1) * (c[i + 1] - own));
        const double y = k.down * open(f, 2) * (rows.below[i] - own) + k.up * open(f, 3) * (rows.above[i] - own);
        const double z = k.z * (open(f, 4) * (rows.back[i] - own) + open(f, 5) * (rows.front[i] - own));
        to[i] = own + ((x + y) + z);
    }
}

/// The largest sum of conductances that one voxel of an axis of `n` voxels has, for conductance k between voxels.
double sum_along(int n, double k, const WaterSide& lower, const WaterSide& upper) {
    const double at_lower = lower.fixed ? 2 * k : 0;
    const double at_upper = upper.fixed ? 2 * k : 0;
    if (n == 1) return at_lower + at_upper;
    return std::max(k + std::max(at_lower, at_upper), n > 2 ? 2 * k : 0);
}

}  // namespace

WaterDiffusion::WaterDiffusion(const WaterGrid& grid, const WaterParameters& parameters)
    : grid_(grid), sides_(parameters.sides), max_substeps_(parameters.max_substeps), place_(parameters.space.place) {
    const int height = grid.size().y;
    const double h2 = grid.voxel() * grid.voxel();
    for (int y = 0; y < height; ++y) {
        const WaterLayer* layer = parameters.layer_at(grid.centre({0, y, 0}).y);
        const glm::dvec3 d = layer ? layer->diffusion : parameters.diffusion;
        x_.push_back(d.x / h2);
        y_.push_back(d.y / h2);
        z_.push_back(d.z / h2);
    }
    const auto harmonic_mean = [](double a, double b) { return a > 0 && b > 0 ? 2 * a * b / (a + b) : 0; };
    for (int y = 0; y < height; ++y) {
        down_.push_back(y > 0 ? harmonic_mean(y_[y], y_[y - 1]) : 0);
        up_.push_back(y + 1 < height ? harmonic_mean(y_[y], y_[y + 1]) : 0);
        const double across_bottom = y == 0 && sides_[2].fixed ? 2 * y_[y] : 0;
        const double across_top = y + 1 == height && sides_[3].fixed ? 2 * y_[y] : 0;
        outflow_ = std::max(outflow_, sum_along(grid.size().x, x_[y], sides_[0], sides_[1]) +
                                          (down_[y] + up_[y] + across_bottom + across_top) +
                                          sum_along(grid.size().z, z_[y], sides_[4], sides_[5]));
    }
    any_side_ = std::any_of(sides_.begin(), sides_.end(), [](const WaterSide& side) { return side.fixed; });
    inflow_.resize(grid.rows());
}

int WaterDiffusion::substeps(double dt) const {
    const double needed = std::max(1.0, std::ceil(dt * outflow_ / part_of_limit * (1 - 1e-12)));
    if (!(needed <= max_substeps_)) {
        throw UserError(place_, fmt::format("diffusion over a step of {} in voxels of {} m needs {} substeps to be "
                                            "stable, max_substeps is {}: use larger voxels or a smaller diffusion",
                                            format_general(dt), format_general(grid_.voxel()), format_general(needed),
                                            max_substeps_));
    }
    return static_cast<int>(needed);
}

double WaterDiffusion::sweep(const WaterFaces& faces, WaterBrick& from, WaterBrick& to, double dt) {
    const int n = grid_.size().x;
    grid_.for_rows([&](std::size_t row) {
        const int y = grid_.y_of(row);
        const Conductances k{x_[y] * dt, down_[y] * dt, up_[y] * dt, z_[y] * dt};
        const Rows rows = rows_around(grid_, from, row);
        double* out = to.data() + grid_.row_begin(row);
        if (faces.plain_row(row)) {
            spread_plain(rows, out, n, k);
        } else {
            spread_among_obstacles(rows, faces.row(grid_.row_begin(row)), out, n, k);
        }
        if (any_side_) inflow_[row] = cross_sides(faces, rows.c, out, row, dt);
    });
    double inflow = 0;
    if (any_side_) {
        for (const double of_row : inflow_) inflow += of_row;
    }
    return inflow;
}

/// Flow through the fixed sides of the domain, half a voxel from the centres: 2 k (content of the side - own).
double WaterDiffusion::cross_sides(const WaterFaces& faces, const double* c, double* to, std::size_t row,
                                   double dt) const {
    const glm::ivec3 size = grid_.size();
    const int y = grid_.y_of(row), z = grid_.z_of(row);
    const std::uint8_t* bits = faces.row(grid_.row_begin(row));
    double inflow = 0;
    const auto cross = [&](int side, int first, int last, double k) {
        if (!sides_[side].fixed) return;
        for (int x = first; x <= last; ++x) {
            if ((bits[x] & WaterFaces::free_bit) == 0) continue;
            const double flow = 2 * k * dt * (sides_[side].content - c[x]);
            to[x] += flow;
            inflow += flow;
        }
    };
    cross(0, 0, 0, x_[y]);
    cross(1, size.x - 1, size.x - 1, x_[y]);
    if (y == 0) cross(2, 0, size.x - 1, y_[y]);
    if (y + 1 == size.y) cross(3, 0, size.x - 1, y_[y]);
    if (z == 0) cross(4, 0, size.x - 1, z_[y]);
    if (z + 1 == size.z) cross(5, 0, size.x - 1, z_[y]);
    return inflow;
}

double WaterDiffusion::conductance(int y, int face) const {
    switch (face) {
        case 0:
        case 1:
            return x_[y];
        case 2:
            return down_[y];
        case 3:
            return up_[y];
        default:
            return z_[y];
    }
}

WaterDiffusion::AcrossSides WaterDiffusion::across_sides(const glm::ivec3& voxel) const {
    const glm::ivec3 last = grid_.size() - 1;
    const bool at_side[6] = {voxel.x == 0,      voxel.x == last.x, voxel.y == 0,
                             voxel.y == last.y, voxel.z == 0,      voxel.z == last.z};
    const double along[3] = {x_[voxel.y], y_[voxel.y], z_[voxel.y]};
    AcrossSides across;
    for (int side = 0; side < 6; ++side) {
        if (!at_side[side] || !sides_[side].fixed) continue;
        across.conductance += 2 * along[side / 2];
        across.inflow += 2 * along[side / 2] * sides_[side].content;
    }
    return across;
}

double relaxation_sweep(const WaterGrid& grid, const WaterFaces& faces, double w, WaterBrick& from, WaterBrick& to) {
    const glm::ivec3 size = grid.size();
    std::vector<double> largest(grid.rows(), 0);
    grid.for_rows([&](std::size_t row) {
        const int y = grid.y_of(row), z = grid.z_of(row);
        const Rows rows = rows_around(grid, from, row);
        const std::uint8_t* bits = faces.row(grid.row_begin(row));
        double* out = to.data() + grid.row_begin(row);
        for (int x = 0; x < size.x; ++x) {
            const double own = rows.c[x];
            const bool inside[6] = {x > 0, x + 1 < size.x, y > 0, y + 1 < size.y, z > 0, z + 1 < size.z};
            double with[6];
            double count = 0;
            for (int face = 0; face < 6; ++face) {
                with[face] = inside[face] ? open(bits[x], face) : 0;
                count += with[face];
            }
            const double sum = ((with[0] * rows.c[x - 1] + with[1] * rows.c[x + 1]) +
                                (with[2] * rows.below[x] + with[3] * rows.above[x])) +
                               (with[4] * rows.back[x] + with[5] * rows.front[x]);
            out[x] = count > 0 ? (1 - w) * own + w * (sum / count) : own;
            largest[row] = std::max(largest[row], std::abs(out[x] - own));
        }
    });
    return largest.empty() ? 0 : *std::max_element(largest.begin(), largest.end());
}

}  // namespace espalier::environment
