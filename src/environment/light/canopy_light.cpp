// canopy-light: photons of sun and sky that leaves absorb, by Beer's law along exact paths through voxels of leaf area.
// Ross 1981, The radiation regime and architecture of plant stands; Sinoquet et al. 2001, RATP: a model for simulating
// the spatial distribution of radiation absorption, transpiration and photosynthesis within canopies.
#include "espalier/environment/environment_process.h"
#include "espalier/environment/shape.h"

#include "base/parallel.h"
#include "base/text.h"
#include "environment/light/canopy/canopy_space.h"
#include "environment/light/canopy/scattering.h"
#include "environment/light/optics/organ_light.h"
#include "geometry/grids/voxel_values.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace espalier::environment {
namespace {

// Fluxes of two beams and of all, depths and what is added, the numbers of filled voxels, and what fields show.
constexpr double bytes_per_voxel = 2 * 8 + 6 * 4 + 4 * 8 + 3 * 8 + 2 * 5;
// Itself and its copy while they are sorted; what its two sides meet and send, its area, and the sun.
constexpr double bytes_per_piece = 2 * sizeof(LeafPiece) + 6 * 8 + sizeof(OrientedArea) + 5 * 8;

LeafAngles read_angles(const Settings& settings) {
    if (settings.has("leaf_ratio")) return LeafAngles(settings.number("leaf_ratio", Range::between(0.01, 100)));
    return LeafAngles(settings.choice_or("leaf_angles", "spherical", LeafAngles::names()));
}

CanopyScattering::Options read_options(const Settings& settings) {
    CanopyScattering::Options options;
    options.clumping = settings.number_or("clumping", 1, Range{0, 1, true});
    options.beams = static_cast<int>(settings.integer_or("beams", 2, Range::between(1, 64)));
    const Settings table = settings.table("scattering");
    options.rings = table.integer_or("rings", 3, Range::between(1, 32));
    options.around = table.integer_or("around", 6, Range::between(3, 360));
    options.residual = table.number_or("residual", 0.01, Range::between(1e-9, 0.5));
    return options;
}

class CanopyLight final : public EnvironmentProcess {
public:
    CanopyLight(Settings& settings, const EnvironmentContext& context, Fields& fields)
        : name_(context.name),
          memory_(context.memory),
          weather_(Weather::named_by(settings.table("sky"), "weather", fields)),
          sky_(settings.table("sky"), least_rise, weather_, context.warnings),
          optics_(settings),
          organs_(settings, optics_.bands(), context.plants),
          angles_(read_angles(settings)),
          options_(read_options(settings)),
          space_(settings, context.domain, 0.2),
          days_(read_days(settings, weather_.get())),
          stems_(settings.flag_or("stems", true)),
          asks_area_(settings.choice_or("area", "drawn", {"drawn", "queries"}) == "queries"),
          plants_(context.plants) {
        for (Settings table : settings.tables("solids")) solids_.push_back(read_shape(table));
        fields.provide({name_, "mol/m2", "photons across all directions in a step", nullptr, true, [this] {
                            return grid_of(organs_.has_time_passed() ? first_band().fluence : std::vector<float>());
                        }});
        fields.provide({name_ + ".leaf_area_density", "m2/m3", "leaf area per volume", nullptr, true,
                        [this] { return grid_of(leaves_.densities(voxels_)); }});
    }

    void advance(const WorldView& world, Queries queries, Fields&) override {
        light_ = sky_.of_step(world.step, world.dt * days_);
        organs_.begin(world, light_);
        collect(world, queries);
        lay_voxels(queries);
        leaves_.sort_into(voxels_);
        mark_solids();
        shine();
    }

    void answer(const WorldView&, Queries queries, std::span<Answer> answers, Fields&) override {
        const std::size_t skipped = asks_area_ ? 1 : 0;
        for (std::size_t i = 0; i < queries.size(); ++i) {
            const Answer answer = answers[i].subspan(std::min(skipped, answers[i].size()));
            organs_.answer(queries[i], 1 - skipped, answer,
                           [&](std::size_t band) { return open_share(queries[i], band); });
        }
    }

    std::vector<Quantity> statistics(std::uint32_t plant) const override {
        std::vector<Quantity> quantities = organs_.statistics(plant, false, {});
        quantities.push_back({"passed", passed_});
        for (std::size_t b = 0; b < bands_.size(); ++b) {
            const std::string of_band = b == 0 ? "" : "." + optics_.bands()[b].name;
            const CanopyBandLight& band = bands_[b];
            const auto share = [&](double light) { return band.entered > 0 ? light / band.entered : std::nan(""); };
            quantities.push_back({"soil" + of_band, share(band.ends.soil)});
            quantities.push_back({"escaped" + of_band, share(band.ends.escaped)});
            if (!solids_.empty()) quantities.push_back({"solids" + of_band, share(band.ends.solids)});
            quantities.push_back({"closure" + of_band, band.closure()});
        }
        return quantities;
    }

    std::vector<OrganQuantity> organ_quantities() const override { return organs_.organ_quantities(false); }
    std::shared_ptr<const std::vector<float>> organ_values(const std::string& name,
                                                           std::uint32_t plant) const override {
        return organs_.organ_values(name, plant);
    }

    std::pair<int, int> query_arity() const override { return {1, 25}; }
    Spreading spreading() const override { return Spreading::plants; }

    ProcessMemory memory() const override {
        return {static_cast<std::size_t>(
                    bytes_of(static_cast<double>(voxels_.count()), static_cast<double>(leaves_.pieces().size()))),
                true};
    }
    void limit_memory(std::size_t bytes) override { memory_ = bytes; }

private:
    void collect(const WorldView& world, Queries queries) {
        leaves_.clear();
        if (!asks_area_) {
            for (const PlantView& plant : world.plants) {
                leaves_.add(plant.plant, plant.drawn(), space_.edge(), optics_, stems_,
                            [&](const ForeseenPieces& all) { require_memory(space_.over(all.box), all.count); });
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

    /// Voxels over all leaves, places that are asked for and solids.
    void lay_voxels(Queries queries) {
        Box box = leaves_.bounds();
        for (const Query& query : queries) box.add(query.pose.position);
        for (const auto& solid : solids_) {
            if (const std::optional<Box> bounds = solid->bounds()) box.add(*bounds);
        }
        if (box.empty()) box.add(glm::dvec3(0));
        const CanopySpace::Extent extent = space_.over(box);
        require_memory(extent, static_cast<double>(leaves_.pieces().size()));
        voxels_ = space_.voxels(extent);
    }

    static double bytes_of(double voxels, double pieces) { return voxels * bytes_per_voxel + pieces * bytes_per_piece; }

    void require_memory(const CanopySpace::Extent& extent, double pieces) const {
        const double voxels = extent.count(), bytes = bytes_of(voxels, pieces);
        if (voxels < 2e9 && bytes <= static_cast<double>(memory_)) return;
        throw RunError(
            fmt::format("{}: '{}' would have {} voxels and {} pieces of leaves and stems, and take {} GB: "
                        "use larger voxels or more memory",
                        to_string(space_.edge_place()), name_, rounded(voxels), rounded(pieces), rounded(bytes / 1e9)));
    }

    static std::string rounded(double number) { return fmt::format("{:.3g}", number); }

    /// Voxels whose middles are in solids.
    void mark_solids() {
        is_solid_.clear();
        if (solids_.empty()) return;
        is_solid_.assign(voxels_.count(), 0);
        for_in_parallel(std::size_t{0}, is_solid_.size(), [&](std::size_t v) {
            const auto x = static_cast<std::size_t>(voxels_.size.x), y = static_cast<std::size_t>(voxels_.size.y);
            const glm::dvec3 cell(double(v % x), double(v / x % y), double(v / x / y));
            const glm::dvec3 middle = voxels_.corner + space_.edge() * (cell + 0.5);
            is_solid_[v] =
                std::any_of(solids_.begin(), solids_.end(), [&](const auto& solid) { return solid->inside(middle); });
        });
    }

    void shine() {
        const SortedPieces pieces = leaves_.pieces();
        const CanopyScattering scattering(voxels_, pieces, optics_, angles_, is_solid_, options_);
        bands_.assign(1, {});
        const CanopyFlux first = scattering.first(light_.beams);
        const double square = space_.edge() * space_.edge();
        const double down = square * std::accumulate(first.ground.begin(), first.ground.end(), 0.0);
        passed_ = first.entered > 0 ? (down + first.escaped) / first.entered : std::nan("");
        bands_.clear();
        for (std::size_t b = 0; b < optics_.bands().size(); ++b) {
            bands_.push_back(scattering.band(first, b));
            add_up(bands_.back().flux, b);
        }
        look(first);
    }

    /// Adds what pieces meet to their modules.
    void add_up(const CanopyFlux& flux, std::size_t band) {
        const std::span<const LeafPiece> pieces = leaves_.pieces().pieces;
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            if (pieces[i].plant >= plants_) continue;
            const std::size_t slot = organs_.start(pieces[i].plant) + pieces[i].module;
            const auto [front, back] = optics_.of(pieces[i].kind, pieces[i].material, band);
            OrganLight::Meeting& meeting = organs_.meeting(slot, band);
            meeting.front += flux.front[i];
            (pieces[i].kind == LitKind::leaf ? meeting.back : meeting.front) += flux.back[i];
            meeting.absorbed += flux.front[i] * (1 - front.reflectance - front.transmittance) +
                                flux.back[i] * (1 - back.reflectance - back.transmittance);
            if (band > 0) continue;
            if (pieces[i].kind == LitKind::leaf) organs_.leaf_area(slot) += area_of(pieces[i]);
            if (pieces[i].kind == LitKind::body) organs_.body_area(slot) += area_of(pieces[i]);
        }
    }

    /// Where the light comes from, and which of it from the sun.
    void look(const CanopyFlux& first) {
        const std::span<const LeafPiece> pieces = leaves_.pieces().pieces;
        for (std::size_t i = 0; i < pieces.size() && i < first.towards.size(); ++i) {
            if (pieces[i].plant >= plants_) continue;
            OrganLight::View& view = organs_.view(organs_.start(pieces[i].plant) + pieces[i].module);
            view.sun += first.sun[i];
            view.open_sun += first.open_sun[i];
            view.towards += first.towards[i];
        }
    }

    const CanopyFlux& first_band() const {
        static const CanopyFlux none;
        return bands_.empty() ? none : bands_.front().flux;
    }

    /// What a small leaf of the distribution would absorb there, over the light on open level ground.
    double open_share(const Query& query, std::size_t band) const {
        if (!(light_.on_ground > 0)) return 0;
        const SideOptics& leaf = optics_.of(LitKind::leaf, 0, band).front;
        const double met = bands_[band].flux.isotropic[voxels_.number_of(query.pose.position)];
        return met * (1 - leaf.reflectance - leaf.transmittance) / light_.on_ground;
    }

    std::shared_ptr<const FieldGrid> grid_of(const std::vector<float>& values) const {
        VoxelValues light(space_.edge(), voxels_.corner);
        if (!values.empty()) light.fill(voxels_.size, values);
        return light.grid();
    }

    std::string name_;
    std::size_t memory_;
    std::shared_ptr<const Weather> weather_;  ///< that the sky names; null: none
    DaylightSeries sky_;
    Optics optics_;
    OrganLight organs_;
    LeafAngles angles_;
    CanopyScattering::Options options_;
    CanopySpace space_;
    double days_;
    bool stems_, asks_area_;
    std::size_t plants_;
    std::vector<std::shared_ptr<const Shape>> solids_;

    Daylight light_;  ///< all that follows is of this step
    CanopyLeaves leaves_;
    CanopyVoxels voxels_;
    std::vector<char> is_solid_;
    std::vector<CanopyBandLight> bands_;
    double passed_ = 1;
};

const std::string& canopy_light_help() {
    static const std::string text =
        std::string(
            R"(Leaves, stems and spheres fill voxels evenly and at random. Light of each direction passes the voxels along its exact path, and
exp(-projected area per area across the path) of it is left (Beer's law); the leaves of a voxel share what it loses by
the area that each turns to the light. What they and the soil do not absorb is scattered as Lambert's law says, and
goes on in `scattering` directions, generation by generation. docs/light.md says when that is right.

?name(f)        -> f: light that the leaves of the module that follows in the string absorb per area, over what falls
                   on open level ground. If it draws no leaf but a sphere, light of this per half of its surface; if
                   neither, what a small leaf of `leaf_angles` in its place would
?name(f, m)     -> m: mol of photons that leaves and stems of this module absorb in the step
?name(f, m, e)  -> e: umol m-2 s-1 that the leaves absorb while there is light
?name(a, ...)      with area = "queries": a is the leaf area (m2) of the query itself, and f, m, e come after it
Three more parameters for each further band tell the same of it. Other parameters keep their values.

voxel         0.2 m, >= 1.5e-5; edge of a voxel
beams         2: beams from each voxel's width of the top
days          1: days that a unit of time stands for
area          "drawn": leaves are the polygons, patches, surfaces, discs and open cylinders that plants have drawn; or
              "queries"
stems         true: internodes and closed generalized cylinders take light too
leaf_angles   "spherical": how leaves that are not drawn are inclined; or "planophile", "erectophile", "plagiophile",
              "extremophile", "uniform" (de Wit 1965), "horizontal", "vertical"
leaf_ratio    ellipsoidal angles instead: horizontal over vertical axis of the spheroid (Campbell 1986)
clumping      1: leaves in clumps smaller than a voxel hide each other; light sees this share of their area (Nilson 1971)
periodic      false; true repeats the scene's domain to all sides
ground        0 m: height of the soil; leaves below it lower it
solids        [[solids]] tables of shapes, which absorb all light in voxels whose middle they hold
scattering    { rings = 3, around = 6, residual = 0.01 }: directions of scattered light, in each half of the sphere; the
              generations end where less than residual of the light is left, which is distributed like the last one
)") + OrganLight::help() +
        optics_help() +
        R"(sky           the table of the light, below

Fields: name, photons across all directions (mol/m2, first band); name.leaf_area_density (m2/m3).
Of organs a timeline can record absorbed, flux, front, back, reflected, direct, each for every band, sunlit, brightest.
Statistics of a plant: absorbed, of further bands absorbed.BAND, leaf_area (m2), mean (absorbed per area over what falls
on open level ground); of the world: incoming (per m2 of open level ground), passed (share of the light over the voxels
that meets nothing), for each band soil and escaped (shares of the light), closure (all shares, less 1).
Frame 0 is the beginning: its shares and rates are those of the first step's light, its amounts 0.

)" + sky_help();
    return text;
}

const Registered<ProcessType> entry{{"canopy-light",
                                     "photons that leaves absorb: sun and sky through voxels of leaf area",
                                     canopy_light_help(), construct<CanopyLight>}};

}  // namespace
}  // namespace espalier::environment
