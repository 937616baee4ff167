// Light along random paths: from sun, sky and lamps to leaves, stems, solids and soil, scattered until little is left.
#pragma once

#include "environment/light/optics/optics.h"
#include "environment/light/rays/lamp.h"
#include "environment/light/rays/light_sensor.h"
#include "environment/light/rays/lit_triangles.h"
#include "environment/light/sky/daylight.h"
#include "geometry/rays/ray_scene.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace espalier::environment {

class LightPaths {
public:
    struct Options {
        double ground = 0;            ///< height of the soil
        std::optional<Box> period;    ///< of a stand without an edge
        double residual = 0.001;      ///< where less of a path's light is left, that is absorbed where it is
        bool evenly = true;           ///< by Sobol's sequence, or by independent random numbers
        std::uint32_t depth = 0;      ///< how often a path may meet something before it ends; 0: as often as it does
        bool only_scattered = false;  ///< what a path brings to where it is first met is not counted
    };

    /// `optics` is kept by reference.
    LightPaths(const Optics& optics, std::vector<LightSensor> sensors, Options options);

    /// What is to be lit; `slots` is the number of modules. Lamps shine for `lamp_seconds`; `factors` are the photons
    /// of each band for one of PAR. Keeps references to the triangles and the lamps. Returns how many parts of the
    /// triangles have changed.
    std::size_t set(const LitTriangles& triangles, std::size_t slots, const Daylight& light,
                    std::span<const Lamp> lamps, double lamp_seconds, std::span<const double> factors);

    /// Follows so many paths; each `seed` is an independent trial. What follows is of this trial, and the same with any
    /// number of threads.
    void trace(std::uint32_t paths, std::uint32_t seed);

    /// What all paths bring: mol of PAR, or of other bands over their factor.
    double light() const { return light_; }
    /// Shares of it.
    double absorbed(std::size_t slot, std::size_t band) const { return share(absorbed_[slot * bands() + band]); }
    /// On the front and the back of leaves, and on stems.
    double front(std::size_t slot, std::size_t band) const { return share(front_[slot * bands() + band]); }
    double back(std::size_t slot, std::size_t band) const { return share(back_[slot * bands() + band]); }
    /// Light of the sun that nothing has scattered, in PAR, and the mean direction to all light that nothing has.
    double sun(std::size_t slot) const { return share(sun_[slot]); }
    glm::dvec3 towards(std::size_t slot) const;
    double absorbed_by_soil(std::size_t band) const { return share(ends_.soil[band]); }
    double absorbed_by_solids(std::size_t band) const { return share(ends_.solids[band]); }
    double escaped(std::size_t band) const { return share(ends_.escaped[band]); }
    /// All that the paths have brought in a band; 1 but for lamps.
    double brought(std::size_t band) const { return share(ends_.brought[band]); }
    /// What passes a cell of a sensor from its front.
    double passed(std::size_t sensor, std::size_t cell, std::size_t band) const {
        return share(through_sensors_[(first_cells_[sensor] + cell) * bands() + band]);
    }
    const std::vector<LightSensor>& sensors() const { return sensors_; }

    /// Light of sun and sky that a small leaf of any direction meets at a place per area, scattered light apart.
    double open_light(const glm::dvec3& place) const;

private:
    struct Path {
        glm::dvec3 origin, direction;
        double near = 0;  ///< nothing is met before
        bool is_first = true, from_sun = false;
        std::array<double, most_bands> weights{};
    };
    struct Met {
        enum class Kind : std::uint8_t { triangle, soil, sky } kind = Kind::sky;
        RayScene::Hit hit{};
    };
    /// Light of one direction, and two unit vectors across it.
    struct Source {
        LightBeam beam;
        glm::dvec3 x, y;
    };
    // In units of 2^-32 paths, so that their order does not matter.
    using Sums = std::vector<std::uint64_t>;
    using OfBands = std::array<std::uint64_t, most_bands>;
    /// Where light begins and ends but for organs. Nearly every path adds to it, so each thread has its own.
    struct Ends {
        OfBands brought{}, soil{}, solids{}, escaped{};

        void add(const Ends& other);
    };

    static std::int64_t units(double weight);
    double share(std::uint64_t sum) const {
        return static_cast<double>(static_cast<std::int64_t>(sum)) * 0x1p-32 / paths_;
    }
    std::size_t bands() const { return optics_.bands().size(); }
    Box lit_box(const LitTriangles& triangles) const;
    void set_sources(const Daylight& light, std::span<const Lamp> lamps, double lamp_seconds,
                     std::span<const double> factors, const glm::dvec3& size);
    Path first_of(const std::array<double, 4>& sample) const;
    Path from_beam(const Source& source, const std::array<double, 4>& sample) const;
    void follow(std::uint32_t number, std::uint32_t seed, Ends& ends);
    template <class Pass>
    Met advance_with(Path& path, const Pass& pass) const;
    double to_side(const Path& path) const;
    void enter_opposite(Path& path) const;
    void count_at_sensors(const Path& path, double to);
    template <class Sample>
    bool scatter(Path& path, const RayScene::Hit& hit, const Sample& sample, Ends& ends);
    template <class Sample>
    bool scatter_from_soil(Path& path, const Sample& sample, Ends& ends);
    void absorb(const LitTriangles::Owner& owner, const Path& path, Ends& ends);
    void note_meeting(const Path& path, const LitTriangles::Owner& owner, bool on_back);
    SideOptics optics_of(const LitTriangles::Owner& owner, bool on_back, std::size_t band) const;
    bool is_spent(const Path& path) const;
    void add(Sums& sums, std::size_t slot, const Path& path) const;
    void add(OfBands& sums, const Path& path) const;

    const Optics& optics_;
    std::vector<LightSensor> sensors_;
    std::vector<std::size_t> first_cells_;
    Options options_;

    RayScene scene_;
    const LitTriangles* triangles_ = nullptr;
    std::vector<Source> beams_;
    std::span<const Lamp> lamps_;
    std::vector<std::array<double, most_bands>> lamp_weights_;
    std::vector<double> powers_;  ///< sums up to each beam, then lamp; the last is 1
    double light_ = 0;
    glm::dvec3 centre_{0, 0, 0};
    double radius_ = 0, near_ = 0, top_ = 0;
    double soil_ = 0;  ///< a little below the ground, so that what is drawn at its height lies on the soil
    std::uint32_t paths_ = 1;
    Sums absorbed_, front_, back_, sun_, towards_, through_sensors_;
    Ends ends_;
};

}  // namespace espalier::environment
