// Newton's method for one implicit substep of Richards' equation.
#pragma once

#include "environment/soil/richards/fluxes.h"
#include "environment/soil/richards/linear_system.h"
#include "environment/soil/richards/sink.h"

#include <span>
#include <vector>

namespace espalier::environment {

/// An implicit step from the contents theta_0: for every voxel, whose edge is e,
///     e (theta(h) - theta_0) / dt + outflow(h) + e (uptake(h) - inflow) = 0.
struct ImplicitStep {
    double day = 0;     ///< when its substep begins
    double days = 0;    ///< dt
    double weight = 1;  ///< the part of the substep that dt is
    const SoilForcing& forcing;
    const WaterBrick& theta_0;
    const WaterBrick& inflow;   ///< of sources, content per day
    const WaterBrick& ponding;  ///< cm, per column
    std::span<SoilSink* const> sinks;
};

/// The soil as it would be with trial heads. Newton's method changes dry voxels by their content, wet ones by their
/// conductivity (Forsyth et al. 1995).
class SoilNewton {
public:
    SoilNewton(const SoilLayout& layout, const SoilParameters& parameters);

    /// Finds the heads that solve the step, from these on. False if it does not come so far.
    bool solve(const WaterBrick& heads, const ImplicitStep& step);

    /// Takes these heads, and the curves of the soil there.
    void look(const WaterBrick& heads);
    void forget_uptake();
    /// Lets the sinks draw from the soil as it is looked at: see SoilSink::draw.
    void draw(std::span<SoilSink* const> sinks, double day, double days, double weight);
    /// Fluxes between voxels with the heads that were looked at.
    void find_inner_fluxes() { fluxes_.find_inner(points_); }

    const WaterBrick& heads() const { return heads_; }
    const std::vector<SoilPoint>& points() const { return points_; }
    const SoilFluxes& fluxes() const { return fluxes_; }
    const WaterBrick& uptake() const { return uptake_; }      ///< content per day
    const WaterBrick& residual() const { return residual_; }  ///< what is missing, cm/d
    std::size_t worst_cell() const;

private:
    void find_points();
    double evaluate(const ImplicitStep& step, std::span<SoilSink* const> sinks);
    void find_joint_uptake(std::span<SoilSink* const> sinks);
    double find_residuals(std::size_t row, const ImplicitStep& step);
    double search_line(double norm, const ImplicitStep& step);
    void change_heads(double part);
    double changed_head(std::size_t cell, double change) const;

    const SoilLayout& layout_;
    const WaterGrid& grid_;
    WaterBrick heads_;
    std::vector<SoilPoint> points_;  ///< the curves at the heads
    SoilFluxes fluxes_;
    WaterBrick uptake_, uptake_by_head_;
    WaterBrick residual_, change_, before_;
    std::vector<double> row_norm_;
    SoilLinearSystem jacobian_;
};

}  // namespace espalier::environment
