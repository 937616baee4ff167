#include "environment/soil/richards/richards_process.h"

#include "environment/exchange/changing_settings.h"
#include "environment/soil/grid/field.h"
#include "environment/soil/grid/queries.h"
#include "environment/soil/grid/solids.h"
#include "environment/soil/richards/richards.h"

#include <algorithm>
#include <istream>
#include <ostream>

namespace espalier::environment {
namespace {

double bytes_per_soil_voxel(const SoilSpace& space) {
    Box layer = space.domain;
    layer.upper.y = layer.lower.y + space.voxel;
    const double columns = WaterGrid::voxels_needed(layer, space.voxel, space.flat);
    return 37 * 8 + 6 * 5 + 4 + (SoilBand::pays(columns) ? SoilBand::bytes_per_voxel(columns) : 0);
}

/// The layer of voxels on the soil in which ponding water is shown.
WaterGrid layer_on(const WaterGrid& soil) {
    Box box{soil.lower(), soil.upper()};
    box.lower.y = soil.upper().y;
    box.upper.y = box.lower.y + soil.voxel();
    return WaterGrid(box, soil.voxel(), soil.flat());
}

class RichardsSoil final : public EnvironmentProcess, public SharedSoil {
public:
    RichardsSoil(Settings& settings, const EnvironmentContext& context, Fields& fields, bool is_still)
        : parameters_(read_soil_parameters(settings, context, is_still, fields)),
          grid_(parameters_.space.affordable_grid(context, bytes_per_soil_voxel(parameters_.space))),
          solids_(parameters_.space),
          layout_((solids_.look(fields), SoilLayout(grid_, parameters_, solids_.free_voxels(grid_), fields))),
          soil_(layout_, parameters_),
          name_(context.name),
          warnings_(context.warnings),
          queries_(parameters_.querying, context) {
        provide(context.name, fields);
    }

    void advance(const WorldView& world, Queries, Fields& fields) override {
        if (solids_.look(fields)) {
            throw RunError(
                "a shape in the soil has moved: stones and pots of model = \"richards\" stay where they are");
        }
        for (SoilSink* sink : sinks_) sink->begin(world, layout_);
        for (SoilFollower* follower : followers_) follower->begin(world, soil_.contents());
        if (world.step > 0) {
            soil_.advance(world.dt * parameters_.days, sinks_);
        } else {
            soil_.show_to(sinks_);
        }
    }

    void answer(const WorldView&, Queries queries, std::span<Answer> answers, Fields&) override {
        answer_heads(queries, answers);
        queries_.answer({grid_, layout_.faces(), solids_, soil_.contents(), layout_.joined_x(), layout_.joined_z()},
                        queries, answers, soil_);
        for (WaterField& field : shown_) field.change();
    }

    std::vector<ChangingSetting> changing_settings() override {
        std::vector<ChangingSetting> settings = changing_settings_of(parameters_.querying);
        SoilSurface& surface = parameters_.surface;
        if (surface.kind != SoilSurface::Kind::atmosphere) return settings;
        const Range rates = Range::between(0, 1e5);
        if (surface.rain.is_constant()) {
            settings.push_back(changing("boundaries.top.rain", rates, surface.rain.constant()));
        }
        if (surface.evaporation.is_constant()) {
            settings.push_back(changing("boundaries.top.evaporation", rates, surface.evaporation.constant()));
        }
        return settings;
    }

    std::vector<Quantity> statistics(std::uint32_t plant) const override {
        const SoilBalance& balance = soil_.balance();
        const double mm = 10 / static_cast<double>(soil_.ponding().size());  // per cm times columns
        double ponding = 0;
        for (const double depth : soil_.ponding()) ponding += depth;
        return queries_.statistics(plant, {{"storage", balance.stored * mm, "mm"},
                                           {"ponding", ponding * mm, "mm"},
                                           {"rain", balance.flown.rain * mm, "mm"},
                                           {"evaporation", balance.flown.evaporation * mm, "mm"},
                                           {"runoff", balance.flown.runoff * mm, "mm"},
                                           {"infiltration", balance.flown.top * mm, "mm"},
                                           {"sides", balance.flown.sides * mm, "mm"},
                                           {"drainage", -balance.flown.bottom * mm, "mm"},
                                           {"added", balance.flown.added * mm, "mm"},
                                           {"drunk", balance.flown.drunk * mm, "mm"},
                                           {"balance", balance.relative_error()},
                                           {"substeps", static_cast<double>(soil_.substeps())}});
    }

    void attach(SoilSink& sink) override { sinks_.push_back(&sink); }
    void attach(SoilFollower& follower) override {
        followers_.push_back(&follower);
        soil_.attach(follower);
    }
    const WaterBrick& contents() const override { return soil_.contents(); }
    const SoilLayout& layout() const override { return layout_; }
    double days_per_unit() const override { return parameters_.days; }
    double distance_to_wall(const glm::dvec3& point) const override {
        return solids_.distance_to_wall(point, grid_, layout_.joined_x(), layout_.joined_z());
    }
    void warn_of_root_outside(std::uint32_t plant, const glm::dvec3& point) override {
        environment::warn_of_root_outside(warnings_, parameters_, name_, plant, point);
    }

    std::pair<int, int> query_arity() const override { return {1, 100}; }
    Spreading spreading() const override { return Spreading::queries; }

    ProcessMemory memory() const override {
        return {
            static_cast<std::size_t>(bytes_per_soil_voxel(parameters_.space) * static_cast<double>(grid_.voxels()))};
    }

    void save(std::ostream& out) const override {
        soil_.save(out);
        queries_.save(out);
    }

    void restore(std::istream& in) override {
        soil_.restore(in);
        queries_.restore(in);
    }

private:
    void provide(const std::string& name, Fields& fields) {
        const auto show = [&](const std::string& part, const char* unit, const char* meaning,
                              std::function<const WaterBrick&()> values) {
            WaterField& field = shown_.emplace_back(name + part, unit, grid_, meaning);
            field.set_faces(layout_.faces());
            field.provide(std::move(values), fields, this);
        };
        shown_.reserve(6);
        show("", "m3/m3", "water content of the soil", [this]() -> const WaterBrick& { return soil_.contents(); });
        show(".head", "cm", "pressure head of the soil's water",
             [this]() -> const WaterBrick& { return soil_.heads(); });
        if (parameters_.is_still) return;
        static const char* const axes[] = {".flux_x", ".flux_y", ".flux_z"};
        for (int axis = 0; axis < (grid_.flat() ? 2 : 3); ++axis) {
            show(axes[axis], "cm/d", "water that flows along the axis",
                 [this, axis]() -> const WaterBrick& { return fluxes_along(axis); });
        }
        if (parameters_.surface.kind != SoilSurface::Kind::atmosphere) return;
        const WaterGrid layer = layer_on(grid_);
        WaterField& ponding = shown_.emplace_back(name + ".ponding", "mm", layer, "water that stands on the soil");
        ponding.set_faces(WaterFaces(layer, std::vector<std::uint8_t>(layer.voxels(), 1)));
        ponding.provide([this, layer]() -> const WaterBrick& { return ponding_on(layer); }, fields);
    }

    const WaterBrick& fluxes_along(int axis) {
        shown_values_.assign(grid_.cells(), 0);
        layout_.for_free([&](std::size_t cell) { shown_values_[cell] = soil_.flux(cell, axis); });
        return shown_values_;
    }

    const WaterBrick& ponding_on(const WaterGrid& layer) {
        shown_values_.assign(layer.cells(), 0);
        for (int z = 0; z < layer.size().z; ++z) {
            for (int x = 0; x < layer.size().x; ++x) {
                shown_values_[layer.cell({x, 0, z})] = 10 * soil_.ponding()[std::size_t(z) * layer.size().x + x];
            }
        }
        return shown_values_;
    }

    /// The tenth parameter of a query is answered the pressure head around it, cm; three more its gradient, cm/cm.
    void answer_heads(Queries queries, std::span<Answer> answers) const {
        for (std::size_t q = 0; q < queries.size(); ++q) {
            if (answers[q].size() < 10) continue;
            const WaterSample sample = sample_water(grid_, layout_.faces(), soil_.heads(), queries[q].pose.position);
            const glm::dvec3 gradient = 0.01 * sample.gradient;
            const double all[] = {sample.content, gradient.x, gradient.y, gradient.z};
            std::copy_n(all, std::min<std::size_t>(4, answers[q].size() - 9), answers[q].begin() + 9);
        }
    }

    SoilParameters parameters_;
    WaterGrid grid_;
    WaterSolids solids_;
    SoilLayout layout_;
    Richards soil_;
    std::string name_;
    std::vector<Diagnostic>* warnings_;  ///< null as soon as there was one
    SoilQueries queries_;
    std::vector<SoilSink*> sinks_;
    std::vector<SoilFollower*> followers_;
    std::vector<WaterField> shown_;
    WaterBrick shown_values_;  ///< of the field that is being made
};

}  // namespace

std::unique_ptr<EnvironmentProcess> make_richards_soil(Settings& settings, const EnvironmentContext& context,
                                                       Fields& fields, bool is_still) {
    return std::make_unique<RichardsSoil>(settings, context, fields, is_still);
}

}  // namespace espalier::environment
