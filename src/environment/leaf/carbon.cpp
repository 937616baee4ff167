// carbon: what leaves gain pays for what a plant keeps alive and builds.
#include "espalier/base/math.h"
#include "espalier/environment/environment.h"
#include "espalier/environment/environment_process.h"

#include "base/bytes.h"
#include "environment/exchange/changing_settings.h"
#include "environment/exchange/measured_before.h"
#include "environment/given/weather/weather.h"
#include "environment/leaf/carbon/plant_sugar.h"
#include "turtle/internode_bearers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace espalier::environment {
namespace {

using namespace carbon;

constexpr double carbon_of_mole = 12.011;  ///< g

/// Grams of carbon of one plant, since the beginning or in one step.
struct Ledger {
    double gained = 0;       ///< by leaves and organs that give
    double brought = 0;      ///< as seed, and by organs that the model made of nothing
    double maintenance = 0;  ///< respired
    double growth = 0;       ///< respired by what is built
    double built = 0;
    double shed = 0;  ///< with organs that are gone: structure and sugar
    double unpaid = 0;

    void add(const Ledger& other) {
        gained += other.gained;
        brought += other.brought;
        maintenance += other.maintenance;
        growth += other.growth;
        built += other.built;
        shed += other.shed;
        unpaid += other.unpaid;
    }
};

struct PlantCarbon {
    PlantSugar sugar;
    double structure = 0;  ///< of all organs, what may be built now included
    Ledger all, step;
    std::vector<double> concentrations;                   ///< of each node, g cm-3
    SugarTree tree;                                       ///< of the step
    std::vector<std::pair<std::uint32_t, double>> built;  ///< modules that asked, and what they may build
};

/// What a query wants of its plant.
struct Wish {
    std::size_t query = 0;
    std::uint32_t node = 0;
    double grams = 0;  ///< to build; below 0: it gives
    double has = 0;
    double upkeep = 1;  ///< of the maintenance of what it has
    bool says_what_it_has = false;
    double granted = 0;
};

/// The node that a module stands on.
using NodeOfModule = std::function<std::uint32_t(std::uint32_t module, const glm::dvec3& place)>;

class Carbon final : public EnvironmentProcess {
public:
    Carbon(Settings& settings, const EnvironmentContext& context, Fields& fields)
        : name_(context.name),
          leaves_(settings.text_or("leaves", "")),
          leaves_place_(settings.place("leaves")),
          transports_(settings.choice_or("share", "pool", {"pool", "transport"}) == "transport"),
          weather_(Weather::named_by(settings, "air", fields)),
          days_(read_days(settings, weather_.get())),
          temperature_(settings.number_or("temperature", 20, Range::between(-40, 60))),
          respiration_(settings.number_or("maintenance", 0.015, Range::between(0, 10))),
          q10_(settings.number_or("q10", 2, Range::between(1, 10))),
          yield_(settings.number_or("yield", 0.75, Range::between(0.05, 1))),
          has_own_temperature_(settings.has("temperature") || !weather_) {
        const double seed = settings.number_or("seed", 0, Range::between(0, 1e9));
        if (transports_) {
            ways_.conductivity = settings.number_or("conductivity", ways_.conductivity, Range::between(0, 1e9));
            ways_.storage = settings.number_or("storage", ways_.storage, Range::between(1e-6, 1));
            half_.sink = settings.number_or("half", half_.sink, Range::between(1e-9, 10));
            half_.upkeep = half_.sink / 20;
        }
        PlantCarbon beginning;
        beginning.sugar = PlantSugar(seed);
        beginning.all.brought = seed;
        plants_.assign(context.plants, beginning);
    }

    void advance(const WorldView& world, Queries queries, Fields&) override {
        if (!world.environment) throw RunError("carbon works in a scene's exchange only");
        if (!leaves_.empty()) find_leaves(*world.environment);
        if (weather_ && !has_own_temperature_) temperature_ = weather_->now().temperature;
        step_days_ = world.dt * days_;
        passed_days_ = world.step > 0 ? step_days_ : 0;
        granted_.assign(queries.size(), 0);
        nodes_.assign(queries.size(), 0);
        std::vector<std::vector<std::size_t>> of_plant(plants_.size());
        for (std::size_t i = 0; i < queries.size(); ++i) {
            if (queries[i].plant < plants_.size()) of_plant[queries[i].plant].push_back(i);
        }
        for (const PlantView& plant : world.plants) {
            if (plant.plant < plants_.size()) live(plant, *world.environment, queries, of_plant[plant.plant]);
        }
    }

    void answer(const WorldView&, Queries queries, std::span<Answer> answers, Fields&) override {
        for (std::size_t i = 0; i < queries.size(); ++i) {
            answers[i][0] = granted_[i];
            if (answers[i].size() > 3) answers[i][3] = level_at(queries[i], nodes_[i]);
        }
    }

    std::vector<Quantity> statistics(std::uint32_t plant) const override {
        const PlantCarbon none;
        const PlantCarbon& of = plant < plants_.size() ? plants_[plant] : none;
        const Ledger& step = of.step;
        return {{"gain", step.gained, "g"},
                {"maintenance", step.maintenance, "g"},
                {"growth", step.growth, "g"},
                {"built", step.built, "g"},
                {"shed", step.shed, "g"},
                {"unpaid", step.unpaid, "g"},
                {"reserve", of.sugar.total(), "g"},
                {"structure", of.structure, "g"},
                {"balance", balance(of)}};
    }

    std::vector<OrganQuantity> organ_quantities() const override {
        std::vector<OrganQuantity> all{{"built", "g", "carbon that the organ may build in the step"}};
        if (transports_) all.push_back({"sugar", "g cm-3", "carbon of sugar in what leads it"});
        return all;
    }

    std::shared_ptr<const std::vector<float>> organ_values(const std::string& name,
                                                           std::uint32_t plant) const override {
        if (plant >= plants_.size()) return nullptr;
        const PlantCarbon& of = plants_[plant];
        auto values = std::make_shared<std::vector<float>>(of.tree.internodes_of_module.size(), std::nanf(""));
        if (name == "built") {
            for (const auto& [module, grams] : of.built) (*values)[module] = static_cast<float>(grams);
        } else if (name == "sugar" && transports_) {
            for (std::size_t i = 0; i < values->size(); ++i) {
                const std::uint32_t node = of.tree.internodes_of_module[i];
                if (node != SugarTree::none) (*values)[i] = static_cast<float>(of.concentrations[node]);
            }
        } else {
            return nullptr;
        }
        return values;
    }

    std::vector<ChangingSetting> changing_settings() override {
        std::vector<ChangingSetting> all{changing("maintenance", Range::between(0, 10), respiration_)};
        if (has_own_temperature_) all.push_back(changing("temperature", Range::between(-40, 60), temperature_));
        return all;
    }

    std::pair<int, int> query_arity() const override { return {1, 4}; }
    Spreading spreading() const override { return Spreading::plants; }

    void save(std::ostream& out) const override {
        for (const PlantCarbon& plant : plants_) {
            plant.sugar.save(out);
            put(out, plant.structure);
            put(out, plant.all);
        }
    }
    void restore(std::istream& in) override {
        for (PlantCarbon& plant : plants_) {
            plant.sugar.restore(in);
            plant.structure = get<double>(in);
            plant.all = get<Ledger>(in);
        }
    }

private:
    void find_leaves(const Environment& environment) const {
        if (measures_before(environment, name_, leaves_, "gain")) return;
        throw UserError(leaves_place_,
                        fmt::format("'{}' needs a leaf-exchange called '{}', before it in the scene", name_, leaves_));
    }

    void live(const PlantView& plant, const Environment& environment, Queries queries,
              const std::vector<std::size_t>& own) {
        PlantCarbon& of = plants_[plant.plant];
        of.step = {};
        of.tree = transports_ ? sugar_tree(plant, ways_) : sugar_pool(plant);
        const NodeOfModule node_of = nodes_of(plant);
        std::vector<Wish> wishes;
        for (const std::size_t i : own) wishes.push_back(wish_of(queries[i], i, node_of));
        for (const Wish& wish : wishes) load(of, wish);
        load_leaves(of, plant, environment, node_of);
        note_organs(of, plant.plant, wishes);
        of.step.shed += of.sugar.put_into(of.tree, plant);
        upkeep(of, wishes);
        if (transports_) {
            transport(of, wishes);
        } else {
            share_pool(of, wishes);
        }
        of.built.clear();
        for (const Wish& wish : wishes) {
            if (wish.grams > 0) of.built.emplace_back(queries[wish.query].module, wish.granted);
            of.step.built += wish.granted;
            nodes_[wish.query] = wish.node;
            granted_[wish.query] = wish.grams > 0 ? wish.granted : wish.grams;
        }
        of.step.growth = of.step.built * (1 / yield_ - 1);
        of.structure += of.step.built;
        of.all.add(of.step);
    }

    /// A pool is one node.
    NodeOfModule nodes_of(const PlantView& plant) const {
        if (!transports_) return [](std::uint32_t, const glm::dvec3&) { return 0u; };
        return [bearers = turtle::OrganBearers(plant.interpretation->geometry, *plant.string)](
                   std::uint32_t module, const glm::dvec3& place) {
            const std::uint32_t bearer = bearers.of(module, place);
            return bearer == turtle::no_bearer ? 0 : bearer;
        };
    }

    Wish wish_of(const Query& query, std::size_t i, const NodeOfModule& node_of) const {
        Wish wish;
        wish.query = i;
        wish.node = node_of(query.module, query.pose.position);
        wish.grams = query.parameters[0];
        if (query.parameters.size() > 1) {
            wish.has = query.parameters[1];
            wish.says_what_it_has = true;
            if (query.parameters.size() > 2) wish.upkeep = query.parameters[2];
            if (wish.has < 0 || wish.upkeep < 0) {
                throw RunError(
                    fmt::format("'?{}' of plant {}: an organ cannot have {} g that take {} of the maintenance", name_,
                                query.plant, wish.has, wish.upkeep));
            }
        }
        return wish;
    }

    /// An organ that gives.
    void load(PlantCarbon& of, const Wish& wish) const {
        if (wish.grams >= 0 || passed_days_ == 0) return;
        of.tree.nodes[wish.node].source += -wish.grams / step_days_;
        of.step.gained -= wish.grams;
    }

    /// What leaves gain is loaded where they stand; what they respire is taken there.
    void load_leaves(PlantCarbon& of, const PlantView& plant, const Environment& environment,
                     const NodeOfModule& node_of) const {
        if (leaves_.empty()) return;
        const auto gains = environment.organ_values(leaves_ + ".gain", plant.plant);
        for (std::uint32_t module = 0; gains && module < gains->size(); ++module) {
            const double grams = carbon_of_mole * (*gains)[module];
            if (!(std::abs(grams) > 0)) continue;
            SugarNode& node = of.tree.nodes[node_of(module, {})];
            (grams > 0 ? node.source : node.upkeep) += std::abs(grams) / step_days_;
            if (grams > 0) of.step.gained += grams;
        }
    }

    /// What organs say that they have is compared with what they had and were given.
    void note_organs(PlantCarbon& of, std::uint32_t plant, const std::vector<Wish>& wishes) const {
        double has = 0;
        std::size_t saying = 0;
        for (const Wish& wish : wishes) has += wish.has, saying += wish.says_what_it_has ? 1 : 0;
        if (saying == 0 && !wishes.empty()) return;
        if (saying < wishes.size()) {
            throw RunError(fmt::format(
                "plant {}: some '?{}' say what their organs have and some do not: give all of them a second parameter",
                plant, name_));
        }
        (has > of.structure ? of.step.brought : of.step.shed) += std::abs(has - of.structure);
        of.structure = has;
    }

    void upkeep(PlantCarbon& of, const std::vector<Wish>& wishes) const {
        if (passed_days_ == 0) return;
        const double rate = respiration_ * math::pow(q10_, (temperature_ - 25) / 10);
        double said = 0;
        for (const Wish& wish : wishes) {
            of.tree.nodes[wish.node].upkeep += rate * wish.upkeep * wish.has;
            said += wish.has;
        }
        const double unsaid = std::max(0.0, of.structure - said);
        double volume = 0;
        for (const SugarNode& node : of.tree.nodes) volume += node.volume;
        for (SugarNode& node : of.tree.nodes) node.upkeep += rate * unsaid * node.volume / volume;
    }

    void share_pool(PlantCarbon& of, std::vector<Wish>& wishes) const {
        double pool = of.step.gained, due = 0, demand = 0;
        for (const SugarNode& node : of.tree.nodes) {
            pool += node.sugar;
            due += node.upkeep * step_days_;
        }
        of.step.maintenance = std::min(pool, due);
        of.step.unpaid = due - of.step.maintenance;
        pool -= of.step.maintenance;
        for (const Wish& wish : wishes) demand += std::max(0.0, wish.grams) / yield_;
        const double share = demand > pool ? pool / demand : 1;
        for (Wish& wish : wishes) wish.granted = share * std::max(0.0, wish.grams);
        of.sugar.take_from(of.tree, {std::max(0.0, pool - share * demand)});
    }

    void transport(PlantCarbon& of, std::vector<Wish>& wishes) {
        std::vector<SugarNode>& nodes = of.tree.nodes;
        for (const Wish& wish : wishes) nodes[wish.node].sink += std::max(0.0, wish.grams) / (yield_ * step_days_);
        of.concentrations = transport_.concentrations(nodes, step_days_, half_);
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            const double c = of.concentrations[i], paid = c / (half_.upkeep + c);
            of.step.maintenance += paid * nodes[i].upkeep * step_days_;
            of.step.unpaid += (1 - paid) * nodes[i].upkeep * step_days_;
        }
        for (Wish& wish : wishes) {
            const double c = of.concentrations[wish.node];
            wish.granted = std::max(0.0, wish.grams) * c / (half_.sink + c);
        }
        of.sugar.take_from(of.tree, of.concentrations);
    }

    /// The fourth parameter: what there is where the query stands.
    double level_at(const Query& query, std::uint32_t node) const {
        if (query.plant >= plants_.size()) return 0;
        const PlantCarbon& of = plants_[query.plant];
        return transports_ ? of.concentrations[node] : of.sugar.total();
    }

    /// Of all that came, the share that neither stands nor went.
    static double balance(const PlantCarbon& of) {
        const double came = of.all.gained + of.all.brought;
        const double went = of.all.maintenance + of.all.growth + of.all.shed + of.structure + of.sugar.total();
        return came > 0 ? (came - went) / came : 0;
    }

    std::string name_, leaves_;
    Place leaves_place_;
    bool transports_;
    std::shared_ptr<const Weather> weather_;
    double days_, temperature_, respiration_, q10_, yield_;
    bool has_own_temperature_;
    SugarWays ways_;
    HalfSaturation half_;
    SugarTransport transport_;
    std::vector<PlantCarbon> plants_;
    // Of the step.
    double step_days_ = 1, passed_days_ = 0;
    std::vector<double> granted_;       ///< of each query
    std::vector<std::uint32_t> nodes_;  ///< that each query stands on
};

const std::string& help() {
    static const std::string text =
        R"(What leaves gain pays for what a plant keeps alive and what it builds. All masses are grams of carbon; dry matter has about 0.45
of its weight.

leaves         none; name of a leaf-exchange before this one in the scene, whose net gain is loaded where its leaves stand
share          "pool", "transport"; who gets it: all sinks alike, or those that sugar reaches along the axes
seed           0 g; what each plant has at the beginning
yield          0.75; carbon built of a gram that growth takes; what is left is respired (Penning de Vries et al. 1974)
maintenance    0.015 1/d; respiration of what stands, per gram and day at 25 degrees; may have keyframes
q10            2; by how much 10 degrees raise it
temperature    20 degrees Celsius, or the weather's; of the plant; may have keyframes
air            none; the name of a process weather that stands before this one
days           1; days that a unit of time stands for, or the weather's

Of share = "transport" (Allen, Prusinkiewicz & DeJong 2005; Prusinkiewicz et al. 2007):
conductivity   2000 cm2/d; flow of sugar for a fall of concentration along an internode, per area of its whole section
storage        0.1; share of an internode's volume that holds sugar
half           0.05 g/cm3; concentration at which a sink takes half of what it wishes; maintenance, a twentieth of it

?name(wish)                        -> carbon that the organ may build in this step; maintenance is that of all that was built
?name(wish, has)                   -> the same for an organ that has so much carbon, which costs its maintenance
?name(wish, has, upkeep)           -> the same where so many times the maintenance is due: 0 for leaves, which respire in
                                   leaf-exchange
?name(wish, has, upkeep, sugar)    -> ..., and the plant's reserve (g), or with transport the concentration of sugar where the
                                   query stands (g/cm3)

A wish below 0 gives: an organ that the model itself lets gain. Maintenance is paid first. Where it cannot be paid, `unpaid`
says so, and the model decides what dies. An organ that no longer says what it has is shed.

Statistics of each plant, of the step: gain, maintenance, growth (respired), built, shed, unpaid; reserve and structure (g);
balance: carbon that came since the beginning and neither stands nor went, as a share of it.
Organs: built; with transport also sugar.)";
    return text;
}

const Registered<ProcessType> entry{{"carbon",
                                     "carbon of plants: gain, respiration, growth, reserves, transport along axes",
                                     help(), construct<Carbon>}};

}  // namespace
}  // namespace espalier::environment
