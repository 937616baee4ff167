// leaf-exchange: what leaves take of carbon dioxide and give of water in the light that they absorb.
#include "espalier/environment/environment.h"
#include "espalier/environment/environment_process.h"

#include "base/bytes.h"
#include "base/parallel.h"
#include "environment/exchange/changing_settings.h"
#include "environment/exchange/measured_before.h"
#include "environment/exchange/needed_field.h"
#include "environment/given/weather/weather.h"
#include "environment/leaf/gas/leaf_water.h"
#include "environment/leaf/leaves/big_leaf.h"
#include "environment/leaf/leaves/leaf_kinds.h"
#include "environment/leaf/leaves/plant_leaves.h"
#include "environment/leaf/leaves/units.h"
#include "environment/leaf/waves/canopy_waves.h"
#include "geometry/drawn/faces.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

namespace espalier::environment {
namespace {

using namespace leaf;

constexpr float least_part = 1e-3F;  ///< of a leaf, which is not divided below

using Values = std::shared_ptr<const std::vector<float>>;

/// A leaf's light, from the process that measures it.
struct OrganLightValues {
    Values power, near_infrared, area, lit;
    Values sunlit, direct, direct_near_infrared;  ///< null where leaves are not divided
};

/// What a leaf does per day: net CO2, mol, and water, cm3.
struct LeafRates {
    double gain = 0, water = 0;
};

/// What a plant is during a step in which the water's way to its leaves is solved.
struct SuppliedPlant {
    std::vector<DrawingLeaf> leaves;
    std::vector<LeafChunk> chunks;
    std::vector<LeafRates> mean;  ///< by leaf, over the last substep
    double residual = 0;
    bool is_supplied = false;  ///< in this step
};

struct LeafQuantity {
    OrganQuantity told;
    double (*of)(const PlantLeaves&, std::size_t row);
};

template <LeafState State>
double state_of(const PlantLeaves& leaves, std::size_t row) {
    return leaves.state[State][row];
}

/// The last where long waves are followed.
const std::array<LeafQuantity, 10>& known() {
    static const std::array<LeafQuantity, 10> all{
        {{{"assimilation", "umol m-2 s-1", "net CO2 that leaves take, while there is light"}, state_of<assimilation>},
         {{"transpiration", "mmol m-2 s-1", "water that leaves give, while there is light"},
          [](const PlantLeaves& leaves, std::size_t row) { return 1000 * leaves.state[transpiration][row]; }},
         {{"conductance", "mol m-2 s-1", "of stomata to water vapour"}, state_of<conductance>},
         {{"temperature", "degC", "of the leaf"}, state_of<temperature>},
         {{"internal", "umol/mol", "CO2 in the leaf"}, state_of<internal>},
         {{"deficit", "kPa", "of vapour pressure at the leaf's surface"}, state_of<deficit>},
         {{"potential", "MPa", "water potential of the leaf"},
          [](const PlantLeaves& leaves, std::size_t row) { return leaves.potential[row]; }},
         {{"gain", "mol", "net CO2 of the organ in the step"},
          [](const PlantLeaves& leaves, std::size_t row) { return leaves.gain[row]; }},
         {{"water", "cm3", "water that the organ gives in the step"},
          [](const PlantLeaves& leaves, std::size_t row) { return leaves.water[row]; }},
         {{"thermal", "W m-2", "long waves that meet both sides together"},
          [](const PlantLeaves& leaves, std::size_t row) {
              return leaves.thermal.empty() ? std::nan("") : leaves.thermal[row];
          }}}};
    return all;
}

std::string light_named_by(const Settings& settings) {
    if (settings.has("light")) return settings.text("light");
    throw UserError(settings.place(),
                    "leaves need light: write light = \"light\", the name of a canopy-light or a ray-light that stands "
                    "before them in the scene");
}

/// The process that brings water to leaves; null: their potential is given.
LeafSupply* supply_of(const Settings& settings, const Fields& fields) {
    if (!settings.has("roots")) return nullptr;
    const std::string name = settings.text("roots");
    auto* const supply = dynamic_cast<LeafSupply*>(needed_field(settings, "roots", name, fields, "root-water").source);
    if (!supply) {
        throw UserError(settings.place("roots"),
                        fmt::format("'{}' is not a root-water, which brings water to leaves", name));
    }
    if (settings.has("potential")) {
        throw UserError(settings.place("potential"),
                        "the water's way from the roots decides the potential of each leaf: leave out 'potential' or "
                        "'roots'");
    }
    return supply;
}

class LeafExchange final : public EnvironmentProcess, public LeafWater {
public:
    LeafExchange(Settings& settings, const EnvironmentContext& context, Fields& fields)
        : name_(context.name),
          light_(light_named_by(settings)),
          light_place_(settings.place("light")),
          kinds_(settings, context.plants),
          form_(settings, context.name),
          weather_(Weather::named_by(settings, "air", fields)),
          air_(SceneAir::read(settings)),
          near_infrared_(settings.number_or("nir", 0.25, Range::between(0, 10))),
          potential_(settings.number_or("potential", 0, Range::between(-20, 0))),
          is_divided_(settings.flag_or("sunlit", true)),
          days_(read_days(settings, weather_.get())),
          supply_(supply_of(settings, fields)),
          compares_(settings.choice_or("canopy", "leaves", {"leaves", "big-leaf"}) == "big-leaf"),
          leaves_(context.plants),
          supplied_(supply_ ? context.plants : 0) {
        if (supply_) supply_->attach(*this, name_);
        if (weather_) air_name_ = settings.text("air"), air_place_ = settings.place("air");
        for (const char* key : {"temperature", "humidity", "wind", "co2"}) {
            if (!weather_ || settings.has(key)) own_air_.insert(key);
        }
        has_own_pressure_ = settings.has("pressure") || settings.has("height");
        read_long_waves(settings, context);
    }

    void advance(const WorldView& world, Queries, Fields&) override {
        if (!world.environment) throw RunError("leaf-exchange works in a scene's exchange only");
        if (!supply_) begin_step(world);
        std::vector<std::uint32_t> given;  // plants whose leaves have the potential that is given
        for (std::uint32_t plant = 0; plant < leaves_.size(); ++plant) {
            if (!supply_ || !supplied_[plant].is_supplied) given.push_back(plant);
        }
        const std::vector<LeafChunk> chunks = chunks_of(leaves_, given, kinds_.size());
        for_in_parallel(std::size_t{0}, chunks.size(), [&](std::size_t i) { solver_->solve(leaves_, chunks[i], {}); });
        if (world.step == 0) return;
        const double days = seconds_ / seconds_per_day;
        for (const std::uint32_t plant : given) {
            PlantLeaves& leaves = leaves_[plant];
            for (std::size_t row = 0; row < leaves.size(); ++row) {
                leaves.gain[row] = leaves.gain_rate[row] * days;
                leaves.water[row] = leaves.water_rate[row] * days;
            }
        }
    }

    void begin_step(const WorldView& world) override {
        if (supply_) require_before(*world.environment, supply_->solved_with());
        find_light(*world.environment);
        seconds_ = world.dt * days_ * seconds_per_day;
        take_weather();
        solver_.emplace(kinds_, air_.air(), air_.thermal_radiation());
        for (std::uint32_t plant = 0; plant < last_potentials_.size(); ++plant) {
            last_potentials_[plant] = mean_of(leaves_[plant], leaves_[plant].potential, last_potentials_[plant]);
        }
        for (PlantLeaves& plant : leaves_) plant.clear();
        for (SuppliedPlant& plant : supplied_) plant = {};
        for (const PlantView& plant : world.plants) {
            if (plant.plant < leaves_.size()) list_leaves(plant, *world.environment);
        }
        for (std::uint32_t plant = 0; plant < supplied_.size(); ++plant) list_supplied(plant);
        if (waves_) follow_long_waves(world);
    }

    std::span<const DrawingLeaf> leaves(std::uint32_t plant) const override {
        return plant < supplied_.size() ? std::span<const DrawingLeaf>(supplied_[plant].leaves)
                                        : std::span<const DrawingLeaf>();
    }

    void lose(std::uint32_t plant, std::span<const double> potentials, std::span<LeafLoss> losses) override {
        SuppliedPlant& supplied = supplied_[plant];
        PlantLeaves& leaves = leaves_[plant];
        supplied.is_supplied = true;
        std::copy(potentials.begin(), potentials.end(), leaves.potential.begin());
        constexpr std::size_t work_of_leaf = 500;
        for_each_if_worth(supplied.chunks.size(), leaves.size() * work_of_leaf,
                          [&](std::size_t i) { solver_->solve(leaves_, supplied.chunks[i], {.by_potential = true}); });
        for (std::size_t row = 0; row < leaves.size(); ++row) {
            losses[row] = {leaves.water_rate[row], leaves.by_potential[row]};
        }
    }

    void pass(std::uint32_t plant, double days, double weight) override {
        SuppliedPlant& supplied = supplied_[plant];
        PlantLeaves& leaves = leaves_[plant];
        for (std::size_t row = 0; row < leaves.size(); ++row) {
            LeafRates& mean = supplied.mean[row];
            mean.gain = weight * leaves.gain_rate[row] + (1 - weight) * mean.gain;
            mean.water = weight * leaves.water_rate[row] + (1 - weight) * mean.water;
            leaves.gain[row] += mean.gain * days;
            leaves.water[row] += mean.water * days;
            supplied.residual = std::max(supplied.residual, double(leaves.residual[row]));
        }
    }

    void answer(const WorldView&, Queries queries, std::span<Answer> answers, Fields&) override {
        for (std::size_t i = 0; i < queries.size(); ++i) {
            const std::array<double, 8> numbers = told_of_leaf_behind(queries[i]);
            for (std::size_t k = 0; k < std::min(answers[i].size(), form_.size()); ++k) {
                if (form_.answer(k) >= 0) answers[i][k] = numbers[static_cast<std::size_t>(form_.answer(k))];
            }
        }
    }

    std::vector<Quantity> statistics(std::uint32_t plant) const override {
        static const PlantLeaves no_leaves;
        const PlantLeaves& leaves = plant < leaves_.size() ? leaves_[plant] : no_leaves;
        double area = 0, gain = 0, water = 0, residual = 0;
        for (std::size_t row = 0; row < leaves.size(); ++row) {
            area += leaves.area[row];
            gain += leaves.gain[row];
            water += leaves.water[row];
            residual = std::max(residual, double(leaves.residual[row]));
        }
        if (plant < supplied_.size()) residual = std::max(residual, supplied_[plant].residual);
        const auto mean = [&](const auto& column) { return mean_of(leaves, column, std::nan("")); };
        const double days = seconds_ / seconds_per_day, moles = water / cm3_of_mole;
        std::vector<Quantity> all{{"gain", gain, "mol"},
                                  {"water", water, "cm3"},
                                  {"transpiration", days > 0 ? water / days : 0, "cm3/d"},
                                  {"efficiency", moles > 0 ? 1000 * gain / moles : std::nan(""), "mmol/mol"},
                                  {"assimilation", mean(leaves.state[assimilation]), "umol m-2 s-1"},
                                  {"conductance", mean(leaves.state[conductance]), "mol m-2 s-1"},
                                  {"internal", mean(leaves.state[internal]), "umol/mol"},
                                  {"temperature", mean(leaves.state[temperature]), "degC"},
                                  {"potential", mean(leaves.potential), "MPa"},
                                  {"leaf_area", area, "m2"},
                                  {"residual", residual}};
        if (waves_) tell_long_waves(leaves, all);
        if (compares_) compare(plant, leaves, all);
        return all;
    }

    std::vector<OrganQuantity> organ_quantities() const override {
        std::vector<OrganQuantity> all;
        for (const LeafQuantity& quantity : known()) all.push_back(quantity.told);
        if (!waves_) all.pop_back();
        return all;
    }

    std::shared_ptr<const std::vector<float>> organ_values(const std::string& name,
                                                           std::uint32_t plant) const override {
        const auto quantity = std::find_if(known().begin(), known().end(),
                                           [&](const LeafQuantity& one) { return one.told.name == name; });
        if (quantity == known().end() || plant >= leaves_.size()) return nullptr;
        const PlantLeaves& leaves = leaves_[plant];
        auto values = std::make_shared<std::vector<float>>(leaves.modules_in_string, std::nanf(""));
        for (std::size_t row = 0; row < leaves.size(); ++row) {
            (*values)[leaves.modules[row]] = static_cast<float>(quantity->of(leaves, row));
        }
        return values;
    }

    std::vector<ChangingSetting> changing_settings() override {
        std::vector<ChangingSetting> all{changing("temperature", Range::between(-40, 60), air_.temperature),
                                         changing("humidity", Range::between(0, 1), air_.humidity),
                                         changing("wind", Range::between(0.01, 100), air_.wind),
                                         changing("co2", Range::between(50, 10000), air_.carbon_dioxide)};
        std::erase_if(all, [&](const ChangingSetting& one) { return !own_air_.contains(one.key); });
        all.push_back(changing("cloud", Range::between(0, 1), air_.cloud));
        if (!supply_) all.push_back(changing("potential", Range::between(-20, 0), potential_));
        if (soil_temperature_) all.push_back(changing("soil_temperature", soil_temperatures, *soil_temperature_));
        return all;
    }

    std::pair<int, int> query_arity() const override { return {1, static_cast<int>(form_.size())}; }
    Spreading spreading() const override { return Spreading::plants; }

    void save(std::ostream& out) const override {
        if (waves_ && supply_) write_doubles(out, last_potentials());
    }
    void restore(std::istream& in) override {
        if (waves_ && supply_) read_doubles(in, last_potentials_);
    }

private:
    static constexpr Range soil_temperatures{-40, 80};

    void read_long_waves(const Settings& settings, const EnvironmentContext& context) {
        if (!settings.has("long_waves")) {
            if (!settings.has("soil_temperature")) return;
            throw UserError(settings.place("soil_temperature"),
                            "the soil's temperature counts with long waves only: add long_waves = { voxel = 0.2 }");
        }
        if (settings.has("thermal")) {
            throw UserError(settings.place("thermal"),
                            "long_waves find the thermal radiation of each leaf: leave out 'thermal' or 'long_waves'");
        }
        waves_ = std::make_unique<CanopyWaves>(settings.table("long_waves"), context);
        last_potentials_.assign(supplied_.size(), 0);
        if (settings.has("soil_temperature")) {
            soil_temperature_ = settings.number("soil_temperature", soil_temperatures);
        }
    }

    /// Temperatures of leaves and the waves that they exchange depend on each other: both are found in turn, until
    /// nothing moves. Where roots bring the water, leaves have the plant's mean potential of the step before for that.
    void follow_long_waves(const WorldView& world) {
        constexpr int most_turns = 300;
        constexpr double small_change = 1e-11;
        waves_->lay(world, leaves_);
        const double usual = air_.thermal_radiation();
        std::vector<std::uint32_t> all;
        for (std::uint32_t plant = 0; plant < leaves_.size(); ++plant) {
            PlantLeaves& leaves = leaves_[plant];
            leaves.thermal.assign(leaves.size(), usual);
            leaves.sent.assign(leaves.size(), 0);
            if (supply_) leaves.potential.assign(leaves.size(), last_potentials_[plant]);
            all.push_back(plant);
        }
        const WavesAround around{waves_->sky().value_or(air_.sky_radiation()), air_.temperature,
                                 soil_temperature_.value_or(air_.temperature), kinds_[0].emissivity};
        const std::vector<LeafChunk> chunks = chunks_of(leaves_, all, kinds_.size());
        for (int turn = 0; turn < most_turns; ++turn) {
            for_in_parallel(std::size_t{0}, chunks.size(),
                            [&](std::size_t i) { solver_->solve(leaves_, chunks[i], {.sent = true}); });
            if (waves_->exchange(leaves_, around) < small_change) break;
        }
        if (!supply_) return;
        for (PlantLeaves& leaves : leaves_) leaves.potential.assign(leaves.size(), potential_);
    }

    /// Over the area of the leaves.
    static double mean_of(const PlantLeaves& leaves, const std::vector<double>& column, double none) {
        double sum = 0, area = 0;
        for (std::size_t row = 0; row < leaves.size(); ++row) {
            sum += leaves.area[row] * column[row];
            area += leaves.area[row];
        }
        return area > 0 ? sum / area : none;
    }
    std::vector<double> last_potentials() const {
        std::vector<double> all;
        for (std::uint32_t plant = 0; plant < last_potentials_.size(); ++plant) {
            all.push_back(mean_of(leaves_[plant], leaves_[plant].potential, last_potentials_[plant]));
        }
        return all;
    }

    void tell_long_waves(const PlantLeaves& leaves, std::vector<Quantity>& all) const {
        const WaveLedger& waves = waves_->ledger();
        all.push_back({"thermal", mean_of(leaves, leaves.thermal, std::nan("")), "W/m2"});
        all.push_back({"waves_from_plants", waves.from_plants, "W"});
        all.push_back({"waves_from_soil", waves.from_soil, "W"});
        all.push_back({"waves_from_sky", waves.from_sky, "W"});
        all.push_back({"waves_to_plants", waves.to_plants, "W"});
        all.push_back({"waves_to_soil", waves.to_soil, "W"});
        all.push_back({"waves_to_sky", waves.to_sky, "W"});
        all.push_back({"waves_closure", waves.closure()});
    }

    /// What a plant would do as one leaf, and what a lawn would.
    void compare(std::uint32_t plant, const PlantLeaves& leaves, std::vector<Quantity>& all) const {
        const double none = std::nan(""), days = seconds_ / seconds_per_day;
        BigLeaf big{none, none, none};
        if (leaves.size() > 0) {
            big = big_leaf(leaves, kinds_[kinds_.of(plant)], air_.air(), air_.thermal_radiation());
        }
        all.push_back({"big_gain", big.gain_rate * days, "mol"});
        all.push_back({"big_transpiration", big.water_rate, "cm3/d"});
        all.push_back({"penman_monteith", big.by_formula, "cm3/d"});
        all.push_back({"fao56", weather_ ? weather_->now().evaporation / days : none, "mm/d"});
    }

    /// What the scene says of these leaves themselves stays.
    void take_weather() {
        if (!weather_) return;
        constexpr double calm = 0.1;  // m/s: air over warm leaves moves
        const AirOfStep& air = weather_->now();
        if (!own_air_.contains("temperature")) air_.temperature = air.temperature;
        if (!own_air_.contains("humidity")) air_.humidity = air.humidity;
        if (!own_air_.contains("wind")) air_.wind = std::max(calm, air.wind);
        if (!own_air_.contains("co2")) air_.carbon_dioxide = air.carbon_dioxide;
        if (!has_own_pressure_) air_.pressure = air.pressure;
    }

    /// What leaves read in the turn of another process must stand before that.
    void require_before(const Environment& environment, const std::string& other) const {
        const auto at = environment.find(other);
        const auto refuse = [&](const Place& place, const std::string& name) {
            throw UserError(place,
                            fmt::format("'{}' must stand before '{}' in the scene, with which the leaves of '{}' "
                                        "are solved",
                                        name, other, name_));
        };
        if (const auto light = environment.find(light_); light && at && *light > *at) refuse(light_place_, light_);
        if (const auto air = environment.find(air_name_); air && at && *air > *at) refuse(air_place_, air_name_);
    }

    void find_light(const Environment& environment) {
        has_near_infrared_ = measures_before(environment, name_, light_, "power.nir");
        if (measures_before(environment, name_, light_, "power")) return;
        throw UserError(
            light_place_,
            fmt::format("'{}' needs a canopy-light or a ray-light called '{}', before it in the scene", name_, light_));
    }

    OrganLightValues light_of(std::uint32_t plant, const Environment& environment) const {
        const auto values = [&](const char* quantity) {
            return environment.organ_values(light_ + "." + quantity, plant);
        };
        return {values("power"),
                has_near_infrared_ ? values("power.nir") : nullptr,
                values("area"),
                values("lit"),
                is_divided_ ? values("sunlit") : nullptr,
                is_divided_ ? values("direct") : nullptr,
                is_divided_ && has_near_infrared_ ? values("direct.nir") : nullptr};
    }

    /// The leaves of a plant in their light, and what its model says of them.
    void list_leaves(const PlantView& plant, const Environment& environment) {
        const OrganLightValues light = light_of(plant.plant, environment);
        PlantLeaves& leaves = leaves_[plant.plant];
        if (!light.area || !light.power || !light.lit) return;
        leaves.modules_in_string = light.area->size();
        const std::vector<std::uint16_t> colours =
            kinds_.know_colours() ? colours_of(plant) : std::vector<std::uint16_t>();
        for (std::uint32_t module = 0; module < light.area->size(); ++module) {
            const float area = (*light.area)[module];
            if (!(area > 0)) continue;
            leaves.add(module, kinds_.of(plant.plant, module < colours.size() ? colours[module] : std::uint16_t{0}),
                       area);
            add_light(leaves, light, module);
        }
        leaves.begin(potential_);
        if (form_.says_something()) read_own_parameters(plant, environment, leaves);
    }

    /// Of the modules that draw leaves.
    static std::vector<std::uint16_t> colours_of(const PlantView& plant) {
        DrawnFaces faces;
        faces.add_leaves(plant.plant, plant.drawn());
        std::vector<std::uint16_t> colours(plant.string->size(), 0);
        for (std::size_t i = 0; i < faces.size(); ++i) colours[faces[i].owner.module] = faces[i].owner.colour;
        return colours;
    }

    void read_own_parameters(const PlantView& plant, const Environment& environment, PlantLeaves& leaves) const {
        const bool is_default = environment.default_process() == environment.find(name_);
        for (const Query& query : plant.interpretation->queries) {
            const bool is_ours =
                query.process < 0 ? is_default : plant.model->processes[std::size_t(query.process)] == name_;
            const std::size_t row = is_ours ? leaves.row_of(query.module + 1) : leaves.size();
            if (row < leaves.size()) form_.read(query, leaves.size(), row, leaves.own);
        }
    }

    void list_supplied(std::uint32_t plant) {
        SuppliedPlant& supplied = supplied_[plant];
        PlantLeaves& leaves = leaves_[plant];
        for (std::size_t row = 0; row < leaves.size(); ++row) {
            supplied.leaves.push_back({leaves.modules[row], leaves.area[row]});
        }
        supplied.chunks = chunks_of(leaves_, std::span(&plant, 1), kinds_.size());
        supplied.mean.resize(leaves.size());
        leaves.by_potential.assign(leaves.size(), 0);
    }

    void add_light(PlantLeaves& leaves, const OrganLightValues& values, std::size_t module) const {
        const auto of = [&](const Values& column, float none) { return column ? (*column)[module] : none; };
        const float power = (*values.power)[module];
        leaves.lit.push_back(seconds_ > 0 ? static_cast<float>(std::min(1.0, (*values.lit)[module] / seconds_)) : 0);
        const float photons = power > 0 ? static_cast<float>(photons_of_joule) * power : 0;
        const float near = power > 0 ? of(values.near_infrared, static_cast<float>(near_infrared_) * power) : 0;
        float sunlit = power > 0 ? std::min(1.0F, of(values.sunlit, 0)) : 0;
        if (!(sunlit > least_part && sunlit < 1 - least_part)) sunlit = 0;
        const float direct = sunlit > 0 ? of(values.direct, 0) : 0;
        const float near_direct = sunlit > 0 ? of(values.direct_near_infrared, direct) : 0;
        const float more = sunlit > 0 ? 1 / sunlit - 1 : 0;
        leaves.sunlit.push_back(sunlit);
        leaves.sun_photons.push_back(photons * (1 + direct * more));
        leaves.sun_near_infrared.push_back(near * (1 + near_direct * more));
        leaves.shade_photons.push_back(photons * (1 - direct));
        leaves.shade_near_infrared.push_back(near * (1 - near_direct));
    }

    /// The answers in the order of QueryForm::answered().
    std::array<double, 8> told_of_leaf_behind(const Query& query) const {
        std::array<double, 8> told{};
        told[5] = air_.temperature;
        if (query.plant >= leaves_.size()) return told;
        const PlantLeaves& leaves = leaves_[query.plant];
        const std::size_t row = leaves.row_of(query.module + 1);
        if (row == leaves.size()) return told;
        const auto state = [&](LeafState of) { return leaves.state[of][row]; };
        return {leaves.gain[row],   leaves.water[row],  state(assimilation), 1000 * state(transpiration),
                state(conductance), state(temperature), state(internal),     leaves.potential[row]};
    }

    std::string name_, light_;
    Place light_place_;
    LeafKinds kinds_;
    QueryForm form_;
    std::shared_ptr<const Weather> weather_;  ///< null: the air is the table's alone
    SceneAir air_;
    std::set<std::string> own_air_;  ///< keys that the weather does not change
    bool has_own_pressure_ = false;
    double near_infrared_, potential_;
    bool is_divided_;
    double days_;
    LeafSupply* supply_;  ///< null: the potential is given
    bool compares_;       ///< plants as one leaf, and a lawn, are told, too
    std::string air_name_;
    Place air_place_;
    // Of the step.
    double seconds_ = 0;
    bool has_near_infrared_ = false;  ///< the light measures it
    std::optional<LeafSolver> solver_;
    std::vector<PlantLeaves> leaves_;      ///< of each plant
    std::vector<SuppliedPlant> supplied_;  ///< of each plant
    std::unique_ptr<CanopyWaves> waves_;   ///< null: leaves see the open sky
    std::optional<double> soil_temperature_;
    std::vector<double> last_potentials_;  ///< of each plant in the step before; with long waves
};

const std::string& help() {
    static const std::string text =
        R"(Photosynthesis, stomata, boundary layer and energy of every leaf, solved at once in the light that a canopy-light or a ray-light
has measured in this step. Leaves are what those take for leaves.

light          required; name of the process of light, which stands before this one in the scene. A band "nir" of it is absorbed
               energy, too
nir            0.25; without such a band, near infrared that leaves absorb, as a share of the energy of PAR that they do
roots          none; name of a root-water with a `stem`, which stands before this one: it brings each leaf its water, so that the
               leaf's potential is what the way from the soil leaves of it. Light and weather stand before the soil
potential      0 MPa; without `roots`: water potential of all leaves, by which stomata close where `sf` is above 0. Roots take
               what the leaves give where a root-water says collar = { leaves = "name of this process" }
sunlit         true; leaves are a part in the sun's own light and a part without it, by the shares that the light tells; false:
               their mean light counts
canopy         "leaves", or "big-leaf"; with it, statistics also tell what each plant would do as one leaf in the mean light of its
               leaves, what Penman & Monteith's equation gives for that leaf with the mean conductance of the leaves, and the
               evaporation of a lawn in the weather (FAO-56)
days           1; days that a unit of time stands for

Of the leaves:
)" + leaf_help() +
        canopy_waves_help() +
        R"(kinds          []; tables of other leaves: plants = [1, 2], by their numbers from 0, colours = [4], of the turtle that drew them, or
               both; and what of the above is different. The last that means a leaf counts
query          ["gain", "water", "A", "E", "gs", "T", "Ci", "psi"]; what the parameters of a query are, in turn. A model that says of
               single leaves what they are has "v", "jmax", "rd", "g1" or "width" among them, or alone: 0 is the scene's

Of the air; temperature, humidity, wind, co2, cloud and potential may have keyframes. Of the first four and the pressure, what
is not written here is the weather's, where `air` names one; its calm is a wind of 0.1 m/s at the leaves:
air            none; the name of a process weather that stands before this one
)" + air_help() +
        R"(
?name(gain)                        -> net CO2 in the step of the leaf that follows the query, mol
?name(gain, water, A, E, gs, T, Ci, psi)  -> ..., water that it gave (cm3); and while there was light: net assimilation
                                   (umol m-2 s-1), transpiration (mmol m-2 s-1), conductance of the stomata
                                   (mol m-2 s-1), temperature (degrees Celsius), CO2 in the leaf (umol/mol), water
                                   potential (MPa)
?name(v, jmax, g1, width)          with query = ["v", "jmax", "g1", "width"]: says what the leaf that follows the query has

The light of a step counts as its mean while there is light: photosynthesis is not linear in light, so that steps of an hour are
right and steps of a day take 5 to 20 % too much on a clear one (C4: 3 to 10).

Statistics of each plant: gain (mol) and water (cm3) of the step, transpiration (cm3/d), efficiency (mmol CO2 per mol of water),
means over the area while there was light of assimilation (umol m-2 s-1), conductance (mol m-2 s-1), internal (umol/mol),
temperature, potential (MPa), leaf_area (m2), residual: how far the equations are from holding, of the largest term. With
long_waves also thermal (W/m2 that meet both sides, mean of the leaves) and, of the whole world in W, waves_from_plants, _soil and _sky
and waves_to_plants, _soil and _sky, and waves_closure: all that is absorbed over all that is sent, less 1. With canopy = "big-leaf" also big_gain (mol), big_transpiration and
penman_monteith (cm3/d) and fao56 (mm/d).
Organs: assimilation, transpiration, conductance, temperature, internal, deficit, potential, gain, water; with long_waves thermal.)";
    return text;
}

const Registered<ProcessType> entry{{"leaf-exchange",
                                     "gas exchange of leaves: photosynthesis, stomata, temperature, transpiration",
                                     help(), construct<LeafExchange>}};

}  // namespace
}  // namespace espalier::environment
