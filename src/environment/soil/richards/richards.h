// Richards' equation on a grid of voxels.
#pragma once

#include "environment/soil/richards/cells.h"
#include "environment/soil/richards/linear_system.h"
#include "environment/soil/richards/parameters.h"
#include "environment/soil/richards/sink.h"
#include "environment/soil/richards/surface.h"

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

/// What acts on the soil's surface and floor during a substep, in cm and days.
struct SoilForcing {
    SurfaceWeather weather;
    double surface_flux = 0, surface_head = 0, floor_flux = 0, floor_head = 0;
    std::array<double, 4> sides{};  ///< cm, or m of a water table, by SoilParameters::sides

    friend bool operator==(const SoilForcing&, const SoilForcing&) = default;
};

/// d content / dt = div(K (grad h + e_y)) - uptake, in mixed form and implicit (Celia et al. 1990), by Newton's method
/// with a line search; substeps are as long as the error in time allows. Dry voxels are changed by their content, wet
/// ones by their head (Forsyth et al. 1995).
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
    double flux(std::size_t cell, int axis) const;

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
    enum class Outcome { good, too_long, failed };
    struct Outflow {
        double flux, by_head;
    };

    void begin();
    double first_head(std::size_t cell, const SoilBeginning& beginning, double height) const;
    void set_measured_heads(double day);
    void stand_still(double days, std::span<SoilSink* const> sinks);
    void measure();
    Outcome substep(double days, std::span<SoilSink* const> sinks, double& error);
    bool newton(double days, double weight, std::span<SoilSink* const> sinks);
    /// `days`: of the implicit step, a part `weight` of the substep. Sets fluxes, residuals and diagonal for `trial_`;
    /// returns the norm of the residual, m3/m3.
    double evaluate(double days, double weight, std::span<SoilSink* const> sinks);
    void find_points();
    void find_fluxes(std::size_t row);
    void find_boundary_fluxes(std::size_t row, double days);
    double find_residuals(std::size_t row, double days);
    /// What leaves a voxel through its faces, and how that changes with its head. `column`: of the first of its row.
    Outflow outflow(const NeighbourRows& at, int x, std::size_t column) const;
    SoilFlux floor_flux(std::size_t cell) const;
    void find_side_fluxes(std::size_t row);
    /// Into a voxel through the sides, by_second: with its own head.
    SoilFlux through_sides(std::size_t cell) const;
    double side_flux(std::size_t side, const glm::ivec3& voxel) const;
    void update(double part);
    double updated_head(std::size_t cell, double change) const;
    double error_of(double days) const;
    double choose_start(double days);
    bool stands_on_surface() const;
    void account(double days, double weight);
    void record_movement(double days, double weight);
    double longest_substep(double end, std::span<SoilSink* const> sinks) const;
    [[noreturn]] void give_up(double days) const;
    WaterBrick available() const;

    const SoilLayout& layout_;
    const SoilParameters& parameters_;
    WaterGrid grid_;
    double edge_;

    WaterBrick head_, content_, trial_, rate_;  ///< rate of the last substep, content per day
    std::vector<SoilPoint> points_;             ///< at `trial_`
    std::array<FaceFluxes, 3> fluxes_;
    std::vector<SoilFlux> floor_;           ///< upwards through the lowest faces, per column
    std::vector<SurfaceExchange> surface_;  ///< per column
    /// Into the soil through the faces of each side, by_second: with the voxel's head; empty without a given head.
    std::array<std::vector<SoilFlux>, 4> sides_;
    WaterBrick uptake_, uptake_by_head_, inflow_, residual_, change_, before_, start_;
    std::vector<double> row_norm_, row_sum_;
    SoilLinearSystem system_;
    SoilForcing forcing_;
    std::vector<SoilFollower*> followers_;
    SoilMovement movement_;  ///< empty without followers

    WaterBrick ponding_;
    SoilBalance balance_;
    double day_ = 0, next_substep_ = 0;
    SoilRates rates_;       ///< of the last substep, per day
    double last_days_ = 0;  ///< its length
    bool has_rate_ = false, smooth_ = false;
    std::size_t substeps_ = 0;
    bool has_side_heads_ = false;
};

}  // namespace espalier::environment
