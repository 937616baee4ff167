// The regular grid that water lives on: where its voxels are, which are free, and how a point lies between them.
#pragma once

#include "espalier/base/column.h"
#include "espalier/geometry/plant_geometry.h"

#include "base/parallel.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace espalier::environment {

/// The voxels around a point and their shares of it. Weights sum to 1, or are all 0 where no voxel is free.
/// Entries come in mirror pairs along x, then y, then z: sums taken pairwise are the same for mirrored points.
struct WaterStencil {
    std::array<glm::ivec3, 8> voxel{};
    std::array<double, 8> weight{};
};

/// Sum of eight numbers in pairs along x, then y, then z.
inline double sum_in_pairs(const std::array<double, 8>& values) {
    return ((values[0] + values[1]) + (values[2] + values[3])) + ((values[4] + values[5]) + (values[6] + values[7]));
}

/// A box of cubic voxels. Storage is by rows along x, each with one spare cell at either end for what lies outside.
class WaterGrid {
public:
    /// How many voxels a grid would have.
    static double voxels_needed(const Box& domain, double voxel, bool flat);
    /// Covers `domain` with whole voxels about the same middle. `flat`: one voxel thick, z of positions does not
    /// matter.
    WaterGrid(const Box& domain, double voxel, bool flat);

    const glm::ivec3& size() const { return size_; }
    double voxel() const { return voxel_; }
    bool flat() const { return flat_; }
    std::size_t voxels() const { return rows() * size_.x; }
    std::size_t rows() const { return std::size_t(size_.y) * size_.z; }
    std::size_t stride() const { return std::size_t(size_.x) + 2; }
    std::size_t cells() const { return rows() * stride(); }

    int y_of(std::size_t row) const { return static_cast<int>(row % size_.y); }
    int z_of(std::size_t row) const { return static_cast<int>(row / size_.y); }
    /// Where a row begins: the cell of its first voxel.
    std::size_t row_begin(std::size_t row) const { return row * stride() + 1; }
    std::size_t cell(const glm::ivec3& v) const { return row_begin(std::size_t(v.z) * size_.y + v.y) + v.x; }

    glm::ivec3 voxel_of(std::size_t cell) const {
        const std::size_t row = cell / stride();
        return {static_cast<int>(cell - row_begin(row)), y_of(row), z_of(row)};
    }

    glm::dvec3 lower() const;
    glm::dvec3 upper() const;
    glm::dvec3 centre(const glm::ivec3& voxel) const;
    bool has(const glm::ivec3& v) const {
        return v.x >= 0 && v.y >= 0 && v.z >= 0 && v.x < size_.x && v.y < size_.y && v.z < size_.z;
    }
    /// Within the box, its surface included; false for NaN.
    bool contains(const glm::dvec3& point) const;
    /// Calls work(row) for every row, in parallel where that pays.
    template <class Work>
    void for_rows(Work work) const {
        const std::size_t grain = std::max<std::size_t>(1, 4096 / stride());
        if (rows() <= grain) {
            for (std::size_t row = 0; row < rows(); ++row) work(row);
            return;
        }
        for_in_parallel(tbb::blocked_range<std::size_t>(0, rows(), grain), [&](const auto& range) {
            for (std::size_t row = range.begin(); row != range.end(); ++row) work(row);
        });
    }
    /// Calls visit(cell) for every voxel of a row.
    template <class Visit>
    void for_cells_of(std::size_t row, Visit visit) const {
        const std::size_t begin = row_begin(row), end = begin + size_.x;
        for (std::size_t cell = begin; cell != end; ++cell) visit(cell);
    }

    /// The same for all, one after the other.
    template <class Visit>
    void for_each_cell(Visit visit) const {
        for (std::size_t row = 0; row < rows(); ++row) for_cells_of(row, visit);
    }

    /// (Tri)linear interpolation weights of `point` among all voxels, free or not; beyond the outermost centres the
    /// nearest counts alone. `point` must be contained.
    WaterStencil stencil(const glm::dvec3& point) const;

private:
    glm::ivec3 size_{1};
    double voxel_;
    glm::dvec3 middle_;
    bool flat_;
};

using WaterBrick = Column<double>;

/// Per cell: bits 0-5 say that water may cross its face towards -x, +x, -y, +y, -z, +z; bit 6 that it is free at all.
class WaterFaces {
public:
    static constexpr std::uint8_t free_bit = 64;

    /// `is_free`: one flag per voxel, x fastest.
    WaterFaces(const WaterGrid& grid, const std::vector<std::uint8_t>& is_free);

    bool free(std::size_t cell) const { return (bits_[cell] & free_bit) != 0; }
    std::uint8_t bits(std::size_t cell) const { return bits_[cell]; }
    const std::uint8_t* row(std::size_t begin) const { return bits_.data() + begin; }
    /// True if every face of every voxel of the row is open.
    bool plain_row(std::size_t row) const { return plain_[row] != 0; }
    std::size_t free_voxels() const { return free_voxels_; }

    /// Calls work(cell) for every free voxel, in parallel where that pays.
    template <class Work>
    void for_free(const WaterGrid& grid, Work work) const {
        grid.for_rows([&](std::size_t row) { visit_free(grid, row, work); });
    }
    /// Calls visit(cell) for every free voxel, one after the other.
    template <class Visit>
    void for_each_free(const WaterGrid& grid, Visit visit) const {
        for (std::size_t row = 0; row < grid.rows(); ++row) visit_free(grid, row, visit);
    }

private:
    template <class Visit>
    void visit_free(const WaterGrid& grid, std::size_t row, Visit& visit) const {
        grid.for_cells_of(row, [&](std::size_t cell) {
            if (free(cell)) visit(cell);
        });
    }

    std::vector<std::uint8_t> bits_;
    std::vector<std::uint8_t> plain_;
    std::size_t free_voxels_ = 0;
};

}  // namespace espalier::environment
