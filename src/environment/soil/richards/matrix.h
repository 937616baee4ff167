// The linear equations of one Newton step: a coefficient for every voxel and each of its faces.
#pragma once

#include "environment/soil/richards/cells.h"

#include <array>
#include <utility>
#include <vector>

namespace espalier::environment {

/// A matrix J of voxels and their neighbours: `diagonal`, and the couplings of the faces that `faces` points to, one
/// for each axis. Its vertical columns can be solved by themselves.
class SoilMatrix {
public:
    explicit SoilMatrix(const SoilRows& rows);

    const SoilRows& rows() const { return rows_; }
    /// product = J v.
    void multiply(WaterBrick& v, WaterBrick& product) const;
    /// Prepares `solve_columns` for the coefficients of now.
    void factorise();
    /// Solves J z = r in every vertical column, as if it had no neighbours (line Jacobi).
    void solve_columns(const WaterBrick& r, WaterBrick& z) const;
    /// Calls work(cell) for all voxels, in parallel where that pays.
    template <class Work>
    void for_cells(Work work) const {
        const WaterGrid& grid = rows_.grid();
        grid.for_rows([&](std::size_t row) { grid.for_cells_of(row, work); });
    }

    /// J lacks factor u u^T for each of these; `solve_columns` does without.
    struct RankOne {
        std::vector<std::pair<std::size_t, double>> u;  ///< of some cells
        double factor = 0;
    };

    WaterBrick diagonal;
    std::vector<RankOne> less;
    std::array<const FaceCouplings*, 3> faces{};

private:
    void multiply_row(std::size_t row, const double* v, double* product) const;
    template <class Work>
    void for_columns(Work work) const;

    SoilRows rows_;
    WaterBrick pivot_, upper_;  ///< of the columns' factors
};

}  // namespace espalier::environment
