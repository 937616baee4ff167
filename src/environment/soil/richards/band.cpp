#include "environment/soil/richards/band.h"

#include <algorithm>

namespace espalier::environment {

SoilBand::SoilBand(const SoilRows& rows) : columns_(std::size_t(rows.grid().size().x) * rows.grid().size().z) {
    const WaterGrid& grid = rows.grid();
    const glm::ivec3 size = grid.size();
    const auto place = [&](int x, int y, int z) { return (std::size_t(y) * size.z + z) * size.x + x; };
    for (int y = 0; y < size.y; ++y) {
        for (int z = 0; z < size.z; ++z) {
            for (int x = 0; x < size.x; ++x) {
                const std::size_t cell = grid.cell({x, y, z}), own = cells_.size();
                cells_.push_back(cell);
                const auto face = [&](std::size_t axis, std::size_t next) {
                    faces_.push_back({axis, cell, own, next});
                };
                if (x + 1 < size.x || rows.joined_x()) face(0, place((x + 1) % size.x, y, z));
                if (y + 1 < size.y) face(1, place(x, y + 1, z));
                if (z + 1 < size.z || rows.joined_z()) face(2, place(x, y, (z + 1) % size.z));
            }
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
    for (std::size_t i = 0; i < cells_.size(); ++i) row(i)[columns_] = diagonal[cells_[i]];
    for (const Face& face : faces_) {
        row(face.own)[columns_ + face.next - face.own] += faces[face.axis]->by_next[face.cell];
        row(face.next)[columns_ + face.own - face.next] -= faces[face.axis]->by_own[face.cell];
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

void SoilBand::solve(const WaterBrick& r, WaterBrick& z) const {
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
