#include "environment/soil/richards/linear_system.h"

#include <cmath>

namespace espalier::environment {
namespace {

constexpr int most_iterations = 100;
constexpr int few_iterations = 2;  ///< with columns alone: a cycle of multigrid costs four times as much

}  // namespace

SoilLinearSystem::SoilLinearSystem(const SoilRows& rows) : matrix_(rows), sums_(rows.grid().rows()) {
    for (WaterBrick* brick : {&r_, &r0_, &p_, &v_, &s_, &t_, &y_}) brick->assign(rows.grid().cells(), 0.0);
    if (const glm::ivec3 size = rows.grid().size(); SoilBand::pays(size.x * size.z)) band_.emplace(rows);
}

double SoilLinearSystem::dot(const WaterBrick& a, const WaterBrick& b) {
    const WaterGrid& grid = matrix_.rows().grid();
    grid.for_rows([&](std::size_t row) {
        double sum = 0;
        grid.for_cells_of(row, [&](std::size_t c) { sum += a[c] * b[c]; });
        sums_[row] = sum;
    });
    double sum = 0;
    for (const double of_row : sums_) sum += of_row;
    return sum;
}

void SoilLinearSystem::precondition(By by, const WaterBrick& r, WaterBrick& z) {
    switch (by) {
        case By::columns:
            return matrix_.solve_columns(r, z);
        case By::multigrid:
            return multigrid_->cycle(matrix_, r, z);
        case By::band:
            return band_->solve(r, z);
    }
}

int SoilLinearSystem::solve(const std::array<FaceFluxes, 3>& fluxes, const WaterBrick& b, double tolerance,
                            WaterBrick& x) {
    for (std::size_t axis = 0; axis < 3; ++axis) matrix_.faces[axis] = &fluxes[axis];
    const double goal = tolerance * tolerance * dot(b, b);
    if (band_) {
        band_->factorise(matrix_.diagonal, matrix_.faces);
        band_->solve(b, x);
        return improve(By::band, goal, b, x);
    }
    matrix_.factorise();
    // The columns' own solution to begin with: it is the solution where nothing flows across.
    matrix_.solve_columns(b, x);
    const int quick = improve(By::columns, goal, b, x);
    if (quick >= 0) return quick;
    if (!multigrid_) multigrid_.emplace(matrix_.rows());
    multigrid_->coarsen(matrix_);
    return improve(By::multigrid, goal, b, x);
}

/// BiCGSTAB from x on; returns the iterations, or -1 if it does not come so far in as many as are allowed.
int SoilLinearSystem::improve(By by, double goal, const WaterBrick& b, WaterBrick& x) {
    matrix_.multiply(x, v_);
    matrix_.for_cells([&](std::size_t c) { p_[c] = r0_[c] = r_[c] = b[c] - v_[c]; });
    double rho = dot(r0_, r_);
    if (rho <= goal) return 0;
    const int most = by == By::columns ? few_iterations : most_iterations;
    for (int iteration = 1; iteration <= most; ++iteration) {
        precondition(by, p_, y_);
        matrix_.multiply(y_, v_);
        const double along = dot(r0_, v_);
        if (along == 0 || !std::isfinite(along)) return -1;
        const double alpha = rho / along;
        matrix_.for_cells([&](std::size_t c) {
            x[c] += alpha * y_[c];
            s_[c] = r_[c] - alpha * v_[c];
        });
        precondition(by, s_, y_);
        matrix_.multiply(y_, t_);
        const double tt = dot(t_, t_);
        const double omega = tt > 0 ? dot(t_, s_) / tt : 0;
        matrix_.for_cells([&](std::size_t c) {
            x[c] += omega * y_[c];
            r_[c] = s_[c] - omega * t_[c];
        });
        if (dot(r_, r_) <= goal) return iteration;
        const double next = dot(r0_, r_);
        if (omega == 0 || rho == 0 || !std::isfinite(next)) return -1;
        const double beta = next / rho * (alpha / omega);
        rho = next;
        matrix_.for_cells([&](std::size_t c) { p_[c] = r_[c] + beta * (p_[c] - omega * v_[c]); });
    }
    return -1;
}

}  // namespace espalier::environment
