// greene: vines that seek their way in the voxels near the surfaces of a solid, towards sun and sky.
// Greene 1989, Voxel space automata: modeling with stochastic growth processes in voxel space: segments are tried at
// random in allowed voxels, collisions rejected and the best trial taken; the light of a voxel is the share of the
// sun's path and of the sky that is seen from it, past the solid and through the leaves.
#include "espalier/base/math.h"
#include "espalier/environment/environment_process.h"
#include "espalier/environment/shape.h"

#include "base/bytes.h"
#include "base/parallel.h"
#include "environment/exchange/covering.h"
#include "environment/light/shade/exposure.h"
#include "environment/light/shade/leaf_area.h"
#include "environment/light/shade/sky_directions.h"
#include "environment/light/sky/daylight.h"
#include "geometry/grids/voxel_values.h"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_map>

namespace espalier::environment {
namespace {

using Voxel = std::array<int, 3>;

struct VoxelHash {
    std::size_t operator()(const Voxel& voxel) const {
        const auto part = [&](int axis) { return static_cast<std::size_t>(voxel[axis]); };
        return part(0) * 73856093 ^ part(1) * 19349669 ^ part(2) * 83492791;
    }
};

/// Where vines may grow.
struct VineRoom {
    std::shared_ptr<const Shape> solid;
    double voxel, reach, clearance, ground;

    explicit VineRoom(const Settings& settings) {
        Settings table = settings.table("solid");
        solid = read_shape(table);
        voxel = read_voxel(settings, 0.1);
        reach = settings.number_or("reach", 0.2, Range::positive());
        clearance = settings.number_or("clearance", 0.01, Range::not_negative());
        ground = settings.number_or("ground", 0);
    }

    Voxel voxel_of(const glm::dvec3& place) const {
        const glm::ivec3 at = voxel_at(place, voxel);
        return {at.x, at.y, at.z};
    }
    glm::dvec3 centre_of(const Voxel& at) const { return voxel * (glm::dvec3(at[0], at[1], at[2]) + 0.5); }
    /// Near the surface, above the ground, and in a voxel that is not solid.
    bool allows(const glm::dvec3& place) const {
        const double distance = solid->distance(place);
        return distance >= clearance && distance <= reach && place.y >= ground &&
               !solid->inside(centre_of(voxel_of(place)));
    }
    bool is_clear(const glm::dvec3& from, const glm::dvec3& direction, double length) const {
        return !meets(*solid, from, direction, length, voxel / 16);
    }
};

/// What a trial is worth.
struct VineWeights {
    double light, near, straight, up, crowd;

    explicit VineWeights(const Settings& settings)
        : light(settings.number_or("light", 1)),
          near(settings.number_or("near", 0.5)),
          straight(settings.number_or("straight", 0.3)),
          up(settings.number_or("up", 0.3)),
          crowd(settings.number_or("crowd", 0.3)) {}
};

struct VoxelLight {
    double sun = 0, sky = 0;
};

/// In which directions nothing solid is seen from a voxel.
struct VoxelView {
    std::vector<bool> sun, sky;
};

/// Directions with their shares of the light.
struct LightShares {
    std::vector<glm::dvec3> towards;
    std::vector<double> weights;

    void add(const glm::dvec3& direction, double weight) {
        towards.push_back(direction);
        weights.push_back(weight);
    }
    double sum() const { return std::accumulate(weights.begin(), weights.end(), 0.0); }
};

struct VineTrial {
    glm::dvec3 direction, place;
    Voxel voxel;
};

/// Uniform in the cap of half-angle `spread` about the heading.
glm::dvec3 direction_about(const Pose& pose, double least_cosine, RandomSamples& samples) {
    const double cosine = 1 - samples.uniform() * (1 - least_cosine);
    const double turn = 2 * glm::pi<double>() * samples.uniform(), sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    return glm::normalize(cosine * pose.heading + sine * (math::cos(turn) * pose.left + math::sin(turn) * pose.up));
}

class Greene final : public EnvironmentProcess {
public:
    Greene(Settings& settings, const EnvironmentContext& context, Fields& fields)
        : room_(settings),
          weights_(settings.table("weights")),
          key_(context.seed, 0, Stream::process, 0x677265656e65),
          trials_(settings.integer_or("trials", 12, Range::between(1, 10000))),
          least_cosine_(math::cos(glm::radians(settings.number_or("spread", 60, Range::between(0, 180))))),
          most_nodes_(settings.number_or("most_nodes", 3, Range::positive())),
          extinction_(settings.number_or("extinction", 0, Range::not_negative())),
          leaves_(room_.voxel),
          totals_(context.plants) {
        const std::vector<double> days = settings.numbers_or("days", {80, 172, 264});
        if (settings.has("sky")) {
            look_at_light(settings.table("sky"), days);
        } else {
            look_at_directions(settings, days);
        }
        fields.provide({context.name, "1", "exposure to sun and sky of the voxels that vines have looked at", nullptr,
                        true, [this] { return grid(); }});
    }

    void advance(const WorldView& world, Queries queries, Fields&) override {
        if (extinction_ > 0) leaves_.collect(world.plants);
        nodes_.clear();
        for (const Query& query : queries) ++nodes_[room_.voxel_of(query.pose.position)];
        tried_.assign(queries.size(), {});
        for_in_parallel(std::size_t{0}, queries.size(), [&](std::size_t i) {
            if (seeks(queries[i])) tried_[i] = allowed_trials(queries[i], world.step);
        });
        look_at_voxels(queries);
    }

    void answer(const WorldView&, Queries queries, std::span<Answer> answers, Fields&) override {
        std::fill(totals_.begin(), totals_.end(), Totals());
        for (std::size_t i = 0; i < queries.size(); ++i) {
            if (seeks(queries[i])) answer_seeker(queries[i], tried_[i], answers[i]);
            if (answers[i].size() >= 5) answer_place(queries[i].pose.position, answers[i]);
        }
    }

    std::vector<Quantity> statistics(std::uint32_t plant) const override {
        const Totals totals = plant < totals_.size() ? totals_[plant] : Totals();
        constexpr double none = std::numeric_limits<double>::quiet_NaN();
        return {{"grown", totals.grown},
                {"stuck", totals.stuck},
                {"chosen", totals.grown > 0 ? totals.chosen / totals.grown : none},
                {"rejected", totals.others > 0 ? totals.rejected / totals.others : none}};
    }

    std::pair<int, int> query_arity() const override { return {1, 20}; }
    Spreading spreading() const override { return Spreading::plants; }

    void save(std::ostream& out) const override {
        std::vector<Voxel> voxels;
        for (const auto& [voxel, light] : light_) voxels.push_back(voxel);
        std::sort(voxels.begin(), voxels.end());
        espalier::put(out, static_cast<std::uint64_t>(voxels.size()));
        for (const Voxel& voxel : voxels) {
            espalier::put(out, voxel);
            espalier::put(out, light_.at(voxel));
        }
    }
    void restore(std::istream& in) override {
        light_.clear();
        for (auto left = espalier::get<std::uint64_t>(in); left > 0; --left) {
            const auto voxel = espalier::get<Voxel>(in);
            light_[voxel] = espalier::get<VoxelLight>(in);
        }
    }

private:
    /// Exposures of the trials of one step.
    struct Totals {
        double grown = 0, stuck = 0, chosen = 0, others = 0, rejected = 0;
    };

    /// The sun's path and the whole sky, each evenly.
    void look_at_directions(const Settings& settings, std::span<const double> days) {
        const double latitude = settings.number_or("latitude", 50, Range::between(-90, 90));
        const glm::dvec3 north = settings.vector_or("north", {0, 0, -1});
        if (north.y != 0 || !(glm::length(north) > 0)) {
            throw UserError(settings.place("north"), "'north' must be horizontal and not zero: [x, 0, z]");
        }
        sun_share_ = settings.number_or("sun_share", 0.5, Range::between(0, 1));
        const auto samples = settings.integer_or("sun_samples", 32, Range::between(1, 1e6));
        for (const glm::dvec3& towards : sun_path(latitude, days, samples, glm::normalize(north))) sun_.add(towards, 1);
        for (const glm::dvec3& towards :
             sky_hemisphere(settings.integer_or("sky_samples", 128, Range::between(1, 1e6)))) {
            sky_.add(towards, 1);
        }
    }

    /// The light of these days, in photons.
    void look_at_light(const Settings& table, std::span<const double> days) {
        constexpr double least_elevation = 0.0349;  // sine of 2 degrees
        const DaylightSeries series(table, least_elevation);
        for (const double day : days) {
            for (const LightBeam& beam : series.over(day - series.first_day(), 1).beams) {
                (beam.is_sun ? sun_ : sky_).add(beam.towards, beam.photons);
            }
        }
        const double of_sun = sun_.sum(), of_sky = sky_.sum();
        if (!(of_sun + of_sky > 0)) throw UserError(table.place(), "there is no light on any of the 'days'");
        sun_share_ = of_sun / (of_sun + of_sky);
    }

    static bool seeks(const Query& query) { return query.parameters.size() >= 4 && query.parameters[0] > 0; }

    std::vector<VineTrial> allowed_trials(const Query& query, int step) const {
        RandomSamples samples(key_, mix(query.identity, query.plant), static_cast<std::uint32_t>(step));
        const double length = query.parameters[0];
        std::vector<VineTrial> allowed;
        for (std::int64_t i = 0; i < trials_; ++i) {
            const glm::dvec3 direction = direction_about(query.pose, least_cosine_, samples);
            const glm::dvec3 place = query.pose.position + length * direction;
            const Voxel voxel = room_.voxel_of(place);
            if (nodes_in(voxel) >= most_nodes_ || !room_.allows(place)) continue;
            if (room_.is_clear(query.pose.position, direction, length)) allowed.push_back({direction, place, voxel});
        }
        return allowed;
    }

    double nodes_in(const Voxel& voxel) const {
        const auto found = nodes_.find(voxel);
        return found == nodes_.end() ? 0 : found->second;
    }

    /// Looks once at the light of every voxel that this step is the first to ask for.
    void look_at_voxels(Queries queries) {
        std::vector<Voxel> asked;
        for (std::size_t i = 0; i < queries.size(); ++i) {
            if (queries[i].parameters.size() >= 5) asked.push_back(room_.voxel_of(queries[i].pose.position));
            for (const VineTrial& trial : tried_[i]) asked.push_back(trial.voxel);
        }
        // Leaves change the light of a voxel, the solid does not.
        if (extinction_ == 0) std::erase_if(asked, [&](const Voxel& voxel) { return light_.count(voxel) > 0; });
        std::sort(asked.begin(), asked.end());
        asked.erase(std::unique(asked.begin(), asked.end()), asked.end());
        std::vector<VoxelView*> views;
        for (const Voxel& voxel : asked) views.push_back(&views_[voxel]);
        std::vector<VoxelLight> seen(asked.size());
        for_in_parallel(std::size_t{0}, asked.size(), [&](std::size_t i) {
            const glm::dvec3 centre = room_.centre_of(asked[i]);
            VoxelView& view = *views[i];
            if (view.sky.empty()) {
                view.sun = unobstructed(*room_.solid, centre, sun_.towards, room_.voxel / 16);
                view.sky = unobstructed(*room_.solid, centre, sky_.towards, room_.voxel / 16);
            }
            seen[i] = {light_from(centre, sun_, view.sun), light_from(centre, sky_, view.sky)};
        });
        for (std::size_t i = 0; i < asked.size(); ++i) light_[asked[i]] = seen[i];
        if (extinction_ == 0) views_.clear();
    }

    /// The share of the light of all directions that comes through the leaves; 0 without light.
    double light_from(const glm::dvec3& place, const LightShares& light, const std::vector<bool>& free) const {
        double sum = 0;
        for (std::size_t i = 0; i < light.towards.size(); ++i) {
            if (!free[i]) continue;
            const double passed =
                extinction_ > 0 ? math::exp(-extinction_ * leaves_.crossed(place, light.towards[i])) : 1;
            sum += light.weights[i] * passed;
        }
        const double all = light.sum();
        return all > 0 ? sum / all : 0;
    }

    double exposure(const VoxelLight& light) const { return sun_share_ * light.sun + (1 - sun_share_) * light.sky; }
    double exposure(const Voxel& voxel) const { return exposure(light_.at(voxel)); }

    double score(const VineTrial& trial, const glm::dvec3& heading) const {
        const double near = 1 - room_.solid->distance(trial.place) / room_.reach;
        return weights_.light * exposure(trial.voxel) + weights_.near * near +
               weights_.straight * glm::dot(heading, trial.direction) + weights_.up * trial.direction.y -
               weights_.crowd * nodes_in(trial.voxel);
    }

    void answer_seeker(const Query& query, std::span<const VineTrial> trials, Answer answer) {
        Totals& totals = totals_.at(query.plant);
        const VineTrial* best = nullptr;
        double highest = -std::numeric_limits<double>::infinity();
        for (const VineTrial& trial : trials) {
            const double scored = score(trial, query.pose.heading);
            if (scored > highest) best = &trial;
            highest = std::max(highest, scored);
        }
        if (!best) {
            answer[0] = 0;
            ++totals.stuck;
            return;
        }
        for (int k = 0; k < 3; ++k) answer[1 + k] = best->direction[k];
        ++totals.grown;
        totals.chosen += exposure(best->voxel);
        for (const VineTrial& trial : trials) {
            if (&trial == best) continue;
            ++totals.others;
            totals.rejected += exposure(trial.voxel);
        }
    }

    void answer_place(const glm::dvec3& place, Answer answer) const {
        const VoxelLight& light = light_.at(room_.voxel_of(place));
        answer[4] = exposure(light);
        if (answer.size() < 7) return;
        answer[5] = light.sun;
        answer[6] = light.sky;
        if (answer.size() < 10) return;
        const glm::dvec3 normal = room_.solid->sample(place).normal;
        for (int k = 0; k < 3; ++k) answer[7 + k] = normal[k];
    }

    std::shared_ptr<const FieldGrid> grid() const {
        VoxelValues values(room_.voxel, {0, 0, 0});
        for (const auto& [voxel, light] : light_) {
            values.set({voxel[0], voxel[1], voxel[2]}, static_cast<float>(exposure(light)));
        }
        return values.grid();
    }

    VineRoom room_;
    VineWeights weights_;
    RandomKey key_;
    std::int64_t trials_;
    double least_cosine_, most_nodes_, sun_share_ = 0.5, extinction_;
    LeafArea leaves_;
    LightShares sky_, sun_;
    std::unordered_map<Voxel, VoxelView, VoxelHash> views_;   ///< past the solid, where leaves make the light change
    std::unordered_map<Voxel, VoxelLight, VoxelHash> light_;  ///< light in the voxels looked at so far, as last seen
    std::unordered_map<Voxel, double, VoxelHash> nodes_;      ///< nodes of this step
    std::vector<std::vector<VineTrial>> tried_;               ///< trials of this step, for each query
    std::vector<Totals> totals_;
};

const std::string& greene_help() {
    static const std::string text =
        std::string(
            R"(Vines grow in the voxels near a solid. A tip tries segments at random within the angle `spread` about its heading. A trial
is allowed if it ends at most `reach` from the surface, at least `clearance` outside it, above the ground, in a voxel
whose centre is not solid and which holds less than `most_nodes` queries, and if it does not pass through the solid.
The trial with the highest score is chosen: light * exposure + near * (1 - distance / reach) + straight * cosine of its
turn + up * its upward part - crowd * nodes in its voxel.

?name(l, x, y, z)       -> a tip that wants a segment of l metres; l: 0 if no trial was allowed, else as it was;
                           x, y, z: its direction, a unit vector
?name(l, x, y, z, e)    -> and the exposure e of the voxel of the query, from 0 to 1, as all values of light;
                           with l = 0 the query asks for this only
?name(..., sun, sky)    -> with 7 parameters also the share of the time from sunrise to sunset in which the sun is
                           seen from the centre of that voxel, and the share of the sky's solid angle that is seen
?name(..., nx, ny, nz)  -> with 10 parameters also the unit normal of the nearest surface
?name(p)                   is a node in its voxel, and keeps its value

solid         required; the table of a solid: solid = { shape = "mesh", file = "house.obj" }
voxel         0.1 m, >= 1.5e-5; edge of a voxel
reach         0.2 m, > 0; farthest from the surface that a segment may end
clearance     0.01 m, >= 0; nearest to the surface that a segment may end
ground        0 m; height below which nothing grows
trials        12, 1 to 10000; segments that a tip tries
spread        60 degrees, 0 to 180; greatest angle between the heading of a tip and a trial
most_nodes    3, > 0; a voxel with so many queries takes no more
weights       {}; what the score of a trial counts
    light     1; weight of the exposure
    near      0.5; weight of being near the surface
    straight  0.3; weight of going straight on
    up        0.3; weight of growing upwards
    crowd     0.3; weight of each node that is in the voxel already
sun_share     0.5, 0 to 1; exposure = sun_share * sun + (1 - sun_share) * sky
latitude      50 degrees, -90 to 90; geographical latitude, north of the equator
north         [0, 0, -1]; horizontal direction to the north
days          [80, 172, 264]; days of the year on which the sun is looked at
sun_samples   32, 1 to 1e6; times a day, from sunrise to sunset
sky_samples   128, 1 to 1e6; directions of the sky
sky           none; a table of light as canopy-light has it: then sun and sky are those of the light of `days`, weighted
              with their photons, and sun_share is the sun's
extinction    0, >= 0; 0: only the solid casts shadow. k > 0: leaves do, and of the light of a direction exp(-k leaf area
              that it crosses, per area across it) comes through; 0.5 for leaves that are turned in all directions evenly

Field: name, the exposure of the voxels that have been looked at, as it was then. Leaves are the polygons, patches,
discs and surfaces that plants have drawn; each is in the voxel of its middle.
Statistics of a plant: grown and stuck, numbers of tips; chosen and rejected, mean exposures of the trials.

)") + shape_help();
    return text;
}

const Registered<ProcessType> entry{
    {"greene", "vines that seek light along the surfaces of a solid (Greene 1989)", greene_help(), construct<Greene>}};

}  // namespace
}  // namespace espalier::environment
