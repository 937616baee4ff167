#include "environment/soil/linear/steady.h"

#include "espalier/base/stop.h"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <limits>

namespace espalier::environment {
namespace {

/// The diagonal, which the solver asks in each of its iterations.
struct Preconditioner : Eigen::DiagonalPreconditioner<double> {
    template <class Vector>
    auto solve(const Eigen::MatrixBase<Vector>& residual) const {
        end_if_asked();
        return Eigen::DiagonalPreconditioner<double>::solve(residual);
    }
};

constexpr std::size_t not_numbered = std::numeric_limits<std::size_t>::max();

/// Calls visit(neighbour's cell, conductance) for every free neighbour that exchanges water with a voxel.
template <class Visit>
void for_neighbours(const WaterGrid& grid, const WaterFaces& faces, const WaterDiffusion& diffusion,
                    const glm::ivec3& voxel, Visit visit) {
    static constexpr glm::ivec3 steps[6] = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}};
    const std::uint8_t bits = faces.bits(grid.cell(voxel));
    for (int face = 0; face < 6; ++face) {
        const double conductance = diffusion.conductance(voxel.y, face);
        // A face of the domain itself counts as open in `bits`.
        if ((bits >> face & 1) == 0 || conductance <= 0 || !grid.has(voxel + steps[face])) continue;
        visit(grid.cell(voxel + steps[face]), conductance);
    }
}

/// Soil that exchanges water within itself: its voxels, and whether a side or a held voxel fixes its level.
struct Part {
    std::vector<glm::ivec3> voxels;
    double sum = 0, gain = 0;
    bool fixed = false;
};

class SteadyState {
public:
    SteadyState(const WaterGrid& grid, const WaterFaces& faces, const WaterDiffusion& diffusion,
                const WaterForcing& forcing, WaterBrick& contents)
        : grid_(grid), faces_(faces), diffusion_(diffusion), forcing_(forcing), contents_(contents) {}

    void settle();

private:
    Part part_of(const glm::ivec3& seed);
    void level(const Part& part);
    void number(const Part& part);
    void solve();

    const WaterGrid& grid_;
    const WaterFaces& faces_;
    const WaterDiffusion& diffusion_;
    const WaterForcing& forcing_;
    WaterBrick& contents_;
    std::vector<std::uint8_t> seen_;
    std::vector<std::size_t> row_of_cell_;
    std::vector<glm::ivec3> unknowns_;
};

void SteadyState::settle() {
    seen_.assign(grid_.cells(), 0);
    row_of_cell_.assign(grid_.cells(), not_numbered);
    faces_.for_each_free(grid_, [&](std::size_t cell) {
        if (forcing_.held[cell] || seen_[cell]) return;
        const Part part = part_of(grid_.voxel_of(cell));
        part.fixed ? number(part) : level(part);
    });
    if (!unknowns_.empty()) solve();
}

Part SteadyState::part_of(const glm::ivec3& seed) {
    Part part;
    part.voxels.push_back(seed);
    seen_[grid_.cell(seed)] = 1;
    for (std::size_t i = 0; i < part.voxels.size(); ++i) {
        const glm::ivec3 voxel = part.voxels[i];
        const std::size_t own = grid_.cell(voxel);
        part.sum += contents_[own];
        part.gain += forcing_.gain[own];
        part.fixed = part.fixed || diffusion_.across_sides(voxel).conductance > 0;
        for_neighbours(grid_, faces_, diffusion_, voxel, [&](std::size_t cell, double) {
            if (forcing_.held[cell]) part.fixed = true;
            if (forcing_.held[cell] || seen_[cell]) return;
            seen_[cell] = 1;
            part.voxels.push_back(grid_.voxel_of(cell));
        });
    }
    return part;
}

void SteadyState::level(const Part& part) {
    if (part.gain > 0) {
        throw UserError(diffusion_.place(),
                        "begin = \"steady\": a source brings water into soil that nothing leaves, so it never settles; "
                        "open a side or hold a source at a content");
    }
    for (const glm::ivec3& voxel : part.voxels) {
        contents_[grid_.cell(voxel)] = part.sum / static_cast<double>(part.voxels.size());
    }
}

void SteadyState::number(const Part& part) {
    for (const glm::ivec3& voxel : part.voxels) {
        row_of_cell_[grid_.cell(voxel)] = unknowns_.size();
        unknowns_.push_back(voxel);
    }
}

void SteadyState::solve() {
    const auto n = static_cast<Eigen::Index>(unknowns_.size());
    Eigen::SparseMatrix<double, Eigen::RowMajor> system(n, n);
    system.reserve(Eigen::VectorXi::Constant(n, 7));
    Eigen::VectorXd right(n), start(n);
    StopCheck<4096> check_stop;
    for (Eigen::Index row = 0; row < n; ++row) {
        check_stop();
        const glm::ivec3 voxel = unknowns_[static_cast<std::size_t>(row)];
        const std::size_t own = grid_.cell(voxel);
        const WaterDiffusion::AcrossSides sides = diffusion_.across_sides(voxel);
        double diagonal = sides.conductance;
        right[row] = sides.inflow + forcing_.gain[own];
        for_neighbours(grid_, faces_, diffusion_, voxel, [&](std::size_t cell, double conductance) {
            diagonal += conductance;
            if (forcing_.held[cell]) {
                right[row] += conductance * contents_[cell];
            } else {
                system.insert(row, static_cast<Eigen::Index>(row_of_cell_[cell])) = -conductance;
            }
        });
        system.insert(row, row) = diagonal;
        start[row] = contents_[own];
    }
    system.makeCompressed();

    Eigen::ConjugateGradient<Eigen::SparseMatrix<double, Eigen::RowMajor>, Eigen::Lower | Eigen::Upper, Preconditioner>
        solver;
    solver.setTolerance(1e-12);
    solver.compute(system);
    const Eigen::VectorXd solution = solver.solveWithGuess(right, start);
    if (solver.info() != Eigen::Success || !solution.allFinite()) {
        throw RunError("begin = \"steady\": the soil's steady state could not be found");
    }
    // The maximum principle holds for the exact solution; rounding must not make water negative.
    for (Eigen::Index row = 0; row < n; ++row) {
        contents_[grid_.cell(unknowns_[static_cast<std::size_t>(row)])] = std::max(0.0, solution[row]);
    }
}

}  // namespace

void settle(const WaterGrid& grid, const WaterFaces& faces, const WaterDiffusion& diffusion,
            const WaterForcing& forcing, WaterBrick& contents) {
    SteadyState(grid, faces, diffusion, forcing, contents).settle();
}

}  // namespace espalier::environment
