// What takes water out of a soil while it flows, as roots do.
#pragma once

#include "espalier/environment/environment_process.h"

#include "environment/soil/richards/movement.h"

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace espalier::environment {

/// How roots that share one collar answer together: where it is not held, more water in one voxel lets it rise, and the
/// roots in all others take less. The uptake changes by c_i dh_i, as `by_head` of draw() tells, less
/// c_i sum(c_j dh_j) / collar.
struct JointUptake {
    std::vector<std::pair<std::size_t, double>> cells;  ///< c: of all roots in a cell, content per day and cm
    double collar = 0;                                  ///< of the same unit: of roots and shoot together
};

class SoilSink {
public:
    virtual ~SoilSink() = default;

    /// How long a substep that begins at `day` may be.
    virtual double longest_substep(double day) const = 0;
    /// Whether what it would take has jumped since it was asked before, so that rates of the past tell nothing.
    virtual bool has_jumped(double day) = 0;
    /// A step begins: the plants are as they are in `world`.
    virtual void begin(const WorldView& world, const SoilLayout& layout) = 0;
    /// Adds what is taken from each cell, content per day, and how that changes with the cell's head, in a substep of
    /// `days` from `day` on. `points` are a Newton step's guess of the soil at its end. Of the rate over that time,
    /// what is added is the part `weight`; the rest is the rate over the substep before. `days` = 0: at that moment.
    virtual void draw(std::span<const SoilPoint> points, double day, double days, double weight, WaterBrick& uptake,
                      WaterBrick& by_head) = 0;
    /// Of the last draw, those plants whose collar is not held.
    virtual std::vector<JointUptake> joint() const { return {}; }
    /// The last draw holds: the soil has come on by `days`. Of the rate over that time it is the part `weight`; the
    /// rest is the rate over the time before.
    virtual void accept(double days, double weight) = 0;
};

/// A soil as other processes find it: the source of its fields.
class SharedSoil : public FieldSource {
public:
    /// From now on `sink` takes water in every step; it lives as long as the soil.
    virtual void attach(SoilSink& sink) = 0;
    /// From now on `follower` is told of every substep.
    virtual void attach(SoilFollower& follower) = 0;
    virtual const SoilLayout& layout() const = 0;
    virtual const WaterBrick& contents() const = 0;
    virtual double days_per_unit() const = 0;
    /// To the nearest stone, side or floor, m; see WaterSolids.
    virtual double distance_to_wall(const glm::dvec3& point) const = 0;
    /// Tells the user, once.
    virtual void warn_of_root_outside(std::uint32_t plant, const glm::dvec3& point) = 0;
};

}  // namespace espalier::environment
