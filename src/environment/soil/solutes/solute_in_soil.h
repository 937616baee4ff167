// A solute with all that happens to it: it moves, decays, is added, and roots take it.
#pragma once

#include "environment/soil/solutes/parameters.h"

#include <iosfwd>
#include <optional>

namespace espalier::environment {

/// Amounts, in the solute's unit; all but `stored` since the beginning.
struct SoluteAccount {
    double start = 0, stored = 0;
    double fertilised = 0, produced = 0, decayed = 0, taken = 0;
    double minimum = 0, maximum = 0;  ///< concentrations at present
};

class SoluteInSoil {
public:
    SoluteInSoil(const SoilLayout& layout, const SoluteParameters& parameters, std::uint32_t plants);

    const SoluteTransport& transport() const { return transport_; }
    const SoluteAccount& account() const { return account_; }
    double day() const { return day_; }
    double taken(std::uint32_t plant) const { return plant < taken_.size() ? taken_[plant] : 0; }
    double taken_in_step(std::uint32_t plant) const { return plant < in_step_.size() ? in_step_[plant] : 0; }
    double days_in_step() const { return days_in_step_; }
    /// In this step the first root that is outside the soil, and where.
    struct RootOutside {
        std::uint32_t plant;
        glm::dvec3 place;
    };
    const std::optional<RootOutside>& root_outside() const { return root_outside_; }
    /// What the account misses, relative to its largest entry.
    double balance_error() const;

    void begin_with(const WaterBrick& contents);
    /// The roots of a step.
    void begin_step(const WorldView& world, double days_per_unit, const WaterBrick& contents);
    /// A substep of the water, to `contents`.
    void advance(const SoilMovement& movement, const WaterBrick& contents);

    void save(std::ostream& out) const;
    void restore(std::istream& in);

private:
    /// A piece of root in a voxel; sorted by voxel.
    struct Piece {
        std::size_t cell;
        double radius, length;  ///< cm
        std::uint32_t plant;
    };
    /// The pieces of one voxel.
    struct RootedCell {
        std::size_t first, count;
        double length, surface;  ///< cm, cm2
    };

    void find_cells();
    void fertilise(double until);
    void react(double days);
    void take_up_all(double days);
    void surround(const SoilMovement& movement, const RootedCell& cell);
    void measure();
    std::vector<std::size_t> cells_in(const SolutePart& part, const Place& place) const;

    const SoilLayout& layout_;
    const SoluteParameters& parameters_;
    SoluteTransport transport_;
    std::vector<Piece> pieces_;
    std::vector<RootedCell> rooted_;
    std::vector<RootSurface> surfaces_;  ///< of the pieces
    std::vector<double> taken_now_;      ///< by them, amount per volume of soil
    std::vector<std::vector<std::size_t>> source_cells_, event_cells_;
    std::size_t next_event_ = 0;
    std::vector<double> taken_, in_step_;  ///< by plant
    SoluteAccount account_;
    double day_ = 0, days_in_step_ = 0;
    std::optional<RootOutside> root_outside_;
};

}  // namespace espalier::environment
