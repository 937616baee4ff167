// Water between leaves and what brings it to them.
#pragma once

#include "espalier/environment/environment_process.h"

#include <cstdint>
#include <span>
#include <string>

namespace espalier::environment {

/// A leaf that draws water.
struct DrawingLeaf {
    std::uint32_t module = 0;  ///< in the plant's string
    float area = 0;            ///< of one side, m2
};

/// What a leaf gives at a water potential.
struct LeafLoss {
    double rate = 0;          ///< cm3/d
    double by_potential = 0;  ///< not negative, cm3/d/MPa
};

/// The leaves of a scene, for the process that brings them water.
class LeafWater {
public:
    virtual ~LeafWater() = default;

    /// A step begins: light and air are those of `world`.
    virtual void begin_step(const WorldView& world) = 0;
    virtual std::span<const DrawingLeaf> leaves(std::uint32_t plant) const = 0;
    /// Of all leaves of a plant at these water potentials, MPa.
    virtual void lose(std::uint32_t plant, std::span<const double> potentials, std::span<LeafLoss> losses) = 0;
    /// The last potentials hold, and so many days have passed. Of the rates over that time what leaves did at these
    /// potentials is the part `weight`; the rest is what they did over the time before.
    virtual void pass(std::uint32_t plant, double days, double weight) = 0;
};

/// What brings water to leaves, as their process finds it: the source of a field.
class LeafSupply : public FieldSource {
public:
    /// From now on it brings water to the leaves of `leaves`, a process called `name`, which lives as long as it does.
    /// Throws UserError where it brings none, or to others already.
    virtual void attach(LeafWater& leaves, const std::string& name) = 0;
    /// The process in whose turn leaves are solved: what they read must stand before it in the scene.
    virtual const std::string& solved_with() const = 0;
};

}  // namespace espalier::environment
