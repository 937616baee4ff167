// The leaves of a plant in a step, column by column, and their gas exchange.
#pragma once

#include "environment/leaf/leaves/leaf_kinds.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace espalier::environment::leaf {

/// What a leaf does while there is light, or all the time in the dark.
enum LeafState { assimilation, transpiration, conductance, temperature, internal, deficit };
inline constexpr std::size_t leaf_states = 6;

/// Rows are leaves in the order of their modules. 120 to 200 bytes each, see bench/leaf.bench.cpp.
struct PlantLeaves {
    std::size_t modules_in_string = 0;
    std::vector<std::uint32_t> modules;
    std::vector<std::uint16_t> kinds;
    std::vector<float> area;  ///< m2
    // A part in the sun's own light and a part without it (de Pury & Farquhar 1997): photosynthesis is not linear.
    std::vector<float> lit;                                     ///< share of the step in which there is light
    std::vector<float> sunlit;                                  ///< share of the area
    std::vector<float> sun_photons, shade_photons;              ///< umol m-2 s-1, absorbed
    std::vector<float> sun_near_infrared, shade_near_infrared;  ///< W m-2
    std::vector<double> thermal;                                ///< W m-2 that meet both sides; empty: the scene's
    OwnParameters own;

    std::vector<double> potential;  ///< MPa
    std::array<std::vector<double>, leaf_states> state;
    std::vector<double> gain_rate, water_rate;  ///< net CO2, mol/d; cm3/d
    std::vector<float> by_potential;            ///< of the water's rate, cm3/d/MPa; where it is asked for
    std::vector<double> sent;                   ///< thermal radiation of both sides, W m-2; where it is asked for
    std::vector<float> residual;                ///< the largest
    std::vector<double> gain, water;            ///< of the step: net CO2, mol; cm3

    std::size_t size() const { return modules.size(); }
    void clear() { *this = {}; }
    void add(std::uint32_t module, std::uint16_t kind, float leaf_area);
    /// Makes room for what is solved; all leaves have this potential.
    void begin(double with_potential);
    /// The row of a module's leaf; size(): it has none.
    std::size_t row_of(std::uint32_t module) const;
    double own_or(OwnParameter parameter, std::size_t row, double of_kind) const;
    bool has_own(std::size_t row) const;
    std::size_t bytes() const;
};

struct LeafRow {
    std::uint32_t plant, row;
};

/// Leaves of one kind that are solved at once.
struct LeafChunk {
    std::uint16_t kind = 0;
    std::vector<LeafRow> rows;
};

/// All leaves of some plants.
std::vector<LeafChunk> chunks_of(std::span<const PlantLeaves> all, std::span<const std::uint32_t> plants,
                                 std::size_t kinds);

/// The gas exchange of a step's leaves in one air.
class LeafSolver {
public:
    LeafSolver(const LeafKinds& kinds, const Air& air, double thermal);

    struct Asked {
        bool by_potential = false, sent = false;
    };
    /// Of all leaves of a chunk, in their light, at their potentials.
    void solve(std::span<PlantLeaves> plants, const LeafChunk& chunk, const Asked& asked) const;

private:
    class Rows;
    struct Parts;
    using UsualRow = std::array<double, leaf_states + 3>;
    Parts add_leaf(Rows& rows, const PlantLeaves& leaves, std::size_t row) const;
    bool is_usual_in_the_dark(const PlantLeaves& leaves, std::size_t row) const;

    const LeafKinds& kinds_;
    Air air_;
    double thermal_;
    std::vector<UsualRow> unlit_;  ///< of each kind in the dark, not dried: as the rows that are solved
};

}  // namespace espalier::environment::leaf
