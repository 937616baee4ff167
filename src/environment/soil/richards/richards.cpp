#include "environment/soil/richards/richards.h"

#include "espalier/base/stop.h"

#include "base/bytes.h"
#include "base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace espalier::environment {
namespace {

constexpr double shortest_substep = 1e-9;  ///< days
constexpr double driest_head = -1e6;       ///< cm, that a soil may begin with

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
      trial_(layout, parameters),
      steps_(layout) {
    for (WaterBrick* brick : {&head_, &content_, &inflow_}) brick->assign(grid_.cells(), 0.0);
    ponding_.assign(std::size_t(grid_.size().x) * grid_.size().z, 0.0);
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
    layout_.for_each_free([&](std::size_t cell) {
        const glm::dvec3 centre = grid_.centre(grid_.voxel_of(cell));
        head_[cell] = first_head(cell, layout_.beginning(centre), centre.y);
        content_[cell] = layout_.kind(cell).at(head_[cell]).content;
    });
    set_measured_heads(0);
    find_inflow();
    measure();
    balance_.start = balance_.stored;
    trial_.look(head_);
    if (!parameters_.is_still) trial_.find_inner_fluxes();
}

void Richards::find_inflow() {
    for (const SoilInflow& inflow : parameters_.inflows) {
        std::vector<std::size_t> cells = cells_of_source(grid_, *inflow.shape, inflow.place);
        std::erase_if(cells, [&](std::size_t cell) { return !layout_.free(cell); });
        if (cells.empty()) throw UserError(inflow.place, "this source lies within stones: move it");
        for (const std::size_t cell : cells) inflow_[cell] += inflow.rate;
    }
}

void Richards::attach(SoilFollower& follower) {
    if (followers_.empty()) movement_.resize(grid_, trial_.fluxes().has_side_heads());
    followers_.push_back(&follower);
}

void Richards::measure() {
    std::vector<double> row_sum(grid_.rows());
    layout_.for_rows(
        [&](std::size_t row) { grid_.for_cells_of(row, [&](std::size_t cell) { row_sum[row] += content_[cell]; }); });
    double cells = 0, ponding = 0;
    for (const double sum : row_sum) cells += sum;
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
    trial_.look(head_);
    trial_.draw(sinks, day_, 0, 1);
}

bool Richards::is_before(double end) const {
    return end - day_ > 1e-12 * (1 + std::abs(end));
}

void Richards::come_on(double days, double end) {
    day_ = std::abs(end - day_ - days) < 1e-12 * (1 + std::abs(end)) ? end : day_ + days;
}

void Richards::advance(double days, std::span<SoilSink* const> sinks) {
    if (parameters_.is_still) return stand_still(days, sinks);
    const double end = day_ + days, accuracy = parameters_.accuracy;
    while (is_before(end)) {
        end_if_asked();
        const double dt = steps_.next(longest_substep(end, sinks));
        const double weight = solve(dt, sinks);
        if (weight == 0) {
            if (dt < shortest_substep) give_up(dt);
            steps_.shorten(dt, 0.25);
            continue;
        }
        const double error = steps_.error(trial_.points(), content_, dt);
        // The error of an implicit Euler step grows with the square of its length.
        const double fitting = std::clamp(0.9 * std::sqrt(accuracy / std::max(error, 1e-12)), 0.2, 2.0);
        if (error > 4 * accuracy && dt > 100 * shortest_substep) {
            steps_.shorten(dt, fitting);
            continue;
        }
        accept(dt, weight, sinks);
        come_on(dt, end);
        steps_.lengthen(dt, fitting);
    }
    measure();
}

double Richards::solve(double days, std::span<SoilSink* const> sinks) {
    const SoilForcing forcing = SoilForcing::at(day_ + 0.5 * days, parameters_, grid_);
    if (!(forcing == forcing_)) steps_.jump();
    for (SoilSink* sink : sinks) {
        if (sink->has_jumped(day_)) steps_.jump();
    }
    forcing_ = forcing;
    for (;;) {
        const double weight = steps_.begin(content_, days);
        const ImplicitStep step{day_, weight * days, weight, forcing_, steps_.theta_0(), inflow_, ponding_, sinks};
        const bool is_solved = trial_.solve(head_, step) && !(weight < 1 && trial_.fluxes().has_pond());
        if (is_solved) return weight;
        if (weight == 1) return 0;
        steps_.jump();  // once more as an implicit Euler step
    }
}

void Richards::accept(double days, double weight, std::span<SoilSink* const> sinks) {
    account(days, weight);
    if (!followers_.empty()) tell_followers(days, weight);
    for (SoilSink* sink : sinks) sink->accept(days, weight);
}

void Richards::account(double days, double weight) {
    SoilRates now;
    layout_.for_each_free([&](std::size_t c) {
        // What Newton's method left over is carried on, so that nothing is lost.
        const double content = trial_.points()[c].content + trial_.residual()[c] * weight * days / edge_;
        steps_.rate()[c] = (content - content_[c]) / days;
        content_[c] = content;
        head_[c] = trial_.heads()[c];
        now.drunk += trial_.uptake()[c] * edge_;
        now.added += inflow_[c] * edge_;
    });
    const SoilFluxes& fluxes = trial_.fluxes();
    now.sides = fluxes.through_sides();
    const bool atmosphere = parameters_.surface.kind == SoilSurface::Kind::atmosphere;
    bool ponded = false;
    for (std::size_t column = 0; column < ponding_.size(); ++column) {
        const SurfaceExchange& surface = fluxes.surface()[column];
        now.bottom += fluxes.floor()[column].flux;
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
        bring_on(rates_.*rate, now.*rate, weight);
        balance_.flown.*rate += rates_.*rate * days;
    }
    steps_.accept(days, !ponded);
    ++substeps_;
}

void Richards::tell_followers(double days, double weight) {
    movement_.pass(day_, days, weight, layout_, trial_.fluxes(), trial_.uptake());
    for (SoilFollower* follower : followers_) follower->follow(movement_, content_);
}

void Richards::give_up(double days) const {
    const std::size_t worst = trial_.worst_cell();
    const glm::dvec3 at = grid_.centre(grid_.voxel_of(worst));
    throw RunError(
        fmt::format("the soil's water does not converge on day {}, at ({:.3g}, {:.3g}, {:.3g}) with a head of {:.4g} "
                    "cm, even in substeps "
                    "of {:.2g} d: use smaller voxels, a larger 'accuracy', or less abrupt soils and boundaries there; "
                    "where no water can "
                    "leave full soil, open a side",
                    format_general(day_), at.x, at.y, at.z, trial_.heads()[worst], days));
}

void Richards::set_measured_heads(double day) {
    if (!parameters_.measured.any()) return;
    layout_.for_rows([&](std::size_t row) {
        const double head = parameters_.measured.at(grid_.centre({0, grid_.y_of(row), 0}).y, day);
        grid_.for_cells_of(row, [&](std::size_t c) {
            if (!layout_.free(c)) return;
            head_[c] = head;
            content_[c] = layout_.kind(c).at(head).content;
        });
    });
}

/// What roots take is put back.
void Richards::stand_still(double days, std::span<SoilSink* const> sinks) {
    const double end = day_ + days;
    while (is_before(end)) {
        end_if_asked();
        const double dt = longest_substep(end, sinks), stored = balance_.stored;
        set_measured_heads(day_ + 0.5 * dt);
        measure();
        trial_.look(head_);
        trial_.forget_uptake();
        for (SoilSink* sink : sinks) sink->has_jumped(day_);
        trial_.draw(sinks, day_, dt, 1);
        double drunk = 0;
        for (const double uptake : trial_.uptake()) drunk += uptake * edge_ * dt;
        balance_.flown.drunk += drunk;
        balance_.flown.added += drunk + (balance_.stored - stored);
        if (!followers_.empty()) tell_followers(dt, 1);
        for (SoilSink* sink : sinks) sink->accept(dt, 1);
        come_on(dt, end);
        ++substeps_;
    }
}

/// What lies above the wilting point.
WaterBrick Richards::available() const {
    WaterBrick available(grid_.cells(), 0.0);
    layout_.for_free([&](std::size_t c) {
        available[c] = std::max(0.0, content_[c] - layout_.kind(c).at(parameters_.wilting_head).content);
    });
    return available;
}

void Richards::drink(const std::function<double(WaterBrick&)>& take) {
    WaterBrick left = available();
    const WaterBrick before = left;
    const double taken = take(left);
    if (taken == 0) return;
    layout_.for_free([&](std::size_t c) {
        if (left[c] == before[c]) return;
        content_[c] -= before[c] - left[c];
        head_[c] = layout_.kind(c).head_at(content_[c], head_[c]);
    });
    balance_.flown.drunk += taken * edge_;
    measure();
}

void Richards::save(std::ostream& out) const {
    for (const WaterBrick* brick : {&head_, &content_, &steps_.rate(), &ponding_}) {
        write_doubles(out, {brick->data(), brick->size()});
    }
    put(out, day_);
    steps_.save(out);
    put(out, static_cast<double>(substeps_));
    put(out, balance_);
    put(out, rates_);
    put(out, forcing_);
    movement_.save(out);
}

void Richards::restore(std::istream& in) {
    for (WaterBrick* brick : {&head_, &content_, &steps_.rate(), &ponding_}) {
        read_doubles(in, {brick->data(), brick->size()});
    }
    day_ = get<double>(in);
    steps_.restore(in);
    substeps_ = static_cast<std::size_t>(get<double>(in));
    balance_ = get<SoilBalance>(in);
    rates_ = get<SoilRates>(in);
    forcing_ = get<SoilForcing>(in);
    movement_.restore(in);
    measure();
}

}  // namespace espalier::environment
