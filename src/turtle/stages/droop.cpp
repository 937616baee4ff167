// droop: branches that hang, the more the nearer they are to hanging.
// Brzoska 2019, section 3.4.5, equation 13: psi = lambda (1 - theta / 180) theta, from the base to the tips.
#include "espalier/base/math.h"
#include "espalier/turtle/geometry_stage.h"

#include "geometry/drawn/rigid_motion.h"
#include "turtle/internode_bearers.h"

#include <glm/geometric.hpp>

#include <numbers>
#include <optional>

namespace espalier::turtle {
namespace {

constexpr glm::dvec3 down{0, -1, 0};

/// Turns `heading` down by lambda (1 - theta / pi) theta, theta being its angle to `down`.
glm::dquat turn_down(const glm::dvec3& heading, double lambda) {
    const glm::dvec3 across = glm::cross(heading, down);
    const double sine = glm::length(across), theta = math::atan2(sine, glm::dot(heading, down));
    if (sine <= 1e-12 * glm::length(heading)) return {1, 0, 0, 0};
    return turn_about(across / sine, lambda * (1 - theta / std::numbers::pi) * theta);
}

class Droop final : public GeometryStage {
public:
    explicit Droop(Settings& settings)
        : lambda_(settings.number("lambda", Range::between(0, 1))),
          from_(static_cast<std::uint32_t>(settings.integer_or("from", 1, Range::between(0, 65535)))),
          counts_nodes_(settings.choice_or("count", "order", {"order", "nodes"}) == "nodes") {}

    void apply(StagedPlant& plant) const override {
        if (lambda_ == 0) return;
        PlantGeometry& geometry = plant.geometry;
        const OrganBearers organ_bearers(geometry, plant.string);
        const std::vector<std::optional<RigidMotion>> motions = motions_of(plant);
        move_organs(geometry, [&](std::uint32_t module, const glm::dvec3& place) -> const RigidMotion* {
            const std::uint32_t bearer = organ_bearers.of(module, place);
            return bearer == no_bearer || !motions[bearer] ? nullptr : &*motions[bearer];
        });
        for (std::size_t i = 0; i < motions.size(); ++i) {
            if (!motions[i]) continue;
            Internode& internode = geometry.internodes[i];
            internode.base = motions[i]->to;
            internode.tip = motions[i]->point(internode.tip);
        }
    }

private:
    /// None of an internode that stays with all that bears it.
    std::vector<std::optional<RigidMotion>> motions_of(const StagedPlant& plant) const {
        const Column<Internode>& internodes = plant.geometry.internodes;
        const std::vector<std::uint32_t> bearers = internode_bearers(plant.geometry, plant.string);
        std::vector<std::optional<RigidMotion>> motions(internodes.size());
        std::vector<std::uint32_t> depths(internodes.size(), 1);
        for (std::size_t i = 0; i < internodes.size(); ++i) {
            const Internode& internode = internodes[i];
            RigidMotion motion{{1, 0, 0, 0}, internode.base, internode.base};
            const bool is_borne = bearers[i] != no_bearer;
            if (is_borne) depths[i] = depths[bearers[i]] + 1;
            const bool is_carried = is_borne && motions[bearers[i]];
            if (is_carried) {
                motion.turn = motions[bearers[i]]->turn;
                motion.to = motions[bearers[i]]->point(internode.base);
            }
            const bool bends = (counts_nodes_ ? depths[i] : internode.order) >= from_;
            if (bends) {
                const glm::dvec3 heading = motion.direction(internode.tip - internode.base);
                motion.turn = glm::normalize(turn_down(heading, lambda_) * motion.turn);
            }
            if (bends || is_carried) motions[i] = motion;
        }
        return motions;
    }

    double lambda_;
    std::uint32_t from_;
    bool counts_nodes_;
};

const Registered<GeometryStageType> entry{
    {"droop", "branches hang: psi = lambda (1 - theta/180) theta, from the base to the tips (Brzoska 2019)",
     R"(lambda    required, 0 to 1; an internode at theta degrees from straight down turns down by
          psi = lambda (1 - theta/180) theta degrees about its base, with all that it bears; then those it bears turn.
          0 changes nothing; straight up stays straight up
from      1, 0 to 65535; the first order or node that turns; 0: all
count     "order", or "nodes"; order: `from` is an order of branching, the main axis being 0; nodes: it counts internodes
          from the base, the first being 1
Lengths stay. Organs, polygons, meshes and labels turn with the internode that bears them; generalized cylinders are no
internodes and do not bend.
)",
     construct<Droop>}};

}  // namespace
}  // namespace espalier::turtle
