// The soil's voxels as the solver sees them: one brick per quantity, and the flux through every face.
#pragma once

#include "environment/soil/grid/grid.h"
#include "environment/soil/hydraulics/steady_flux.h"
#include "environment/soil/richards/parameters.h"

#include <array>
#include <cstdint>
#include <vector>

namespace espalier::environment {

/// Faces of one axis. At a cell: how the flux through its face towards +x, +y or +z, in that direction, changes with
/// the heads of the cell itself and of the one beyond, 1/d. Where water cannot pass, both are 0.
struct FaceCouplings {
    WaterBrick by_own, by_next;
    void resize(std::size_t cells);
};

/// The same with the flux itself, cm/d.
struct FaceFluxes : FaceCouplings {
    WaterBrick flux;
    void resize(std::size_t cells);
};

/// Where the neighbours of a row are; a row beyond a closed side is the row itself, to which no face is open.
struct NeighbourRows {
    std::size_t own, below, above, back, front;  ///< first cells
    bool has_above, has_front;
};

/// A grid whose sides may be joined.
class SoilRows {
public:
    SoilRows(const WaterGrid& grid, bool periodic)
        : grid_(grid), joined_x_(periodic && grid.size().x > 1), joined_z_(periodic && grid.size().z > 1) {}

    const WaterGrid& grid() const { return grid_; }
    bool joined_x() const { return joined_x_; }
    bool joined_z() const { return joined_z_; }
    NeighbourRows neighbours(std::size_t row) const;
    /// Copies the ends of a row into the spare cells beyond, if the sides are joined.
    void wrap(double* row) const;

private:
    WaterGrid grid_;
    bool joined_x_, joined_z_;
};

/// The layout of a soil: grid, free voxels, kinds, how sides are joined.
class SoilLayout {
public:
    SoilLayout(const WaterGrid& grid, const SoilParameters& parameters, const std::vector<std::uint8_t>& free_voxels,
               const Fields& fields);

    const SoilRows& rows() const { return rows_; }
    const WaterGrid& grid() const { return rows_.grid(); }
    const WaterFaces& faces() const { return faces_; }
    bool free(std::size_t cell) const { return faces_.free(cell); }
    const SoilHydraulics& kind(std::size_t cell) const { return kinds_[kind_of_[cell]]; }
    std::uint8_t kind_number(std::size_t cell) const { return kind_of_[cell]; }
    OutsideSoil outside() const { return parameters_.outside; }
    bool joined_x() const { return rows_.joined_x(); }
    bool joined_z() const { return rows_.joined_z(); }
    NeighbourRows neighbours(std::size_t row) const { return rows_.neighbours(row); }
    double edge() const { return edge_; }                    ///< of a voxel, cm
    double volume() const { return edge_ * edge_ * edge_; }  ///< of a voxel, cm3
    /// How the soil begins at a point.
    const SoilBeginning& beginning(const glm::dvec3& point) const;

    /// Calls work(row) for every row, in parallel where that pays.
    template <class Work>
    void for_rows(Work work) const {
        grid().for_rows(work);
    }
    /// Calls work(cell) for every free voxel, in parallel where that pays.
    template <class Work>
    void for_free(Work work) const {
        faces_.for_free(grid(), work);
    }
    /// Calls visit(cell) for every free voxel, one after the other.
    template <class Visit>
    void for_each_free(Visit visit) const {
        faces_.for_each_free(grid(), visit);
    }

private:
    void place_kinds(const Fields& fields);

    SoilRows rows_;
    const SoilParameters& parameters_;
    std::vector<SoilHydraulics> kinds_;
    WaterFaces faces_;
    std::vector<std::uint8_t> kind_of_;
    double edge_;
};

}  // namespace espalier::environment
