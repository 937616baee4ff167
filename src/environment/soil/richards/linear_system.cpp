#include "environment/soil/richards/linear_system.h"

#include <algorithm>
#include <cmath>

namespace espalier::environment {

SoilLinearSystem::SoilLinearSystem(const SoilLayout& layout) : layout_(layout), sums_(layout.grid().rows()) {
    for (WaterBrick* brick : {&diagonal, &pivot_, &upper_, &r_, &r0_, &p_, &v_, &s_, &t_, &y_}) {
        brick->assign(layout.grid().cells(), 0.0);
    }
}

/// Calls work(z, first x, end x) for bundles of columns, in parallel where that pays.
template <class Work>
void SoilLinearSystem::for_columns(Work work) const {
    const glm::ivec3 size = layout_.grid().size();
    constexpr int bundle = 32;
    const int bundles = (size.x + bundle - 1) / bundle;
    const auto part = [&](int i) {
        const int z = i / bundles, x = i % bundles * bundle;
        work(z, x, std::min(x + bundle, size.x));
    };
    if (layout_.grid().voxels() < 8192) {
        for (int i = 0; i < bundles * size.z; ++i) part(i);
    } else {
        for_in_parallel(0, bundles * size.z, part);
    }
}

void SoilLinearSystem::factorise(const FaceFluxes& vertical) {
    const WaterGrid& grid = layout_.grid();
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

void SoilLinearSystem::precondition(const FaceFluxes& vertical, const WaterBrick& r, WaterBrick& z_out) const {
    const WaterGrid& grid = layout_.grid();
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

void SoilLinearSystem::multiply(const std::array<FaceFluxes, 3>& fluxes, WaterBrick& v, WaterBrick& product) const {
    const int n = layout_.grid().size().x;
    const FaceFluxes &fx = fluxes[0], &fy = fluxes[1], &fz = fluxes[2];
    layout_.for_rows([&](std::size_t row) { layout_.wrap(v.data() + layout_.grid().row_begin(row)); });
    layout_.for_rows([&](std::size_t row) {
        const NeighbourRows at = layout_.neighbours(row);
        for (int x = 0; x < n; ++x) {
            const std::size_t c = at.own + x, d = at.below + x, b = at.back + x;
            double sum = diagonal[c] * v[c];
            sum += fx.by_next[c] * v[c + 1] - fx.by_own[c - 1] * v[c - 1];
            if (at.has_above) sum += fy.by_next[c] * v[at.above + x];
            if (d != c) sum -= fy.by_own[d] * v[d];
            if (at.has_front) sum += fz.by_next[c] * v[at.front + x];
            if (b != c) sum -= fz.by_own[b] * v[b];
            product[c] = sum;
        }
    });
    for (const RankOne& one : less) {
        double along = 0;
        for (const auto& [c, u] : one.u) along += u * v[c];
        for (const auto& [c, u] : one.u) product[c] -= one.factor * along * u;
    }
}

double SoilLinearSystem::dot(const WaterBrick& a, const WaterBrick& b) {
    const WaterGrid& grid = layout_.grid();
    layout_.for_rows([&](std::size_t row) {
        double sum = 0;
        const std::size_t begin = grid.row_begin(row);
        for (std::size_t c = begin; c < begin + grid.size().x; ++c) sum += a[c] * b[c];
        sums_[row] = sum;
    });
    double sum = 0;
    for (const double of_row : sums_) sum += of_row;
    return sum;
}

int SoilLinearSystem::solve(const std::array<FaceFluxes, 3>& fluxes, const WaterBrick& b, double tolerance,
                            WaterBrick& x) {
    const auto combine = [&](auto value) {
        layout_.for_rows([&](std::size_t row) {
            const std::size_t begin = layout_.grid().row_begin(row);
            for (std::size_t c = begin; c < begin + layout_.grid().size().x; ++c) value(c);
        });
    };
    factorise(fluxes[1]);
    const double goal = tolerance * tolerance * dot(b, b);
    // The columns' own solution to begin with: it is the solution where nothing flows across.
    precondition(fluxes[1], b, x);
    multiply(fluxes, x, v_);
    combine([&](std::size_t c) { p_[c] = r0_[c] = r_[c] = b[c] - v_[c]; });
    double rho = dot(r0_, r_);
    if (rho <= goal) return 0;
    for (int iteration = 1; iteration <= 400; ++iteration) {
        precondition(fluxes[1], p_, y_);
        multiply(fluxes, y_, v_);
        const double along = dot(r0_, v_);
        if (along == 0 || !std::isfinite(along)) return -1;
        const double alpha = rho / along;
        combine([&](std::size_t c) {
            x[c] += alpha * y_[c];
            s_[c] = r_[c] - alpha * v_[c];
        });
        precondition(fluxes[1], s_, y_);
        multiply(fluxes, y_, t_);
        const double tt = dot(t_, t_);
        const double omega = tt > 0 ? dot(t_, s_) / tt : 0;
        combine([&](std::size_t c) {
            x[c] += omega * y_[c];
            r_[c] = s_[c] - omega * t_[c];
        });
        if (dot(r_, r_) <= goal) return iteration;
        const double next = dot(r0_, r_);
        if (omega == 0 || rho == 0 || !std::isfinite(next)) return -1;
        const double beta = next / rho * (alpha / omega);
        rho = next;
        combine([&](std::size_t c) { p_[c] = r_[c] + beta * (p_[c] - omega * v_[c]); });
    }
    return -1;
}

}  // namespace espalier::environment
