// Darcy's law on every face of a soil: between voxels, and through its surface, floor and sides.
#pragma once

#include "environment/soil/richards/cells.h"
#include "environment/soil/richards/surface.h"

#include <array>
#include <span>
#include <vector>

namespace espalier::environment {

/// What acts on the soil's surface, floor and sides during a substep, in cm and days.
struct SoilForcing {
    SurfaceWeather weather;
    double surface_flux = 0, surface_head = 0, floor_flux = 0, floor_head = 0;
    std::array<double, 4> sides{};  ///< cm, or m of a water table, by SoilParameters::sides

    static SoilForcing at(double day, const SoilParameters& parameters, const WaterGrid& grid);
    friend bool operator==(const SoilForcing&, const SoilForcing&) = default;
};

/// K (grad h + e_y) on every face, and its derivatives with the heads on both sides.
class SoilFluxes {
public:
    SoilFluxes(const SoilLayout& layout, const SoilParameters& parameters);

    /// Between the voxels of a soil at these points.
    void find_inner(std::span<const SoilPoint> points);
    /// The same and through the boundaries, where `ponding` stands on the surface; `days` of the substep.
    void find(std::span<const SoilPoint> points, const SoilForcing& forcing, const WaterBrick& ponding, double days);

    const std::array<FaceFluxes, 3>& faces() const { return faces_; }
    const std::vector<SoilFlux>& floor() const { return floor_; }             ///< upwards, per column
    const std::vector<SurfaceExchange>& surface() const { return surface_; }  ///< per column
    bool has_side_heads() const { return has_side_heads_; }
    /// Through all sides of given heads, cm/d.
    double through_sides() const;
    /// Into a voxel through them; by_second: with its own head.
    SoilFlux through_sides(std::size_t cell) const;
    /// Whether water stands on the surface.
    bool has_pond() const;
    /// At a voxel's centre along an axis, cm/d.
    double at_centre(std::size_t cell, int axis) const;

    /// What leaves a voxel through its faces, cm/d, and how that changes with its head.
    struct Outflow {
        double flux, by_head;
    };
    /// `column`: of the first voxel of the row.
    Outflow out_of(const NeighbourRows& at, int x, std::size_t column) const;

private:
    void find_inner(std::size_t row, std::span<const SoilPoint> points);
    void find_surface(std::size_t row, std::span<const SoilPoint> points, const SoilForcing& forcing,
                      const WaterBrick& ponding, double days);
    void find_sides(std::size_t row, std::span<const SoilPoint> points, const SoilForcing& forcing);
    SoilFlux darcy(int axis, std::size_t own, std::size_t next, std::span<const SoilPoint> points) const;
    SoilFlux through_floor(std::size_t cell, const SoilPoint& point, const SoilForcing& forcing) const;
    double into_side(std::size_t side, const glm::ivec3& voxel) const;

    const SoilLayout& layout_;
    const SoilParameters& parameters_;
    const WaterGrid& grid_;
    std::array<FaceFluxes, 3> faces_;
    std::vector<SoilFlux> floor_;
    std::vector<SurfaceExchange> surface_;
    /// Into the soil through the faces of each side, by_second: with the voxel's head; empty without a given head.
    std::array<std::vector<SoilFlux>, 4> sides_;
    bool has_side_heads_ = false;
};

}  // namespace espalier::environment
