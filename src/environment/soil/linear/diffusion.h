// Water moving between voxels: explicit finite volumes, and the relaxation rule of older programs.
#pragma once

#include "environment/soil/grid/grid.h"
#include "environment/soil/linear/parameters.h"

#include <vector>

namespace espalier::environment {

/// Linear diffusion, dc/dt = div(D grad c), by explicit finite volumes: what leaves a voxel through a face enters its
/// neighbour. D depends on the layer; across layers the harmonic mean counts (Patankar 1980, eq. 4.9).
class WaterDiffusion {
public:
    WaterDiffusion(const WaterGrid& grid, const WaterParameters& parameters);

    /// How many equal substeps bring contents stably over `dt`. Throws UserError beyond the parameters' bound.
    int substeps(double dt) const;

    /// One substep of `dt` from `from` to `to`; writes `from`'s spare cells. Returns what came in through the sides,
    /// in content times voxels.
    double sweep(const WaterFaces& faces, WaterBrick& from, WaterBrick& to, double dt);

    /// Between a voxel at height index y and its neighbour across a face (-x, +x, -y, +y, -z, +z), over voxel volume,
    /// 1 per time unit.
    double conductance(int y, int face) const;

    /// What joins a voxel to the fixed sides of the domain: conductances, and conductances times the sides' contents.
    struct AcrossSides {
        double conductance = 0, inflow = 0;
    };
    AcrossSides across_sides(const glm::ivec3& voxel) const;

    const Place& place() const { return place_; }  ///< where the process stands in its scene

private:
    double cross_sides(const WaterFaces& faces, const double* c, double* to, std::size_t row, double dt) const;

    WaterGrid grid_;
    std::array<WaterSide, 6> sides_;
    bool any_side_ = false;
    int max_substeps_;
    Place place_;
    /// Conductances over voxel volume, 1 per time unit, by height: along x, to y - 1, to y + 1, along z.
    std::vector<double> x_, down_, up_, z_;
    std::vector<double> y_;       ///< within the height itself: half a voxel to a side and half beyond
    double outflow_ = 0;          ///< the largest sum of conductances of one voxel
    std::vector<double> inflow_;  ///< per row
};

/// new = (1 - w) old + w * mean of the free face neighbours; a voxel without any keeps its content. Writes `from`'s
/// spare cells; returns the largest change.
double relaxation_sweep(const WaterGrid& grid, const WaterFaces& faces, double w, WaterBrick& from, WaterBrick& to);

}  // namespace espalier::environment
