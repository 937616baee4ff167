// arvo: climbers that creep over the surfaces of obstacles by shooting rays.
// Arvo & Kirk 1988, Modeling plants with environment-sensitive automata: a tip looks for a place that it can reach
// without a hit, and from there for the nearest surface, on which it goes on.
#include "espalier/base/math.h"
#include "espalier/environment/environment_process.h"
#include "espalier/environment/shape.h"
#include "espalier/lsystem/lsystem.h"
#include "espalier/turtle/background.h"

#include "base/bytes.h"
#include "base/parallel.h"
#include "environment/exchange/parameter_file.h"
#include "geometry/drawn/rigid_motion.h"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace espalier::environment {
namespace {

struct ClimbHit {
    double along;
    glm::dvec3 place, normal;  ///< unit; against the ray
};

struct ClimbRay {
    glm::dvec3 from, direction;  ///< unit
    double length;
};

using ClimbTriangle = std::array<glm::dvec3, 3>;

std::optional<ClimbHit> hit_of(const Shape& shape, const ClimbRay& ray) {
    const double surface = 1e-6;
    for (double along = 0; along <= ray.length;) {
        const glm::dvec3 place = ray.from + along * ray.direction;
        const double distance = shape.distance(place);
        if (distance <= surface) return ClimbHit{along, place, shape.sample(place).normal};
        along += distance;
    }
    return std::nullopt;
}

/// Moeller & Trumbore 1997.
std::optional<ClimbHit> hit_of(const ClimbTriangle& triangle, const ClimbRay& ray) {
    const glm::dvec3 side = triangle[1] - triangle[0], other = triangle[2] - triangle[0];
    const glm::dvec3 across = glm::cross(ray.direction, other);
    const double volume = glm::dot(side, across);
    if (volume == 0) return std::nullopt;
    const glm::dvec3 to = ray.from - triangle[0], normal = glm::cross(to, side);
    const double u = glm::dot(to, across) / volume, v = glm::dot(ray.direction, normal) / volume;
    const double along = glm::dot(other, normal) / volume;
    if (u < 0 || v < 0 || u + v > 1 || along < 0 || along > ray.length) return std::nullopt;
    const glm::dvec3 face = glm::normalize(glm::cross(side, other));
    const glm::dvec3 outward = glm::dot(face, ray.direction) > 0 ? -face : face;
    return ClimbHit{along, ray.from + along * ray.direction, outward};
}

/// A ball, a cylinder or a cone that a plant asks to be there.
struct ClimbObject {
    enum class Kind : std::uint8_t { ball, cylinder, cone };
    std::uint64_t owner;  ///< the query
    Kind kind;
    glm::dvec3 base, tip;
    double base_radius, tip_radius;

    std::shared_ptr<const Shape> shape() const {
        Settings table;
        if (kind == Kind::ball) {
            table = {{"shape", "sphere"}, {"center", base}, {"radius", base_radius}};
        } else if (kind == Kind::cylinder) {
            table = {{"shape", "cylinder"}, {"base", base}, {"tip", tip}, {"radius", base_radius}};
        } else {
            table = {{"shape", "cone"},
                     {"base", base},
                     {"tip", tip},
                     {"base_radius", base_radius},
                     {"tip_radius", tip_radius}};
        }
        return read_shape(table);
    }
};

/// What climbers meet: the solid of the scene, the triangles of a file, and what the plants ask to be there.
class ClimbObstacles {
public:
    ClimbObstacles(const Settings& settings, const std::optional<std::filesystem::path>& file,
                   std::vector<Diagnostic>* warnings) {
        if (settings.has("solid")) {
            Settings table = settings.table("solid");
            lasting_.push_back(read_shape(table));
        }
        if (!file) return;
        Background background;
        std::vector<Diagnostic> diagnostics;
        read_background(*file, {}, background, diagnostics);
        if (warnings) warnings->insert(warnings->end(), diagnostics.begin(), diagnostics.end());
        const auto corner = [&](std::size_t i) {
            return glm::dvec3(background.vertices[background.triangles[i]].position);
        };
        for (std::size_t i = 0; i + 2 < background.triangles.size(); i += 3) {
            triangles_.push_back({corner(i), corner(i + 1), corner(i + 2)});
        }
    }

    void forget_objects() { asked_.clear(), objects_.clear(); }
    /// Instead of what the same query has asked for before.
    void add(const ClimbObject& object) {
        const auto [known, is_new] = objects_.insert_or_assign(object.owner, object);
        asked_[known->first] = object.shape();
    }
    std::size_t objects() const { return objects_.size(); }
    void save(std::ostream& out) const {
        espalier::put(out, static_cast<std::uint64_t>(objects_.size()));
        for (const auto& [owner, object] : objects_) espalier::put(out, object);
    }
    void restore(std::istream& in) {
        forget_objects();
        for (auto left = espalier::get<std::uint64_t>(in); left > 0; --left) add(espalier::get<ClimbObject>(in));
    }

    std::optional<ClimbHit> first(const ClimbRay& ray) const {
        std::optional<ClimbHit> nearest;
        const auto keep = [&](const std::optional<ClimbHit>& hit) {
            if (hit && (!nearest || hit->along < nearest->along)) nearest = hit;
        };
        for (const auto& shape : lasting_) keep(hit_of(*shape, ray));
        for (const auto& [owner, shape] : asked_) keep(hit_of(*shape, ray));
        for (const ClimbTriangle& triangle : triangles_) keep(hit_of(triangle, ray));
        return nearest;
    }

private:
    std::vector<std::shared_ptr<const Shape>> lasting_;
    std::map<std::uint64_t, ClimbObject> objects_;  ///< objects of plants, by owner
    std::map<std::uint64_t, std::shared_ptr<const Shape>> asked_;
    std::vector<ClimbTriangle> triangles_;
};

glm::dvec3 direction_on_sphere(RandomSamples& samples) {
    const double y = 2 * samples.uniform() - 1, turn = 2 * glm::pi<double>() * samples.uniform();
    const double across = std::sqrt(1 - y * y);
    return {across * math::cos(turn), y, across * math::sin(turn)};
}

class Arvo final : public EnvironmentProcess {
public:
    Arvo(Settings& settings, const EnvironmentContext& context, Fields&)
        : Arvo(settings, context,
               ParameterFile(settings, context,
                             {"domain size", "position", "grid size", "surface distance", "max surface distance",
                              "tries for Q", "tries for surface", "obstacles", "seed"})) {}

    void advance(const WorldView& world, Queries queries, Fields&) override {
        if (!keeps_objects_) obstacles_.forget_objects();
        for (const Query& query : queries) {
            if (query.parameters.empty()) add_object(query, world);
        }
    }

    void answer(const WorldView& world, Queries queries, std::span<Answer> answers, Fields&) override {
        for_in_parallel(std::size_t{0}, queries.size(), [&](std::size_t i) {
            if (answers[i].size() >= 7) {
                answer_climber(queries[i], world.step, answers[i]);
            } else if (!answers[i].empty()) {
                answer_segment(queries[i].pose, answers[i]);
            }
        });
        std::fill(climbing_.begin(), climbing_.end(), 0);
        std::fill(stuck_.begin(), stuck_.end(), 0);
        for (std::size_t i = 0; i < queries.size(); ++i) {
            if (answers[i].size() >= 7) ++(answers[i][0] > 0 ? climbing_ : stuck_).at(queries[i].plant);
        }
    }

    std::vector<Quantity> statistics(std::uint32_t plant) const override {
        return {{"climbing", static_cast<double>(climbing_.at(plant))},
                {"stuck", static_cast<double>(stuck_.at(plant))}};
    }

    std::pair<int, int> query_arity() const override { return {0, 20}; }
    Spreading spreading() const override { return Spreading::queries; }

    void save(std::ostream& out) const override { obstacles_.save(out); }
    void restore(std::istream& in) override { obstacles_.restore(in); }

private:
    Arvo(Settings& settings, const EnvironmentContext& context, ParameterFile file)
        : obstacles_(settings, file.file("obstacles"), context.warnings),
          surface_distance_(file.number("surface distance", 0.05, Range::positive())),
          farthest_(file.number("max surface distance", 1, Range::positive())),
          keeps_objects_(settings.flag_or("keep_objects", false)),
          tries_for_place_(file.whole("tries for Q", 16, Range::between(1, 1e6))),
          tries_for_surface_(file.whole("tries for surface", 16, Range::between(0, 1e6))),
          key_(mix(context.seed, static_cast<std::uint64_t>(file.whole("seed", 0, Range::between(0, 2e9)))), 0,
               Stream::process, 0x6172766f),
          climbing_(context.plants),
          stuck_(context.plants) {
        // These describe the grid of cpfg's program; rays need none here.
        for (const char* key : {"domain size", "position", "grid size"}) file.numbers(key, {0, 0, 0});
    }

    void add_object(const Query& query, const WorldView& world) {
        if (query.following == no_letter) return;
        const std::string& symbol = world.plants[query.plant].model->alphabet.name(query.following);
        const std::span<const double> sizes = query.following_parameters;
        const glm::dvec3& base = query.pose.position;
        const std::uint64_t owner = keeps_objects_ ? mix(query.identity, query.plant) : obstacles_.objects();
        const auto tip = [&](double height) { return base + height * query.pose.heading; };
        using enum ClimbObject::Kind;
        if (symbol == "S" && sizes.size() == 1 && sizes[0] > 0) {
            obstacles_.add({owner, ball, base, base, sizes[0], sizes[0]});
        } else if (symbol == "C" && sizes.size() == 2 && sizes[0] > 0 && sizes[1] > 0) {
            obstacles_.add({owner, cylinder, base, tip(sizes[1]), sizes[0], sizes[0]});
        } else if (symbol == "C" && sizes.size() == 3 && sizes[0] > 0 && sizes[1] >= 0 && sizes[2] > 0) {
            obstacles_.add({owner, cone, base, tip(sizes[2]), sizes[0], sizes[1]});
        }
    }

    void answer_segment(const Pose& pose, Answer answer) const {
        const double sign = answer[0] < 0 ? -1 : 1;
        const auto hit = obstacles_.first({pose.position, sign * pose.heading, std::abs(answer[0])});
        answer[0] = hit.has_value();
        for (int k = 0; hit && answer.size() >= 4 && k < 3; ++k) answer[1 + k] = hit->normal[k];
    }

    void answer_climber(const Query& query, int step, Answer answer) const {
        const double length = answer[0];
        RandomSamples samples(key_, mix(query.identity, query.plant), static_cast<std::uint32_t>(step));
        answer[0] = 0;
        for (std::int64_t k = 0; length > 0 && k < tries_for_place_; ++k) {
            const std::optional<ClimbHit> hit = surface_ahead(query.pose, length, turn_of_try(k), samples);
            if (!hit) continue;
            const glm::dvec3 tip = hit->place + surface_distance_ * hit->normal;
            const glm::dvec3 way = tip - query.pose.position;
            const double walked = glm::length(way);
            if (walked < 1e-9 || obstacles_.first({query.pose.position, way / walked, walked})) continue;
            write_climber(way / walked, walked, hit->normal, answer);
            return;
        }
    }

    /// 0, then to both sides in turn, further and further.
    double turn_of_try(std::int64_t k) const {
        const auto aside = static_cast<double>((k + 1) / 2);
        return (k % 2 == 0 ? -1 : 1) * aside * 2 * glm::pi<double>() / static_cast<double>(tries_for_place_);
    }

    /// The nearest surface around the place that lies `length` ahead, `turn` aside, if the way there is free.
    std::optional<ClimbHit> surface_ahead(const Pose& pose, double length, double turn, RandomSamples& samples) const {
        const glm::dvec3 direction = geometry::turn_about(pose.up, turn) * pose.heading;
        if (obstacles_.first({pose.position, direction, length})) return std::nullopt;
        const glm::dvec3 place = pose.position + length * direction;
        std::optional<ClimbHit> nearest = obstacles_.first({place, -pose.up, farthest_});
        for (std::int64_t i = 0; i < tries_for_surface_; ++i) {
            const auto hit = obstacles_.first({place, direction_on_sphere(samples), farthest_});
            if (hit && (!nearest || hit->along < nearest->along)) nearest = hit;
        }
        return nearest;
    }

    static void write_climber(const glm::dvec3& heading, double length, const glm::dvec3& normal, Answer answer) {
        glm::dvec3 up = normal - glm::dot(normal, heading) * heading;  // @R takes it only at right angles
        up = glm::length(up) > 1e-6 ? glm::normalize(up) : normal;
        answer[0] = length;
        for (int k = 0; k < 3; ++k) {
            answer[1 + k] = heading[k];
            answer[4 + k] = up[k];
        }
    }

    ClimbObstacles obstacles_;
    double surface_distance_, farthest_;
    bool keeps_objects_;
    std::int64_t tries_for_place_, tries_for_surface_;
    RandomKey key_;
    std::vector<std::uint64_t> climbing_, stuck_;  ///< tips of each plant in this step
};

const std::string& arvo_help() {
    static const std::string text =
        std::string(
            R"(A tip looks ahead by the length of its segment, in the plane across its up direction: straight on, then to both sides in
`tries_for_q` directions. From the first place that it can reach without a hit, rays go against the up direction and in
`tries_for_surface` random directions. The nearest surface within `max_surface_distance` is where it goes on.

?name(l, x, y, z, ux, uy, uz) -> a tip that wants a segment of l metres; l: the length that leads to `surface_distance`
                                 before that surface, or 0 if there is none; x, y, z: its heading; ux, uy, uz: the
                                 normal of the surface, made perpendicular to it, for @R(x, y, z, ux, uy, uz)
?name(l), ?name(l, x, y, z)   -> 1 if the segment of l metres ahead (behind if l < 0) hits an obstacle, else 0; with
                                 four parameters also the normal there
?name                            before a module S(r), C(r, h) or C(r1, r2, h): a ball, a cylinder or a cone at the
                                 turtle, along its heading, is an obstacle in this step

solid                 none; the table of a solid to climb: solid = { shape = "sphere", center = [0, 1, 0], radius = 1 }
obstacles             none; a file of objects like those of `background scene` in view files
keep_objects          false; objects of plants are there for the step; true: they stay when their queries are gone
surface_distance      0.05 m, > 0; distance from the surface at which a climber grows
max_surface_distance  1 m, > 0; distance of the farthest surface that a tip finds
tries_for_q           16, 1 to 1e6; directions in which a tip looks for its next place
tries_for_surface     16, 0 to 1e6; random directions in which it looks for a surface from that place
seed                  0, 0 to 2e9; another number gives other random directions
domain_size, position, grid_size, verbose   accepted and ignored: of the grid and the messages of cpfg's program
parameters            none; a file with these keys in words, as cpfg's program arvo reads it

Where no surface is found from a place, the next one is tried. Answers do not depend on the order of the queries.
Statistics of a plant: climbing and stuck, numbers of tips.

)") + shape_help();
    return text;
}

const Registered<ProcessType> entry{
    {"arvo", "climbers that follow the surfaces of obstacles (Arvo & Kirk 1988)", arvo_help(), construct<Arvo>}};

}  // namespace
}  // namespace espalier::environment
