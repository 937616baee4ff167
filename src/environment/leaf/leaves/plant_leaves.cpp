#include "environment/leaf/leaves/plant_leaves.h"

#include "environment/leaf/gas/leaf_columns.h"
#include "environment/leaf/leaves/units.h"

#include <algorithm>
#include <cmath>

namespace espalier::environment::leaf {
namespace {

constexpr std::size_t leaves_at_once = 256;
constexpr std::uint32_t no_row = ~0U;

}  // namespace

void PlantLeaves::add(std::uint32_t module, std::uint16_t kind, float leaf_area) {
    modules.push_back(module);
    kinds.push_back(kind);
    area.push_back(leaf_area);
}

void PlantLeaves::begin(double with_potential) {
    potential.assign(size(), with_potential);
    for (std::vector<double>& column : state) column.assign(size(), 0);
    for (auto* column : {&gain_rate, &water_rate, &gain, &water}) column->assign(size(), 0);
    residual.assign(size(), 0);
}

std::size_t PlantLeaves::row_of(std::uint32_t module) const {
    const auto found = std::lower_bound(modules.begin(), modules.end(), module);
    return found != modules.end() && *found == module ? static_cast<std::size_t>(found - modules.begin()) : size();
}

double PlantLeaves::own_or(OwnParameter parameter, std::size_t row, double of_kind) const {
    const std::vector<float>& column = own[static_cast<std::size_t>(parameter)];
    return column.empty() || std::isnan(column[row]) ? of_kind : static_cast<double>(column[row]);
}

bool PlantLeaves::has_own(std::size_t row) const {
    return std::any_of(own.begin(), own.end(),
                       [&](const std::vector<float>& column) { return !column.empty() && !std::isnan(column[row]); });
}

std::size_t PlantLeaves::bytes() const {
    std::size_t all = 0;
    const auto count = [&](const auto& column) { all += column.size() * sizeof column[0]; };
    count(modules), count(kinds), count(area), count(lit), count(sunlit), count(sun_photons), count(shade_photons);
    count(sun_near_infrared), count(shade_near_infrared), count(thermal), count(potential), count(gain_rate);
    count(water_rate), count(by_potential), count(sent), count(residual), count(gain), count(water);
    for (const auto& column : own) count(column);
    for (const auto& column : state) count(column);
    return all;
}

std::vector<LeafChunk> chunks_of(std::span<const PlantLeaves> all, std::span<const std::uint32_t> plants,
                                 std::size_t kinds) {
    std::vector<LeafChunk> chunks;
    std::vector<std::size_t> open(kinds, std::size_t(-1));  // the chunk of each kind that has room
    for (const std::uint32_t plant : plants) {
        for (std::uint32_t row = 0; row < all[plant].size(); ++row) {
            std::size_t& of_kind = open[all[plant].kinds[row]];
            if (of_kind == std::size_t(-1) || chunks[of_kind].rows.size() == leaves_at_once) {
                of_kind = chunks.size();
                chunks.push_back({all[plant].kinds[row], {}});
            }
            chunks[of_kind].rows.push_back({plant, row});
        }
    }
    return chunks;
}

// What is solved of a row, behind the states of a leaf.
constexpr std::size_t sent_column = leaf_states, slope_column = leaf_states + 1, residual_column = leaf_states + 2;
constexpr std::size_t solved_columns = leaf_states + 3;

/// What is solved for a chunk: up to three rows a leaf.
class LeafSolver::Rows {
public:
    Rows(std::size_t most, const Asked& asked) : asked_(asked) {
        for (auto& column : in_) column.reserve(most);
    }

    std::uint32_t add(const LeafKind& kind, const PlantLeaves& leaves, std::size_t row, const LeafLight& light) {
        const Photosynthesis& rates = kind.photosynthesis;
        const double numbers[] = {light.photons,
                                  light.near_infrared,
                                  light.thermal,
                                  leaves.potential[row],
                                  leaves.own_or(OwnParameter::v, row, rates.carboxylation.at_25),
                                  leaves.own_or(OwnParameter::jmax, row, rates.electron_transport.at_25),
                                  leaves.own_or(OwnParameter::rd, row, rates.respiration.at_25),
                                  leaves.own_or(OwnParameter::g1, row, kind.stomata.slope),
                                  leaves.own_or(OwnParameter::width, row, kind.width)};
        for (std::size_t i = 0; i < in_.size(); ++i) in_[i].push_back(numbers[i]);
        return static_cast<std::uint32_t>(in_[0].size() - 1);
    }

    void solve(const LeafKind& kind, const Air& air) {
        for (auto& column : out_) column.resize(in_[0].size());
        const auto in = [&](std::size_t i) { return in_[i].data(); };
        const auto out = [&](std::size_t i) { return out_[i].data(); };
        leaf::solve(kind, air,
                    {in_[0].size(), in(0), in(1), in(2), in(3), in(4), in(5), in(6), in(7), in(8), out(assimilation),
                     out(transpiration), out(conductance), out(temperature), out(internal), out(deficit),
                     out(sent_column), asked_.by_potential ? out(slope_column) : nullptr, out(residual_column)});
    }

    double operator()(std::size_t column, std::uint32_t row) const { return out_[column][row]; }

private:
    Asked asked_;
    std::array<std::vector<double>, 9> in_;
    std::array<std::vector<double>, solved_columns> out_;
};

/// The rows of a leaf: in the sun's own light and out of it, and in the dark.
struct LeafSolver::Parts {
    std::uint32_t sun = no_row, shade = no_row, dark = no_row;
    double sunlit = 0, lit = 0;

    double in_the_dark(const Rows& rows, const UsualRow& usual, std::size_t column) const {
        return dark == no_row ? usual[column] : rows(column, dark);
    }
    /// While there is light, or in the dark where there is none.
    double now(const Rows& rows, const UsualRow& usual, std::size_t column) const {
        if (shade == no_row) return in_the_dark(rows, usual, column);
        const double shaded = rows(column, shade);
        return sun == no_row ? shaded : shaded + sunlit * (rows(column, sun) - shaded);
    }
    double over_step(const Rows& rows, const UsualRow& usual, std::size_t column) const {
        return lit * now(rows, usual, column) + (1 - lit) * in_the_dark(rows, usual, column);
    }
    double residual(const Rows& rows, const UsualRow& usual) const {
        double largest = in_the_dark(rows, usual, residual_column);
        for (const std::uint32_t part : {sun, shade}) {
            if (part != no_row) largest = std::max(largest, rows(residual_column, part));
        }
        return largest;
    }
};

LeafSolver::LeafSolver(const LeafKinds& kinds, const Air& air, double thermal)
    : kinds_(kinds), air_(air), thermal_(thermal) {
    const LeafLight dark{0, 0, thermal};
    for (std::size_t k = 0; k < kinds.size(); ++k) {
        const GasExchange unlit = gas_exchange(kinds[k], dark, air);
        unlit_.push_back({unlit.assimilation, unlit.transpiration, unlit.conductance, unlit.temperature, unlit.internal,
                          unlit.deficit, unlit.sent, 0, residuals_of(unlit, kinds[k], dark, air).largest()});
    }
}

/// All leaves of a kind that have not dried are alike in the dark.
bool LeafSolver::is_usual_in_the_dark(const PlantLeaves& leaves, std::size_t row) const {
    return leaves.thermal.empty() && !leaves.has_own(row) &&
           leaves.potential[row] >= kinds_[leaves.kinds[row]].stomata.dry;
}

LeafSolver::Parts LeafSolver::add_leaf(Rows& rows, const PlantLeaves& leaves, std::size_t row) const {
    const LeafKind& kind = kinds_[leaves.kinds[row]];
    const double thermal = leaves.thermal.empty() ? thermal_ : leaves.thermal[row];
    Parts parts;
    parts.sunlit = leaves.sunlit[row];
    parts.lit = leaves.lit[row];
    if (leaves.shade_photons[row] > 0 || parts.sunlit > 0) {
        parts.shade =
            rows.add(kind, leaves, row, {leaves.shade_photons[row], leaves.shade_near_infrared[row], thermal});
    }
    if (parts.sunlit > 0) {
        parts.sun = rows.add(kind, leaves, row, {leaves.sun_photons[row], leaves.sun_near_infrared[row], thermal});
    }
    const bool is_lit_all_the_time = parts.lit >= 1 && parts.shade != no_row;
    if (!is_lit_all_the_time && !is_usual_in_the_dark(leaves, row)) {
        parts.dark = rows.add(kind, leaves, row, {0, 0, thermal});
    }
    return parts;
}

void LeafSolver::solve(std::span<PlantLeaves> plants, const LeafChunk& chunk, const Asked& asked) const {
    Rows rows(3 * chunk.rows.size(), asked);
    std::vector<Parts> parts;
    for (const auto& [plant, row] : chunk.rows) parts.push_back(add_leaf(rows, plants[plant], row));
    rows.solve(kinds_[chunk.kind], air_);
    const UsualRow& usual = unlit_[chunk.kind];
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto [plant, row] = chunk.rows[i];
        PlantLeaves& leaves = plants[plant];
        const double area = leaves.area[row], water = cm3_of_mole * seconds_per_day * area;
        for (std::size_t s = 0; s < leaf_states; ++s) leaves.state[s][row] = parts[i].now(rows, usual, s);
        const auto over_step = [&](std::size_t column) { return parts[i].over_step(rows, usual, column); };
        leaves.gain_rate[row] = 1e-6 * seconds_per_day * area * over_step(assimilation);
        leaves.water_rate[row] = water * over_step(transpiration);
        leaves.residual[row] = static_cast<float>(parts[i].residual(rows, usual));
        if (asked.by_potential) leaves.by_potential[row] = static_cast<float>(water * over_step(slope_column));
        if (asked.sent) leaves.sent[row] = over_step(sent_column);
    }
}

}  // namespace espalier::environment::leaf
