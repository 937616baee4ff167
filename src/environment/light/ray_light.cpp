// ray-light: photons of sun, sky and lamps that each drawn leaf and stem absorbs, by rays from these to the light, and
// paths of light through the drawn plants. Chelle & Andrieu 1998, The nested radiosity model for the distribution of
// light within plant canopies, for the question; Veach 1997, Robust Monte Carlo methods for light transport simulation,
// for the method.
#include "espalier/environment/environment_process.h"

#include "base/text.h"
#include "environment/light/optics/organ_light.h"
#include "environment/light/rays/light_paths.h"
#include "environment/light/rays/program_rays.h"
#include "environment/light/sky/daylight.h"
#include "geometry/grids/voxel_values.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace espalier::environment {
namespace {

constexpr double least_elevation = 0.0349;  // sine of 2 degrees
constexpr int trials = 8;
constexpr std::uint32_t most_paths = 1U << 27;
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double bytes_per_triangle = 420;  // corners twice, owner, order, open light, and Embree's boxes

LightPaths::Options read_path_options(const Settings& settings, const EnvironmentContext& context) {
    LightPaths::Options options;
    options.ground = settings.number_or("ground", 0);
    options.residual = settings.number_or("residual", 0.25, Range::between(1e-9, 0.5));
    options.from_organs = true;
    options.evenly = settings.choice_or("sampling", "sobol", {"sobol", "random"}) == "sobol";
    if (!settings.flag_or("periodic", false)) return options;
    if (!context.domain) {
        throw UserError(settings.place("periodic"),
                        "a periodic stand needs the scene's domain, whose sides are its period");
    }
    options.period = context.domain;
    return options;
}

std::optional<DaylightSeries> read_daylight(const Settings& settings, const std::shared_ptr<const Weather>& weather,
                                            const EnvironmentContext& context) {
    if (settings.has("lamps") && !settings.has("sky")) return std::nullopt;
    return DaylightSeries(settings.table("sky"), least_elevation, weather, context.warnings);
}

std::shared_ptr<const Weather> read_weather(const Settings& settings, const Fields& fields) {
    return settings.has("sky") ? Weather::named_by(settings.table("sky"), "weather", fields) : nullptr;
}

/// Level, along the axes, in square cells: such a sensor is a field.
bool is_field(const LightSensor& sensor) {
    const double along_x = sensor.size[0] / static_cast<double>(sensor.cells[0]),
                 along_z = sensor.size[1] / static_cast<double>(sensor.cells[1]);
    return sensor.count() > 1 && sensor.normal.y == 1 && sensor.x.x == 1 &&
           std::abs(along_x - along_z) < 1e-9 * along_x;
}

class RayLight final : public EnvironmentProcess {
public:
    RayLight(Settings& settings, const EnvironmentContext& context, Fields& fields)
        : name_(context.name),
          seed_(context.seed),
          memory_(context.memory),
          weather_(read_weather(settings, fields)),
          sky_(read_daylight(settings, weather_, context)),
          optics_(settings),
          organs_(settings, optics_.bands(), context.plants),
          lamps_(read_lamps(settings, optics_.bands(), context.warnings)),
          paths_(optics_, read_sensors(settings), read_path_options(settings, context)),
          ground_(settings.number_or("ground", 0)),
          days_(read_days(settings, weather_.get())),
          count_(static_cast<std::uint32_t>(settings.integer_or("paths", 1 << 16, Range::between(64, most_paths)))),
          accuracy_(settings.number_or("accuracy", 0, Range::between(0, 1))),
          paths_place_(settings.place("paths")),
          warnings_(context.warnings),
          plants_(context.plants) {
        read_solids(settings);
        if (!lamps_.empty()) read_reference(settings);
        provide_fields(fields);
    }

    void advance(const WorldView& world, Queries, Fields&) override {
        light_ = sky_ ? sky_->of_step(world.step, world.dt * days_) : Daylight();
        const double lamp_seconds = 3600 * lit_hours_ * world.dt * days_;
        if (!lamps_.empty()) light_.seconds = std::max(light_.seconds, lamp_seconds);
        if (!sky_) light_.on_ground = 1e-6 * on_reference_ * lamp_seconds;
        organs_.begin(world, light_);
        collect(world);
        require_memory();
        std::vector<double> factors;
        for (std::size_t b = 0; b < optics_.bands().size(); ++b) factors.push_back(organs_.factor(b));
        paths_.set(triangles_, organs_.slots(), light_, lamps_, lamp_seconds, factors);
        const auto seed = static_cast<std::uint32_t>(mix(seed_, static_cast<std::uint64_t>(world.step)));
        traced_ = count_;
        trace(traced_, seed);
        while (accuracy_ > 0 && worst_error() > accuracy_ && traced_ <= most_paths / 4) {
            traced_ *= 4;
            trace(traced_, seed);
        }
        warn_of_accuracy(world.step);
    }

    void answer(const WorldView& world, Queries queries, std::span<Answer> answers, Fields&) override {
        warn_of_unmet(queries, world.step);
        for (std::size_t i = 0; i < queries.size(); ++i) {
            organs_.answer(queries[i], 1, answers[i],
                           [&](std::size_t band) { return open_share(queries[i].pose.position, band); });
        }
    }

    std::vector<Quantity> statistics(std::uint32_t plant) const override {
        std::vector<double> errors;
        for (std::size_t b = 0; b < bands() && plant < plants_; ++b) errors.push_back(estimate(plant, b).error);
        std::vector<Quantity> quantities = organs_.statistics(plant, true, errors);
        for (std::size_t b = 0; b < bands(); ++b) {
            const std::string name = b == 0 ? "" : "." + optics_.bands()[b].name;
            const Balance balance = b < balances_.size() ? balances_[b] : Balance();
            quantities.push_back({"soil" + name, balance.soil});
            quantities.push_back({"escaped" + name, balance.escaped});
            if (!solids_.empty()) quantities.push_back({"solids" + name, balance.solids});
            quantities.push_back({"closure" + name, balance.closure});
        }
        for (std::size_t k = 0; k < paths_.sensors().size(); ++k) {
            for (std::size_t b = 0; b < bands(); ++b) {
                const std::string name = b == 0 ? "" : "." + optics_.bands()[b].name;
                quantities.push_back({"sensor." + paths_.sensors()[k].name + name, organs_.amount(sensor_mean(k, b), b),
                                      organs_.unit() + "/m2"});
            }
        }
        return quantities;
    }

    std::vector<OrganQuantity> organ_quantities() const override { return organs_.organ_quantities(true); }
    std::shared_ptr<const std::vector<float>> organ_values(const std::string& name,
                                                           std::uint32_t plant) const override {
        return organs_.organ_values(name, plant);
    }

    std::pair<int, int> query_arity() const override { return {1, 24}; }
    Spreading spreading() const override { return Spreading::plants; }

    ProcessMemory memory() const override {
        return {static_cast<std::size_t>(bytes_per_triangle * static_cast<double>(triangles_.size())), true};
    }
    void limit_memory(std::size_t bytes) override { memory_ = bytes; }

private:
    struct Estimate {
        double mean = 0, error = 0;  ///< mol of PAR before the band's factor; its standard error, NaN if unknown
    };
    struct Balance {
        double soil = 0, escaped = 0, solids = 0, closure = 0;  ///< shares of a band's light
    };

    std::size_t bands() const { return optics_.bands().size(); }

    void read_solids(const Settings& settings) {
        solid_voxel_ = settings.number_or("solid_voxel", 0.05, Range::positive());
        for (Settings table : settings.tables("solids")) {
            solids_.push_back(read_shape(table));
            if (solids_.back()->bounds()) continue;
            throw UserError(table.place(), "a solid that light meets must have bounds: a half-space has none");
        }
    }

    void read_reference(const Settings& settings) {
        lit_hours_ = settings.number_or("lit_hours", 24, Range{0, 24, true});
        const glm::dvec3 reference = settings.vector_or("reference", {0, 0, 0});
        for (const Lamp& lamp : lamps_) on_reference_ += lamp.photons[0] * lamp.on_level_ground(reference);
        if (sky_ || on_reference_ > 0) return;
        throw UserError(settings.place("reference"),
                        fmt::format("no lamp sends {} to the place 'reference', with whose light organs are compared",
                                    optics_.bands().front().name));
    }

    void provide_fields(Fields& fields) {
        for (std::size_t k = 0; k < paths_.sensors().size(); ++k) {
            if (!is_field(paths_.sensors()[k])) continue;
            fields.provide({name_ + "." + paths_.sensors()[k].name, organs_.unit() + "/m2",
                            "light that falls on the sensor in a step", nullptr, true,
                            [this, k] { return grid_of(k); }});
        }
    }

    void collect(const WorldView& world) {
        triangles_.clear();
        std::vector<const PlantView*> views(plants_, nullptr);
        for (const PlantView& plant : world.plants) {
            if (plant.plant < plants_) views[plant.plant] = &plant;
        }
        static const PlantGeometry nothing;
        for (std::uint32_t plant = 0; plant < plants_; ++plant) {
            const PlantGeometry& geometry = views[plant] ? views[plant]->drawn() : nothing;
            triangles_.add(geometry, static_cast<std::uint32_t>(organs_.start(plant)), plant, optics_);
        }
        for (const auto& solid : solids_) triangles_.add(*solid, solid_voxel_);
    }

    void require_memory() const {
        if (bytes_per_triangle * static_cast<double>(triangles_.size()) <= static_cast<double>(memory_)) return;
        throw RunError(fmt::format("'{}' has {} triangles to light, which take {} GB: draw fewer or give more memory",
                                   name_, triangles_.size(),
                                   format_general(bytes_per_triangle * static_cast<double>(triangles_.size()) / 1e9)));
    }

    void trace(std::uint32_t count, std::uint32_t seed) {
        for (std::size_t slot = 0; slot < organs_.slots(); ++slot) {
            organs_.view(slot) = {};
            organs_.leaf_area(slot) = 0;
            organs_.body_area(slot) = 0;
            for (std::size_t b = 0; b < bands(); ++b) organs_.meeting(slot, b) = {};
        }
        by_plant_.assign(plants_ * bands() * trials, 0);
        balances_.assign(bands(), {});
        sensor_sums_.assign(sensor_cells() * bands(), 0);
        for (std::uint32_t trial = 0; trial < trials; ++trial) {
            paths_.trace(std::max(1U, count / trials), static_cast<std::uint32_t>(mix(seed, trial)));
            paths_.trace_from_organs(trial, seed);
            add_trial(trial);
            add_balance();
            add_sensors();
        }
        finish();
    }

    void add_trial(std::uint32_t trial) {
        const double light = paths_.light();
        for (std::size_t plant = 0; plant < plants_; ++plant) {
            for (std::size_t slot = organs_.start(plant); slot < organs_.start(plant + 1); ++slot) {
                for (std::size_t b = 0; b < bands(); ++b) {
                    OrganLight::Meeting& meeting = organs_.meeting(slot, b);
                    const double absorbed = light * paths_.absorbed(slot, b);
                    meeting.front += light * paths_.front(slot, b) / trials;
                    meeting.back += light * paths_.back(slot, b) / trials;
                    meeting.absorbed += absorbed / trials;
                    meeting.error += absorbed * absorbed / trials;
                    by_plant_[(plant * bands() + b) * trials + trial] += absorbed;
                }
                organs_.view(slot).sun += light * paths_.sun(slot) / trials;
                organs_.view(slot).towards += light * paths_.towards(slot) / double(trials);
            }
        }
    }

    void add_balance() {
        for (std::size_t b = 0; b < bands(); ++b) {
            const double brought = paths_.brought(b);
            if (!(brought > 0)) continue;
            double organs = 0;
            for (std::size_t slot = 0; slot < organs_.slots(); ++slot) organs += paths_.absorbed(slot, b);
            Balance& balance = balances_[b];
            balance.soil += paths_.absorbed_by_soil(b) / brought / trials;
            balance.escaped += paths_.escaped(b) / brought / trials;
            balance.solids += paths_.absorbed_by_solids(b) / brought / trials;
            const double all = organs + paths_.absorbed_by_soil(b) + paths_.escaped(b) + paths_.absorbed_by_solids(b);
            balance.closure += (all / brought - 1) / trials;
        }
    }

    std::size_t sensor_cells() const {
        std::size_t cells = 0;
        for (const LightSensor& sensor : paths_.sensors()) cells += sensor.count();
        return cells;
    }

    void add_sensors() {
        std::size_t at = 0;
        for (std::size_t k = 0; k < paths_.sensors().size(); ++k) {
            const LightSensor& sensor = paths_.sensors()[k];
            for (std::size_t cell = 0; cell < sensor.count(); ++cell) {
                for (std::size_t b = 0; b < bands(); ++b) {
                    sensor_sums_[at++] += paths_.light() * paths_.passed(k, cell, b) / sensor.cell_area() / trials;
                }
            }
        }
    }

    /// Light per m2 of the whole sensor.
    double sensor_mean(std::size_t number, std::size_t band) const {
        const std::size_t count = paths_.sensors()[number].count(), first = first_sensor_cell(number);
        double sum = 0;
        for (std::size_t cell = 0; cell < count && !sensor_sums_.empty(); ++cell) {
            sum += sensor_sums_[(first + cell) * bands() + band];
        }
        return sum / static_cast<double>(count);
    }

    std::size_t first_sensor_cell(std::size_t number) const {
        std::size_t first = 0;
        for (std::size_t k = 0; k < number; ++k) first += paths_.sensors()[k].count();
        return first;
    }

    bool is_met(std::size_t slot) {
        for (std::size_t b = 0; b < bands(); ++b) {
            const OrganLight::Meeting& meeting = organs_.meeting(slot, b);
            if (meeting.front + meeting.back > 0) return true;
        }
        return false;
    }

    /// Standard errors of organs, their areas, and what the sun would bring them without shade.
    void finish() {
        const bool is_dark = !(paths_.light() > 0);
        looks_.assign(organs_.slots(), 0);
        unseen_.assign(organs_.slots(), 0);
        for (const LightPaths::Looks& looks : paths_.looks()) {
            looks_[looks.slot] = looks.count;
            unseen_[looks.slot] = looks.unseen;
        }
        plants_met_.assign(plants_, false);
        surfaces_.assign(organs_.slots(), 0);
        for (std::size_t plant = 0; plant < plants_; ++plant) {
            for (std::size_t slot = organs_.start(plant); slot < organs_.start(plant + 1); ++slot) {
                const bool met = is_met(slot);
                plants_met_[plant] = plants_met_[plant] || met;
                for (std::size_t b = 0; b < bands(); ++b) {
                    OrganLight::Meeting& meeting = organs_.meeting(slot, b);
                    const double variance = std::max(0.0, meeting.error - meeting.absorbed * meeting.absorbed);
                    const double unseen = unseen_[slot] * unseen_[slot];
                    meeting.error = met || is_dark ? std::sqrt(variance / (trials - 1) + unseen) : unknown;
                }
            }
        }
        triangles_.visit_areas([&](const LitTriangles::Owner& owner, const glm::dvec3& area) {
            if (owner.kind == LitKind::solid) return;
            const double seen = owner.kind == LitKind::leaf ? 1 : 0.5;  // of a closed thing, the other half is behind
            surfaces_[owner.slot] += seen * glm::length(area);
            if (owner.kind == LitKind::leaf) organs_.leaf_area(owner.slot) += glm::length(area);
            if (owner.kind == LitKind::body) organs_.body_area(owner.slot) += seen * glm::length(area);
            for (const LightBeam& beam : light_.beams) {
                if (!beam.is_sun) continue;
                organs_.view(owner.slot).open_sun += seen * beam.photons * std::abs(glm::dot(area, beam.towards));
            }
        });
    }

    Estimate estimate(std::size_t plant, std::size_t band) const {
        if (by_plant_.empty()) return {};
        const double* const sums = &by_plant_[(plant * bands() + band) * trials];
        Estimate found;
        if (is_unknown(plant)) return {0, unknown};
        for (int i = 0; i < trials; ++i) found.mean += sums[i] / trials;
        double squares = 0;
        for (int i = 0; i < trials; ++i) squares += (sums[i] - found.mean) * (sums[i] - found.mean);
        squares /= trials * (trials - 1);
        for (std::size_t slot = organs_.start(plant); slot < organs_.start(plant + 1); ++slot) {
            squares += unseen_[slot] * unseen_[slot];
        }
        found.error = std::sqrt(squares);
        return found;
    }

    double surface_of(std::size_t plant) const {
        const auto first = surfaces_.begin();
        return std::accumulate(first + static_cast<std::ptrdiff_t>(organs_.start(plant)),
                               first + static_cast<std::ptrdiff_t>(organs_.start(plant + 1)), 0.0);
    }

    /// Whether a plant is drawn and there is light, but no path has met it.
    bool is_unknown(std::size_t plant) const {
        return !plants_met_[plant] && paths_.light() > 0 && surface_of(plant) > 0;
    }

    /// How often the organs of a plant have looked for the light.
    double looks_of(std::size_t plant) const {
        const auto first = looks_.begin();
        return std::accumulate(first + static_cast<std::ptrdiff_t>(organs_.start(plant)),
                               first + static_cast<std::ptrdiff_t>(organs_.start(plant + 1)), 0.0);
    }

    /// The largest relative standard error of a plant; infinite where one has found no light and not looked often. A
    /// plant that has stands in the dark.
    double worst_error() const {
        constexpr double often = 4096;
        double worst = 0;
        for (std::size_t plant = 0; plant < plants_; ++plant) {
            const Estimate found = estimate(plant, 0);
            if (found.mean > 0) worst = std::max(worst, found.error / found.mean);
            if (std::isnan(found.error) && looks_of(plant) < often) worst = std::numeric_limits<double>::infinity();
        }
        return worst;
    }

    void warn(const std::string& message) const {
        if (warnings_) warnings_->push_back({Diagnostic::Severity::warning, paths_place_, message});
    }

    void warn_of_accuracy(int step) {
        const double worst = accuracy_ > 0 && !warned_of_accuracy_ ? worst_error() : 0;
        if (worst <= accuracy_) return;
        warned_of_accuracy_ = true;
        warn(fmt::format(
            "in step {}, {} paths are not enough for '{}': the standard error of a plant is {} of its light, "
            "where accuracy = {:g} was asked for",
            step, traced_, name_, std::isinf(worst) ? "unknown" : fmt::format("{:.2g}", worst), accuracy_));
    }

    /// Of organs that are asked for, where they have looked too seldom to tell that they are in the dark.
    void warn_of_unmet(Queries queries, int step) {
        constexpr double enough = 100;
        if ((warned_of_unmet_ && warned_of_buried_) || !(paths_.light() > 0)) return;
        std::size_t count = 0, buried = 0;
        double most = 0;
        for (const Query& query : queries) {
            if (query.plant >= plants_) continue;
            const std::size_t slot = organs_.start(query.plant) + query.module + 1;
            if (slot >= organs_.start(query.plant + 1) || !(surfaces_[slot] > 0) || is_met(slot)) continue;
            if (query.pose.position.y < ground_) ++buried;
            if (query.pose.position.y < ground_ || looks_[slot] >= enough) continue;
            ++count;
            most = std::max(most, looks_[slot]);
        }
        warn_of_buried(buried, step);
        if (count == 0 || warned_of_unmet_) return;
        warned_of_unmet_ = true;
        warn(fmt::format(
            "in step {}, neither a path of '{}' nor a ray to its sources has found light on {} of the organs that are "
            "asked "
            "for: their light is answered as 0, but is unknown. They have looked {:.2g} times at most: give more "
            "'paths', or an 'accuracy'",
            step, name_, count, most));
    }

    void warn_of_buried(std::size_t count, int step) {
        if (count == 0 || warned_of_buried_) return;
        warned_of_buried_ = true;
        warn(
            fmt::format("in step {}, {} of the organs that '{}' is asked for begin below the ground, which is at y = "
                        "{:g} m, and get no light: lower 'ground', or raise the plant",
                        step, count, name_, ground_));
    }

    double open_share(const glm::dvec3& place, std::size_t band) const {
        const SideOptics& leaf = optics_.of(LitKind::leaf, 0, band).front;
        const double absorbed = 1 - leaf.reflectance - leaf.transmittance;
        return light_.on_ground > 0 ? absorbed * paths_.open_light(place) / light_.on_ground : 0;
    }

    std::shared_ptr<const FieldGrid> grid_of(std::size_t number) const {
        const LightSensor& sensor = paths_.sensors()[number];
        const double edge = sensor.size[0] / static_cast<double>(sensor.cells[0]);
        const glm::dvec3 corner = sensor.middle - glm::dvec3(sensor.size[0], edge, sensor.size[1]) / 2.0;
        VoxelValues values(edge, corner);
        const auto columns = static_cast<int>(sensor.cells[0]), rows = static_cast<int>(sensor.cells[1]);
        values.show({0, 0, 0}, {columns - 1, 0, rows - 1});
        const std::size_t first = first_sensor_cell(number);
        for (std::size_t cell = 0; cell < sensor.count() && !sensor_sums_.empty(); ++cell) {
            const double light = organs_.amount(sensor_sums_[(first + cell) * bands()], 0);
            const auto column = static_cast<int>(cell % sensor.cells[0]),
                       row = static_cast<int>(cell / sensor.cells[0]);
            values.set({column, 0, row}, static_cast<float>(light));
        }
        return values.grid();
    }

    std::string name_;
    std::uint64_t seed_;
    std::size_t memory_;
    std::shared_ptr<const Weather> weather_;  ///< that the sky names; null: none
    std::optional<DaylightSeries> sky_;
    Optics optics_;
    OrganLight organs_;
    std::vector<Lamp> lamps_;
    LightPaths paths_;
    double ground_, days_;
    std::uint32_t count_;
    double accuracy_;
    Place paths_place_;
    std::vector<Diagnostic>* warnings_;
    bool warned_of_accuracy_ = false, warned_of_unmet_ = false, warned_of_buried_ = false;
    std::size_t plants_;
    std::vector<std::shared_ptr<const Shape>> solids_;
    double solid_voxel_ = 0.05, lit_hours_ = 24;
    double on_reference_ = 0;  ///< umol m-2 s-1 of lamps

    Daylight light_;  ///< all that follows is of this step
    std::uint32_t traced_ = 0;
    std::vector<bool> plants_met_;
    std::vector<double> surfaces_;        ///< m2 of each module's leaves, and half that of closed things
    std::vector<double> looks_, unseen_;  ///< by module: `LightPaths::Looks`
    LitTriangles triangles_;
    std::vector<double> by_plant_;     ///< mol, by plant, band and trial
    std::vector<double> sensor_sums_;  ///< mol/m2, by cell and band
    std::vector<Balance> balances_;
};

const std::string& ray_light_help() {
    static const std::string text =
        std::string(
            R"(Paths of light begin at sun, sky and lamps, and end at the leaves, stems, spheres, solids and the soil that absorb them, as
the plants of the step are drawn. What is not absorbed is scattered as Lambert's law says, by leaves to both sides.

?name(f)        -> f: light that the leaves of the module that follows in the string absorb per area, over what falls
                   on open level ground. If it draws no leaf but a sphere, light of this per half of its surface; if
                   neither, what a small leaf of any direction in its place would absorb of sun and sky, scattered
                   light apart
?name(f, m)     -> m: mol of photons that leaves and stems of this module absorb in the step
?name(f, m, e)  -> e: umol m-2 s-1 that the leaves absorb while there is light
Three more parameters for each further band tell the same of it.

paths         65536: paths of light in each step, 8 independent trials, whose spread gives the standard error. Each organ looks
              for sun, sky and lamps by rays of its own, 4 for each path in all; where there are too many organs for
              that, they are drawn as the light sees them. Where no light is found on an organ, it is answered as 0, and
              its error is unknown: an empty cell
accuracy      0: the standard error that each plant's sum may have, as a share of it; paths and rays grow until it is reached,
              and for a plant on which no light is found until it has looked 4096 times
sampling      "sobol", even; or "random", plain Monte Carlo, for comparisons
residual      0.25: where less than this share of a path's light is left, chance decides at each meeting whether all of it is
              absorbed there or all of it goes on
days          1: days that a unit of time stands for
periodic      false; true repeats the scene's domain to all sides
ground        0 m: height of the soil
solids        [[solids]] tables of shapes with bounds; their surfaces are made with voxels of solid_voxel, 0.05 m
)") + OrganLight::help() +
        optics_help() + lamps_help() + sensors_help() +
        R"(sky           the table of the light, below

Of organs a timeline can record absorbed, flux, front, back, reflected, direct, error, each for every band, sunlit,
brightest. Statistics of a plant: leaf_area (m2, one side), absorbed (mol) with its standard error absorbed_error, also of
further bands as absorbed.BAND, mean (absorbed per leaf area over what falls on open level ground); of the world: incoming
(per m2 of it), for each band soil and escaped (shares of the light), closure (all shares, less 1: rounding).
Frame 0 is the beginning: its shares and rates are those of the first step's light, its amounts 0.

)" + program_rays_help() +
        "\n" + sky_help();
    return text;
}

std::unique_ptr<EnvironmentProcess> make(Settings& settings, const EnvironmentContext& context, Fields& fields) {
    if (settings.has("parameters")) return make_program_rays(settings, context);
    return std::make_unique<RayLight>(settings, context, fields);
}

const Registered<ProcessType> entry{
    {"ray-light", "photons that drawn leaves and stems absorb: paths of light, scattered", ray_light_help(), make}};

}  // namespace
}  // namespace espalier::environment
