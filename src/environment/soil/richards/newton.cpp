// One substep of Richards' equation: fluxes, residuals and Newton's method.
#include "environment/soil/richards/richards.h"

#include <algorithm>
#include <cmath>

namespace espalier::environment {
namespace {

constexpr double newton_tolerance = 1e-7;  ///< m3/m3: what a voxel may carry over to the next substep
constexpr double negligible = 1e-6 * newton_tolerance;
constexpr int most_newton_steps = 25;
constexpr double wet = 0.9;  ///< effective saturation above which a voxel is changed by its head

constexpr double just_full = 5e-4;  ///< cm: below saturation, where the curves are straight

}  // namespace

bool Richards::newton(double days, double weight, std::span<SoilSink* const> sinks) {
    trial_ = head_;
    double norm = evaluate(days, weight, sinks);
    for (int step = 0; step < most_newton_steps; ++step) {
        if (norm <= newton_tolerance) return true;
        if (system_.solve(fluxes_, residual_, 1e-3, change_) < 0) return false;
        before_ = trial_;
        double part = 1;
        const double worst = 10 * norm;  // a residual may grow while a front enters the next voxel
        for (int halving = 0;; ++halving) {
            update(part);
            norm = evaluate(days, weight, sinks);
            if (norm < worst || halving == 6) break;
            trial_ = before_;
            evaluate(days, weight, {});
            part *= 0.5;
        }
        if (!std::isfinite(norm)) return false;
    }
    return norm <= newton_tolerance;
}

double Richards::evaluate(double days, double weight, std::span<SoilSink* const> sinks) {
    find_points();
    std::fill(uptake_.begin(), uptake_.end(), 0);
    std::fill(uptake_by_head_.begin(), uptake_by_head_.end(), 0);
    for (SoilSink* sink : sinks) sink->draw(points_, day_, days / weight, weight, uptake_, uptake_by_head_);
    layout_.for_rows([&](std::size_t row) {
        find_fluxes(row);
        find_boundary_fluxes(row, days);
        if (has_side_heads_) find_side_fluxes(row);
    });
    layout_.for_rows([&](std::size_t row) {
        for (WaterBrick* brick : {&fluxes_[0].flux, &fluxes_[0].by_own, &fluxes_[0].by_next}) {
            (*brick)[grid_.row_begin(row) - 1] =
                layout_.joined_x() ? (*brick)[grid_.row_begin(row) + grid_.size().x - 1] : 0;
        }
        row_norm_[row] = find_residuals(row, days);
    });
    double norm = 0;
    for (const double of_row : row_norm_) norm = of_row > norm || std::isnan(of_row) ? of_row : norm;
    return norm;
}

void Richards::find_points() {
    layout_.for_rows([&](std::size_t row) {
        const std::size_t begin = grid_.row_begin(row);
        for (std::size_t c = begin; c < begin + grid_.size().x; ++c) {
            if (layout_.free(c)) points_[c] = layout_.kind(c).at(trial_[c]);
        }
    });
}

void Richards::find_fluxes(std::size_t row) {
    const NeighbourRows at = layout_.neighbours(row);
    const int n = grid_.size().x;
    const auto set = [&](int axis, std::size_t own, std::size_t next) {
        SoilFlux flux;
        if (layout_.free(own) && layout_.free(next)) {
            const bool same = layout_.kind_number(own) == layout_.kind_number(next);
            const SoilPoint &a = points_[own], &b = points_[next];
            if (axis != 1) {
                flux = same ? flux_across(a, b, edge_)
                            : flux_between_soils(layout_.kind(own), a, layout_.kind(next), b, edge_, false);
            } else {
                const SoilFlux down =
                    same ? flux_down(b, a, edge_)
                         : flux_between_soils(layout_.kind(next), b, layout_.kind(own), a, edge_, true);
                flux = {-down.flux, -down.by_second, -down.by_first};
            }
        }
        FaceFluxes& fluxes = fluxes_[axis];
        fluxes.flux[own] = flux.flux;
        fluxes.by_own[own] = flux.by_first;
        fluxes.by_next[own] = flux.by_second;
    };
    for (int x = 0; x + 1 < n; ++x) set(0, at.own + x, at.own + x + 1);
    if (layout_.joined_x()) set(0, at.own + n - 1, at.own);
    for (int x = 0; x < n && at.has_above; ++x) set(1, at.own + x, at.above + x);
    for (int x = 0; x < n && at.has_front; ++x) set(2, at.own + x, at.front + x);
}

/// Upwards into the lowest voxel; by_first: with that voxel's head.
SoilFlux Richards::floor_flux(std::size_t cell) const {
    const SoilPoint& point = points_[cell];
    switch (parameters_.floor.kind) {
        case SoilFloor::Kind::free_drainage:
            return {-point.conductivity, -point.slope, 0};
        case SoilFloor::Kind::flux:
            return {forcing_.floor_flux, 0, 0};
        case SoilFloor::Kind::head:
        case SoilFloor::Kind::seepage: {
            const bool seeps = parameters_.floor.kind == SoilFloor::Kind::seepage;
            const SoilFlux down = flux_down(point, layout_.kind(cell).at(seeps ? 0 : forcing_.floor_head), 0.5 * edge_);
            if (seeps && down.flux <= 0) return {};
            return {-down.flux, -down.by_first, 0};
        }
        default:
            return {};
    }
}

void Richards::find_boundary_fluxes(std::size_t row, double days) {
    const int n = grid_.size().x, y = grid_.y_of(row);
    const std::size_t begin = grid_.row_begin(row), column = std::size_t(grid_.z_of(row)) * n;
    if (y == 0) {
        for (int x = 0; x < n; ++x) floor_[column + x] = layout_.free(begin + x) ? floor_flux(begin + x) : SoilFlux{};
    }
    if (y + 1 != grid_.size().y) return;
    for (int x = 0; x < n; ++x) {
        SurfaceExchange& surface = surface_[column + x];
        const std::size_t cell = begin + x;
        const SoilSurface::Kind kind = parameters_.surface.kind;
        surface = {};
        if (!layout_.free(cell)) {  // rain runs off a stone
            if (kind == SoilSurface::Kind::atmosphere) surface.runoff = forcing_.weather.rain;
        } else if (kind == SoilSurface::Kind::atmosphere) {
            surface = exchange_at_surface(layout_.kind(cell), points_[cell], 0.5 * edge_, forcing_.weather,
                                          ponding_[column + x], days);
        } else if (kind == SoilSurface::Kind::flux) {
            surface.into.flux = forcing_.surface_flux;
        } else if (kind == SoilSurface::Kind::head) {
            surface.into = flux_down(layout_.kind(cell).at(forcing_.surface_head), points_[cell], 0.5 * edge_);
        }
    }
}

/// Half a voxel from a face whose head is given.
void Richards::find_side_fluxes(std::size_t row) {
    const glm::ivec3 size = grid_.size();
    const int y = grid_.y_of(row), z = grid_.z_of(row);
    const double height = grid_.centre({0, y, 0}).y;
    const auto set = [&](std::size_t side, std::size_t face, std::size_t cell) {
        if (sides_[side].empty()) return;
        SoilFlux& into = sides_[side][face];
        into = {};
        if (!layout_.free(cell)) return;
        const bool is_table = parameters_.sides[side].kind == SoilSide::Kind::table;
        const double given = forcing_.sides[side], head = is_table ? 100 * (given - height) : given;
        into = flux_across(layout_.kind(cell).at(head), points_[cell], 0.5 * edge_);
    };
    const std::size_t begin = grid_.row_begin(row), end = begin + size.x - 1;
    set(0, row, begin);
    set(1, row, end);
    for (int x = 0; x < size.x; ++x) {
        const std::size_t face = std::size_t(y) * size.x + x;
        if (z == 0) set(2, face, begin + x);
        if (z == size.z - 1) set(3, face, begin + x);
    }
}

SoilFlux Richards::through_sides(std::size_t cell) const {
    const glm::ivec3 at = grid_.voxel_of(cell), size = grid_.size();
    const std::size_t row = cell / grid_.stride(), face = std::size_t(at.y) * size.x + at.x;
    SoilFlux sum;
    const auto add = [&](std::size_t side, bool is_there, std::size_t index) {
        if (!is_there || sides_[side].empty()) return;
        sum.flux += sides_[side][index].flux;
        sum.by_second += sides_[side][index].by_second;
    };
    add(0, at.x == 0, row);
    add(1, at.x == size.x - 1, row);
    add(2, at.z == 0, face);
    add(3, at.z == size.z - 1, face);
    return sum;
}

/// 0 for a voxel that does not lie at the side.
double Richards::side_flux(std::size_t side, const glm::ivec3& voxel) const {
    if (sides_[side].empty()) return 0;
    const int axis = side < 2 ? 0 : 2, place = side % 2 == 0 ? 0 : grid_.size()[axis] - 1;
    if (voxel[axis] != place) return 0;
    const std::size_t row = std::size_t(voxel.z) * grid_.size().y + voxel.y;
    return sides_[side][side < 2 ? row : std::size_t(voxel.y) * grid_.size().x + voxel.x].flux;
}

Richards::Outflow Richards::outflow(const NeighbourRows& at, int x, std::size_t column) const {
    const std::size_t c = at.own + x, below = at.below + x, back = at.back + x;
    const auto& [fx, fy, fz] = fluxes_;
    Outflow out{fx.flux[c] - fx.flux[c - 1], fx.by_own[c] - fx.by_next[c - 1]};
    if (at.has_above) {
        out.flux += fy.flux[c];
        out.by_head += fy.by_own[c];
    } else {
        out.flux -= surface_[column + x].into.flux;
        out.by_head -= surface_[column + x].into.by_second;
    }
    if (below != c) {
        out.flux -= fy.flux[below];
        out.by_head -= fy.by_next[below];
    } else {
        out.flux -= floor_[column + x].flux;
        out.by_head -= floor_[column + x].by_first;
    }
    if (at.has_front) {
        out.flux += fz.flux[c];
        out.by_head += fz.by_own[c];
    }
    if (back != c) {
        out.flux -= fz.flux[back];
        out.by_head -= fz.by_next[back];
    }
    if (has_side_heads_) {
        const SoilFlux into = through_sides(c);
        out.flux -= into.flux;
        out.by_head -= into.by_second;
    }
    return out;
}

/// Per voxel: what came in, less what went out and what is stored, with the sign that Newton's step solves for.
double Richards::find_residuals(std::size_t row, double days) {
    const NeighbourRows at = layout_.neighbours(row);
    const int n = grid_.size().x;
    const std::size_t column = std::size_t(grid_.z_of(row)) * n;
    double norm = 0;
    for (int x = 0; x < n; ++x) {
        const std::size_t c = at.own + x;
        double& diagonal = system_.diagonal[c];
        if (!layout_.free(c)) {
            diagonal = 1;
            residual_[c] = 0;
            continue;
        }
        const SoilPoint& point = points_[c];
        auto [out, by_head] = outflow(at, x, column);
        out += edge_ * (uptake_[c] - inflow_[c]);
        by_head += edge_ * uptake_by_head_[c];
        residual_[c] = -(edge_ * (point.content - start_[c]) / days + out);
        // Soil that is full everywhere stores nothing: a trace of storage chooses one of its heads.
        diagonal = edge_ * std::max(point.capacity, 1e-12) / days + by_head;
        const double miss = std::abs(residual_[c]) * days / edge_;
        norm = miss > norm || std::isnan(miss) ? miss : norm;
    }
    return norm;
}

void Richards::update(double part) {
    layout_.for_rows([&](std::size_t row) {
        const std::size_t begin = grid_.row_begin(row);
        for (std::size_t c = begin; c < begin + grid_.size().x; ++c) {
            if (layout_.free(c)) trial_[c] = updated_head(c, part * change_[c]);
        }
    });
}

namespace {

/// Wet soil is changed by its conductivity, in which the fluxes are nearly linear where the head's are steep.
double updated_wet_head(const SoilPoint& point, const SoilHydraulics& kind, double change) {
    if (point.head >= 0) return std::max(point.head + change, -just_full);
    const double full = kind.soil().conductivity;
    const double goal = point.conductivity + point.slope * change;
    if (goal >= full) return std::max(point.head + change, 0.0);
    return kind.head_of_conductivity(std::max(goal, 0.3 * point.conductivity), point.head);
}

}  // namespace

double Richards::updated_head(std::size_t cell, double change) const {
    const SoilPoint& point = points_[cell];
    const SoilHydraulics& kind = layout_.kind(cell);
    const SoilKind& soil = kind.soil();
    const double range = soil.saturated - soil.residual;
    const double saturation = (point.content - soil.residual) / range;
    if (saturation >= wet) return updated_wet_head(point, kind, change);
    if (std::abs(point.capacity * change) < negligible) return point.head;  // soil at rest
    const double goal = saturation + point.capacity * change / range;
    if (goal >= 0.99) return std::max(kind.head_at(soil.residual + 0.99 * range), point.head);
    return kind.head_at(soil.residual + range * std::max(goal, 0.1 * saturation), point.head);
}

}  // namespace espalier::environment
