// Soil water: a content that diffuses between obstacles, layers and sides, and that roots drink.
// Its parameters and queries are described in linear/parameters.cpp, the numbers behind it in docs/water.md. With
// model = "richards" it is another process: richards/richards_process.h.
#include "espalier/environment/environment_process.h"

#include "environment/soil/grid/field.h"
#include "environment/soil/grid/queries.h"
#include "environment/soil/grid/solids.h"
#include "environment/soil/linear/diffusion.h"
#include "environment/soil/linear/steady.h"
#include "environment/soil/linear/stock.h"
#include "environment/soil/richards/parameters.h"
#include "environment/soil/richards/richards_process.h"

#include <fmt/format.h>

#include <algorithm>
#include <istream>
#include <ostream>

namespace espalier::environment {
namespace {

// Two bricks of doubles, two grids of floats, flags.
constexpr double bytes_per_voxel = 2 * 8 + 2 * 5 + 3;

class SoilWater final : public EnvironmentProcess {
public:
    SoilWater(Settings& settings, const EnvironmentContext& context, Fields& fields)
        : parameters_(read_water_parameters(settings, context)),
          grid_(parameters_.space.affordable_grid(context,
                                                  bytes_per_voxel + (parameters_.steady ? steady_bytes_per_voxel : 0))),
          solids_(parameters_.space),
          diffusion_(grid_, parameters_),
          field_(context.name, parameters_.unit, grid_),
          name_(context.name),
          warnings_(context.warnings),
          queries_(parameters_.querying, context) {
        solids_.look(fields);
        stock_.emplace(grid_, parameters_, solids_.free_voxels(grid_));
        if (parameters_.steady) stock_->settle(diffusion_);
        field_.set_faces(stock_->faces());
        field_.provide([this]() -> const WaterBrick& { return stock_->contents(); }, fields);
    }

    void advance(const WorldView& world, Queries, Fields& fields) override {
        const bool moved = solids_.look(fields);
        if (moved || restored_) {
            restored_ = false;
            stock_->set_free(solids_.free_voxels(grid_));
            field_.set_faces(stock_->faces());
        }
        if (world.step == 0) {
            stock_->hold();  // no time has passed
        } else if (parameters_.mode == WaterMode::relaxation) {
            stock_->relax(world.dt);
        } else {
            stock_->diffuse(diffusion_, world.dt);
        }
    }

    void answer(const WorldView&, Queries queries, std::span<Answer> answers, Fields&) override {
        queries_.answer({grid_, stock_->faces(), solids_, stock_->contents(), false, false,
                         [this](double height) {
                             const WaterLayer* const layer = parameters_.layer_at(height);
                             return layer ? layer->gravity : glm::dvec3(0, -1, 0);
                         }},
                        queries, answers, *stock_);
        stock_->measure();
        warn_of_water_without_room();
        field_.change();
    }

    std::vector<ChangingSetting> changing_settings() override {
        std::vector<ChangingSetting> settings = changing_settings_of(parameters_.querying);
        for (std::size_t k = 0; k < parameters_.sources.size(); ++k) {
            const bool holds = parameters_.sources[k].hold.has_value();
            const Range range = holds ? Range::between(0, std::min(parameters_.porosity, 1e30)) : content_range;
            settings.push_back({fmt::format("sources.{}.{}", k, holds ? "hold" : "rate"), range,
                                [this, k](double value) { stock_->set_source(k, value); }});
        }
        return settings;
    }

    std::vector<Quantity> statistics(std::uint32_t plant) const override {
        const WaterBalance& balance = stock_->balance();
        const double amount = parameters_.querying.amount;
        const std::string unit = parameters_.querying.unit();
        return queries_.statistics(plant, {{"total", balance.total * amount, unit},
                                           {"added", balance.added * amount, unit},
                                           {"boundary", balance.boundary * amount, unit},
                                           {"drunk", balance.drunk * amount, unit},
                                           {"displaced", balance.displaced * amount, unit},
                                           {"runoff", balance.runoff * amount, unit},
                                           {"balance", balance.relative_error()},
                                           {"minimum", balance.minimum, "m3/m3"},
                                           {"maximum", balance.maximum, "m3/m3"}});
    }

    std::pair<int, int> query_arity() const override { return {1, 100}; }
    Spreading spreading() const override { return Spreading::queries; }

    ProcessMemory memory() const override {
        return {static_cast<std::size_t>(bytes_per_voxel * static_cast<double>(grid_.voxels()))};
    }

    void save(std::ostream& out) const override {
        stock_->save(out);
        queries_.save(out);
    }

    void restore(std::istream& in) override {
        stock_->restore(in);
        queries_.restore(in);
        field_.set_faces(stock_->faces());
        restored_ = true;
    }

private:
    // Once. A concentration may be what it likes, but there is no more than a cubic metre of water in one of soil.
    void warn_of_water_without_room() {
        if (!warnings_ || parameters_.unit != "m3/m3" || !(stock_->balance().maximum > 1)) return;
        warnings_->push_back({Diagnostic::Severity::warning, parameters_.space.place,
                              fmt::format("'{}' holds {:.3g} m3/m3, more water than there is room: give the soil its "
                                          "porosity (porosity = 0.45), so that the excess runs off, or another unit",
                                          name_, stock_->balance().maximum),
                              ""});
        warnings_ = nullptr;
    }

    WaterParameters parameters_;
    WaterGrid grid_;
    WaterSolids solids_;
    WaterDiffusion diffusion_;
    WaterField field_;
    std::optional<WaterStock> stock_;
    bool restored_ = false;  ///< the solids looked at are older than the stock
    std::string name_;
    std::vector<Diagnostic>* warnings_;  ///< null as soon as there was one
    SoilQueries queries_;
};

std::unique_ptr<EnvironmentProcess> make_soil(Settings& settings, const EnvironmentContext& context, Fields& fields) {
    const std::string model = settings.choice_or("model", "linear", {"linear", "richards", "still"});
    if (model != "linear") return make_richards_soil(settings, context, fields, model == "still");
    return std::make_unique<SoilWater>(settings, context, fields);
}

const Registered<ProcessType> entry{
    {"soil-water", "water or another substance in soil: diffusion or Richards' equation, layers, uptake by roots",
     std::string(soil_water_help) + "\n" + richards_help, make_soil}};

}  // namespace
}  // namespace espalier::environment
