#include "environment/soil/richards/band.h"

#include <algorithm>

namespace espalier::environment {

SoilBand::SoilBand(const SoilRows& rows)
    : rows_(rows), columns_(std::size_t(rows.grid().size().x) * rows.grid().size().z) {
    const glm::ivec3 size = rows.grid().size();
    for (int y = 0; y < size.y; ++y) {
        for (int z = 0; z < size.z; ++z) {
            for (int x = 0; x < size.x; ++x) cells_.push_back(rows.grid().cell({x, y, z}));
        }
    }
    band_.resize(cells_.size() * width());
    solution_.resize(cells_.size());
}

void SoilBand::factorise(const WaterBrick& diagonal, const std::array<const FaceCouplings*, 3>& faces) {
    set(diagonal, faces);
    eliminate();
}

void SoilBand::set(const WaterBrick& diagonal, const std::array<const FaceCouplings*, 3>& faces) {
    std::fill(band_.begin(), band_.end(), 0.0);
    const glm::ivec3 size = rows_.grid().size();
    const auto place = [&](int x, int y, int z) { return (std::size_t(y) * size.z + z) * size.x + x; };
    for (std::size_t own = 0; own < cells_.size(); ++own) {
        const std::size_t cell = cells_[own];
        const auto [x, y, z] = std::array{int(own % size.x), int(own / columns_), int(own % columns_ / size.x)};
        const auto join = [&](int axis, std::size_t next) {
            row(own)[columns_ + next - own] += faces[axis]->by_next[cell];
            row(next)[columns_ + own - next] -= faces[axis]->by_own[cell];
        };
        row(own)[columns_] += diagonal[cell];
        if (x + 1 < size.x || rows_.joined_x()) join(0, place((x + 1) % size.x, y, z));
        if (y + 1 < size.y) join(1, place(x, y + 1, z));
        if (z + 1 < size.z || rows_.joined_z()) join(2, place(x, y, (z + 1) % size.z));
    }
}

void SoilBand::eliminate() {
    const std::size_t m = columns_;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        double* const pivot = row(i) + m;
        *pivot = 1 / *pivot;
        const std::size_t end = std::min(m, cells_.size() - 1 - i);
        for (std::size_t k = 1; k <= end; ++k) {
            double* const other = row(i + k) + m - k;
            const double factor = *other *= *pivot;
            for (std::size_t j = 1; j <= m; ++j) other[j] -= factor * pivot[j];
        }
    }
}

void SoilBand::solve(const WaterBrick& r, WaterBrick& z) {
    const std::size_t m = columns_, n = cells_.size();
    for (std::size_t i = 0; i < n; ++i) {
        double sum = r[cells_[i]];
        for (std::size_t k = std::min(m, i); k > 0; --k) sum -= row(i)[m - k] * solution_[i - k];
        solution_[i] = sum;
    }
    for (std::size_t i = n; i-- > 0;) {
        double sum = solution_[i];
        for (std::size_t k = std::min(m, n - 1 - i); k > 0; --k) sum -= row(i)[m + k] * solution_[i + k];
        z[cells_[i]] = solution_[i] = sum * row(i)[m];
    }
}

}  // namespace espalier::environment
