// sway: stems that sway in the wind.
// Weber & Penn 1995, on wind: a stem of length L turns at the share z of its length, where it has the radius r(z), by
//   a1 sin b + a2 sin 0.7 b,   a0 = 4 L (1 - z) / r(z) degrees,   a1 = speed / 50 a0,   a2 = gust / 50 a0 + a1 / 2,
// about each of two axes across it, and b grows with the time as the stem's radius / L.
#include "espalier/base/math.h"
#include "espalier/turtle/geometry_stage.h"

#include "geometry/drawn/rigid_motion.h"
#include "geometry/vectors.h"
#include "turtle/internode_bearers.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace espalier::turtle {
namespace {

double length_of_piece(const Internode& internode) {
    return glm::distance(internode.base, internode.tip);
}

/// Internodes that sway as one rod: those of an axis, and where an axis ends, the thickest that it bears.
struct RodOfInternodes {
    std::uint32_t first;  ///< internode
    double length = 0;    ///< m
    double bend = 0;      ///< sum of a0 over the internodes, each by its share of the length; degrees
};

/// The rod of each internode, and how far up the rod its middle is, m.
struct Rods {
    std::vector<RodOfInternodes> all;
    std::vector<std::uint32_t> of;
    std::vector<double> up;

    Rods(const Column<Internode>& internodes, const std::vector<std::uint32_t>& bearers);

    /// a0 times the share of the rod that the internode is. What has no radius does not bend.
    double bend(const Column<Internode>& internodes, std::uint32_t i) const {
        const RodOfInternodes& rod = all[of[i]];
        const double radius = (internodes[i].base_radius + internodes[i].tip_radius) / 2;
        return radius > 0 ? 4 * (rod.length - up[i]) / radius * length_of_piece(internodes[i]) / rod.length : 0;
    }
};

/// What each internode goes on as beyond its tip.
std::vector<std::uint32_t> continuations(const Column<Internode>& internodes,
                                         const std::vector<std::uint32_t>& bearers) {
    std::vector<std::uint32_t> next(internodes.size(), no_bearer);
    for (std::uint32_t i = 0; i < internodes.size(); ++i) {
        if (bearers[i] == no_bearer) continue;
        const Internode& bearer = internodes[bearers[i]];
        std::uint32_t& chosen = next[bearers[i]];
        const auto is_same_axis = [&](std::uint32_t k) { return internodes[k].axis == bearer.axis; };
        const bool is_better = chosen == no_bearer ||
                               (!is_same_axis(chosen) && internodes[i].base_radius > internodes[chosen].base_radius);
        if (is_same_axis(i) || is_better) chosen = i;
    }
    return next;
}

Rods::Rods(const Column<Internode>& internodes, const std::vector<std::uint32_t>& bearers)
    : of(internodes.size()), up(internodes.size()) {
    const std::vector<std::uint32_t> next = continuations(internodes, bearers);
    for (std::uint32_t i = 0; i < internodes.size(); ++i) {
        const bool goes_on = bearers[i] != no_bearer && next[bearers[i]] == i;
        of[i] = goes_on ? of[bearers[i]] : static_cast<std::uint32_t>(all.size());
        if (!goes_on) all.push_back({i});
        RodOfInternodes& rod = all[of[i]];
        const double length = length_of_piece(internodes[i]);
        up[i] = rod.length + length / 2;
        rod.length += length;
    }
    for (std::uint32_t i = 0; i < internodes.size(); ++i) all[of[i]].bend += bend(internodes, i);
}

/// Two directions across another, at right angles to each other.
std::array<glm::dvec3, 2> axes_across(const glm::dvec3& along) {
    const glm::dvec3 a = glm::normalize(glm::cross(along, axis_apart_from(along)));
    return {a, glm::cross(along, a)};
}

class Sway final : public GeometryStage {
public:
    explicit Sway(Settings& settings)
        : speed_(settings.number("speed", Range::not_negative())),
          gust_(settings.number_or("gust", 0, Range::not_negative())),
          pace_(settings.number_or("pace", 100, Range::positive())),
          most_(settings.number_or("most", 60, Range::between(0, 180))) {}

    void apply(StagedPlant& plant) const override {
        if (speed_ == 0 && gust_ == 0) return;
        PlantGeometry& geometry = plant.geometry;
        const OrganBearers organ_bearers(geometry, plant.string);
        const std::vector<RigidMotion> motions = motions_of(plant);
        move_organs(geometry, [&](std::uint32_t module, const glm::dvec3& place) -> const RigidMotion* {
            const std::uint32_t bearer = organ_bearers.of(module, place);
            return bearer == no_bearer ? nullptr : &motions[bearer];
        });
        for (std::size_t i = 0; i < motions.size(); ++i) {
            Internode& internode = geometry.internodes[i];
            internode.base = motions[i].to;
            internode.tip = motions[i].point(internode.tip);
        }
    }

private:
    std::vector<RigidMotion> motions_of(const StagedPlant& plant) const {
        const Column<Internode>& internodes = plant.geometry.internodes;
        const std::vector<std::uint32_t> bearers = internode_bearers(plant.geometry, plant.string);
        const Rods rods(internodes, bearers);
        std::vector<glm::dvec3> turns;  // turn of a whole rod, about the world's axes, per degree of bend
        for (const RodOfInternodes& rod : rods.all) turns.push_back(turn_of(rod, plant));
        std::vector<RigidMotion> motions;
        motions.reserve(internodes.size());
        for (std::uint32_t i = 0; i < internodes.size(); ++i) {
            RigidMotion motion{{1, 0, 0, 0}, internodes[i].base, internodes[i].base};
            if (bearers[i] != no_bearer) {
                motion.turn = motions[bearers[i]].turn;
                motion.to = motions[bearers[i]].point(internodes[i].base);
            }
            const glm::dvec3 turn = turns[rods.of[i]] * glm::radians(rods.bend(internodes, i));
            if (const double angle = glm::length(turn); angle > 0) {
                motion.turn = glm::normalize(motion.turn * turn_about(turn / angle, angle));
            }
            motions.push_back(motion);
        }
        return motions;
    }

    /// Returns the turn of a bend of one degree: the axis times the degrees.
    glm::dvec3 turn_of(const RodOfInternodes& rod, const StagedPlant& plant) const {
        const Internode& foot = plant.geometry.internodes[rod.first];
        if (foot.base_radius == 0 || rod.length == 0) return glm::dvec3(0);
        const double first = speed_ / 50, second = gust_ / 50 + first / 2;
        const double reach = rod.bend * (first + second);
        const double limit = reach > most_ ? most_ / reach : 1;
        const ModuleString& string = plant.string;
        RandomSamples samples(plant.key, string.has_lineage() ? string.identity(foot.module) : foot.module, 0);
        const glm::dvec3 along = foot.tip - foot.base;
        glm::dvec3 turn(0);
        for (const glm::dvec3& axis : axes_across(glm::length(along) > 0 ? glm::normalize(along) : plant.heading)) {
            const double offset = 2 * std::numbers::pi * samples.uniform();
            const double b = offset + pace_ * foot.base_radius / rod.length * plant.time;
            turn += axis * limit * (first * math::sin(b) + second * math::sin(0.7 * b));
        }
        return turn;
    }

    double speed_, gust_, pace_, most_;
};

const Registered<GeometryStageType> entry{
    {"sway", "stems sway in the wind, each at a frequency of its own (Weber & Penn 1995)",
     R"(speed     required, >= 0; speed of the wind, without unit: the middle of a stem of length L and radius r turns back and
          forth by about speed / 50 4 L / r degrees, each of its internodes by its share. 0 changes nothing
gust      0, >= 0; strength of the slow part of the movement, at 0.7 of the frequency
pace      100, > 0; a stem has the angular frequency pace r / L, with the radius r of its base, per unit of time of the
          scene: a trunk of 13 m and 0.2 m swings in 4 units
most      60 degrees, 0 to 180; no stem bends further about one of its two axes
The time is that of the frame: step times dt. The phases are random, one of each stem. A stem is an axis, and where it
ends goes on in the thickest branch. What has no radius does not bend, but moves with what bears it: `pipe-radii` gives
radii. [[keyframes]] of speed and gust let the wind rise and fall.
)",
     construct<Sway>}};

}  // namespace
}  // namespace espalier::turtle
