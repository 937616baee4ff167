// Richards' equation on a grid of voxels.
#pragma once

#include "environment/soil/richards/newton.h"
#include "environment/soil/richards/time_steps.h"

#include <functional>
#include <iosfwd>
#include <span>
#include <vector>

namespace espalier::environment {

/// What passes, in cm of water over the surface times columns: amounts, or amounts per day.
struct SoilRates {
    double rain = 0, evaporation = 0, runoff = 0;
    double top = 0;     ///< into the soil through a surface of given flux or head
    double bottom = 0;  ///< net, into the soil; what drains is negative
    double sides = 0;   ///< net, into the soil through sides of given heads
    double added = 0;   ///< by sources
    double drunk = 0;   ///< by queries and roots

    static constexpr double SoilRates::*all[] = {&SoilRates::rain,  &SoilRates::evaporation, &SoilRates::runoff,
                                                 &SoilRates::top,   &SoilRates::bottom,      &SoilRates::sides,
                                                 &SoilRates::added, &SoilRates::drunk};
};

struct SoilBalance {
    double start = 0, stored = 0;  ///< in the soil and on it
    SoilRates flown;               ///< since the beginning

    /// What the account misses, relative to its largest entry.
    double relative_error() const;
};

/// d theta / dt = div(K (grad h + e_y)) - uptake, in mixed form and implicit (Celia et al. 1990): substeps of second
/// order, as long as the error in time allows, each by Newton's method. Or soil that stands still: its heads are given,
/// and what is taken is put back.
class Richards {
public:
    Richards(const SoilLayout& layout, const SoilParameters& parameters);

    const WaterBrick& contents() const { return content_; }
    const WaterBrick& heads() const { return head_; }
    const WaterBrick& ponding() const { return ponding_; }  ///< cm, per column, x fastest
    const SoilBalance& balance() const { return balance_; }
    double day() const { return day_; }
    std::size_t substeps() const { return substeps_; }
    /// Flux at a voxel's centre along an axis, cm/d.
    double flux(std::size_t cell, int axis) const { return trial_.fluxes().at_centre(cell, axis); }

    /// Lets so many days pass. Throws RunError, naming place and time, where no substep is short enough.
    void advance(double days, std::span<SoilSink* const> sinks);

    /// Lets the sinks draw from the soil as it is; no time passes.
    void show_to(std::span<SoilSink* const> sinks);

    /// Tells `follower` of every substep.
    void attach(SoilFollower& follower);

    /// Lets `take` take from what lies above the wilting point; it returns how much, in content times voxels.
    void drink(const std::function<double(WaterBrick&)>& take);

    void save(std::ostream& out) const;
    void restore(std::istream& in);

private:
    void begin();
    void find_inflow();
    double first_head(std::size_t cell, const SoilBeginning& beginning, double height) const;
    void set_measured_heads(double day);
    void stand_still(double days, std::span<SoilSink* const> sinks);
    /// Solves a substep; returns its weight, 0 if it failed.
    double solve(double days, std::span<SoilSink* const> sinks);
    void accept(double days, double weight, std::span<SoilSink* const> sinks);
    void account(double days, double weight);
    void tell_followers(double days, double weight);
    void measure();
    WaterBrick available() const;
    double longest_substep(double end, std::span<SoilSink* const> sinks) const;
    bool is_before(double end) const;
    void come_on(double days, double end);
    [[noreturn]] void give_up(double days) const;

    const SoilLayout& layout_;
    const SoilParameters& parameters_;
    const WaterGrid& grid_;
    double edge_;

    WaterBrick head_, content_, ponding_;
    WaterBrick inflow_;  ///< of sources, content per day
    SoilNewton trial_;   ///< the soil at the end of the substep
    SoilTimeSteps steps_;
    SoilForcing forcing_;  ///< of the last substep
    double day_ = 0;
    std::size_t substeps_ = 0;
    SoilBalance balance_;
    SoilRates rates_;  ///< of the last substep, per day
    std::vector<SoilFollower*> followers_;
    SoilMovement movement_;  ///< empty without followers
};

}  // namespace espalier::environment
