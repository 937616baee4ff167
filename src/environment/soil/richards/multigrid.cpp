#include "environment/soil/richards/multigrid.h"

#include <glm/common.hpp>

#include <algorithm>

namespace espalier::environment {
namespace {

constexpr double damping = 0.8;  ///< of line Jacobi: the best for changes from column to column

/// Calls visit(fine cell, its voxel) for the voxels that lie in one of a coarser level.
template <class Visit>
void for_children(const WaterGrid& fine, const glm::ivec3& merged, const glm::ivec3& at, Visit visit) {
    const glm::ivec3 first = at * merged, end = glm::min(first + merged, fine.size());
    for (int z = first.z; z < end.z; ++z) {
        for (int x = first.x; x < end.x; ++x) visit(fine.cell({x, at.y, z}), glm::ivec3(x, at.y, z));
    }
}

}  // namespace

SoilMultigrid::Level::Level(const SoilRows& finer, const SoilRows& own, const glm::ivec3& merged)
    : merged(merged), matrix(own) {
    for (std::size_t axis = 0; axis < 3; ++axis) faces[axis].resize(own.grid().cells());
    for (WaterBrick* brick : {&r, &z}) brick->assign(own.grid().cells(), 0.0);
    for (WaterBrick* brick : {&rest, &change}) brick->assign(finer.grid().cells(), 0.0);
}

SoilMultigrid::SoilMultigrid(const SoilRows& finest) {
    SoilRows rows = finest;
    while (rows.grid().size().x * rows.grid().size().z > 1) {
        const glm::ivec3 size = rows.grid().size();
        const glm::ivec3 merged(size.x > 1 ? 2 : 1, 1, size.z > 1 ? 2 : 1), fewer = (size + merged - 1) / merged;
        const SoilRows coarser(WaterGrid(Box{glm::dvec3(0), glm::dvec3(fewer)}, 1, false),
                               rows.joined_x() || rows.joined_z());
        levels_.emplace_back(rows, coarser, merged);
        rows = coarser;
    }
}

void SoilMultigrid::coarsen(const SoilMatrix& finest) {
    const SoilMatrix* fine = &finest;
    for (Level& level : levels_) {
        coarsen(*fine, level);
        fine = &level.matrix;
    }
}

void SoilMultigrid::coarsen(const SoilMatrix& fine, Level& coarse) {
    const WaterGrid& grid = coarse.matrix.rows().grid();
    for (std::size_t axis = 0; axis < 3; ++axis) coarse.matrix.faces[axis] = &coarse.faces[axis];
    grid.for_rows([&](std::size_t row) {
        for (int x = 0; x < grid.size().x; ++x) merge(fine, coarse, {x, grid.y_of(row), grid.z_of(row)});
        for (WaterBrick* brick : {&coarse.faces[0].by_own, &coarse.faces[0].by_next}) {
            coarse.matrix.rows().wrap(brick->data() + grid.row_begin(row));
        }
    });
    grid.for_rows([&](std::size_t row) { widen(coarse, row); });
    coarse.matrix.factorise();
}

/// The sum of the equations of the voxels that lie in one, for heads that are the same in them. Couplings sideways are
/// those of twice the distance.
void SoilMultigrid::merge(const SoilMatrix& fine, Level& coarse, const glm::ivec3& at) {
    const WaterGrid& grid = fine.rows().grid();
    const std::size_t own = coarse.matrix.rows().grid().cell(at);
    double diagonal = 0;
    std::array<double, 3> by_own{}, by_next{};
    for_children(grid, coarse.merged, at, [&](std::size_t c, const glm::ivec3& voxel) {
        diagonal += fine.diagonal[c];
        for (int axis = 0; axis < 3; ++axis) {
            const FaceCouplings& face = *fine.faces[axis];
            const int next = (voxel[axis] + 1) % grid.size()[axis];
            if (axis != 1 && next / coarse.merged[axis] == at[axis]) {
                diagonal += face.by_next[c] - face.by_own[c];
            } else {
                by_own[axis] += face.by_own[c] / coarse.merged[axis];
                by_next[axis] += face.by_next[c] / coarse.merged[axis];
            }
        }
    });
    coarse.matrix.diagonal[own] = diagonal;
    for (int axis = 0; axis < 3; ++axis) {
        coarse.faces[axis].by_own[own] = by_own[axis];
        coarse.faces[axis].by_next[own] = by_next[axis];
    }
}

/// Takes the part of the couplings that the greater distance took away out of the diagonal.
void SoilMultigrid::widen(Level& coarse, std::size_t row) {
    const NeighbourRows at = coarse.matrix.rows().neighbours(row);
    const FaceCouplings &fx = coarse.faces[0], &fz = coarse.faces[2];
    const double x_part = coarse.merged.x - 1, z_part = coarse.merged.z - 1;
    for (int x = 0; x < coarse.matrix.rows().grid().size().x; ++x) {
        const std::size_t c = at.own + x, back = at.back + x;
        double& diagonal = coarse.matrix.diagonal[c];
        diagonal += x_part * (fx.by_next[c - 1] - fx.by_own[c]) - z_part * fz.by_own[c];
        if (back != c) diagonal += z_part * fz.by_next[back];
    }
}

void SoilMultigrid::cycle(std::size_t depth, const SoilMatrix& matrix, const WaterBrick& r, WaterBrick& z) {
    matrix.solve_columns(r, z);
    if (depth == levels_.size()) return;
    Level& coarse = levels_[depth];
    WaterBrick &rest = coarse.rest, &change = coarse.change;
    matrix.for_cells([&](std::size_t c) { z[c] *= damping; });
    matrix.multiply(z, rest);
    const WaterGrid &fine = matrix.rows().grid(), &grid = coarse.matrix.rows().grid();
    coarse.matrix.for_cells([&](std::size_t own) {
        double sum = 0;
        for_children(fine, coarse.merged, grid.voxel_of(own),
                     [&](std::size_t c, const glm::ivec3&) { sum += r[c] - rest[c]; });
        coarse.r[own] = sum;
    });
    cycle(depth + 1, coarse.matrix, coarse.r, coarse.z);
    coarse.matrix.for_cells([&](std::size_t own) {
        for_children(fine, coarse.merged, grid.voxel_of(own),
                     [&](std::size_t c, const glm::ivec3&) { z[c] += coarse.z[own]; });
    });
    matrix.multiply(z, rest);
    matrix.for_cells([&](std::size_t c) { rest[c] = r[c] - rest[c]; });
    matrix.solve_columns(rest, change);
    matrix.for_cells([&](std::size_t c) { z[c] += damping * change[c]; });
}

}  // namespace espalier::environment
