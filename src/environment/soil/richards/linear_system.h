// The linear equations of one Newton step: a coefficient for every voxel and each of its faces.
#pragma once

#include "environment/soil/richards/cells.h"

namespace espalier::environment {

/// Solves J x = b, where J has `diagonal` and, for neighbours, the derivatives of the fluxes: BiCGSTAB (van der Vorst
/// 1992), preconditioned by the exact solution of every vertical column by itself (line Jacobi). A soil of one column
/// is solved at once. Sums are taken row by row, so that any number of threads gives the same bits.
class SoilLinearSystem {
public:
    explicit SoilLinearSystem(const SoilLayout& layout);

    WaterBrick diagonal;
    /// J lacks factor u u^T for each of these.
    struct RankOne {
        std::vector<std::pair<std::size_t, double>> u;  ///< of some cells
        double factor = 0;
    };
    std::vector<RankOne> less;
    /// Solves to a residual of `tolerance` times that of x = 0; returns the iterations, or -1 if it did not come so
    /// far.
    int solve(const std::array<FaceFluxes, 3>& fluxes, const WaterBrick& b, double tolerance, WaterBrick& x);

private:
    void factorise(const FaceFluxes& vertical);
    void precondition(const FaceFluxes& vertical, const WaterBrick& r, WaterBrick& z) const;
    void multiply(const std::array<FaceFluxes, 3>& fluxes, WaterBrick& v, WaterBrick& product) const;
    double dot(const WaterBrick& a, const WaterBrick& b);
    template <class Work>
    void for_columns(Work work) const;

    const SoilLayout& layout_;
    WaterBrick pivot_, upper_;  ///< of the columns' factors
    WaterBrick r_, r0_, p_, v_, s_, t_, y_;
    std::vector<double> sums_;  ///< per row
};

}  // namespace espalier::environment
