#include "environment/soil/richards/newton.h"

#include <algorithm>
#include <cmath>

namespace espalier::environment {
namespace {

constexpr double newton_tolerance = 1e-7;  ///< m3/m3: what a voxel may carry over to the next substep
constexpr double negligible = 1e-6 * newton_tolerance;
constexpr double linear_tolerance = 1e-2;  ///< of what a Newton step solves: fewer such steps would cost more
constexpr int most_newton_steps = 25, most_halvings = 6;
constexpr double wet = 0.9;         ///< effective saturation above which a voxel is changed by its head
constexpr double stone = 1e-30;     ///< the equation of a stone: of no weight, so that its head does not matter
constexpr double just_full = 5e-4;  ///< cm: below saturation, where the curves are straight

double larger(double norm, double other) {
    return other > norm || std::isnan(other) ? other : norm;
}

}  // namespace

SoilNewton::SoilNewton(const SoilLayout& layout, const SoilParameters& parameters)
    : layout_(layout),
      grid_(layout.grid()),
      points_(grid_.cells()),
      fluxes_(layout, parameters),
      row_norm_(grid_.rows()),
      jacobian_(layout.rows()) {
    for (WaterBrick* brick : {&heads_, &uptake_, &uptake_by_head_, &residual_, &change_, &before_}) {
        brick->assign(grid_.cells(), 0.0);
    }
}

bool SoilNewton::solve(const WaterBrick& heads, const ImplicitStep& step) {
    heads_ = heads;
    double norm = evaluate(step, step.sinks);
    for (int i = 0; i < most_newton_steps; ++i) {
        if (norm <= newton_tolerance) return true;
        find_joint_uptake(step.sinks);
        if (jacobian_.solve(fluxes_.faces(), residual_, linear_tolerance, change_) < 0) return false;
        norm = search_line(norm, step);
        if (!std::isfinite(norm)) return false;
    }
    return norm <= newton_tolerance;
}

/// The whole change, or half of it and half again until the residual is no longer far worse: it may grow while a front
/// enters the next voxel.
double SoilNewton::search_line(double norm, const ImplicitStep& step) {
    const double worst = 10 * norm;
    before_ = heads_;
    double part = 1;
    for (int halving = 0;; ++halving) {
        change_heads(part);
        norm = evaluate(step, step.sinks);
        if (norm < worst || halving == most_halvings) return norm;
        heads_ = before_;
        evaluate(step, {});
        part *= 0.5;
    }
}

/// Sets fluxes, residuals and the diagonal of the Jacobian for the heads; returns the norm of the residual, m3/m3.
double SoilNewton::evaluate(const ImplicitStep& step, std::span<SoilSink* const> sinks) {
    find_points();
    forget_uptake();
    draw(sinks, step.day, step.days / step.weight, step.weight);
    fluxes_.find(points_, step.forcing, step.ponding, step.days);
    layout_.for_rows([&](std::size_t row) { row_norm_[row] = find_residuals(row, step); });
    double norm = 0;
    for (const double of_row : row_norm_) norm = larger(norm, of_row);
    return norm;
}

void SoilNewton::look(const WaterBrick& heads) {
    heads_ = heads;
    find_points();
}

void SoilNewton::find_points() {
    layout_.for_free([&](std::size_t c) { points_[c] = layout_.kind(c).at(heads_[c]); });
}

void SoilNewton::forget_uptake() {
    std::fill(uptake_.begin(), uptake_.end(), 0);
    std::fill(uptake_by_head_.begin(), uptake_by_head_.end(), 0);
}

void SoilNewton::draw(std::span<SoilSink* const> sinks, double day, double days, double weight) {
    for (SoilSink* sink : sinks) sink->draw(points_, day, days, weight, uptake_, uptake_by_head_);
}

void SoilNewton::find_joint_uptake(std::span<SoilSink* const> sinks) {
    jacobian_.less().clear();
    for (const SoilSink* sink : sinks) {
        for (JointUptake& joint : sink->joint()) {
            jacobian_.less().push_back({std::move(joint.cells), layout_.edge() / joint.collar});
        }
    }
}

/// The left side of the step's equation with the sign that Newton's step solves for, and its derivative.
double SoilNewton::find_residuals(std::size_t row, const ImplicitStep& step) {
    const NeighbourRows at = layout_.neighbours(row);
    const std::size_t column = std::size_t(grid_.z_of(row)) * grid_.size().x;
    const double edge = layout_.edge(), dt = step.days;
    double norm = 0;
    for (int x = 0; x < grid_.size().x; ++x) {
        const std::size_t c = at.own + x;
        if (!layout_.free(c)) {
            jacobian_.diagonal()[c] = stone;
            residual_[c] = 0;
            continue;
        }
        auto [out, by_head] = fluxes_.out_of(at, x, column);
        out += edge * (uptake_[c] - step.inflow[c]);
        by_head += edge * uptake_by_head_[c];
        residual_[c] = -(edge * (points_[c].content - step.theta_0[c]) / dt + out);
        // Soil that is full everywhere stores nothing: a trace of storage chooses one of its heads.
        jacobian_.diagonal()[c] = edge * std::max(points_[c].capacity, 1e-12) / dt + by_head;
        norm = larger(norm, std::abs(residual_[c]) * dt / edge);
    }
    return norm;
}

void SoilNewton::change_heads(double part) {
    layout_.for_free([&](std::size_t c) { heads_[c] = changed_head(c, part * change_[c]); });
}

namespace {

/// Wet soil is changed by its conductivity, in which the fluxes are nearly linear where the head's are steep.
double changed_wet_head(const SoilPoint& point, const SoilHydraulics& kind, double change) {
    if (point.head >= 0) return std::max(point.head + change, -just_full);
    const double full = kind.soil().conductivity;
    const double goal = point.conductivity + point.slope * change;
    if (goal >= full) return std::max(point.head + change, 0.0);
    return kind.head_of_conductivity(std::max(goal, 0.3 * point.conductivity), point.head);
}

}  // namespace

double SoilNewton::changed_head(std::size_t cell, double change) const {
    const SoilPoint& point = points_[cell];
    const SoilHydraulics& kind = layout_.kind(cell);
    const SoilKind& soil = kind.soil();
    const double range = soil.saturated - soil.residual;
    const double saturation = (point.content - soil.residual) / range;
    if (saturation >= wet) return changed_wet_head(point, kind, change);
    if (std::abs(point.capacity * change) < negligible) return point.head;  // soil at rest
    const double goal = saturation + point.capacity * change / range;
    if (goal >= 0.99) return std::max(kind.head_at(soil.residual + 0.99 * range), point.head);
    return kind.head_at(soil.residual + range * std::max(goal, 0.1 * saturation), point.head);
}

std::size_t SoilNewton::worst_cell() const {
    std::size_t worst = grid_.row_begin(0);
    grid_.for_each_cell([&](std::size_t c) {
        if (std::abs(residual_[c]) > std::abs(residual_[worst])) worst = c;
    });
    return worst;
}

}  // namespace espalier::environment
