#include "environment/soil/solutes/solute_in_soil.h"

#include "espalier/base/math.h"
#include "espalier/base/stop.h"

#include "base/bytes.h"
#include "base/parallel.h"
#include "environment/soil/roots/plant_roots.h"
#include "environment/soil/roots/zone.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <istream>
#include <limits>
#include <numbers>
#include <ostream>

namespace espalier::environment {

SoluteInSoil::SoluteInSoil(const SoilLayout& layout, const SoluteParameters& parameters, std::uint32_t plants)
    : layout_(layout),
      parameters_(parameters),
      transport_(layout, parameters.properties),
      taken_(plants, 0),
      in_step_(plants, 0) {
    for (const SoluteSource& source : parameters.sources) {
        source_cells_.push_back(cells_in(source.part, source.place));
    }
    for (const SoluteEvent& event : parameters.events) event_cells_.push_back(cells_in(event.part, event.place));
}

std::vector<std::size_t> SoluteInSoil::cells_in(const SolutePart& part, const Place& place) const {
    const WaterGrid& grid = layout_.grid();
    std::vector<std::size_t> cells;
    for (std::size_t row = 0; row < grid.rows(); ++row) {
        for (int x = 0; x < grid.size().x; ++x) {
            const std::size_t c = grid.row_begin(row) + x;
            if (layout_.free(c) && part.inside(grid.centre(grid.voxel_of(c)))) cells.push_back(c);
        }
    }
    if (cells.empty()) throw UserError(place, "this holds no voxel's centre: make it larger or move it");
    return cells;
}

void SoluteInSoil::begin_with(const WaterBrick& contents) {
    transport_.set_content(contents);
    const WaterGrid& grid = layout_.grid();
    layout_.for_rows([&](std::size_t row) {
        for (int x = 0; x < grid.size().x; ++x) {
            const std::size_t c = grid.row_begin(row) + x;
            if (!layout_.free(c)) continue;
            double concentration = parameters_.initial;
            const glm::dvec3 centre = grid.centre(grid.voxel_of(c));
            for (const SoluteBeginning& beginning : parameters_.beginnings) {
                if (beginning.part.inside(centre)) concentration = beginning.concentration;
            }
            transport_.amount[c] = parameters_.properties.sorption.amount(transport_.content()[c], concentration);
        }
    });
    transport_.find_concentrations();
    measure();
    account_.start = account_.stored;
}

void SoluteInSoil::begin_step(const WorldView& world, double days_per_unit, const WaterBrick& contents) {
    transport_.set_content(contents);
    transport_.find_concentrations();
    std::fill(in_step_.begin(), in_step_.end(), 0);
    days_in_step_ = 0;
    root_outside_.reset();
    pieces_.clear();
    if (parameters_.kinetics.any()) {
        static const std::vector<RootConductances> none{{RootCurve{{}, {0}}, RootCurve{{}, {0}}}};
        for (const PlantView& plant : world.plants) {
            const PlantRoots roots = roots_in_soil(plant, world, days_per_unit, layout_, none, RootMeasure::age);
            if (roots.left_at && !root_outside_) root_outside_ = {plant.plant, *roots.left_at};
            for (std::size_t i = 0; i < roots.pieces.size(); ++i) {
                if (roots.cells[i] == PlantRoots::no_cell) continue;
                pieces_.push_back({roots.cells[i], roots.radii[i], roots.pieces[i].length, plant.plant});
            }
        }
    }
    find_cells();
}

void SoluteInSoil::find_cells() {
    std::stable_sort(pieces_.begin(), pieces_.end(), [](const Piece& a, const Piece& b) { return a.cell < b.cell; });
    rooted_.clear();
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
        if (i == 0 || pieces_[i].cell != pieces_[i - 1].cell) rooted_.push_back({i, 0, 0, 0});
        RootedCell& cell = rooted_.back();
        ++cell.count;
        cell.length += pieces_[i].length;
        cell.surface += 2 * std::numbers::pi * pieces_[i].radius * pieces_[i].length;
    }
    surfaces_.assign(pieces_.size(), {});
    taken_now_.assign(pieces_.size(), 0);
}

/// Half a step of uptake and decay before each step of movement, half after it (Strang 1968).
void SoluteInSoil::advance(const SoilMovement& movement, const WaterBrick& contents) {
    const double end = movement.day + movement.days;
    const int stable = transport_.parts(movement, contents);
    const int parts = std::max(stable, static_cast<int>(std::ceil(movement.days / parameters_.max_substep)));
    const double days = movement.days / parts;
    SoluteSides sides = parameters_.sides;
    sides.entering_top = parameters_.rain.at(movement.day + 0.5 * movement.days);
    for (const RootedCell& cell : rooted_) surround(movement, cell);
    for (int part = 0; part < parts; ++part) {
        end_if_asked();
        day_ = movement.day + part * days;
        fertilise(day_ + days);
        react(0.5 * days);
        transport_.advance(movement, contents, days, days * (parts - part), sides);
        react(0.5 * days);
        transport_.find_concentrations();
    }
    day_ = end;
    days_in_step_ += movement.days;
    measure();
}

/// An event falls on the beginning of the part of a substep that its day is in.
void SoluteInSoil::fertilise(double until) {
    for (; next_event_ < parameters_.events.size() && parameters_.events[next_event_].day < until; ++next_event_) {
        const std::vector<std::size_t>& cells = event_cells_[next_event_];
        const double amount = parameters_.events[next_event_].amount;
        const double share = amount / (layout_.volume() * static_cast<double>(cells.size()));
        for (const std::size_t c : cells) transport_.amount[c] += share;
        account_.fertilised += amount;
    }
}

void SoluteInSoil::react(double days) {
    const double volume = layout_.volume();
    for (std::size_t k = 0; k < source_cells_.size(); ++k) {
        const double amount = parameters_.sources[k].rate * days;
        for (const std::size_t c : source_cells_[k]) transport_.amount[c] += amount;
        account_.produced += amount * volume * static_cast<double>(source_cells_[k].size());
    }
    if (parameters_.decay > 0) {
        const double lost = 1 - math::exp(-parameters_.decay * days);
        for (double& amount : transport_.amount) {
            account_.decayed += lost * amount * volume;
            amount -= lost * amount;
        }
    }
    if (!rooted_.empty()) take_up_all(days);
}

void SoluteInSoil::surround(const SoilMovement& movement, const RootedCell& cell) {
    const std::size_t c = pieces_[cell.first].cell;
    const double volume = layout_.volume(), outer = std::sqrt(volume / (std::numbers::pi * cell.length));
    // Roots share the water of their voxel by their surfaces; what gives water gives no solute.
    const double water = std::max(movement.uptake[c], 0.0) * volume / cell.surface;
    const double conductivity = transport_.diffusivity(c);
    for (std::size_t i = cell.first; i < cell.first + cell.count; ++i) {
        const double radius = pieces_[i].radius;
        const double distance = parameters_.zone ? radius * zone_factor(radius, outer) : 0;
        surfaces_[i] = {SolutePath::of(water, distance, conductivity),
                        2 * std::numbers::pi * radius * pieces_[i].length / volume};
    }
}

void SoluteInSoil::take_up_all(double days) {
    for_in_parallel(tbb::blocked_range<std::size_t>(0, rooted_.size(), 64), [&](const auto& range) {
        for (std::size_t k = range.begin(); k != range.end(); ++k) {
            const RootedCell& cell = rooted_[k];
            const std::size_t c = pieces_[cell.first].cell;
            transport_.amount[c] =
                take_up(parameters_.kinetics, parameters_.properties.sorption, transport_.content()[c],
                        transport_.amount[c], std::span(surfaces_).subspan(cell.first, cell.count), days,
                        std::span(taken_now_).subspan(cell.first, cell.count));
        }
    });
    const double volume = layout_.volume();
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
        const double amount = taken_now_[i] * volume;
        account_.taken += amount;
        if (pieces_[i].plant >= taken_.size()) continue;
        taken_[pieces_[i].plant] += amount;
        in_step_[pieces_[i].plant] += amount;
    }
}

void SoluteInSoil::measure() {
    account_.stored = 0;
    account_.minimum = std::numeric_limits<double>::infinity();
    account_.maximum = 0;
    const WaterGrid& grid = layout_.grid();
    for (std::size_t row = 0; row < grid.rows(); ++row) {
        double sum = 0;
        for (std::size_t c = grid.row_begin(row); c < grid.row_begin(row) + grid.size().x; ++c) {
            if (!layout_.free(c)) continue;
            sum += transport_.amount[c];
            account_.minimum = std::min(account_.minimum, transport_.concentration[c]);
            account_.maximum = std::max(account_.maximum, transport_.concentration[c]);
        }
        account_.stored += sum * layout_.volume();
    }
    if (account_.minimum > account_.maximum) account_.minimum = 0;
}

double SoluteInSoil::balance_error() const {
    const SoluteAccount& a = account_;
    const SoluteFlown& f = transport_.flown();
    const double missing =
        a.start + a.fertilised + a.produced + f.top + f.bottom + f.sides - a.decayed - a.taken - a.stored;
    const double largest = std::max({a.start, a.stored, a.fertilised, a.produced, std::abs(f.top), std::abs(f.bottom),
                                     std::abs(f.sides), a.decayed, a.taken});
    return largest > 0 ? missing / largest : 0;
}

void SoluteInSoil::save(std::ostream& out) const {
    write_doubles(out, {transport_.amount.data(), transport_.amount.size()});
    write_doubles(out, taken_);
    write_doubles(out, in_step_);
    const double numbers[] = {day_, days_in_step_, static_cast<double>(next_event_)};
    write_doubles(out, numbers);
    put(out, account_);
    put(out, transport_.flown());
}

void SoluteInSoil::restore(std::istream& in) {
    read_doubles(in, {transport_.amount.data(), transport_.amount.size()});
    read_doubles(in, taken_);
    read_doubles(in, in_step_);
    double numbers[3];
    read_doubles(in, numbers);
    day_ = numbers[0];
    days_in_step_ = numbers[1];
    next_event_ = static_cast<std::size_t>(numbers[2]);
    account_ = get<SoluteAccount>(in);
    transport_.flown() = get<SoluteFlown>(in);
}

}  // namespace espalier::environment
