// ray-light: photons of sun and sky that each drawn leaf and stem absorbs, by paths of light through the drawn plants.
// Chelle & Andrieu 1998, The nested radiosity model for the distribution of light within plant canopies, for the
// question; Veach 1997, Robust Monte Carlo methods for light transport simulation, for the method.
#include "espalier/environment/environment_process.h"

#include "base/text.h"
#include "environment/rays/light_paths.h"
#include "environment/sky/daylight.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace espalier::environment {
namespace {

constexpr double least_elevation = 0.0349;  // sine of 2 degrees
constexpr int trials = 8;
constexpr std::uint32_t most_paths = 1U << 27;
constexpr double bytes_per_triangle = 300;  // corners, owner, and Embree's boxes

std::array<double, 2> read_leaf(const Settings& table, std::array<double, 2> fallback) {
    const std::vector<double> leaf = table.numbers_or("leaf", {fallback[0], fallback[1]});
    if (leaf.size() != 2 || leaf[0] < 0 || leaf[1] < 0 || leaf[0] + leaf[1] > 1) {
        throw UserError(table.place("leaf"),
                        "'leaf' must be [reflectance, transmittance], two shares that are 1 together at most");
    }
    return {leaf[0], leaf[1]};
}

OpticalBand read_band(const std::string& name, const Settings& table) {
    const bool is_infrared = name == "nir";
    if (name != "par" && !is_infrared && !table.has("leaf")) {
        throw UserError(table.place(), fmt::format("the band '{}' needs leaf = [reflectance, transmittance]: only par "
                                                   "and nir have defaults",
                                                   name));
    }
    const std::array<double, 2> leaf =
        read_leaf(table, is_infrared ? std::array{0.4, 0.4} : std::array{0.1, 0.1});  // Goudriaan 1977
    const Range share_of_light = Range::between(0, 1);
    return {.name = name,
            .share = table.number_or("share", 1, Range::positive()),
            .leaf_reflectance = leaf[0],
            .leaf_transmittance = leaf[1],
            .stem_reflectance = table.number_or("stem", is_infrared ? 0.5 : 0.2, share_of_light),
            .soil_reflectance = table.number_or("soil", is_infrared ? 0.2 : 0.1, share_of_light)};
}

std::vector<OpticalBand> read_bands(const Settings& table) {
    std::vector<OpticalBand> bands;
    for (const std::string& name : table.keys()) bands.push_back(read_band(name, table.table(name)));
    if (bands.empty()) bands.push_back(read_band("par", table));
    if (bands.size() > most_bands) {
        throw UserError(table.place(), fmt::format("there are {} bands, of at most {}", bands.size(), most_bands));
    }
    return bands;
}

std::optional<Box> read_period(const Settings& settings, const EnvironmentContext& context) {
    if (!settings.flag_or("periodic", false)) return std::nullopt;
    if (context.domain) return context.domain;
    throw UserError(settings.place("periodic"),
                    "a periodic stand needs the scene's domain, whose sides are its period");
}

class RayLight final : public EnvironmentProcess {
public:
    RayLight(Settings& settings, const EnvironmentContext& context, Fields&)
        : name_(context.name),
          seed_(context.seed),
          memory_(context.memory),
          sky_(settings.table("sky"), least_elevation),
          paths_(read_bands(settings.table("bands")), settings.number_or("ground", 0), read_period(settings, context),
                 settings.number_or("residual", 0.001, Range::between(1e-9, 0.5))),
          days_(settings.number_or("days", 1, Range::positive())),
          count_(static_cast<std::uint32_t>(settings.integer_or("paths", 1 << 16, Range::between(64, most_paths)))),
          accuracy_(settings.number_or("accuracy", 0, Range::between(0, 1))),
          plants_(context.plants) {}

    void advance(const WorldView& world, std::span<const Query>, Fields&) override {
        light_ = sky_.over(world.time * days_, world.dt * days_);
        collect(world);
        require_memory();
        paths_.set(triangles_, light_);
        const auto seed = static_cast<std::uint32_t>(mix(seed_, static_cast<std::uint64_t>(world.step)));
        std::uint32_t count = count_;
        trace(count, seed);
        while (accuracy_ > 0 && worst_error() > accuracy_ && count <= most_paths / 4) {
            count *= 4;
            trace(count, seed);
        }
    }

    void answer(const WorldView&, std::span<const Query> queries, std::span<Answer> answers, Fields&) override {
        for (std::size_t i = 0; i < queries.size(); ++i) {
            for (std::size_t b = 0; b < bands().size() && 3 * b < answers[i].size(); ++b) {
                const Answer answer = answers[i].subspan(3 * b);
                const ModuleLight met = met_by(queries[i], b);
                const double open = light_.on_ground * bands()[b].share;
                const double per_area = met.area > 0 ? met.photons / met.area : 0;
                answer[0] = met.area > 0 ? (open > 0 ? per_area / open : 0) : open_share(queries[i]);
                if (answer.size() > 1) answer[1] = met.photons;
                if (answer.size() > 2) answer[2] = light_.seconds > 0 ? 1e6 * per_area / light_.seconds : 0;
            }
        }
    }

    std::vector<Quantity> statistics(std::uint32_t plant) const override {
        const bool is_known = plant < plants_ && plant < slots_.size();
        const double area = is_known ? area_of(plant) : 0, open = light_.on_ground * area;
        std::vector<Quantity> quantities{{"leaf_area", area, "m2"}};
        for (std::size_t b = 0; b < bands().size(); ++b) {
            const std::string of_band = b == 0 ? "" : "." + bands()[b].name;
            const Estimate absorbed = is_known ? estimate(plant, b) : Estimate();
            quantities.push_back({"absorbed" + of_band, absorbed.mean, "mol"});
            quantities.push_back({"absorbed_error" + of_band, absorbed.error, "mol"});
        }
        quantities.push_back({"mean", open > 0 ? estimate(plant, 0).mean / open : std::nan("")});
        quantities.push_back({"incoming", light_.on_ground, "mol/m2"});
        quantities.push_back({"soil", balance_.soil});
        quantities.push_back({"escaped", balance_.escaped});
        quantities.push_back({"closure", balance_.closure});
        return quantities;
    }

    std::pair<int, int> query_arity() const override { return {1, 24}; }

    ProcessMemory memory() const override {
        return {static_cast<std::size_t>(bytes_per_triangle * static_cast<double>(triangles_.size())), true};
    }
    void limit_memory(std::size_t bytes) override { memory_ = bytes; }

private:
    struct ModuleLight {
        double area = 0;     ///< m2 of leaves
        double photons = 0;  ///< mol that leaves and stems absorb
    };
    struct Estimate {
        double mean = 0, error = 0;  ///< mol; the standard error of the mean
    };
    struct Balance {
        double soil = 0, escaped = 0, closure = 0;  ///< shares of the first band's light
    };

    const std::vector<OpticalBand>& bands() const { return paths_.bands(); }

    void collect(const WorldView& world) {
        slots_.assign(plants_ + 1, 0);
        for (const PlantView& plant : world.plants) {
            if (plant.plant < plants_) slots_[plant.plant + 1] = static_cast<std::uint32_t>(plant.string->size());
        }
        for (std::size_t plant = 0; plant < plants_; ++plant) slots_[plant + 1] += slots_[plant];
        triangles_.clear(slots_.back());
        for (const PlantView& plant : world.plants) {
            if (plant.plant < plants_) triangles_.add(plant.interpretation->geometry, slots_[plant.plant]);
        }
    }

    void require_memory() const {
        if (bytes_per_triangle * static_cast<double>(triangles_.size()) <= static_cast<double>(memory_)) return;
        throw RunError(fmt::format("'{}' has {} triangles to light, which take {} GB: draw fewer or give more memory",
                                   name_, triangles_.size(),
                                   format_general(bytes_per_triangle * static_cast<double>(triangles_.size()) / 1e9)));
    }

    void trace(std::uint32_t count, std::uint32_t seed) {
        absorbed_.assign(slots_.back() * bands().size(), 0);
        by_plant_.assign(plants_ * bands().size() * trials, 0);
        balance_ = {};
        double sum = 0;
        for (std::uint32_t trial = 0; trial < trials; ++trial) {
            paths_.trace(std::max(1U, count / trials), static_cast<std::uint32_t>(mix(seed, trial)));
            add_trial(trial);
            balance_.soil += paths_.absorbed_by_soil(0) / trials;
            balance_.escaped += paths_.escaped(0) / trials;
        }
        const double open = light_.on_ground * paths_.area_lit();
        for (std::size_t slot = 0; slot < slots_.back(); ++slot) sum += absorbed_[slot * bands().size()];
        balance_.closure = open > 0 ? balance_.soil + balance_.escaped + sum / open - 1 : 0;
    }

    void add_trial(std::uint32_t trial) {
        for (std::size_t b = 0; b < bands().size(); ++b) {
            const double photons = light_.on_ground * paths_.area_lit() * bands()[b].share;
            for (std::size_t plant = 0; plant < plants_; ++plant) {
                double sum = 0;
                for (std::uint32_t slot = slots_[plant]; slot < slots_[plant + 1]; ++slot) {
                    const double absorbed = photons * paths_.absorbed(slot, b);
                    absorbed_[slot * bands().size() + b] += absorbed / trials;
                    sum += absorbed;
                }
                by_plant_[(plant * bands().size() + b) * trials + trial] = sum;
            }
        }
    }

    Estimate estimate(std::size_t plant, std::size_t band) const {
        const double* const sums = &by_plant_[(plant * bands().size() + band) * trials];
        Estimate found;
        for (int i = 0; i < trials; ++i) found.mean += sums[i] / trials;
        double squares = 0;
        for (int i = 0; i < trials; ++i) squares += (sums[i] - found.mean) * (sums[i] - found.mean);
        found.error = std::sqrt(squares / (trials * (trials - 1)));
        return found;
    }

    /// The largest relative standard error of a plant.
    double worst_error() const {
        double worst = 0;
        for (std::size_t plant = 0; plant < plants_; ++plant) {
            const Estimate found = estimate(plant, 0);
            if (found.mean > 0) worst = std::max(worst, found.error / found.mean);
        }
        return worst;
    }

    double area_of(std::uint32_t plant) const {
        double area = 0;
        for (std::uint32_t slot = slots_[plant]; slot < slots_[plant + 1]; ++slot)
            area += triangles_.leaf_areas()[slot];
        return area;
    }

    /// What the module that follows the query has met.
    ModuleLight met_by(const Query& query, std::size_t band) const {
        if (query.plant >= plants_ || query.module + 1 >= slots_[query.plant + 1] - slots_[query.plant]) return {};
        const std::size_t slot = slots_[query.plant] + query.module + 1;
        return {triangles_.leaf_areas()[slot], absorbed_[slot * bands().size() + band]};
    }

    double open_share(const Query& query) const { return paths_.open_share(query.pose.position); }

    std::string name_;
    std::uint64_t seed_;
    std::size_t memory_;
    DaylightSeries sky_;
    LightPaths paths_;
    double days_;
    std::uint32_t count_;
    double accuracy_;
    std::size_t plants_;

    Daylight light_;  ///< all that follows is of this step
    LitTriangles triangles_;
    std::vector<std::uint32_t> slots_;  ///< the number of the first module of each plant, and behind the last
    std::vector<double> absorbed_;      ///< mol, by slot and band: the mean of the trials
    std::vector<double> by_plant_;      ///< mol, by plant, band and trial
    Balance balance_;
};

const std::string& ray_light_help() {
    static const std::string text =
        std::string(
            R"(Paths of light begin at sun and sky, and end at the leaves, stems and the soil that absorb them, as the plants of the
step are drawn. What is not absorbed is scattered as Lambert's law says, by leaves to both sides.

?name(f)        -> f: photons that the leaves of the module that follows in the string absorb per area, over those on
                   open level ground. If it draws no leaf, what a small leaf of any direction in its place gets of sun
                   and sky, scattered light apart
?name(f, m)     -> m: mol of photons that leaves and stems of this module absorb in the step
?name(f, m, e)  -> e: umol m-2 s-1 that the leaves absorb while there is light
Three more parameters for each further band tell the same of it.

paths         65536: paths of light in each step. They are 8 independent trials, whose spread gives the standard error
accuracy      0: the standard error that each plant's sum may have, as a share of it; paths grow until it is reached
residual      0.001: a path ends where less than this share of its light is left
days          1: days that a unit of time stands for
periodic      false; true repeats the scene's domain to all sides
ground        0 m: height of the soil
bands         the tables of the bands, as in bands.par = { leaf = [0.1, 0.1] }; default: par alone
  leaf        [reflectance, transmittance] of both sides; par [0.1, 0.1], nir [0.4, 0.4] (Goudriaan 1977)
  stem        reflectance of stems; par 0.2, nir 0.5
  soil        reflectance of the soil; par 0.1, nir 0.2
  share       1: incoming photons of the band over those of PAR
sky           the table of the light, below

Statistics of a plant: leaf_area (m2, one side), absorbed (mol) with its standard error absorbed_error, also of further
bands as absorbed.BAND, mean (absorbed per leaf area over what falls on open level ground); of the world: incoming
(mol/m2), soil and escaped (shares of the light of the first band), closure (all shares, less 1).

)") + sky_help();
    return text;
}

const Registered<ProcessType> entry{{"ray-light",
                                     "photons that drawn leaves and stems absorb: paths of light, scattered",
                                     ray_light_help(), construct<RayLight>}};

}  // namespace
}  // namespace espalier::environment
