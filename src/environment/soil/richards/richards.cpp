#include "environment/soil/richards/richards.h"

#include "espalier/base/stop.h"

#include "base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace espalier::environment {
namespace {

constexpr double shortest_substep = 1e-9, first_substep = 1e-5;  ///< days
constexpr double driest_head = -1e6;                             ///< cm, that a soil may begin with

}  // namespace

double SoilBalance::relative_error() const {
    const SoilRates& f = flown;
    const double missing =
        start + f.rain + f.top + f.bottom + f.sides + f.added - f.evaporation - f.runoff - f.drunk - stored;
    double largest = std::max(start, stored);
    for (const double SoilRates::*amount : SoilRates::all) largest = std::max(largest, std::abs(f.*amount));
    return largest > 0 ? missing / largest : 0;
}

Richards::Richards(const SoilLayout& layout, const SoilParameters& parameters)
    : layout_(layout),
      parameters_(parameters),
      grid_(layout.grid()),
      edge_(layout.edge()),
      points_(grid_.cells()),
      row_norm_(grid_.rows()),
      row_sum_(grid_.rows()),
      system_(layout) {
    for (WaterBrick* brick : {&head_, &content_, &trial_, &rate_, &uptake_, &uptake_by_head_, &inflow_, &residual_,
                              &change_, &before_, &start_}) {
        brick->assign(grid_.cells(), 0.0);
    }
    for (FaceFluxes& axis : fluxes_) axis.resize(grid_.cells());
    const std::size_t columns = std::size_t(grid_.size().x) * grid_.size().z;
    floor_.resize(columns);
    surface_.resize(columns);
    ponding_.assign(columns, 0.0);
    for (std::size_t side = 0; side < sides_.size(); ++side) {
        if (parameters.sides[side].kind == SoilSide::Kind::closed) continue;
        has_side_heads_ = true;
        sides_[side].resize(side < 2 ? grid_.rows() : std::size_t(grid_.size().x) * grid_.size().y);
    }
    next_substep_ = first_substep;
    begin();
}

double Richards::first_head(std::size_t cell, const SoilBeginning& beginning, double height) const {
    const double value = beginning.at(height);
    if (beginning.kind != SoilBeginning::Kind::content) return value;
    const SoilHydraulics& soil = layout_.kind(cell);
    const double least = soil.at(driest_head).content, most = soil.soil().saturated;
    if (value >= least && value <= most) return soil.head_at(value);
    throw UserError(
        beginning.place,
        fmt::format("the soil at y = {:g}, {}, cannot hold a content of {:g}: it holds {:.4g} when full, and {:.4g} at "
                    "{:g} cm",
                    height, parameters_.kind_names[layout_.kind_number(cell)], value, most, least, driest_head));
}

void Richards::begin() {
    for (std::size_t row = 0; row < grid_.rows(); ++row) {
        for (int x = 0; x < grid_.size().x; ++x) {
            const std::size_t cell = grid_.row_begin(row) + x;
            if (!layout_.free(cell)) continue;
            const glm::dvec3 centre = grid_.centre({x, grid_.y_of(row), grid_.z_of(row)});
            head_[cell] = first_head(cell, layout_.beginning(centre), centre.y);
            content_[cell] = layout_.kind(cell).at(head_[cell]).content;
        }
    }
    set_measured_heads(0);
    for (const SoilInflow& inflow : parameters_.inflows) {
        std::size_t found = 0;
        for (std::size_t row = 0; row < grid_.rows(); ++row) {
            for (int x = 0; x < grid_.size().x; ++x) {
                const std::size_t cell = grid_.row_begin(row) + x;
                const glm::dvec3 centre = grid_.centre({x, grid_.y_of(row), grid_.z_of(row)});
                if (!layout_.free(cell) || !inflow.shape->inside(centre)) continue;
                inflow_[cell] += inflow.rate;
                ++found;
            }
        }
        if (found == 0) throw UserError(inflow.place, "this source holds no voxel's centre: make it larger or move it");
    }
    measure();
    balance_.start = balance_.stored;
    trial_ = head_;
    find_points();
    if (!parameters_.is_still) layout_.for_rows([&](std::size_t row) { find_fluxes(row); });
}

void Richards::attach(SoilFollower& follower) {
    if (followers_.empty()) movement_.resize(grid_, has_side_heads_);
    followers_.push_back(&follower);
}

double Richards::flux(std::size_t cell, int axis) const {
    if (!layout_.free(cell)) return 0;
    const std::size_t row = cell / grid_.stride();
    const NeighbourRows at = layout_.neighbours(row);
    const std::size_t x = cell - at.own;
    const WaterBrick& flux = fluxes_[axis].flux;
    const glm::ivec3 voxel = grid_.voxel_of(cell);
    if (axis == 0) return 0.5 * (flux[cell] + flux[cell - 1] + side_flux(0, voxel) - side_flux(1, voxel));
    if (axis == 2) {
        const double back = at.back != at.own ? flux[at.back + x] : 0;
        return 0.5 * (flux[cell] + back + side_flux(2, voxel) - side_flux(3, voxel));
    }
    const std::size_t column = std::size_t(grid_.z_of(row)) * grid_.size().x + x;
    const double below = at.below != at.own ? flux[at.below + x] : floor_[column].flux;
    const double above = at.has_above ? flux[cell] : -surface_[column].into.flux;
    return 0.5 * (below + above);
}

void Richards::measure() {
    layout_.for_rows([&](std::size_t row) {
        double sum = 0;
        for (int x = 0; x < grid_.size().x; ++x) sum += content_[grid_.row_begin(row) + x];
        row_sum_[row] = sum;
    });
    double cells = 0, ponding = 0;
    for (const double sum : row_sum_) cells += sum;
    for (const double depth : ponding_) ponding += depth;
    balance_.stored = cells * edge_ + ponding;
}

double Richards::longest_substep(double end, std::span<SoilSink* const> sinks) const {
    double longest = std::min(parameters_.max_substep, end - day_);
    const SoilSurface& surface = parameters_.surface;
    for (const TimeSeries* series : {&surface.rain, &surface.evaporation, &surface.flux, &surface.head,
                                     &parameters_.floor.flux, &parameters_.floor.head}) {
        longest = std::min(longest, series->next_change(day_) - day_);
    }
    for (const SoilSide& side : parameters_.sides) longest = std::min(longest, side.value.next_change(day_) - day_);
    for (const TimeSeries& head : parameters_.measured.heads) {
        longest = std::min(longest, head.next_change(day_) - day_);
    }
    for (const SoilSink* sink : sinks) longest = std::min(longest, sink->longest_substep(day_));
    return longest;
}

void Richards::show_to(std::span<SoilSink* const> sinks) {
    trial_ = head_;
    find_points();
    for (SoilSink* sink : sinks) sink->draw(points_, day_, 0, 1, uptake_, uptake_by_head_);
}

void Richards::advance(double days, std::span<SoilSink* const> sinks) {
    if (parameters_.is_still) return stand_still(days, sinks);
    const double end = day_ + days;
    while (end - day_ > 1e-12 * (1 + std::abs(end))) {
        end_if_asked();
        const double longest = longest_substep(end, sinks);
        double substep_days = std::min(next_substep_, longest);
        if (substep_days > 0.6 * longest && substep_days < longest) substep_days = 0.5 * longest;  // no crumb is left
        double error = 0;
        const Outcome outcome = substep(substep_days, sinks, error);
        if (outcome == Outcome::failed && substep_days < shortest_substep) give_up(substep_days);
        // The error of an implicit Euler step grows with the square of its length.
        const double fitting = std::clamp(0.9 * std::sqrt(parameters_.accuracy / std::max(error, 1e-12)), 0.2, 2.0);
        if (outcome == Outcome::good) {
            day_ = std::abs(end - day_ - substep_days) < 1e-12 * (1 + std::abs(end)) ? end : day_ + substep_days;
            next_substep_ =
                std::max(next_substep_ > substep_days && fitting >= 1 ? next_substep_ : 0, substep_days * fitting);
        } else {
            next_substep_ = substep_days * (outcome == Outcome::failed ? 0.25 : fitting);
        }
    }
    measure();
}

Richards::Outcome Richards::substep(double days, std::span<SoilSink* const> sinks, double& error) {
    const SoilSurface& surface = parameters_.surface;
    const double middle = day_ + 0.5 * days;
    SoilForcing now{
        {0.1 * surface.rain.at(middle), 0.1 * surface.evaporation.at(middle), surface.dry_limit, 0.1 * surface.ponding},
        0.1 * surface.flux.at(middle),
        surface.head.at(middle),
        0.1 * parameters_.floor.flux.at(middle),
        parameters_.floor.table ? 100 * (*parameters_.floor.table - grid_.lower().y)
                                : parameters_.floor.head.at(middle)};
    for (std::size_t side = 0; side < sides_.size(); ++side) {
        if (!sides_[side].empty()) now.sides[side] = parameters_.sides[side].value.at(middle);
    }
    if (!(now == forcing_)) smooth_ = false;
    for (SoilSink* sink : sinks) {
        if (sink->has_jumped(day_)) smooth_ = false;
    }
    forcing_ = now;
    const double weight = choose_start(days);
    if (!newton(weight * days, weight, sinks) || (weight < 1 && stands_on_surface())) {
        if (weight == 1) return Outcome::failed;
        smooth_ = false;  // once more as an implicit Euler step
        return substep(days, sinks, error);
    }
    error = has_rate_ ? error_of(days) : 0;
    if (error > 4 * parameters_.accuracy && days > 100 * shortest_substep) return Outcome::too_long;
    account(days, weight);
    if (!followers_.empty()) record_movement(days, weight);
    for (SoilSink* sink : sinks) sink->accept(days, weight);
    return Outcome::good;
}

bool Richards::stands_on_surface() const {
    return std::any_of(surface_.begin(), surface_.end(), [](const SurfaceExchange& at) { return at.ponding > 0; });
}

/// The second-order backward difference (BDF2), written as an implicit Euler step of a part of the substep that begins
/// from contents already moved on: the part is returned. It is 1, implicit Euler, at first, after a jump of the
/// weather, with water on the surface, and where a content would leave its range.
double Richards::choose_start(double days) {
    start_ = content_;
    if (!has_rate_ || !smooth_ || last_days_ <= 0) return 1;
    const double ratio = days / last_days_;
    const double onward = ratio * ratio / (1 + 2 * ratio) * last_days_;
    for (std::size_t row = 0; row < grid_.rows(); ++row) {
        for (int x = 0; x < grid_.size().x; ++x) {
            const std::size_t c = grid_.row_begin(row) + x;
            if (!layout_.free(c)) continue;
            start_[c] = content_[c] + onward * rate_[c];
            const SoilKind& soil = layout_.kind(c).soil();
            if (start_[c] <= soil.saturated && start_[c] > soil.residual + 0.5 * (content_[c] - soil.residual))
                continue;
            start_ = content_;
            return 1;
        }
    }
    return (1 + ratio) / (1 + 2 * ratio);
}

/// Half the change of the rate, over the substep.
double Richards::error_of(double days) const {
    double error = 0;
    for (std::size_t row = 0; row < grid_.rows(); ++row) {
        for (int x = 0; x < grid_.size().x; ++x) {
            const std::size_t c = grid_.row_begin(row) + x;
            if (!layout_.free(c)) continue;
            const double rate = (points_[c].content - content_[c]) / days;
            error = std::max(error, 0.5 * days * std::abs(rate - rate_[c]));
        }
    }
    return error;
}

void Richards::account(double days, double weight) {
    SoilRates now;
    for (std::size_t row = 0; row < grid_.rows(); ++row) {
        for (int x = 0; x < grid_.size().x; ++x) {
            const std::size_t c = grid_.row_begin(row) + x;
            if (!layout_.free(c)) continue;
            // What Newton's method left over is carried on, so that nothing is lost.
            const double content = points_[c].content + residual_[c] * weight * days / edge_;
            rate_[c] = (content - content_[c]) / days;
            content_[c] = content;
            head_[c] = trial_[c];
            now.drunk += uptake_[c] * edge_;
            now.added += inflow_[c] * edge_;
        }
    }
    for (const std::vector<SoilFlux>& side : sides_) {
        for (const SoilFlux& flux : side) now.sides += flux.flux;
    }
    const bool atmosphere = parameters_.surface.kind == SoilSurface::Kind::atmosphere;
    bool ponded = false;
    for (std::size_t column = 0; column < ponding_.size(); ++column) {
        const SurfaceExchange& surface = surface_[column];
        now.bottom += floor_[column].flux;
        if (atmosphere) {
            now.rain += forcing_.weather.rain;
            now.evaporation += surface.evaporation;
            now.runoff += surface.runoff;
            ponded = ponded || ponding_[column] > 0 || surface.ponding > 0;
            ponding_[column] = surface.ponding;
        } else {
            now.top += surface.into.flux;
        }
    }
    for (double SoilRates::*rate : SoilRates::all) {
        // What moved the contents on is a part of the rate before.
        rates_.*rate = weight * (now.*rate) + (1 - weight) * (rates_.*rate);
        balance_.flown.*rate += rates_.*rate * days;
    }
    has_rate_ = true;
    smooth_ = !ponded;
    last_days_ = days;
    ++substeps_;
}

void Richards::record_movement(double days, double weight) {
    movement_.day = day_;
    movement_.days = days;
    layout_.for_rows([&](std::size_t row) {
        const std::size_t begin = grid_.row_begin(row);
        for (std::size_t c = begin; c < begin + grid_.size().x; ++c) {
            for (int axis = 0; axis < 3; ++axis) bring_on(movement_.flux[axis][c], fluxes_[axis].flux[c], weight);
            bring_on(movement_.uptake[c], uptake_[c], weight);
            if (has_side_heads_) bring_on(movement_.sides[c], through_sides(c).flux, weight);
        }
    });
    for (std::size_t column = 0; column < floor_.size(); ++column) {
        bring_on(movement_.floor[column], floor_[column].flux, weight);
        bring_on(movement_.surface[column], surface_[column].into.flux, weight);
    }
    for (SoilFollower* follower : followers_) follower->follow(movement_, content_);
}

void Richards::give_up(double days) const {
    std::size_t worst = grid_.row_begin(0);
    for (std::size_t row = 0; row < grid_.rows(); ++row) {
        for (int x = 0; x < grid_.size().x; ++x) {
            const std::size_t c = grid_.row_begin(row) + x;
            if (std::abs(residual_[c]) > std::abs(residual_[worst])) worst = c;
        }
    }
    const glm::dvec3 at = grid_.centre(grid_.voxel_of(worst));
    throw RunError(
        fmt::format("the soil's water does not converge on day {}, at ({:.3g}, {:.3g}, {:.3g}) with a head of {:.4g} "
                    "cm, even in substeps "
                    "of {:.2g} d: use smaller voxels, a larger 'accuracy', or less abrupt soils and boundaries there; "
                    "where no water can "
                    "leave full soil, open a side",
                    format_general(day_), at.x, at.y, at.z, trial_[worst], days));
}

}  // namespace espalier::environment
