#include "environment/soil/roots/uptake.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

namespace espalier::environment {
double FeddesHeads::factor(double head) const {
    if (head >= anaerobic || head <= wilting) return 0;
    if (head > wet) return (anaerobic - head) / (anaerobic - wet);
    return head >= dry ? 1 : (head - wilting) / (dry - wilting);
}

double FeddesHeads::slope(double head) const {
    if (head >= anaerobic || head <= wilting || (head <= wet && head >= dry)) return 0;
    return head > wet ? -1 / (anaerobic - wet) : 1 / (dry - wilting);
}

double PlantWater::transpiration() const {
    return std::accumulate(uptake.begin(), uptake.end(), 0.0);
}

PlantUptake::PlantUptake(PlantRoots roots, const SoilLayout& soil) : roots_(std::move(roots)), soil_(soil) {
    const std::size_t count = roots_.pieces.size();
    resistance_.assign(count, 0);
    for (std::size_t i = 0; i < count; ++i) {
        radial_.push_back(roots_.pieces[i].radial);
        const std::size_t cell = roots_.cells[i];
        heights_.push_back(cell == PlantRoots::no_cell ? 0 : 100 * soil.grid().centre(soil.grid().voxel_of(cell)).y);
    }
    water_.uptake.assign(count, 0);
    water_.by_head.assign(count, 0);
    water_.surface.assign(count, 0);
    water_.xylem.assign(count, 0);
    find_cells();
    measure_conductance();
}

void PlantUptake::find_cells() {
    // Pieces of one root in one voxel mostly follow one another.
    const std::vector<std::size_t>& cells = roots_.cells;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const bool is_new = i == 0 || cells[i] != cells[i - 1];
        if (is_new && cells[i] != PlantRoots::no_cell) cells_.push_back(cells[i]);
    }
    std::sort(cells_.begin(), cells_.end());
    cells_.erase(std::unique(cells_.begin(), cells_.end()), cells_.end());
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (i > 0 && cells[i] == cells[i - 1]) {
            places_.push_back(places_.back());
        } else {
            const auto place = std::lower_bound(cells_.begin(), cells_.end(), cells[i]) - cells_.begin();
            places_.push_back(static_cast<std::uint32_t>(place));
        }
    }
}

void PlantUptake::measure_conductance() {
    water_.conductance = tree_.look(roots_.pieces).conductance;
    tree_.answer_collar(roots_.pieces, water_.fractions);
    for (double& fraction : water_.fractions) fraction = water_.conductance > 0 ? fraction / water_.conductance : 0;
}

void PlantUptake::add_lengths(WaterBrick& lengths) const {
    for (std::size_t i = 0; i < roots_.pieces.size(); ++i) {
        if (roots_.cells[i] != PlantRoots::no_cell) lengths[roots_.cells[i]] += roots_.pieces[i].length;
    }
}

void PlantUptake::surround(const WaterBrick& lengths, bool zone) {
    const double volume = soil_.volume();
    for (std::size_t i = 0; i < resistance_.size() && zone; ++i) {
        if (roots_.cells[i] == PlantRoots::no_cell) continue;
        const double outer = std::sqrt(volume / (std::numbers::pi * lengths[roots_.cells[i]]));
        resistance_[i] = roots_.radii[i] * zone_factor(roots_.radii[i], outer);
    }
}

void PlantUptake::begin(std::span<const SoilPoint> points) {
    if (begun_) return;
    for (std::size_t i = 0; i < radial_.size(); ++i) {
        if (roots_.cells[i] != PlantRoots::no_cell) water_.xylem[i] = points[roots_.cells[i]].head;
    }
    begun_ = true;
}

void PlantUptake::solve(std::span<const SoilPoint> points, UptakeModel model, const RootCollar& collar,
                        const FeddesHeads& feddes, double demand, double held_head) {
    if (roots_.pieces.empty()) return;
    begin(points);
    water_.demand = collar.held ? std::nan("") : demand;
    shoot_by_head_.reset();
    if (model != UptakeModel::network) return solve_macroscopic(points, model, collar, feddes, demand, held_head);
    solve_network(points, [&](const CollarView& view) {
        if (collar.held) return held_head + roots_.collar_height;
        const double limit = collar.limit + roots_.collar_height;
        const double wanted = view.conductance > 0 ? view.head - demand / view.conductance : limit;
        shoot_by_head_ = wanted > limit ? std::optional(0.0) : std::nullopt;
        return std::max(wanted, limit);
    });
}

void PlantUptake::solve_under(std::span<const SoilPoint> points, CollarEnd& shoot) {
    if (roots_.pieces.empty()) return;
    begin(points);
    solve_network(points, [&](const CollarView& view) { return shoot.meet(view); });
    shoot_by_head_ = shoot.by_head();
}

bool PlantUptake::answer_together(std::vector<double>& by_cell, double& collar) const {
    if (!shoot_by_head_ || roots_.pieces.empty()) return false;
    collar = conductance_ + *shoot_by_head_;
    std::vector<double> by_collar;
    tree_.answer_collar(roots_.pieces, by_collar);
    by_cell.assign(cells_.size(), 0);
    for (std::size_t i = 0; i < by_collar.size(); ++i) {
        if (roots_.cells[i] != PlantRoots::no_cell) by_cell[places_[i]] += by_collar[i];
    }
    return collar > 0;
}

void PlantUptake::pass(double days, double weight, double before) {
    const std::vector<double>& now = water_.uptake;
    if (rates_.size() != now.size()) {
        // The step begins with other pieces than the last one had: they share what the plant took up.
        const double sum = water_.transpiration();
        rates_ = now;
        if (sum > 0) {
            for (double& rate : rates_) rate *= before / sum;
        }
    }
    days_ += days;
    taken_.resize(now.size(), 0);
    for (std::size_t i = 0; i < now.size(); ++i) {
        rates_[i] = weight * now[i] + (1 - weight) * rates_[i];
        taken_[i] += rates_[i] * days;
    }
}

double PlantUptake::mean_uptake(std::size_t piece) const {
    return days_ > 0 ? taken_[piece] / days_ : water_.uptake[piece];
}

/// Newton's method: around each piece the flow through soil and root wall is replaced by its tangent, and the tree of
/// these is solved exactly.
void PlantUptake::solve_network(std::span<const SoilPoint> points,
                                const std::function<double(const CollarView&)>& collar_head) {
    const tbb::blocked_range<std::size_t> all(0, radial_.size(), 4096);
    const auto take = [&](const auto& part, double most) {
        for (std::size_t i = part.begin(); i != part.end(); ++i) most = std::max(most, take_flow(i));
        return most;
    };
    for (int step = 0; step < 60; ++step) {
        for_in_parallel(all, [&](const auto& part) {
            for (std::size_t i = part.begin(); i != part.end(); ++i) find_tangent(i, points);
        });
        const CollarView view = tree_.look(roots_.pieces);
        const double head = collar_head(view);
        conductance_ = view.conductance;
        tree_.flow(roots_.pieces, head, flow_);
        const double moved = reduce_in_parallel(all, 0.0, take, [](double a, double b) { return std::max(a, b); });
        water_.collar = head - roots_.collar_height;
        // Newton's method doubles the digits: what is left is below 1e-9.
        if (moved < 1e-6) break;
    }
}

/// Of the flow into a piece at its present head.
void PlantUptake::find_tangent(std::size_t i, std::span<const SoilPoint> points) {
    const std::size_t cell = roots_.cells[i];
    if (cell == PlantRoots::no_cell) return;
    const RadialFlow flow =
        radial_flow(soil_.kind(cell), points[cell], water_.xylem[i], radial_[i], resistance_[i], water_.surface[i]);
    RootPiece& piece = roots_.pieces[i];
    piece.radial = std::max(-flow.by_xylem, 1e-13 * radial_[i]);
    piece.outside = heights_[i] + water_.xylem[i] + (piece.radial > 0 ? flow.flux / piece.radial : 0);
    water_.surface[i] = flow.surface_head;
    water_.by_head[i] = flow.by_soil * piece.surface_per_length * piece.length;
}

/// Takes what the tree has for a piece, its uptake and its head; returns how far that moved, relative.
double PlantUptake::take_flow(std::size_t i) {
    const RootPiece& piece = roots_.pieces[i];
    const double wall = piece.radial * piece.surface_per_length * piece.length;
    water_.uptake[i] = flow_.uptake[i];
    if (!(wall > 0)) return 0;
    const double xylem = piece.outside - flow_.uptake[i] / wall - heights_[i];
    const double before = std::exchange(water_.xylem[i], xylem);
    return std::abs(xylem - before) / (1 + std::abs(xylem));
}

/// Feddes: each root takes its share of the demand, by its length, as far as the soil gives it. Couvreur: the shares of
/// uniform soil, and what wet places send to dry ones.
void PlantUptake::solve_macroscopic(std::span<const SoilPoint> points, UptakeModel model, const RootCollar& collar,
                                    const FeddesHeads& feddes, double demand, double held_head) {
    const std::size_t count = radial_.size();
    double length = 0, mean = 0;
    for (std::size_t i = 0; i < count; ++i) {
        if (roots_.cells[i] == PlantRoots::no_cell) continue;
        length += roots_.pieces[i].length;
        mean += water_.fractions[i] * (points[roots_.cells[i]].head + heights_[i]);
    }
    double taken = demand;
    if (model == UptakeModel::couvreur) {
        const double limit = (collar.held ? held_head : collar.limit) + roots_.collar_height;
        const double most = water_.conductance * (mean - limit);
        taken = collar.held ? most : std::min(demand, std::max(most, 0.0));
        water_.collar = mean - taken / std::max(water_.conductance, 1e-300) - roots_.collar_height;
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (roots_.cells[i] == PlantRoots::no_cell) continue;
        const SoilPoint& point = points[roots_.cells[i]];
        if (model == UptakeModel::feddes) {
            const double share = demand * roots_.pieces[i].length / length;
            water_.uptake[i] = share * feddes.factor(point.head);
            water_.by_head[i] = share * feddes.slope(point.head);
        } else {
            const double sends = water_.conductance * water_.fractions[i];
            water_.uptake[i] = water_.fractions[i] * taken + sends * (point.head + heights_[i] - mean);
            water_.by_head[i] = sends;
        }
        water_.surface[i] = point.head;
    }
}

}  // namespace espalier::environment
