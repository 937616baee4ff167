// canopy-light: photons of sun and sky that leaves meet, by Beer's law along exact paths through voxels of leaf area.
// Ross 1981, The radiation regime and architecture of plant stands; Sinoquet et al. 2001, RATP: a model for simulating
// the spatial distribution of radiation absorption, transpiration and photosynthesis within canopies.
#include "espalier/environment/environment_process.h"
#include "espalier/geometry/openvdb_grid.h"

#include "base/parallel.h"
#include "base/text.h"
#include "environment/canopy/leaves.h"
#include "environment/covering.h"
#include "environment/sky/daylight.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <openvdb/tools/Dense.h>

#include <algorithm>
#include <cmath>

namespace espalier::environment {
namespace {

// Flux, depth, sums, and what fields show.
constexpr double bytes_per_voxel = 8 + 8 + 4 + 8 + 4 + 2 * 5;

LeafAngles read_angles(const Settings& settings) {
    if (settings.has("leaf_ratio")) return LeafAngles(settings.number("leaf_ratio", Range::between(0.01, 100)));
    return LeafAngles(settings.choice_or("leaf_angles", "spherical", LeafAngles::names()));
}

/// What the leaves of one module have met in this step.
struct ModuleLight {
    double area = 0;     ///< m2
    double photons = 0;  ///< mol
};

class CanopyLight final : public EnvironmentProcess {
public:
    CanopyLight(Settings& settings, const EnvironmentContext& context, Fields& fields)
        : name_(context.name),
          memory_(context.memory),
          sky_(settings.table("sky"), least_rise),
          angles_(read_angles(settings)),
          edge_(settings.number_or("voxel", 0.2, Range::positive())),
          edge_place_(settings.place("voxel")),
          beams_(static_cast<int>(settings.integer_or("beams", 2, Range::between(1, 64)))),
          days_(settings.number_or("days", 1, Range::positive())),
          asks_area_(settings.choice_or("area", "drawn", {"drawn", "queries"}) == "queries"),
          modules_(context.plants) {
        if (settings.flag_or("periodic", false)) read_period(settings, context);
        fields.provide({name_, "mol/m2", "photons across all directions in a step", nullptr, true,
                        [this] { return grid_of(fluence_); }});
        fields.provide({name_ + ".leaf_area_density", "m2/m3", "leaf area per volume", nullptr, true,
                        [this] { return grid_of(leaves_.densities(voxels_)); }});
    }

    void advance(const WorldView& world, std::span<const Query> queries, Fields&) override {
        light_ = sky_.over(world.time * days_, world.dt * days_);
        collect(world, queries);
        lay_voxels(queries);
        leaves_.sort_into(voxels_);
        for (std::size_t plant = 0; plant < modules_.size(); ++plant) modules_[plant].clear();
        for (const PlantView& plant : world.plants) {
            if (plant.plant < modules_.size()) modules_[plant.plant].resize(plant.string->size());
        }
        shine();
    }

    void answer(const WorldView&, std::span<const Query> queries, std::span<Answer> answers, Fields&) override {
        for (std::size_t i = 0; i < queries.size(); ++i) {
            const Answer answer =
                asks_area_ ? answers[i].subspan(std::min<std::size_t>(1, answers[i].size())) : answers[i];
            if (answer.empty()) continue;
            const double per_area = photons_per_area(queries[i]);
            answer[0] = light_.on_ground > 0 ? per_area / light_.on_ground : 0;
            if (answer.size() > 1) answer[1] = met_by(queries[i]).photons;
            if (answer.size() > 2) answer[2] = light_.seconds > 0 ? 1e6 * per_area / light_.seconds : 0;
        }
    }

    std::vector<Quantity> statistics(std::uint32_t plant) const override {
        ModuleLight sum;
        if (plant < modules_.size()) {
            for (const ModuleLight& module : modules_[plant]) {
                sum.area += module.area;
                sum.photons += module.photons;
            }
        }
        const double open = light_.on_ground * sum.area;
        return {{"absorbed", sum.photons, "mol"},
                {"leaf_area", sum.area, "m2"},
                {"mean", open > 0 ? sum.photons / open : std::nan("")},
                {"incoming", light_.on_ground, "mol/m2"},
                {"passed", passed_},
                {"closure", closure_}};
    }

    std::pair<int, int> query_arity() const override { return {1, 20}; }

    ProcessMemory memory() const override {
        return {static_cast<std::size_t>(bytes_per_voxel * static_cast<double>(voxels_.count())), true};
    }
    void limit_memory(std::size_t bytes) override { memory_ = bytes; }

private:
    void read_period(const Settings& settings, const EnvironmentContext& context) {
        if (!context.domain) {
            throw UserError(settings.place("periodic"),
                            "a periodic canopy needs the scene's domain, whose sides are its period");
        }
        period_ = *context.domain;
        for (const int axis : {0, 2}) {
            const double voxels = (period_->upper[axis] - period_->lower[axis]) / edge_;
            if (std::abs(voxels - std::round(voxels)) < 1e-6 * voxels) continue;
            throw UserError(settings.place("voxel"),
                            fmt::format("a whole number of voxels must make up the period of {:g} m: voxel = {:g}",
                                        voxels * edge_, voxels * edge_ / std::max(1.0, std::round(voxels))));
        }
    }

    void collect(const WorldView& world, std::span<const Query> queries) {
        leaves_.clear();
        if (!asks_area_) {
            for (const PlantView& plant : world.plants) {
                leaves_.add(plant.plant, plant.interpretation->geometry, edge_);
            }
            return;
        }
        for (const Query& query : queries) {
            const double area = query.parameters.empty() ? 0 : query.parameters[0];
            if (!(area >= 0 && std::isfinite(area))) {
                throw RunError(fmt::format("plant {} gives '{}' a leaf area of {} m2: it must be a number from 0 on",
                                           query.plant, name_, format_general(area)));
            }
            leaves_.add(query.plant, query.module, query.pose.position, area);
        }
    }

    /// Voxels over all leaves and all places that are asked for; those at the origin begin there.
    void lay_voxels(std::span<const Query> queries) {
        Box box = leaves_.bounds();
        for (const Query& query : queries) box.add(query.pose.position);
        if (box.empty()) box.add(glm::dvec3(0));
        if (period_) {
            for (const int axis : {0, 2}) {
                box.lower[axis] = period_->lower[axis];
                box.upper[axis] = period_->upper[axis];
            }
        }
        glm::dvec3 first = glm::floor(box.lower / edge_), size = glm::floor(box.upper / edge_) + 1.0 - first;
        if (period_) {
            for (const int axis : {0, 2}) {
                first[axis] = box.lower[axis] / edge_;
                size[axis] = std::round((box.upper[axis] - box.lower[axis]) / edge_);
            }
        }
        require_memory(size);
        voxels_ = {first * edge_, glm::ivec3(size), edge_, period_.has_value()};
    }

    void require_memory(const glm::dvec3& size) const {
        const double voxels = size.x * size.y * size.z, bytes = voxels * bytes_per_voxel;
        if (voxels < 2e9 && bytes <= static_cast<double>(memory_)) return;
        throw RunError(fmt::format("{}: '{}' would have {} voxels and take {} GB: use larger voxels or more memory",
                                   to_string(edge_place_), name_, format_general(voxels), format_general(bytes / 1e9)));
    }

    void shine() {
        const std::span<const LeafPiece> pieces = leaves_.pieces();
        std::vector<double> met(pieces.size(), 0.0);
        fluence_.assign(voxels_.count(), 0.0f);
        isotropic_.assign(voxels_.count(), 0.0f);
        double lost = 0, passed = 0, sent = 0;
        for (const LightBeam& beam : light_.beams) {
            if (beam.photons <= 0) continue;
            const double projection = angles_.projection(beam.towards.y);
            const BeamLight light =
                send_beams(voxels_, leaves_.depths(voxels_, beam.towards, angles_), beam.towards, beams_);
            for_in_parallel(std::size_t{0}, pieces.size(), [&](std::size_t i) {
                met[i] += beam.photons * light.flux[pieces[i].voxel] * seen_area(pieces[i], beam.towards, projection);
            });
            for (std::size_t v = 0; v < fluence_.size(); ++v) {
                fluence_[v] += static_cast<float>(beam.photons * light.flux[v]);
                isotropic_[v] += static_cast<float>(beam.photons * light.flux[v] * projection);
            }
            lost += beam.photons * light.met;
            passed += beam.photons * beam.towards.y * light.passed;
            sent += beam.photons * beam.towards.y;
        }
        passed_ = sent > 0 ? passed / sent : std::nan("");
        add_up(met, lost);
    }

    void add_up(const std::vector<double>& met, double lost) {
        const std::span<const LeafPiece> pieces = leaves_.pieces();
        double sum = 0;
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            sum += met[i];
            if (pieces[i].plant >= modules_.size()) continue;
            ModuleLight& module = modules_[pieces[i].plant][pieces[i].module];
            module.area += area_of(pieces[i]);
            module.photons += met[i];
        }
        closure_ = lost > 0 ? sum / lost - 1 : 0;
    }

    /// Returns the light met by the leaves of the module that follows the query, or by its own area.
    ModuleLight met_by(const Query& query) const {
        if (query.plant >= modules_.size()) return {};
        const std::size_t module = query.module + (asks_area_ ? 0 : 1);
        return module < modules_[query.plant].size() ? modules_[query.plant][module] : ModuleLight();
    }

    /// mol per m2 of leaf; where there is none, what a small leaf of the distribution would meet.
    double photons_per_area(const Query& query) const {
        const ModuleLight met = met_by(query);
        return met.area > 0 ? met.photons / met.area : isotropic_[voxels_.number_of(query.pose.position)];
    }

    std::shared_ptr<const FieldGrid> grid_of(const std::vector<float>& values) const {
        initialize_openvdb();
        auto field = std::make_shared<FieldGrid>();
        field->grid = openvdb::FloatGrid::create(0);
        field->grid->setTransform(cell_centred_transform(edge_, voxels_.corner));
        if (values.empty()) return field;
        field->box = {openvdb::Coord(0), openvdb::Coord(voxels_.size.x - 1, voxels_.size.y - 1, voxels_.size.z - 1)};
        const openvdb::tools::Dense<const float, openvdb::tools::LayoutXYZ> dense(field->box, values.data());
        openvdb::tools::copyFromDense(dense, *field->grid, 0.0f);
        return field;
    }

    std::string name_;
    std::size_t memory_;
    DaylightSeries sky_;
    LeafAngles angles_;
    double edge_;
    Place edge_place_;
    int beams_;
    double days_;
    bool asks_area_;
    std::optional<Box> period_;

    Daylight light_;  ///< all that follows is of this step
    CanopyLeaves leaves_;
    CanopyVoxels voxels_;
    std::vector<float> fluence_;                     ///< mol/m2 across all directions
    std::vector<float> isotropic_;                   ///< mol/m2 that a leaf of the distribution would meet
    std::vector<std::vector<ModuleLight>> modules_;  ///< by plant and place in its string
    double passed_ = 1, closure_ = 0;
};

const std::string& canopy_light_help() {
    static const std::string text =
        std::string(
            R"(Leaves fill voxels evenly and at random. Light of each direction passes the voxels along its exact path, and of it
exp(-projected leaf area per area across the path) is left (Beer's law); the leaves of a voxel share what it loses by
the area that each turns to the light. Leaves absorb all light that they meet: nothing is scattered or reflected, and
stems and solids cast no shadow. docs/light.md says when that is right.

?name(f)        -> f: photons per area of the leaves of the module that follows in the string, over those on open level
                   ground. If it draws no leaf, what a small leaf of `leaf_angles` in its place would meet
?name(f, m)     -> m: mol of photons that these leaves absorb in the step
?name(f, m, e)  -> e: umol m-2 s-1 that they absorb while there is light
?name(a, ...)      with area = "queries": a is the leaf area (m2) of the query itself, and f, m, e come after it
Further parameters (at most 20 in all) keep their values.

voxel         0.2 m; edge of a voxel
beams         2: beams from each voxel's width of the top
days          1: days that a unit of time stands for
area          "drawn": leaves are the polygons, patches, surfaces and discs that plants have drawn; or "queries"
leaf_angles   "spherical": how leaves that are not drawn are inclined; or "planophile", "erectophile", "plagiophile",
              "extremophile", "uniform" (de Wit 1965), "horizontal", "vertical"
leaf_ratio    ellipsoidal angles instead: horizontal over vertical axis of the spheroid (Campbell 1986)
periodic      false; true repeats the scene's domain to all sides
sky           the table of the light, below

Fields: name, photons across all directions (mol/m2); name.leaf_area_density (m2/m3).
Statistics of a plant: absorbed (mol), leaf_area (m2), mean (absorbed per area over that on open level ground);
of the world: incoming (mol/m2 on open level ground), passed (share of the light over the voxels that no leaf meets),
closure (what leaves absorb over what beams lose, less 1).

)") + sky_help();
    return text;
}

const Registered<ProcessType> entry{{"canopy-light",
                                     "photons that leaves absorb: sun and sky through voxels of leaf area",
                                     canopy_light_help(), construct<CanopyLight>}};

}  // namespace
}  // namespace espalier::environment
