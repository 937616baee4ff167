#include "environment/soil/richards/matrix.h"

#include <algorithm>

namespace espalier::environment {

SoilMatrix::SoilMatrix(const SoilRows& rows) : rows_(rows) {
    for (WaterBrick* brick : {&diagonal, &pivot_, &upper_}) brick->assign(rows.grid().cells(), 0.0);
}

/// Calls work(z, first x, end x) for bundles of columns, in parallel where that pays.
template <class Work>
void SoilMatrix::for_columns(Work work) const {
    const glm::ivec3 size = rows_.grid().size();
    constexpr int bundle = 32;
    const int bundles = (size.x + bundle - 1) / bundle;
    const auto part = [&](int i) {
        const int z = i / bundles, x = i % bundles * bundle;
        work(z, x, std::min(x + bundle, size.x));
    };
    if (rows_.grid().voxels() < 8192) {
        for (int i = 0; i < bundles * size.z; ++i) part(i);
    } else {
        for_in_parallel(0, bundles * size.z, part);
    }
}

void SoilMatrix::factorise() {
    const WaterGrid& grid = rows_.grid();
    const FaceCouplings& vertical = *faces[1];
    for_columns([&](int z, int first, int end) {
        for (int y = 0; y < grid.size().y; ++y) {
            const std::size_t row = grid.cell({0, y, z});
            for (std::size_t c = row + first; c < row + end; ++c) {
                const double lower = y > 0 ? -vertical.by_own[c - grid.stride()] * upper_[c - grid.stride()] : 0;
                pivot_[c] = 1 / (diagonal[c] - lower);
                upper_[c] = vertical.by_next[c] * pivot_[c];
            }
        }
    });
}

void SoilMatrix::solve_columns(const WaterBrick& r, WaterBrick& z_out) const {
    const WaterGrid& grid = rows_.grid();
    const FaceCouplings& vertical = *faces[1];
    const std::size_t stride = grid.stride();
    for_columns([&](int z, int first, int end) {
        for (int y = 0; y < grid.size().y; ++y) {
            const std::size_t row = grid.cell({0, y, z});
            for (std::size_t c = row + first; c < row + end; ++c) {
                const double below = y > 0 ? vertical.by_own[c - stride] * z_out[c - stride] : 0;
                z_out[c] = (r[c] + below) * pivot_[c];
            }
        }
        for (int y = grid.size().y - 2; y >= 0; --y) {
            const std::size_t row = grid.cell({0, y, z});
            for (std::size_t c = row + first; c < row + end; ++c) z_out[c] -= upper_[c] * z_out[c + stride];
        }
    });
}

void SoilMatrix::multiply(WaterBrick& v, WaterBrick& product) const {
    const WaterGrid& grid = rows_.grid();
    grid.for_rows([&](std::size_t row) { rows_.wrap(v.data() + grid.row_begin(row)); });
    grid.for_rows([&](std::size_t row) { multiply_row(row, v.data(), product.data()); });
    for (const RankOne& one : less) {
        double along = 0;
        for (const auto& [c, u] : one.u) along += u * v[c];
        for (const auto& [c, u] : one.u) product[c] -= one.factor * along * u;
    }
}

/// An axis after the other: plain loops over contiguous numbers.
void SoilMatrix::multiply_row(std::size_t row, const double* v, double* product) const {
    const FaceCouplings &fx = *faces[0], &fy = *faces[1], &fz = *faces[2];
    const NeighbourRows at = rows_.neighbours(row);
    const auto n = static_cast<std::size_t>(rows_.grid().size().x);
    const double* const own = v + at.own;
    double* const sum = product + at.own;
    const double *d = diagonal.data() + at.own, *east = fx.by_next.data() + at.own, *west = fx.by_own.data() + at.own;
    for (std::size_t x = 0; x < n; ++x) sum[x] = d[x] * own[x] + (east[x] * own[x + 1] - west[x - 1] * own[x - 1]);
    const auto add = [&](const WaterBrick& coupling, std::size_t face, std::size_t other, double sign) {
        const double *c = coupling.data() + face, *beyond = v + other;
        for (std::size_t x = 0; x < n; ++x) sum[x] += sign * c[x] * beyond[x];
    };
    if (at.has_above) add(fy.by_next, at.own, at.above, 1);
    if (at.below != at.own) add(fy.by_own, at.below, at.below, -1);
    if (at.has_front) add(fz.by_next, at.own, at.front, 1);
    if (at.back != at.own) add(fz.by_own, at.back, at.back, -1);
}

}  // namespace espalier::environment
