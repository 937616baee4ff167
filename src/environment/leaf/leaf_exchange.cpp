// leaf-exchange: what leaves take of carbon dioxide and give of water in the light that they absorb.
#include "espalier/environment/environment.h"
#include "espalier/environment/environment_process.h"

#include "base/parallel.h"
#include "environment/exchange/changing_settings.h"
#include "environment/exchange/measured_before.h"
#include "environment/given/weather/weather.h"
#include "environment/leaf/gas/leaf_water.h"
#include "environment/leaf/gas/penman_monteith.h"
#include "environment/leaf/gas/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace espalier::environment {
namespace {

using namespace leaf;

constexpr double seconds_per_day = 86400;
constexpr double least_part = 1e-3;                                      ///< of a leaf, which is not divided below
constexpr double cm3_of_mole = 1000 * water_molar_mass / water_density;  ///< of water

using Values = std::shared_ptr<const std::vector<float>>;

/// What one organ did in a step.
struct LeafStep {
    double area = 0;       ///< m2
    double gain = 0;       ///< net CO2, mol
    double water = 0;      ///< cm3
    GasExchange lit;       ///< while there was light, or all the time in the dark
    double potential = 0;  ///< MPa
};

/// What one organ does per day.
struct LeafRates {
    double gain = 0;   ///< net CO2, mol/d
    double water = 0;  ///< cm3/d
};

/// A leaf's light, from the process that measures it.
struct OrganLightValues {
    Values power, near_infrared, area, lit;
    Values sunlit, direct, direct_near_infrared;  ///< null where leaves are not divided
};

/// Parts of a leaf in the sun's own light and out of it (de Pury & Farquhar 1997): photosynthesis is not linear.
struct LitParts {
    double sunlit = 0;  ///< share of the area
    LeafLight sun, shade;
    double lit = 0;  ///< share of the step in which there is light
};

/// The leaves of a plant during a step in which the water's way to them is solved.
struct SuppliedLeaves {
    std::vector<DrawingLeaf> leaves;
    std::vector<LitParts> light;       ///< by leaf
    std::vector<LeafRates> now, mean;  ///< by leaf: at the last potentials, and over the last substep
    std::vector<double> residuals;     ///< by leaf
    bool is_supplied = false;          ///< in this step
};

/// A plant as one leaf: sums over its leaves of what they get, times their areas.
struct BigLeaf {
    double area = 0, photons = 0, near_infrared = 0, lit = 0;

    void add(double leaf_area, const LitParts& light) {
        const auto mean = [&](double LeafLight::*of) {
            return light.shade.*of + light.sunlit * (light.sun.*of - light.shade.*of);
        };
        area += leaf_area;
        photons += leaf_area * mean(&LeafLight::photons);
        near_infrared += leaf_area * mean(&LeafLight::near_infrared);
        lit += leaf_area * light.lit;
    }
};

struct LeafQuantity {
    OrganQuantity told;
    double (*of)(const LeafStep&);
};

const std::array<LeafQuantity, 9>& known() {
    static const std::array<LeafQuantity, 9> all{
        {{{"assimilation", "umol m-2 s-1", "net CO2 that leaves take, while there is light"},
          [](const LeafStep& leaf) { return leaf.lit.assimilation; }},
         {{"transpiration", "mmol m-2 s-1", "water that leaves give, while there is light"},
          [](const LeafStep& leaf) { return 1000 * leaf.lit.transpiration; }},
         {{"conductance", "mol m-2 s-1", "of stomata to water vapour"},
          [](const LeafStep& leaf) { return leaf.lit.conductance; }},
         {{"temperature", "degC", "of the leaf"}, [](const LeafStep& leaf) { return leaf.lit.temperature; }},
         {{"internal", "umol/mol", "CO2 in the leaf"}, [](const LeafStep& leaf) { return leaf.lit.internal; }},
         {{"deficit", "kPa", "of vapour pressure at the leaf's surface"},
          [](const LeafStep& leaf) { return leaf.lit.deficit; }},
         {{"potential", "MPa", "water potential of the leaf"}, [](const LeafStep& leaf) { return leaf.potential; }},
         {{"gain", "mol", "net CO2 of the organ in the step"}, [](const LeafStep& leaf) { return leaf.gain; }},
         {{"water", "cm3", "water that the organ gives in the step"},
          [](const LeafStep& leaf) { return leaf.water; }}}};
    return all;
}

/// Those of the table, and of its tables `kinds` for some plants.
struct LeafKinds {
    std::vector<LeafKind> kinds;
    std::vector<std::size_t> of_plants;  ///< numbers of their kinds

    LeafKinds(const Settings& settings, std::uint32_t plants)
        : kinds{read_leaf_kind(settings)}, of_plants(std::max(plants, 1U), 0) {
        for (const Settings& table : settings.tables("kinds")) {
            for (const double plant : table.numbers("plants")) of_plants[number(table, plant, plants)] = kinds.size();
            kinds.push_back(read_leaf_kind(table, kinds.front()));
        }
    }

private:
    static std::size_t number(const Settings& table, double plant, std::uint32_t plants) {
        if (plant >= 0 && plant < plants && plant == std::floor(plant)) return static_cast<std::size_t>(plant);
        throw UserError(table.place("plants"),
                        fmt::format("there is no plant {:g}: they are numbered from 0 to {}, as in statistics.csv",
                                    plant, static_cast<int>(plants) - 1));
    }
};

/// The process that brings water to leaves; null: their potential is given.
LeafSupply* supply_of(const Settings& settings, const Fields& fields) {
    if (!settings.has("roots")) return nullptr;
    const std::string name = settings.text("roots");
    auto* const supply = dynamic_cast<LeafSupply*>(fields.need(name).source);
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
          light_(settings.text("light")),
          light_place_(settings.place("light")),
          kinds_(settings, context.plants),
          weather_(Weather::named_by(settings, "air", fields)),
          air_(SceneAir::read(settings)),
          near_infrared_(settings.number_or("nir", 0.25, Range::between(0, 10))),
          potential_(settings.number_or("potential", 0, Range::between(-20, 0))),
          is_divided_(settings.flag_or("sunlit", true)),
          days_(read_days(settings, weather_.get())),
          supply_(supply_of(settings, fields)),
          compares_(settings.choice_or("canopy", "leaves", {"leaves", "big-leaf"}) == "big-leaf"),
          leaves_(context.plants),
          big_(context.plants),
          supplied_(supply_ ? context.plants : 0),
          residuals_(context.plants, 0) {
        if (supply_) supply_->attach(*this, name_);
        if (weather_) air_name_ = settings.text("air"), air_place_ = settings.place("air");
        for (const char* key : {"temperature", "humidity", "wind", "co2"}) {
            if (!weather_ || settings.has(key)) own_air_.insert(key);
        }
        has_own_pressure_ = settings.has("pressure") || settings.has("height");
    }

    void advance(const WorldView& world, std::span<const Query>, Fields&) override {
        if (!world.environment) throw RunError("leaf-exchange works in a scene's exchange only");
        if (!supply_) begin_step(world);
        for (const PlantView& plant : world.plants) {
            if (plant.plant >= leaves_.size() || (supply_ && supplied_[plant.plant].is_supplied)) continue;
            breathe(plant, *world.environment, world.step > 0);
        }
    }

    void begin_step(const WorldView& world) override {
        if (supply_) require_before(*world.environment, supply_->solved_with());
        find_light(*world.environment);
        seconds_ = world.dt * days_ * seconds_per_day;
        take_weather();
        now_ = air_.air();
        dark_ = {0, 0, air_.thermal_radiation()};
        unlit_.clear();
        residual_in_the_dark_ = 0;
        for (const LeafKind& kind : kinds_.kinds) {
            unlit_.push_back(gas_exchange(kind, dark_, now_, potential_));
            residual_in_the_dark_ =
                std::max(residual_in_the_dark_, residuals_of(unlit_.back(), kind, dark_, now_, potential_).largest());
        }
        for (std::vector<LeafStep>& plant : leaves_) plant.clear();
        std::fill(residuals_.begin(), residuals_.end(), 0);
        for (SuppliedLeaves& plant : supplied_) plant = {};
        std::fill(big_.begin(), big_.end(), BigLeaf{});
        if (!supply_) return;
        for (const PlantView& plant : world.plants) {
            if (plant.plant < supplied_.size()) list_leaves(plant, *world.environment);
        }
    }

    std::span<const DrawingLeaf> leaves(std::uint32_t plant) const override {
        return plant < supplied_.size() ? std::span<const DrawingLeaf>(supplied_[plant].leaves)
                                        : std::span<const DrawingLeaf>();
    }

    void lose(std::uint32_t plant, std::span<const double> potentials, std::span<LeafLoss> losses) override {
        SuppliedLeaves& all = supplied_[plant];
        all.is_supplied = true;
        for_in_parallel(std::size_t{0}, all.leaves.size(), [&](std::size_t i) {
            LeafStep& leaf = leaves_[plant][all.leaves[i].module];
            leaf.potential = potentials[i];
            const Solved found = solved(plant, all.light[i], leaf.potential);
            const SlopingExchange dark = in_the_dark(plant, leaf.potential);
            leaf.lit = found.leaf;
            all.residuals[i] = found.residual;
            all.now[i] = rates(leaf, all.light[i].lit, dark.leaf);
            const double share = all.light[i].lit;
            losses[i] = {all.now[i].water,
                         leaf.area * cm3_of_mole * seconds_per_day *
                             (share * found.by_potential + (1 - share) * dark.transpiration_by_potential)};
        });
    }

    void pass(std::uint32_t plant, double days, double weight) override {
        SuppliedLeaves& all = supplied_[plant];
        for (std::size_t i = 0; i < all.leaves.size(); ++i) {
            LeafStep& leaf = leaves_[plant][all.leaves[i].module];
            for (double LeafRates::*const rate : {&LeafRates::gain, &LeafRates::water}) {
                all.mean[i].*rate = weight * (all.now[i].*rate) + (1 - weight) * (all.mean[i].*rate);
            }
            leaf.gain += all.mean[i].gain * days;
            leaf.water += all.mean[i].water * days;
            residuals_[plant] = std::max({residuals_[plant], all.residuals[i], residual_in_the_dark_});
        }
    }

    void answer(const WorldView&, std::span<const Query> queries, std::span<Answer> answers, Fields&) override {
        for (std::size_t i = 0; i < queries.size(); ++i) {
            const LeafStep leaf = leaf_behind(queries[i]);
            const double numbers[] = {leaf.gain,
                                      leaf.water,
                                      leaf.lit.assimilation,
                                      1000 * leaf.lit.transpiration,
                                      leaf.lit.conductance,
                                      leaf.area > 0 ? leaf.lit.temperature : air_.temperature,
                                      leaf.lit.internal,
                                      leaf.potential};
            std::copy_n(numbers, std::min(std::size(numbers), answers[i].size()), answers[i].begin());
        }
    }

    std::vector<Quantity> statistics(std::uint32_t plant) const override {
        LeafStep sum;
        double warmth = 0, potential = 0;
        for (const LeafStep& leaf : plant < leaves_.size() ? leaves_[plant] : std::vector<LeafStep>()) {
            sum.area += leaf.area;
            sum.gain += leaf.gain;
            sum.water += leaf.water;
            if (leaf.area > 0) warmth += leaf.area * leaf.lit.temperature, potential += leaf.area * leaf.potential;
        }
        const double none = std::nan(""), days = seconds_ / seconds_per_day;
        const double moles = sum.water / cm3_of_mole;
        std::vector<Quantity> all{{"gain", sum.gain, "mol"},
                                  {"water", sum.water, "cm3"},
                                  {"transpiration", days > 0 ? sum.water / days : 0, "cm3/d"},
                                  {"efficiency", moles > 0 ? 1000 * sum.gain / moles : none, "mmol/mol"},
                                  {"temperature", sum.area > 0 ? warmth / sum.area : none, "degC"},
                                  {"potential", sum.area > 0 ? potential / sum.area : none, "MPa"},
                                  {"leaf_area", sum.area, "m2"},
                                  {"residual", plant < residuals_.size() ? residuals_[plant] : 0}};
        if (compares_) compare(plant, all);
        return all;
    }

    std::vector<OrganQuantity> organ_quantities() const override {
        std::vector<OrganQuantity> all;
        for (const LeafQuantity& quantity : known()) all.push_back(quantity.told);
        return all;
    }

    std::shared_ptr<const std::vector<float>> organ_values(const std::string& name,
                                                           std::uint32_t plant) const override {
        const auto quantity = std::find_if(known().begin(), known().end(),
                                           [&](const LeafQuantity& one) { return one.told.name == name; });
        if (quantity == known().end() || plant >= leaves_.size()) return nullptr;
        auto values = std::make_shared<std::vector<float>>();
        for (const LeafStep& leaf : leaves_[plant]) {
            values->push_back(leaf.area > 0 ? static_cast<float>(quantity->of(leaf)) : std::nanf(""));
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
        return all;
    }

    std::pair<int, int> query_arity() const override { return {1, 8}; }
    Spreading spreading() const override { return Spreading::plants; }

private:
    /// What a plant would do as one leaf, and what a lawn would.
    void compare(std::uint32_t plant, std::vector<Quantity>& all) const {
        const double none = std::nan("");
        const double lawn = weather_ ? weather_->now().evaporation / (seconds_ / seconds_per_day) : none;
        double gain = none, water = none, by_formula = none;
        if (plant < big_.size() && big_[plant].area > 0) {
            const BigLeaf& big = big_[plant];
            const LeafLight light{big.photons / big.area, big.near_infrared / big.area, dark_.thermal};
            double potential = 0, conductance = 0;
            for (const LeafStep& leaf : leaves_[plant]) {
                potential += leaf.area * leaf.potential / big.area;
                if (leaf.area > 0) conductance += leaf.area * leaf.lit.conductance / big.area;
            }
            const double lit = big.lit / big.area, days = seconds_ / seconds_per_day;
            LeafStep one;
            one.area = big.area;
            one.lit = solved(kind_of(plant), light, potential).leaf;
            const GasExchange unlit = in_the_dark(plant, potential).leaf;
            const LeafRates made = rates(one, lit, unlit);
            gain = made.gain * days;
            water = made.water;
            const auto formula = [&](const LeafLight& of, double open) {
                return penman_monteith(kind_of(plant), of, now_, open);
            };
            by_formula = big.area * cm3_of_mole * seconds_per_day *
                         (lit * formula(light, conductance) + (1 - lit) * formula(dark_, unlit.conductance));
        }
        all.push_back({"big_gain", gain, "mol"});
        all.push_back({"big_transpiration", water, "cm3/d"});
        all.push_back({"penman_monteith", by_formula, "cm3/d"});
        all.push_back({"fao56", lawn, "mm/d"});
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

    /// With a potential that is given.
    void breathe(const PlantView& plant, const Environment& environment, bool has_time_passed) {
        const OrganLightValues light = light_of(plant.plant, environment);
        std::vector<LeafStep>& leaves = leaves_[plant.plant];
        if (!light.area || !light.power || !light.lit) return;
        leaves.assign(light.area->size(), {});
        std::vector<double> residuals(leaves.size(), 0);
        std::vector<LitParts> lights(leaves.size());
        for (std::size_t i = 0; i < leaves.size(); ++i) {
            if (!((*light.area)[i] > 0)) continue;
            lights[i] = light_on(light, i);
            big_[plant.plant].add((*light.area)[i], lights[i]);
        }
        for_in_parallel(std::size_t{0}, leaves.size(), [&](std::size_t i) {
            const float area = (*light.area)[i];
            if (!(area > 0)) return;
            LeafStep& leaf = leaves[i];
            leaf.area = area;
            leaf.potential = potential_;
            const LitParts& parts = lights[i];
            const Solved found = solved(plant.plant, parts, potential_);
            leaf.lit = found.leaf;
            residuals[i] = std::max(residual_in_the_dark_, found.residual);
            if (!has_time_passed) return;
            const LeafRates made = rates(leaf, parts.lit, unlit_[kinds_.of_plants[plant.plant]]);
            leaf.gain = made.gain * seconds_ / seconds_per_day;
            leaf.water = made.water * seconds_ / seconds_per_day;
        });
        residuals_[plant.plant] = leaves.empty() ? 0 : *std::max_element(residuals.begin(), residuals.end());
    }

    /// The leaves of a plant to which water is brought, in their light.
    void list_leaves(const PlantView& plant, const Environment& environment) {
        const OrganLightValues light = light_of(plant.plant, environment);
        std::vector<LeafStep>& leaves = leaves_[plant.plant];
        if (!light.area || !light.power || !light.lit) return;
        leaves.assign(light.area->size(), {});
        SuppliedLeaves& supplied = supplied_[plant.plant];
        for (std::uint32_t module = 0; module < leaves.size(); ++module) {
            const float area = (*light.area)[module];
            if (!(area > 0)) continue;
            leaves[module].area = area;
            supplied.leaves.push_back({module, area});
            supplied.light.push_back(light_on(light, module));
            big_[plant.plant].add(area, supplied.light.back());
        }
        supplied.now.resize(supplied.leaves.size());
        supplied.mean.resize(supplied.leaves.size());
        supplied.residuals.resize(supplied.leaves.size());
    }

    LitParts light_on(const OrganLightValues& values, std::size_t module) const {
        const double lit = seconds_ > 0 ? std::min(1.0, (*values.lit)[module] / seconds_) : 0;
        const double power = (*values.power)[module];
        if (!(power > 0)) return {0, dark_, dark_, lit};
        const double near = values.near_infrared ? (*values.near_infrared)[module] : near_infrared_ * power;
        const LeafLight mean{photons_of_joule * power, near, dark_.thermal};
        const double sunlit = values.sunlit ? std::min(1.0f, (*values.sunlit)[module]) : 0;
        if (!(sunlit > least_part && sunlit < 1 - least_part)) return {0, mean, mean, lit};
        const double direct = (*values.direct)[module];
        const double near_direct = values.direct_near_infrared ? (*values.direct_near_infrared)[module] : direct;
        const auto part = [&](double of_direct) {
            return LeafLight{mean.photons * (1 + direct * (of_direct - 1)), near * (1 + near_direct * (of_direct - 1)),
                             mean.thermal};
        };
        return {sunlit, part(1 / sunlit), part(0), lit};
    }

    struct Solved {
        GasExchange leaf;
        double residual = 0;      ///< the largest
        double by_potential = 0;  ///< of the transpiration, mol m-2 s-1 MPa-1
    };

    Solved solved(const LeafKind& kind, const LeafLight& light, double potential) const {
        const SlopingExchange found = supply_ ? sloping_gas_exchange(kind, light, now_, potential)
                                              : SlopingExchange{gas_exchange(kind, light, now_, potential)};
        return {found.leaf, residuals_of(found.leaf, kind, light, now_, potential).largest(),
                found.transpiration_by_potential};
    }

    /// Both parts of a leaf, and what they are together.
    Solved solved(std::uint32_t plant, const LitParts& light, double potential) const {
        if (!(light.shade.photons > 0) && light.sunlit == 0) {
            const SlopingExchange dark = in_the_dark(plant, potential);
            return {dark.leaf, residual_in_the_dark_, dark.transpiration_by_potential};
        }
        Solved all = solved(kind_of(plant), light.shade, potential);
        if (light.sunlit == 0) return all;
        const Solved sun = solved(kind_of(plant), light.sun, potential);
        for (double GasExchange::*const rate :
             {&GasExchange::assimilation, &GasExchange::transpiration, &GasExchange::conductance,
              &GasExchange::temperature, &GasExchange::internal, &GasExchange::deficit}) {
            all.leaf.*rate += light.sunlit * (sun.leaf.*rate - all.leaf.*rate);
        }
        all.residual = std::max(all.residual, sun.residual);
        all.by_potential += light.sunlit * (sun.by_potential - all.by_potential);
        return all;
    }

    const LeafKind& kind_of(std::uint32_t plant) const { return kinds_.kinds[kinds_.of_plants[plant]]; }

    /// All leaves that have not dried are alike in the dark.
    SlopingExchange in_the_dark(std::uint32_t plant, double potential) const {
        if (potential >= kind_of(plant).stomata.dry) return {unlit_[kinds_.of_plants[plant]], 0};
        return sloping_gas_exchange(kind_of(plant), dark_, now_, potential);
    }

    LeafRates rates(const LeafStep& leaf, double lit, const GasExchange& unlit) const {
        const auto mean = [&](double GasExchange::*rate) { return lit * (leaf.lit.*rate) + (1 - lit) * (unlit.*rate); };
        return {1e-6 * seconds_per_day * leaf.area * mean(&GasExchange::assimilation),
                cm3_of_mole * seconds_per_day * leaf.area * mean(&GasExchange::transpiration)};
    }

    LeafStep leaf_behind(const Query& query) const {
        if (query.plant >= leaves_.size()) return {};
        const std::vector<LeafStep>& leaves = leaves_[query.plant];
        return query.module + 1 < leaves.size() ? leaves[query.module + 1] : LeafStep{};
    }

    std::string name_, light_;
    Place light_place_;
    LeafKinds kinds_;
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
    Air now_;
    LeafLight dark_;
    std::vector<GasExchange> unlit_;  ///< of every leaf in the dark, by kind
    double residual_in_the_dark_ = 0;
    std::vector<std::vector<LeafStep>> leaves_;  ///< of each plant, by module
    std::vector<BigLeaf> big_;                   ///< of each plant
    std::vector<SuppliedLeaves> supplied_;       ///< of each plant
    std::vector<double> residuals_;
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
        R"(kinds          []; tables of other leaves: plants = [1, 2], by their numbers from 0, and what of the above is different

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

The light of a step counts as its mean while there is light: photosynthesis is not linear in light, so that steps of an hour are
right and steps of a day take 5 to 20 % too much on a clear one (C4: 3 to 10).

Statistics of each plant: gain (mol) and water (cm3) of the step, transpiration (cm3/d), efficiency (mmol CO2 per mol of water),
temperature, potential (MPa), leaf_area (m2), residual: how far the equations are from holding, of the largest term. With canopy = "big-leaf" also big_gain (mol), big_transpiration and
penman_monteith (cm3/d) and fao56 (mm/d).
Organs: assimilation, transpiration, conductance, temperature, internal, deficit, potential, gain, water.)";
    return text;
}

const Registered<ProcessType> entry{{"leaf-exchange",
                                     "gas exchange of leaves: photosynthesis, stomata, temperature, transpiration",
                                     help(), construct<LeafExchange>}};

}  // namespace
}  // namespace espalier::environment
