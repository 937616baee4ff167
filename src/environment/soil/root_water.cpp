// Water in roots: the network of each plant in the soil of a process soil-water with model = "richards".
// Doussan et al. 1998; Meunier et al. 2017; Schroeder et al. 2008; Feddes et al. 1978; Couvreur et al. 2012.
#include "espalier/environment/environment.h"
#include "espalier/environment/environment_process.h"

#include "base/bytes.h"
#include "base/parallel.h"
#include "environment/exchange/needed_field.h"
#include "environment/soil/grid/field.h"
#include "environment/soil/hydraulics/heads.h"
#include "environment/soil/richards/sink.h"
#include "environment/soil/roots/internode_water.h"
#include "environment/soil/roots/uptake.h"
#include "environment/soil/shoot/plant_shoot.h"
#include "turtle/internode_bearers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <istream>
#include <limits>
#include <ostream>
#include <utility>

namespace espalier::environment {
namespace {

SharedSoil& soil_of(const Settings& settings, const Fields& fields) {
    const std::string name = settings.text_or("soil", "water");
    auto* const soil = dynamic_cast<SharedSoil*>(needed_field(settings, "soil", name, fields, "soil-water").source);
    if (soil) return *soil;
    throw UserError(
        settings.place("soil"),
        fmt::format("'{}' is not a soil-water with model = \"richards\", in which roots have potentials", name));
}

UptakeModel read_model(const Settings& settings) {
    const std::string model = settings.choice_or("model", "network", {"network", "feddes", "couvreur"});
    return model == "feddes" ? UptakeModel::feddes : model == "couvreur" ? UptakeModel::couvreur : UptakeModel::network;
}

FeddesHeads read_feddes(const Settings& settings, UptakeModel model) {
    FeddesHeads heads;
    if (model != UptakeModel::feddes || !settings.has("heads")) return heads;
    const std::vector<double> given = read_heads(settings, "heads", Range::between(-1e6, 1e4));
    if (given.size() != 4 || !std::is_sorted(given.rbegin(), given.rend(), std::less_equal<>())) {
        throw UserError(settings.place("heads"),
                        "'heads' are four falling pressure heads, cm: too wet, wet, dry, wilting");
    }
    return {given[0], given[1], given[2], given[3]};
}

/// Amounts of a plant, cm3, in the step and since the beginning.
struct Transpired {
    double in_step = 0, wanted_in_step = 0, total = 0;
    double taken = 0, taken_depth = 0;                        ///< from the soil in the step, and times the depth in cm
    double rate = 0, last_demand = 0;                         ///< of the last substep, cm3/d
    double lowest = std::numeric_limits<double>::infinity();  ///< head at the collar in the step, cm
    // Of a shoot.
    double given = 0;   ///< by leaves since the beginning
    double stored = 0;  ///< in its organs at the end of the last substep, less than full
    double grown = 0;   ///< that organs brought which came, less what those took away which went

    /// What roots took and is not given, stored or gone with organs, of the largest.
    double balance() const {
        const double largest = std::max({total, given, std::abs(stored)});
        return largest > 0 ? (total + grown - given - stored) / largest : 0;
    }
};

/// Mean depth of the uptake from uniform soil (SUF), cm.
double standard_depth(const PlantUptake& plant) {
    double sum = 0;
    for (std::size_t i = 0; i < plant.water().fractions.size(); ++i) {
        sum += plant.water().fractions[i] * plant.roots().depths[i];
    }
    return sum;
}

/// Without a stem the collar says what the shoot asks; with one, its leaves do.
RootCollar read_collar(const Settings& settings, const std::optional<ShootKind>& shoot, UptakeModel model) {
    if (!shoot) return RootCollar::read(settings);
    if (settings.has("collar")) {
        throw UserError(settings.place("collar"),
                        "leaves draw through the stem: leave out 'collar', or 'stem' where it is to be given");
    }
    if (model != UptakeModel::network) {
        throw UserError(settings.place("model"), "a stem stands on a network of roots: write model = \"network\"");
    }
    return {};
}

class RootWater final : public EnvironmentProcess, public SoilSink, public LeafSupply {
public:
    RootWater(Settings& settings, const EnvironmentContext& context, Fields& fields)
        : name_(context.name),
          shared_(soil_of(settings, fields)),
          grid_(shared_.layout().grid()),
          orders_(read_root_conductances(settings)),
          measure_(settings.choice_or("along", "age", {"age", "distance from tip"}) == "age"
                       ? RootMeasure::age
                       : RootMeasure::distance_from_tip),
          along_place_(settings.place("along")),
          warnings_(context.warnings),
          model_(read_model(settings)),
          shoot_(ShootKind::read(settings)),
          collar_(read_collar(settings, shoot_, model_)),
          feddes_(read_feddes(settings, model_)),
          zone_(settings.flag_or("zone", true)),
          soil_name_(settings.text_or("soil", "water")),
          stem_place_(settings.place(shoot_ ? "stem" : "")),
          transpired_(context.plants),
          held_(shoot_ ? context.plants : 0),
          lengths_(grid_.cells(), 0.0),
          shown_uptake_(context.name, "1/d", grid_, "water that roots take per volume of soil"),
          shown_lengths_(context.name + ".length_density", "cm/cm3", grid_, "length of roots per volume of soil") {
        if (model_ == UptakeModel::feddes && collar_.held) {
            throw UserError(settings.place("collar"), "Feddes' roots have no potentials: give a 'transpiration'");
        }
        shared_.attach(*this);
        shown_uptake_.set_faces(shared_.layout().faces());
        shown_uptake_.provide([this]() -> const WaterBrick& { return uptake_of_voxels(); }, fields, this);
        shown_lengths_.set_faces(shared_.layout().faces());
        shown_lengths_.provide([this]() -> const WaterBrick& { return densities(); }, fields);
    }

    void attach(LeafWater& leaves, const std::string& name) override {
        if (!shoot_) {
            throw UserError(
                fmt::format("'{}' brings no water to the leaves of '{}': give it a stem = {{ conductivity = "
                            "2 }}",
                            name_, name));
        }
        if (leaves_) throw UserError(fmt::format("'{}' brings water to other leaves than those of '{}'", name_, name));
        leaves_ = &leaves;
    }

    const std::string& solved_with() const override { return soil_name_; }

    void begin(const WorldView& world, const SoilLayout& soil) override {
        begin_leaves(world);
        roots_.clear();
        shoots_.clear();
        plants_.clear();
        demands_.clear();
        begins_ = true;
        std::fill(lengths_.begin(), lengths_.end(), 0);
        for (const PlantView& plant : world.plants) {
            plants_.push_back(plant.plant);
            PlantRoots roots = cut_roots(plant, world, soil);
            if (roots.left_at) shared_.warn_of_root_outside(plant.plant, *roots.left_at);
            roots_.emplace_back(std::move(roots), soil);
            roots_.back().add_lengths(lengths_);
            shoots_.push_back(shoot_of(plant, soil));
            demands_.push_back(shoots_.back() ? shoots_.back()->demand() : demand_of_leaves(plant.plant, world));
        }
        for (PlantUptake& roots : roots_) roots.surround(lengths_, zone_ && model_ == UptakeModel::network);
        for (Transpired& plant : transpired_) {
            plant.in_step = plant.wanted_in_step = plant.taken = plant.taken_depth = 0;
            plant.lowest = std::numeric_limits<double>::infinity();
        }
        days_in_step_ = 0;
    }

    double longest_substep(double day) const override { return collar_.longest_span(day); }

    bool has_jumped(double day) override {
        if (has_leaves()) return std::exchange(begins_, false);  // leaves say another demand in each step
        const double before = std::exchange(level_, collar_.level(day));
        return before != level_;
    }

    void draw(std::span<const SoilPoint> points, double day, double days, double weight, WaterBrick& uptake,
              WaterBrick& by_head) override {
        const double volume = shared_.layout().volume();
        // The demand over the substep is met exactly: what the substep before adds to it is made up for.
        mean_demand_ = collar_.held ? 0 : collar_.mean_demand(day, days);
        const double demand = std::max(0.0, (mean_demand_ - (1 - weight) * last_demand_) / weight);
        const double held = collar_.held ? collar_.head.at(day + 0.5 * days) : 0;
        if (shoot_) {
            solve_under_shoots(points, days, weight);
        } else {
            for_in_parallel(std::size_t{0}, roots_.size(), [&](std::size_t p) {
                roots_[p].solve(points, model_, collar_, feddes_, has_leaves() ? demand_of(p, weight) : demand, held);
            });
        }
        for (const PlantUptake& plant : roots_) {
            const PlantRoots& roots = plant.roots();
            for (std::size_t i = 0; i < roots.pieces.size(); ++i) {
                if (roots.cells[i] == PlantRoots::no_cell) continue;
                uptake[roots.cells[i]] += plant.water().uptake[i] / volume;
                by_head[roots.cells[i]] += plant.water().by_head[i] / volume;
            }
        }
    }

    std::vector<JointUptake> joint() const override {
        const double volume = shared_.layout().volume();
        std::vector<JointUptake> all;
        std::vector<double> by_cell;
        for (const PlantUptake& plant : roots_) {
            JointUptake joint;
            if (!plant.answer_together(by_cell, joint.collar)) continue;
            joint.collar /= volume;
            for (std::size_t k = 0; k < by_cell.size(); ++k) {
                joint.cells.emplace_back(plant.cells()[k], by_cell[k] / volume);
            }
            all.push_back(std::move(joint));
        }
        return all;
    }

    void accept(double days, double weight) override {
        days_in_step_ += days;
        for (std::size_t i = 0; i < roots_.size(); ++i) {
            if (plants_[i] >= transpired_.size()) continue;
            Transpired& plant = transpired_[plants_[i]];
            roots_[i].pass(days, weight, plant.rate);
            plant.rate = weight * roots_[i].water().transpiration() + (1 - weight) * plant.rate;
            plant.in_step += plant.rate * days;
            plant.total += plant.rate * days;
            plant.wanted_in_step += (has_leaves() ? demands_[i] : mean_demand_) * days;
            plant.last_demand = demands_[i];
            const std::vector<double>& uptake = roots_[i].water().uptake;
            for (std::size_t piece = 0; piece < uptake.size(); ++piece) {
                const double taken = std::max(0.0, uptake[piece]) * days;
                plant.taken += taken;
                plant.taken_depth += taken * roots_[i].roots().depths[piece];
            }
            plant.lowest = std::min(plant.lowest, roots_[i].water().collar);
            if (shoots_[i]) pass_shoot(plants_[i], *shoots_[i], days);
        }
        last_demand_ = mean_demand_;
    }

    void answer(const WorldView& world, Queries queries, std::span<Answer> answers, Fields&) override {
        shown_uptake_.change();
        shown_lengths_.change();
        std::size_t q = 0;
        for (std::size_t i = 0; i < world.plants.size() && i < roots_.size(); ++i) {
            const PlantView& view = world.plants[i];
            const std::size_t first = q;
            while (q < queries.size() && queries[q].plant == view.plant) ++q;
            if (q > first) tell(view, i, queries.subspan(first, q - first), answers.subspan(first, q - first));
        }
    }

    std::vector<Quantity> statistics(std::uint32_t plant) const override {
        const Transpired none{};
        const Transpired& water = plant < transpired_.size() ? transpired_[plant] : none;
        const PlantUptake* const roots = roots_of(plant);
        const bool any = roots && !roots->roots().pieces.empty();
        const double nothing = std::nan("");
        // The means of the step; before any time has passed, what flows at that moment.
        const bool passed = days_in_step_ > 0;
        const double now = roots ? roots->water().transpiration() : 0;
        const double demand = passed ? water.wanted_in_step / days_in_step_ : mean_demand_;
        std::vector<Quantity> all{
            {"transpiration", passed ? water.in_step / days_in_step_ : now, "cm3/d"},
            {"demand", collar_.held ? nothing : demand, "cm3/d"},
            {"total", water.total, "cm3"},
            {"collar", any && model_ != UptakeModel::feddes ? std::min(water.lowest, roots->water().collar) : nothing,
             "cm"},
            {"depth", water.taken > 0 ? water.taken_depth / water.taken : nothing, "cm"},
            {"conductance", any ? roots->water().conductance : 0, "cm2/d"},
            {"suf_depth", any ? standard_depth(*roots) : nothing, "cm"}};
        if (shoot_) {
            const PlantShoot* const shoot = shoot_of(plant);
            all.push_back({"given", water.given, "cm3"});
            all.push_back({"stored", shoot ? shoot->stored() : 0, "cm3"});
            all.push_back({"plc", shoot ? 100 * shoot->greatest_loss() : nothing, "%"});
            all.push_back({"water_balance", water.balance()});
        }
        return all;
    }

    std::vector<OrganQuantity> organ_quantities() const override {
        std::vector<OrganQuantity> all = root_quantities();
        for (OrganQuantity& quantity : shoot_ ? shoot_quantities() : std::vector<OrganQuantity>()) {
            const bool is_known = std::any_of(all.begin(), all.end(),
                                              [&](const OrganQuantity& one) { return one.name == quantity.name; });
            if (!is_known) all.push_back(std::move(quantity));
        }
        return all;
    }

    std::shared_ptr<const std::vector<float>> organ_values(const std::string& name,
                                                           std::uint32_t plant) const override {
        const PlantUptake* const roots = roots_of(plant);
        if (!roots) return nullptr;
        const std::shared_ptr<const std::vector<float>> of_roots = root_values(*roots, name);
        const PlantShoot* const shoot = shoot_of(plant);
        if (!shoot) return of_roots;
        auto values = std::make_shared<std::vector<float>>(
            of_roots ? *of_roots : std::vector<float>(shoot->tree().modules_in_string, std::nanf("")));
        return write_shoot_values(*shoot, name, *values) || of_roots ? values : nullptr;
    }

    std::pair<int, int> query_arity() const override { return {1, 6}; }
    Spreading spreading() const override { return Spreading::plants; }

    void save(std::ostream& out) const override {
        const double common[] = {level_, last_demand_, days_in_step_};
        write_doubles(out, common);
        for (const Transpired& plant : transpired_) {
            const double numbers[] = {plant.in_step, plant.wanted_in_step, plant.total,       plant.rate,
                                      plant.lowest,  plant.taken,          plant.taken_depth, plant.last_demand,
                                      plant.given,   plant.stored,         plant.grown};
            write_doubles(out, numbers);
        }
        for (const StoredHeads& heads : held_) save_heads(heads, out);
    }

    void restore(std::istream& in) override {
        double common[3];
        read_doubles(in, common);
        level_ = common[0];
        last_demand_ = common[1];
        days_in_step_ = common[2];
        for (Transpired& plant : transpired_) {
            for (double* number :
                 {&plant.in_step, &plant.wanted_in_step, &plant.total, &plant.rate, &plant.lowest, &plant.taken,
                  &plant.taken_depth, &plant.last_demand, &plant.given, &plant.stored, &plant.grown}) {
                read_doubles(in, {number, 1});
            }
        }
        for (StoredHeads& heads : held_) heads = restored_heads(in);
    }

private:
    void solve_under_shoots(std::span<const SoilPoint> points, double days, double weight) {
        for (std::size_t p = 0; p < roots_.size(); ++p) {
            if (!shoots_[p]) continue;
            shoots_[p]->set_substep(days, weight);
            roots_[p].solve_under(points, *shoots_[p]);
        }
    }

    bool has_leaves() const { return shoot_ || !collar_.leaves.empty(); }

    void begin_leaves(const WorldView& world) {
        if (!shoot_) return;
        if (!leaves_) {
            throw UserError(stem_place_, fmt::format("the stem of '{0}' needs a leaf-exchange with roots = \"{0}\" "
                                                     "behind it in the scene",
                                                     name_));
        }
        leaves_->begin_step(world);
    }

    /// Null for a plant without roots, whose leaves keep the potential that is given.
    std::unique_ptr<PlantShoot> shoot_of(const PlantView& plant, const SoilLayout& soil) {
        if (!shoot_ || plant.plant >= held_.size() || leaves_->leaves(plant.plant).empty()) return nullptr;
        const PlantRoots& roots = roots_.back().roots();
        if (roots.pieces.empty()) {
            warn_of_no_roots(plant.plant);
            return nullptr;
        }
        auto shoot = std::make_unique<PlantShoot>(
            plant.plant, shoot_tree(plant, leaves_->leaves(plant.plant), soil.grid().upper().y, *shoot_),
            roots.collar_height, *leaves_, held_[plant.plant]);
        Transpired& water = transpired_[plant.plant];
        water.grown += shoot->stored_at_first() - water.stored;
        water.stored = shoot->stored_at_first();
        return shoot;
    }

    void warn_of_no_roots(std::uint32_t plant) {
        if (!warnings_) return;
        warnings_->push_back({Diagnostic::Severity::warning, stem_place_,
                              fmt::format("plant {} has leaves, but no root in the soil of '{}' that brings them "
                                          "water: as if they were wet",
                                          plant, soil_name_),
                              ""});
        warnings_ = nullptr;
    }

    void pass_shoot(std::uint32_t plant, PlantShoot& shoot, double days) {
        shoot.pass();
        Transpired& water = transpired_[plant];
        water.given += shoot.mean_loss() * days;
        water.stored = shoot.stored();
        held_[plant] = shoot.held();
    }

    const PlantShoot* shoot_of(std::uint32_t plant) const {
        const auto at = std::find(plants_.begin(), plants_.end(), plant);
        return at == plants_.end() ? nullptr : shoots_[static_cast<std::size_t>(at - plants_.begin())].get();
    }

    /// Null for a plant that is not there in this step.
    const PlantUptake* roots_of(std::uint32_t plant) const {
        const auto at = std::find(plants_.begin(), plants_.end(), plant);
        return at == plants_.end() ? nullptr : &roots_[static_cast<std::size_t>(at - plants_.begin())];
    }

    /// Met over the substep as the demand of the scene is, cm3/d.
    double demand_of(std::size_t plant, double weight) const {
        const std::uint32_t number = plants_[plant];
        const double last = number < transpired_.size() ? transpired_[number].last_demand : 0;
        return std::max(0.0, (demands_[plant] - (1 - weight) * last) / weight);
    }

    /// cm3/d: what the leaves of a plant give in this step.
    double demand_of_leaves(std::uint32_t plant, const WorldView& world) const {
        if (collar_.leaves.empty() || !world.environment) return 0;
        const double demand = world.environment->statistic(collar_.leaves + ".transpiration", plant);
        if (std::isfinite(demand)) return std::max(0.0, demand);
        throw UserError(
            fmt::format("the collar of '{}' needs a leaf-exchange called '{}', before the soil in the scene", name_,
                        collar_.leaves));
    }

    PlantRoots cut_roots(const PlantView& plant, const WorldView& world, const SoilLayout& soil) {
        if (!plant.interpretation || !plant.string) return {};
        const SaidOfRoots said = SaidOfRoots::of(plant, name_);
        if (!said.ages.empty() && measure_ != RootMeasure::age) warn_of_ages(plant.plant);
        return roots_in_soil(plant, world, shared_.days_per_unit(), soil, orders_, measure_, said);
    }

    void warn_of_ages(std::uint32_t plant) {
        if (!warnings_) return;
        warnings_->push_back({Diagnostic::Severity::warning, along_place_,
                              fmt::format("plant {} says the ages of its roots, but '{}' reads its curves along the "
                                          "distance from the tip",
                                          plant, name_),
                              ""});
        warnings_ = nullptr;
    }

    /// Each query is answered the water of the internode before it: potential in it, and of roots uptake, soil at their
    /// surface, share of the uptake from uniform soil.
    void tell(const PlantView& view, std::size_t plant, Queries queries, std::span<Answer> answers) const {
        const turtle::OrganBearers bearers(view.interpretation->geometry, *view.string);
        for (std::size_t q = 0; q < queries.size(); ++q) {
            const std::uint32_t internode = bearers.of(queries[q].module, queries[q].pose.position);
            InternodeWater water = water_in(roots_[plant], internode);
            if (shoots_[plant]) water.xylem = shoots_[plant]->head_in(internode).value_or(water.xylem);
            const double numbers[] = {water.xylem, water.uptake, water.surface, water.fraction};
            for (std::size_t n = 0; n < std::min<std::size_t>(4, answers[q].size()); ++n) answers[q][n] = numbers[n];
        }
    }

    const WaterBrick& uptake_of_voxels() {
        values_.assign(grid_.cells(), 0);
        const double volume = shared_.layout().volume();
        for (const PlantUptake& plant : roots_) {
            for (std::size_t i = 0; i < plant.roots().cells.size(); ++i) {
                if (plant.roots().cells[i] == PlantRoots::no_cell) continue;
                values_[plant.roots().cells[i]] += plant.water().uptake[i] / volume;
            }
        }
        return values_;
    }

    const WaterBrick& densities() {
        values_.assign(grid_.cells(), 0);
        const double volume = shared_.layout().volume();
        for (std::size_t c = 0; c < values_.size(); ++c) values_[c] = lengths_[c] / volume;
        return values_;
    }

    std::string name_;
    SharedSoil& shared_;
    WaterGrid grid_;
    std::vector<RootConductances> orders_;
    RootMeasure measure_;
    Place along_place_;
    std::vector<Diagnostic>* warnings_;  ///< null as soon as there was one
    UptakeModel model_;
    std::optional<ShootKind> shoot_;  ///< none: the collar says what is asked of the roots
    RootCollar collar_;
    FeddesHeads feddes_;
    bool zone_;
    std::string soil_name_;
    Place stem_place_;
    LeafWater* leaves_ = nullptr;               ///< of the shoots
    double level_ = 0;                          ///< of the collar, in the last substep
    double mean_demand_ = 0, last_demand_ = 0;  ///< over this substep and the one before, cm3/d
    double days_in_step_ = 0;                   ///< that have passed; none in the first step
    std::vector<std::uint32_t> plants_;         ///< of this step, and their roots
    std::vector<PlantUptake> roots_;
    std::vector<std::unique_ptr<PlantShoot>> shoots_;  ///< of these plants; null: none
    std::vector<double> demands_;                      ///< of their leaves, cm3/d
    bool begins_ = true;                               ///< no substep of this step has been taken
    std::vector<Transpired> transpired_;               ///< by plant
    std::vector<StoredHeads> held_;                    ///< by plant, of shoots
    WaterBrick lengths_;                               ///< of roots in each voxel, cm
    WaterField shown_uptake_, shown_lengths_;
    WaterBrick values_;  ///< of the field that is being made
};

const char* const help =
    R"(The water of each plant's roots in a soil-water with model = "richards", which stands before it in
the scene. Internodes below the soil's surface are roots.

soil           "water"; name of the process whose soil the roots are in
radial         1/d, conductivity of a root's surface per cm of head, for all orders: a number, or a curve
               { at = [0, 10, 30], values = [1.7e-4, 1e-4, 2e-5] }, linear between its points
axial          cm3/d, conductance along a root times its length, for all orders: a number, or a curve
along          "age", or "distance from tip"; what curves are read along, in days or cm
orders         []; tables { radial, axial } by the order of branching, the last of which stands for all higher orders
collar         required without `stem`; what happens at the collar: a head, or a demand, which a number or leaves say
    head       pressure head at the collar, at most 0 cm, or { file = "weather.csv", column = "...", unit = "MPa" }
    transpiration  demand of each plant as long as the collar is above `limit`, cm3/d, or a column of a file
    leaves     name of a leaf-exchange, before the soil in the scene: its leaves' transpiration in the step is the demand
    limit      lowest pressure head of the collar, by default -15000 cm
    by_day     true: the demand lasts from 6 to 18 o'clock, as a sine with the same mean over a day
zone           true; the soil around each root is a hollow cylinder in which water moves at a steady rate
model          "network", or "feddes", "couvreur"; feddes: the demand is shared by length of roots, reduced where the soil is
               dry or full; couvreur: by the fractions of a uniform soil, with compensation
heads          [-10, -25, -800, -16000] cm; for feddes, between which the uptake rises to its full rate, and falls
stem           none; instead of `collar`: water goes on through the internodes above the soil to the leaves of a
               leaf-exchange that names this process as its `roots`, and their stomata close with their potential. In each
               substep soil, roots, stems and leaves are solved together
    conductivity   2 kg m-1 s-1 MPa-1; of the cross-section of internodes
    b          3 MPa; tension at which exp(-1) of the conductance is left: K = Kmax exp(-(tension / b)^c) (Neufeld et al. 1992).
               It comes back with the water. 0: nothing is lost
    c          3; how steeply
    capacitance    0 kg m-3 MPa-1; water that wood gives as its potential falls
leaf           with `stem`, how water enters leaves: tables of the same b and c, and
    conductance    8 mmol m-2 s-1 MPa-1; from an internode to the leaf, of the leaf's area
    capacitance    0 mol m-2 MPa-1; water that leaves give as their potential falls

Pressure heads are numbers of cm, or texts with a unit, as "-1.5 MPa" (see soil-water). What becomes of roots that leave the soil
says `outside` of the soil-water.

?name(a)                 -> pressure head in the internode before the query, cm; with a stem also of the shoot
?name(a, b, c, d)        -> ..., uptake (cm3/d), pressure head of the soil at its surface (cm), fraction of the uptake from
                         uniform soil
?name(a, b, c, d, t)     also says the age of the internode before the query, t days, along which curves are read; without it
                         an age is the time since the step of its birth
?name(a, b, c, d, kr, kx)  also says the conductances of the internode before the query: kr (1/d) and kx (cm3/d) count for it
                         instead of radial and axial

Fields: `name`, uptake (1/d); `name.length_density` (cm/cm3). Statistics of each plant: transpiration and demand (cm3/d, the
means of the step), total (cm3), collar (pressure head, cm, the lowest in the step), depth of the uptake (cm), conductance of the root system (Krs,
cm2/d), suf_depth (mean depth of the uptake from uniform soil, cm).

With a stem also given (cm3 that leaves gave since the beginning), stored (cm3 in stems and leaves, less than full), plc (%, of the organ
that lost most) and water_balance: what roots took and is not given, stored or gone with organs, of the largest.

Organs: head and soil, the pressure heads in each internode and in the soil at its surface (cm), uptake and mean_uptake of the step (cm3/d), fraction of the
uptake from uniform soil, radial (1/d) and axial (cm3/d). With a stem also of its internodes and leaves: head (cm), flow (cm3/d) and plc
(loss of conductance, %).)";

const Registered<ProcessType> entry{{"root-water",
                                     "water in roots: potentials, uptake and transpiration in soil with pressure", help,
                                     construct<RootWater>}};

}  // namespace
}  // namespace espalier::environment
