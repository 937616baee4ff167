#include "environment/soil/richards/fluxes.h"

#include <algorithm>

namespace espalier::environment {

SoilForcing SoilForcing::at(double day, const SoilParameters& parameters, const WaterGrid& grid) {
    const SoilSurface& surface = parameters.surface;
    const SoilFloor& floor = parameters.floor;
    SoilForcing forcing{
        {0.1 * surface.rain.at(day), 0.1 * surface.evaporation.at(day), surface.dry_limit, 0.1 * surface.ponding},
        0.1 * surface.flux.at(day),
        surface.head.at(day),
        0.1 * floor.flux.at(day),
        floor.table ? 100 * (*floor.table - grid.lower().y) : floor.head.at(day)};
    for (std::size_t side = 0; side < parameters.sides.size(); ++side) {
        if (parameters.sides[side].is_open()) forcing.sides[side] = parameters.sides[side].value.at(day);
    }
    return forcing;
}

SoilFluxes::SoilFluxes(const SoilLayout& layout, const SoilParameters& parameters)
    : layout_(layout), parameters_(parameters), grid_(layout.grid()) {
    for (FaceFluxes& axis : faces_) axis.resize(grid_.cells());
    const std::size_t columns = std::size_t(grid_.size().x) * grid_.size().z;
    floor_.resize(columns);
    surface_.resize(columns);
    for (std::size_t side = 0; side < sides_.size(); ++side) {
        if (!parameters.sides[side].is_open()) continue;
        has_side_heads_ = true;
        sides_[side].resize(side < 2 ? grid_.rows() : std::size_t(grid_.size().x) * grid_.size().y);
    }
}

void SoilFluxes::find_inner(std::span<const SoilPoint> points) {
    layout_.for_rows([&](std::size_t row) { find_inner(row, points); });
}

void SoilFluxes::find(std::span<const SoilPoint> points, const SoilForcing& forcing, const WaterBrick& ponding,
                      double days) {
    layout_.for_rows([&](std::size_t row) {
        find_inner(row, points);
        if (grid_.y_of(row) == 0) {
            const std::size_t column = std::size_t(grid_.z_of(row)) * grid_.size().x, begin = grid_.row_begin(row);
            for (int x = 0; x < grid_.size().x; ++x) {
                floor_[column + x] = through_floor(begin + x, points[begin + x], forcing);
            }
        }
        if (grid_.y_of(row) + 1 == grid_.size().y) find_surface(row, points, forcing, ponding, days);
        if (has_side_heads_) find_sides(row, points, forcing);
    });
}

void SoilFluxes::find_inner(std::size_t row, std::span<const SoilPoint> points) {
    const NeighbourRows at = layout_.neighbours(row);
    const int n = grid_.size().x;
    const auto set = [&](int axis, std::size_t own, std::size_t next) {
        const SoilFlux flux = darcy(axis, own, next, points);
        faces_[axis].flux[own] = flux.flux;
        faces_[axis].by_own[own] = flux.by_first;
        faces_[axis].by_next[own] = flux.by_second;
    };
    for (int x = 0; x + 1 < n; ++x) set(0, at.own + x, at.own + x + 1);
    if (layout_.joined_x()) set(0, at.own + n - 1, at.own);
    for (int x = 0; x < n && at.has_above; ++x) set(1, at.own + x, at.above + x);
    for (int x = 0; x < n && at.has_front; ++x) set(2, at.own + x, at.front + x);
    for (WaterBrick* brick : {&faces_[0].flux, &faces_[0].by_own, &faces_[0].by_next}) {
        (*brick)[at.own - 1] = layout_.joined_x() ? (*brick)[at.own + n - 1] : 0;
    }
}

SoilFlux SoilFluxes::darcy(int axis, std::size_t own, std::size_t next, std::span<const SoilPoint> points) const {
    if (!layout_.free(own) || !layout_.free(next)) return {};
    const bool same = layout_.kind_number(own) == layout_.kind_number(next);
    const SoilPoint &a = points[own], &b = points[next];
    const double edge = layout_.edge();
    if (axis != 1) {
        return same ? flux_across(a, b, edge)
                    : flux_between_soils(layout_.kind(own), a, layout_.kind(next), b, edge, false);
    }
    const SoilFlux down =
        same ? flux_down(b, a, edge) : flux_between_soils(layout_.kind(next), b, layout_.kind(own), a, edge, true);
    return {-down.flux, -down.by_second, -down.by_first};
}

/// Upwards into the lowest voxel; by_first: with that voxel's head.
SoilFlux SoilFluxes::through_floor(std::size_t cell, const SoilPoint& point, const SoilForcing& forcing) const {
    if (!layout_.free(cell)) return {};
    switch (parameters_.floor.kind) {
        case SoilFloor::Kind::free_drainage:
            return {-point.conductivity, -point.slope, 0};
        case SoilFloor::Kind::flux:
            return {forcing.floor_flux, 0, 0};
        case SoilFloor::Kind::head:
        case SoilFloor::Kind::seepage: {
            const bool seeps = parameters_.floor.kind == SoilFloor::Kind::seepage;
            const SoilPoint below = layout_.kind(cell).at(seeps ? 0 : forcing.floor_head);
            const SoilFlux down = flux_down(point, below, 0.5 * layout_.edge());
            if (seeps && down.flux <= 0) return {};
            return {-down.flux, -down.by_first, 0};
        }
        default:
            return {};
    }
}

void SoilFluxes::find_surface(std::size_t row, std::span<const SoilPoint> points, const SoilForcing& forcing,
                              const WaterBrick& ponding, double days) {
    using Kind = SoilSurface::Kind;
    const Kind kind = parameters_.surface.kind;
    const double half = 0.5 * layout_.edge();
    const std::size_t column = std::size_t(grid_.z_of(row)) * grid_.size().x;
    for (int x = 0; x < grid_.size().x; ++x) {
        SurfaceExchange& surface = surface_[column + x];
        const std::size_t cell = grid_.row_begin(row) + x;
        surface = {};
        if (!layout_.free(cell)) {  // rain runs off a stone
            if (kind == Kind::atmosphere) surface.runoff = forcing.weather.rain;
        } else if (kind == Kind::atmosphere) {
            surface =
                exchange_at_surface(layout_.kind(cell), points[cell], half, forcing.weather, ponding[column + x], days);
        } else if (kind == Kind::flux) {
            surface.into.flux = forcing.surface_flux;
        } else if (kind == Kind::head) {
            surface.into = flux_down(layout_.kind(cell).at(forcing.surface_head), points[cell], half);
        }
    }
}

/// Half a voxel from a face whose head is given.
void SoilFluxes::find_sides(std::size_t row, std::span<const SoilPoint> points, const SoilForcing& forcing) {
    const glm::ivec3 size = grid_.size();
    const int y = grid_.y_of(row), z = grid_.z_of(row);
    const double height = grid_.centre({0, y, 0}).y;
    const auto set = [&](std::size_t side, std::size_t face, std::size_t cell) {
        if (sides_[side].empty()) return;
        SoilFlux& into = sides_[side][face];
        into = {};
        if (!layout_.free(cell)) return;
        const bool is_table = parameters_.sides[side].kind == SoilSide::Kind::table;
        const double given = forcing.sides[side], head = is_table ? 100 * (given - height) : given;
        into = flux_across(layout_.kind(cell).at(head), points[cell], 0.5 * layout_.edge());
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

double SoilFluxes::through_sides() const {
    double sum = 0;
    for (const std::vector<SoilFlux>& side : sides_) {
        for (const SoilFlux& flux : side) sum += flux.flux;
    }
    return sum;
}

SoilFlux SoilFluxes::through_sides(std::size_t cell) const {
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
double SoilFluxes::into_side(std::size_t side, const glm::ivec3& voxel) const {
    if (sides_[side].empty()) return 0;
    const int axis = side < 2 ? 0 : 2, place = side % 2 == 0 ? 0 : grid_.size()[axis] - 1;
    if (voxel[axis] != place) return 0;
    const std::size_t row = std::size_t(voxel.z) * grid_.size().y + voxel.y;
    return sides_[side][side < 2 ? row : std::size_t(voxel.y) * grid_.size().x + voxel.x].flux;
}

bool SoilFluxes::has_pond() const {
    return std::any_of(surface_.begin(), surface_.end(), [](const SurfaceExchange& at) { return at.ponding > 0; });
}

double SoilFluxes::at_centre(std::size_t cell, int axis) const {
    if (!layout_.free(cell)) return 0;
    const std::size_t row = cell / grid_.stride();
    const NeighbourRows at = layout_.neighbours(row);
    const std::size_t x = cell - at.own;
    const WaterBrick& flux = faces_[axis].flux;
    const glm::ivec3 voxel = grid_.voxel_of(cell);
    if (axis == 0) return 0.5 * (flux[cell] + flux[cell - 1] + into_side(0, voxel) - into_side(1, voxel));
    if (axis == 2) {
        const double back = at.back != at.own ? flux[at.back + x] : 0;
        return 0.5 * (flux[cell] + back + into_side(2, voxel) - into_side(3, voxel));
    }
    const std::size_t column = std::size_t(grid_.z_of(row)) * grid_.size().x + x;
    const double below = at.below != at.own ? flux[at.below + x] : floor_[column].flux;
    const double above = at.has_above ? flux[cell] : -surface_[column].into.flux;
    return 0.5 * (below + above);
}

SoilFluxes::Outflow SoilFluxes::out_of(const NeighbourRows& at, int x, std::size_t column) const {
    const std::size_t c = at.own + x, below = at.below + x, back = at.back + x;
    const auto& [fx, fy, fz] = faces_;
    Outflow out{fx.flux[c] - fx.flux[c - 1], fx.by_own[c] - fx.by_next[c - 1]};
    const auto leaves = [&](double flux, double by_head) {
        out.flux += flux;
        out.by_head += by_head;
    };
    const auto enters = [&](double flux, double by_head) {
        out.flux -= flux;
        out.by_head -= by_head;
    };
    if (at.has_above) {
        leaves(fy.flux[c], fy.by_own[c]);
    } else {
        enters(surface_[column + x].into.flux, surface_[column + x].into.by_second);
    }
    if (below != c) {
        enters(fy.flux[below], fy.by_next[below]);
    } else {
        enters(floor_[column + x].flux, floor_[column + x].by_first);
    }
    if (at.has_front) leaves(fz.flux[c], fz.by_own[c]);
    if (back != c) enters(fz.flux[back], fz.by_next[back]);
    if (has_side_heads_) {
        const SoilFlux into = through_sides(c);
        enters(into.flux, into.by_second);
    }
    return out;
}

}  // namespace espalier::environment
