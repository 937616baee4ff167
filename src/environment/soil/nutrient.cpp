// A solute in soil: transport, sorption, decay, fertiliser and uptake by roots.
// Millington & Quirk 1961; van Leer 1974; Barber 1995; Schroeder et al. 2008. The rest is in
// src/environment/soil/solutes/.
#include "espalier/environment/environment_process.h"

#include "environment/exchange/needed_field.h"
#include "environment/soil/grid/direction.h"
#include "environment/soil/grid/field.h"
#include "environment/soil/grid/solids.h"
#include "environment/soil/richards/sink.h"
#include "environment/soil/solutes/solute_in_soil.h"
#include "geometry/grids/voxel_values.h"

#include <algorithm>
#include <cmath>

namespace espalier::environment {
namespace {

/// The field of the water that the solute moves in; null if it is alone.
const Field* water_of_solute(const Settings& settings, const Fields& fields) {
    return settings.has("soil") ? &needed_field(settings, "soil", settings.text("soil"), fields, "soil-water")
                                : nullptr;
}

class Nutrient final : public EnvironmentProcess, public SoilFollower {
public:
    Nutrient(Settings& settings, const EnvironmentContext& context, Fields& fields)
        : water_(water_of_solute(settings, fields)),
          shared_(water_ ? dynamic_cast<SharedSoil*>(water_->source) : nullptr),
          parameters_(read_solute_parameters(settings, context, !shared_)),
          days_(shared_ ? shared_->days_per_unit() : parameters_.soil.days),
          name_(context.name),
          warnings_(context.warnings) {
        if (!shared_) make_layout(context, fields);
        solute_.emplace(layout(), parameters_, context.plants);
        if (shared_) {
            shared_->attach(*this);
        } else {
            find_water();
        }
        solute_->begin_with(shared_ ? shared_->contents() : contents_);
        shown_.reserve(2);
        show(context.name, parameters_.unit + "/cm3", "concentration of a solute in the soil's water", fields,
             [this]() -> const WaterBrick& { return solute_->transport().concentration; });
        show(context.name + ".amount", parameters_.unit + "/cm3", "solute per volume of soil, in water and on solids",
             fields, [this]() -> const WaterBrick& { return solute_->transport().amount; });
    }

    void begin(const WorldView& world, const WaterBrick& contents) override {
        solute_->begin_step(world, days_, contents);
        if (const auto& root = solute_->root_outside()) {
            if (shared_) return shared_->warn_of_root_outside(root->plant, root->place);
            warn_of_root_outside(warnings_, parameters_.soil, name_, root->plant, root->place);
        }
    }

    void follow(const SoilMovement& movement, const WaterBrick& contents) override {
        solute_->advance(movement, contents);
    }

    void advance(const WorldView& world, Queries, Fields&) override {
        if (shared_) return;  // the soil has told of everything
        find_water();
        begin(world, contents_);
        if (world.step == 0) return;
        movement_.days = world.dt * days_;
        movement_.day = solute_->day();
        follow(movement_, contents_);
    }

    void answer(const WorldView&, Queries queries, std::span<Answer> answers, Fields&) override {
        for (std::size_t q = 0; q < queries.size(); ++q) {
            const WaterSample sample = sample_water(layout().grid(), layout().faces(),
                                                    solute_->transport().concentration, queries[q].pose.position);
            const glm::dvec3 gradient = 0.01 * sample.gradient;
            const double all[] = {sample.content,
                                  gradient.x,
                                  gradient.y,
                                  gradient.z,
                                  solute_->taken_in_step(queries[q].plant),
                                  distance_to_wall(queries[q].pose.position)};
            std::copy_n(all, std::min(std::size(all), answers[q].size()), answers[q].begin());
        }
        for (WaterField& field : shown_) field.change();
    }

    std::vector<Quantity> statistics(std::uint32_t plant) const override {
        const std::string& unit = parameters_.unit;
        const SoluteAccount& account = solute_->account();
        const SoluteFlown& flown = solute_->transport().flown();
        const double days = solute_->days_in_step();
        return {{"uptake", days > 0 ? solute_->taken_in_step(plant) / days : 0, unit + "/d"},
                {"total", solute_->taken(plant), unit},
                {"stored", account.stored, unit},
                {"fertilised", account.fertilised, unit},
                {"produced", account.produced, unit},
                {"decayed", account.decayed, unit},
                {"taken", account.taken, unit},
                {"inflow", flown.top, unit},
                {"leached", flown.leached, unit},
                {"rising", flown.bottom + flown.leached, unit},
                {"sides", flown.sides, unit},
                {"balance", solute_->balance_error()},
                {"minimum", account.minimum, unit + "/cm3"},
                {"maximum", account.maximum, unit + "/cm3"}};
    }

    std::pair<int, int> query_arity() const override { return {1, 6}; }
    Spreading spreading() const override { return Spreading::plants; }

    ProcessMemory memory() const override {
        return {static_cast<std::size_t>(bytes_per_voxel * static_cast<double>(layout().grid().voxels()))};
    }

    void save(std::ostream& out) const override { solute_->save(out); }
    void restore(std::istream& in) override { solute_->restore(in); }

private:
    static constexpr double bytes_per_voxel = 16 * 8 + 2 * 5;

    const SoilLayout& layout() const { return shared_ ? shared_->layout() : *own_layout_; }

    double distance_to_wall(const glm::dvec3& point) const {
        if (shared_) return shared_->distance_to_wall(point);
        return own_solids_->distance_to_wall(point, layout().grid(), layout().joined_x(), layout().joined_z());
    }

    void make_layout(const EnvironmentContext& context, const Fields& fields) {
        const WaterGrid grid = parameters_.soil.space.affordable_grid(context, bytes_per_voxel);
        own_solids_.emplace(parameters_.soil.space);
        own_solids_->look(fields);
        own_layout_.emplace(grid, parameters_.soil, own_solids_->free_voxels(grid), fields);
        movement_.resize(grid);
        contents_.assign(grid.cells(), parameters_.content);
        for (std::size_t c = 0; c < grid.cells(); ++c) {
            const bool top = grid.y_of(c / grid.stride()) + 1 == grid.size().y;
            if (!top) movement_.flux[1][c] = -parameters_.flow;
        }
        std::fill(movement_.floor.begin(), movement_.floor.end(), -parameters_.flow);
        std::fill(movement_.surface.begin(), movement_.surface.end(), parameters_.flow);
    }

    /// The contents of a linear soil, whose voxels may be others.
    void find_water() {
        if (!water_) return;
        const VoxelReader water(water_->current ? water_->current() : water_->grid);
        const WaterGrid& grid = layout().grid();
        grid.for_each_cell([&](std::size_t cell) { contents_[cell] = water.value(grid.centre(grid.voxel_of(cell))); });
    }

    void show(const std::string& name, const std::string& unit, const char* meaning, Fields& fields,
              std::function<const WaterBrick&()> values) {
        WaterField& field = shown_.emplace_back(name, unit, layout().grid(), meaning);
        field.set_faces(layout().faces());
        field.provide(std::move(values), fields);
    }

    const Field* water_;
    SharedSoil* shared_;
    SoluteParameters parameters_;
    double days_;  ///< that a unit of the scene's time stands for
    std::string name_;
    std::vector<Diagnostic>* warnings_;  ///< null as soon as there was one
    std::optional<WaterSolids> own_solids_;
    std::optional<SoilLayout> own_layout_;
    WaterBrick contents_;    ///< without a soil of its own to tell them
    SoilMovement movement_;  ///< the same
    std::optional<SoluteInSoil> solute_;
    std::vector<WaterField> shown_;
};

const Registered<ProcessType> entry{{"nutrient",
                                     "a solute in soil: transport, sorption, decay, fertiliser, uptake by roots",
                                     nutrient_help, construct<Nutrient>}};

}  // namespace
}  // namespace espalier::environment
