// Light along random paths: from sun and sky to leaves, stems and soil, scattered until little is left.
#pragma once

#include "environment/rays/lit_triangles.h"
#include "environment/rays/ray_scene.h"
#include "environment/sky/daylight.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace espalier::environment {

constexpr std::size_t most_bands = 8;

/// What surfaces do with the light of one band. All scatter as Lambert's law says, a leaf to both sides.
struct OpticalBand {
    std::string name;
    double share = 1;  ///< its incoming light over that of the first band
    double leaf_reflectance = 0, leaf_transmittance = 0, stem_reflectance = 0, soil_reflectance = 0;
};

class LightPaths {
public:
    /// `ground` is the height of the soil, `period` that of a stand without an edge. Where less than the share
    /// `residual` of a path's light is left, that is absorbed where it is.
    LightPaths(std::vector<OpticalBand> bands, double ground, const std::optional<Box>& period, double residual)
        : bands_(std::move(bands)), ground_(ground), period_(period), residual_(residual) {}

    const std::vector<OpticalBand>& bands() const { return bands_; }

    /// What is to be lit. Repeats the triangles of a periodic stand, and keeps a reference to them.
    void set(LitTriangles& triangles, const Daylight& light);

    /// Follows so many paths; each `seed` is an independent trial. What follows is of this trial, and the same with any
    /// number of threads.
    void trace(std::uint32_t paths, std::uint32_t seed);

    /// Shares of the incoming light of a band.
    double absorbed(std::size_t slot, std::size_t band) const { return share(absorbed_[slot * bands_.size() + band]); }
    double absorbed_by_soil(std::size_t band) const { return share(by_soil_[band]); }
    double escaped(std::size_t band) const { return share(escaped_[band]); }
    /// m2 of open level ground whose light the paths bring.
    double area_lit() const { return area_lit_; }

    /// Share of the light on open level ground that a small leaf of any direction gets at a place, scattered light
    /// apart.
    double open_share(const glm::dvec3& place) const;

private:
    struct Path {
        glm::dvec3 origin, direction;
        double near = 0;  ///< nothing is met before
        std::array<double, most_bands> weights{};
    };
    using Sums = std::vector<std::uint64_t>;  ///< in units of 2^-32 paths, so that their order does not matter

    double share(std::uint64_t sum) const { return static_cast<double>(sum) * 0x1p-32 / paths_; }
    Path first_of(const std::array<double, 4>& sample) const;
    void follow(std::uint32_t number, std::uint32_t seed);
    std::uint32_t advance(Path& path) const;
    double to_side(const Path& path) const;
    void enter_opposite(Path& path) const;
    bool scatter(Path& path, std::uint32_t triangle, const std::array<double, 4>& sample);
    bool scatter_from_soil(Path& path, const std::array<double, 4>& sample);
    bool ends(const Path& path) const;
    void add(Sums& sums, std::size_t slot, const Path& path) const;

    std::vector<OpticalBand> bands_;
    double ground_;
    std::optional<Box> period_;
    double residual_;

    RayScene scene_;
    const LitTriangles* triangles_ = nullptr;
    std::vector<LightBeam> beams_;
    std::vector<double> powers_;  ///< sums up to each beam, the last is 1
    double area_lit_ = 0, on_ground_ = 0;
    glm::dvec3 centre_{0, 0, 0};
    double radius_ = 0, near_ = 0;
    std::uint32_t paths_ = 1;
    Sums absorbed_, by_soil_, escaped_;
};

}  // namespace espalier::environment
