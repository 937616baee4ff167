// Light along random paths: from sun, sky and lamps to leaves, stems, solids and soil, scattered until little is left.
#pragma once

#include "environment/light/optics/optics.h"
#include "environment/light/rays/light_projection.h"
#include "environment/light/rays/light_sensor.h"
#include "environment/light/rays/light_sources.h"
#include "environment/light/rays/light_tally.h"
#include "environment/light/rays/lit_space.h"
#include "environment/light/rays/lit_triangles.h"
#include "environment/light/rays/organ_rays.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace espalier::environment {

class LightPaths {
public:
    struct Options {
        double ground = 0;            ///< height of the soil
        std::optional<Box> period;    ///< of a stand without an edge
        double residual = 0.25;       ///< with less of its light left, chance decides where all of that is absorbed
        bool evenly = true;           ///< by Sobol's sequence, or by independent random numbers
        std::uint32_t depth = 0;      ///< how often a path may meet something before it ends; 0: as often as it does
        bool only_scattered = false;  ///< what a path brings to where it is first met is not counted
        bool from_organs = false;     ///< organs look for the sources themselves, by `trace_from_organs`
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
    /// Behind `trace`, with the option `from_organs`: what comes to organs straight from the sources, in proportion to
    /// the paths. Each of the trials, counted from 0, has rays of its own of those of one `seed`.
    void trace_from_organs(std::uint32_t trial, std::uint32_t seed);

    /// How an organ has looked for the sources in all trials since the one numbered 0.
    struct Looks {
        std::size_t slot;
        double count;   ///< rays, or points of projections that it would have in the open
        double unseen;  ///< standard error, in mol, of the light of sources that none of few rays has found
    };
    std::vector<Looks> looks() const;

    /// What all paths bring: mol of PAR, or of other bands over their factor.
    double light() const { return sources_.light(); }
    /// Shares of it.
    double absorbed(std::size_t slot, std::size_t band) const { return tally_.absorbed(slot, band); }
    /// On the front and the back of leaves, and on stems.
    double front(std::size_t slot, std::size_t band) const { return tally_.front(slot, band); }
    double back(std::size_t slot, std::size_t band) const { return tally_.back(slot, band); }
    /// Light of the sun that nothing has scattered, in PAR, and the mean direction to all light that nothing has.
    double sun(std::size_t slot) const { return tally_.sun(slot); }
    glm::dvec3 towards(std::size_t slot) const { return tally_.towards(slot); }
    double absorbed_by_soil(std::size_t band) const { return tally_.ended(&Ends::soil, band); }
    double absorbed_by_solids(std::size_t band) const { return tally_.ended(&Ends::solids, band); }
    double escaped(std::size_t band) const { return tally_.ended(&Ends::escaped, band); }
    /// All that the paths have brought in a band; 1 but for lamps.
    double brought(std::size_t band) const { return tally_.ended(&Ends::brought, band); }
    /// What passes a cell of a sensor from its front.
    double passed(std::size_t sensor, std::size_t cell, std::size_t band) const {
        return tally_.passed(first_cells_[sensor] + cell, band);
    }
    const std::vector<LightSensor>& sensors() const { return sensors_; }

    /// Light of sun and sky that a small leaf of any direction meets at a place per area, scattered light apart.
    double open_light(const glm::dvec3& place) const;

private:
    using Ends = LightTally::Ends;

    std::size_t bands() const { return optics_.bands().size(); }
    /// The numbers of one path, at each of its bounces.
    struct Numbers {
        std::uint32_t path, seed;
        bool evenly;
        std::array<double, 4> operator()(std::uint32_t bounce) const;
    };

    void send_rays(std::uint32_t trial, std::uint32_t seed);
    /// Sun and sky as seen by the projections of a trial.
    struct View {
        SourceKind kind;
        LightSources::Parallel light;
    };
    std::vector<View> views(std::uint32_t trial, std::uint32_t seed) const;
    void project(std::uint32_t trial, std::uint32_t seed);
    void add_points(const LightProjection& projection, LightPath path, double on_ground, Ends& ends);
    void follow_points(const LightProjection& projection, const LightPath& path, double on_ground,
                       const Numbers& of_view, Ends& ends);
    void follow(LightPath path, std::optional<std::size_t> triangle, const Numbers& numbers, Ends& ends);
    bool go_on(LightPath& path, LightPath& parted, const Numbers& numbers, Ends& ends);
    bool scatter(LightPath& path, LightPath& parted, std::size_t triangle, const Numbers& numbers, Ends& ends);
    bool scatter_from_soil(LightPath& path, const Numbers& numbers, Ends& ends);
    void count_at_sensors(const LightPath& path, double to);
    void record(const LightPath& met, const LitTriangles::Owner& owner, bool on_back, const BandWeights& kept,
                Ends& ends);
    std::array<SideOptics, most_bands> optics_of(const LitTriangles::Owner& owner, bool on_back) const;
    struct Sender;
    void send(const Sender& sender, Ends& ends);
    void gather(const Sender& sender, Ends& ends);
    BandWeights scattered_from(LightPath path, const Numbers& numbers) const;
    struct Seen;
    Seen seen_by(LightPath& path, const LitSpace::Met& met) const;
    BandWeights direct_on(const Seen& seen, const std::array<double, 4>& sample) const;
    bool look_on(LightPath& path, const Seen& seen, const std::array<double, 4>& sample) const;

    const Optics& optics_;
    std::vector<LightSensor> sensors_;
    std::vector<std::size_t> first_cells_;
    Options options_;
    LitSpace space_;
    LightSources sources_;
    OrganRays rays_;
    LightTally tally_;
    std::vector<std::array<bool, source_kinds>> found_;  ///< by organ: whether a ray to sources of a kind was free
    std::uint32_t paths_ = 0, trials_ = 0;
    std::size_t lamps_ = 0;
    const LitTriangles* triangles_ = nullptr;
    std::size_t slots_ = 0;
};

}  // namespace espalier::environment
