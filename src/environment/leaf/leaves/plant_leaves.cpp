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

void PlantLeaves::add(std::uint32_t module, std::uint16_t kind, double leaf_area) {
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
        const std::size_t count = in_[0].size();
        for (auto& column : out_) column.resize(count);
        const auto in = [&](std::size_t i) { return in_[i].data(); };
        const auto out = [&](std::size_t i) { return out_[i].data(); };
        leaf::solve(kind, air,
                    {count, in(0), in(1), in(2), in(3), in(4), in(5), in(6), in(7), in(8), out(0), out(1), out(2),
                     out(3), out(4), out(5), out(6), asked_.by_potential ? out(7) : nullptr, out(8)});
    }

    double state(std::size_t of, std::uint32_t row) const { return out_[of][row]; }
    double sent(std::uint32_t row) const { return out_[6][row]; }
    double by_potential(std::uint32_t row) const { return asked_.by_potential ? out_[7][row] : 0; }
    double residual(std::uint32_t row) const { return out_[8][row]; }

private:
    Asked asked_;
    std::array<std::vector<double>, 9> in_, out_;
};

LeafSolver::LeafSolver(const LeafKinds& kinds, const Air& air, double thermal)
    : kinds_(kinds), air_(air), thermal_(thermal) {
    const LeafLight dark{0, 0, thermal};
    for (std::size_t k = 0; k < kinds.size(); ++k) {
        unlit_.push_back(gas_exchange(kinds[k], dark, air));
        residual_in_the_dark_.push_back(residuals_of(unlit_.back(), kinds[k], dark, air).largest());
    }
}

/// All leaves of a kind that have not dried are alike in the dark.
bool LeafSolver::is_usual_in_the_dark(const PlantLeaves& leaves, std::size_t row) const {
    return leaves.thermal.empty() && !leaves.has_own(row) &&
           leaves.potential[row] >= kinds_[leaves.kinds[row]].stomata.dry;
}

void LeafSolver::solve(std::span<PlantLeaves> plants, const LeafChunk& chunk, const Asked& asked) const {
    struct Parts {
        std::uint32_t sun = no_row, shade = no_row, dark = no_row;
    };
    const LeafKind& kind = kinds_[chunk.kind];
    Rows rows(3 * chunk.rows.size(), asked);
    std::vector<Parts> parts(chunk.rows.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto [plant, row] = chunk.rows[i];
        const PlantLeaves& leaves = plants[plant];
        const double thermal = leaves.thermal.empty() ? thermal_ : leaves.thermal[row];
        if (leaves.shade_photons[row] > 0 || leaves.sunlit[row] > 0) {
            parts[i].shade =
                rows.add(kind, leaves, row, {leaves.shade_photons[row], leaves.shade_near_infrared[row], thermal});
        }
        if (leaves.sunlit[row] > 0) {
            parts[i].sun =
                rows.add(kind, leaves, row, {leaves.sun_photons[row], leaves.sun_near_infrared[row], thermal});
        }
        if (leaves.lit[row] >= 1 && parts[i].shade != no_row) continue;
        if (!is_usual_in_the_dark(leaves, row)) parts[i].dark = rows.add(kind, leaves, row, {0, 0, thermal});
    }
    rows.solve(kind, air_);
    const GasExchange& unlit = unlit_[chunk.kind];
    const double usual[] = {unlit.assimilation, unlit.transpiration, unlit.conductance,
                            unlit.temperature,  unlit.internal,      unlit.deficit};
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto [plant, row] = chunk.rows[i];
        const auto& [sun, shade, dark] = parts[i];
        PlantLeaves& leaves = plants[plant];
        const double sunlit = leaves.sunlit[row], lit = leaves.lit[row];
        const auto mean = [&, sun = sun, shade = shade](double in_the_dark, const auto& of) {
            if (shade == no_row) return in_the_dark;
            return sun == no_row ? of(shade) : of(shade) + sunlit * (of(sun) - of(shade));
        };
        double over_step[leaf_states];
        for (std::size_t s = 0; s < leaf_states; ++s) {
            const double unlit_value = dark == no_row ? usual[s] : rows.state(s, dark);
            leaves.state[s][row] = mean(unlit_value, [&](std::uint32_t at) { return rows.state(s, at); });
            over_step[s] = lit * leaves.state[s][row] + (1 - lit) * unlit_value;
        }
        leaves.gain_rate[row] = 1e-6 * seconds_per_day * leaves.area[row] * over_step[assimilation];
        leaves.water_rate[row] = cm3_of_mole * seconds_per_day * leaves.area[row] * over_step[transpiration];
        double residual = dark == no_row ? residual_in_the_dark_[chunk.kind] : rows.residual(dark);
        for (const std::uint32_t part : {sun, shade}) {
            if (part != no_row) residual = std::max(residual, rows.residual(part));
        }
        leaves.residual[row] = static_cast<float>(residual);
        const auto step_mean = [&](double unlit_value, const auto& of) {
            return lit * mean(unlit_value, of) + (1 - lit) * unlit_value;
        };
        if (asked.by_potential) {
            leaves.by_potential[row] = leaves.area[row] * cm3_of_mole * seconds_per_day *
                                       step_mean(dark == no_row ? 0 : rows.by_potential(dark),
                                                 [&](std::uint32_t at) { return rows.by_potential(at); });
        }
        if (asked.sent) {
            leaves.sent[row] = step_mean(dark == no_row ? unlit.sent : rows.sent(dark),
                                         [&](std::uint32_t at) { return rows.sent(at); });
        }
    }
}

}  // namespace espalier::environment::leaf
