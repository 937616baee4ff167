// Multigrid for the linear equations of soil in which water spreads sideways as fast as down.
#pragma once

#include "environment/soil/richards/matrix.h"

#include <vector>

namespace espalier::environment {

/// Columns are merged with their neighbours, two by two in x and in z, level by level; heights stay (semicoarsening,
/// Schaffer 1998). Smoother: damped line Jacobi. A coarser level is the sum of the equations of its voxels, with
/// couplings sideways of the greater distance between its columns.
class SoilMultigrid {
public:
    explicit SoilMultigrid(const SoilRows& finest);

    /// Sets the coarser levels from a matrix.
    void coarsen(const SoilMatrix& finest);
    /// An approximate solution of J z = r: one V-cycle.
    void cycle(const SoilMatrix& finest, const WaterBrick& r, WaterBrick& z) { cycle(0, finest, r, z); }

private:
    /// What a level keeps, with what the level before it, from which it came, needs to work.
    struct Level {
        Level(const SoilRows& finer, const SoilRows& own, const glm::ivec3& merged);
        glm::ivec3 merged;  ///< voxels of the level before in one of this, along each axis
        SoilMatrix matrix;
        std::array<FaceCouplings, 3> faces;
        WaterBrick r, z;
        WaterBrick rest, change;  ///< of the level before
    };
    static void coarsen(const SoilMatrix& fine, Level& coarse);
    static void merge(const SoilMatrix& fine, Level& coarse, const glm::ivec3& at);
    static void widen(Level& coarse, std::size_t row);
    void cycle(std::size_t level, const SoilMatrix& matrix, const WaterBrick& r, WaterBrick& z);

    std::vector<Level> levels_;
};

}  // namespace espalier::environment
