// The exact solution of the linear equations of few columns of soil.
#pragma once

#include "environment/soil/richards/cells.h"

#include <array>
#include <vector>

namespace espalier::environment {

/// Gauss elimination of a matrix whose unknowns stand layer by layer: with m columns, a voxel's neighbours are at most
/// m places away, and so is all that elimination fills. Its time grows with m^2 for each voxel. Rows keep their order:
/// in a soil's equations the diagonal outweighs the rest of its column.
class SoilBand {
public:
    /// With more than twelve, iterations take less time; one alone needs no band.
    static bool pays(double columns) { return columns > 1 && columns <= 12; }
    static double bytes_per_voxel(double columns) { return 8 * (2 * columns + 3); }

    explicit SoilBand(const SoilRows& rows);

    /// Takes the coefficients of SoilMatrix and eliminates.
    void factorise(const WaterBrick& diagonal, const std::array<const FaceCouplings*, 3>& faces);
    /// Solves J z = r.
    void solve(const WaterBrick& r, WaterBrick& z);

private:
    void set(const WaterBrick& diagonal, const std::array<const FaceCouplings*, 3>& faces);
    void eliminate();
    double* row(std::size_t place) { return band_.data() + place * width(); }
    std::size_t width() const { return 2 * columns_ + 1; }

    SoilRows rows_;
    std::size_t columns_;
    std::vector<std::size_t> cells_;  ///< of the unknowns
    /// For each unknown, the coefficients of those up to m places before and behind; once eliminated, those before are
    /// factors, and the diagonal is the reciprocal of its pivot.
    std::vector<double> band_;
    std::vector<double> solution_;
};

}  // namespace espalier::environment
