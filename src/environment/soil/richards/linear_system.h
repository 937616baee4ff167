// The solution of the linear equations of one Newton step.
#pragma once

#include "environment/soil/richards/band.h"
#include "environment/soil/richards/multigrid.h"

#include <optional>

namespace espalier::environment {

/// Solves J x = b, where J has `diagonal` and, for neighbours, the derivatives of the fluxes: BiCGSTAB (van der Vorst
/// 1992), preconditioned by the exact solution of every vertical column by itself; and by multigrid where that does not
/// come far, as in full soil, which stores nothing. A soil of one column or a few is solved at once. Sums are taken row
/// by row, so that any number of threads gives the same bits.
class SoilLinearSystem {
public:
    explicit SoilLinearSystem(const SoilRows& rows);

    WaterBrick& diagonal() { return matrix_.diagonal; }
    std::vector<SoilMatrix::RankOne>& less() { return matrix_.less; }
    /// Solves to a residual of `tolerance` times that of x = 0; returns the iterations, or -1 if it did not come so
    /// far.
    int solve(const std::array<FaceFluxes, 3>& fluxes, const WaterBrick& b, double tolerance, WaterBrick& x);

private:
    enum class By { columns, multigrid, band };
    int improve(By by, double goal, const WaterBrick& b, WaterBrick& x);
    void precondition(By by, const WaterBrick& r, WaterBrick& z);
    double dot(const WaterBrick& a, const WaterBrick& b);

    SoilMatrix matrix_;
    std::optional<SoilMultigrid> multigrid_;  ///< once it was needed
    std::optional<SoilBand> band_;            ///< for two columns and a few more
    WaterBrick r_, r0_, p_, v_, s_, t_, y_;
    std::vector<double> sums_;  ///< per row
};

}  // namespace espalier::environment
