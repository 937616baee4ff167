// The internodes of one plant through a run: each once, with its birth, its death and its last shape.
#pragma once

#include "espalier/timeline/frame.h"

#include <cstdint>
#include <iosfwd>
#include <span>
#include <vector>

namespace espalier::timeline {

/// An Internode lasts a step and refers to a module of its string; this lasts for the run and holds what it needs
/// itself.
struct InternodeLife {
    Identity identity, parent;
    std::uint64_t organ;  ///< number of the module, in the order of births
    std::uint32_t part;   ///< a module may draw several internodes; this is its part-th
    std::int32_t birth;   ///< birth of the module
    std::int32_t death;   ///< first step without it; meaningful once it is dead
    std::uint8_t alive;   ///< 1, or 0 once it is dead: bytes of a checkpoint may be no bool
    std::uint16_t symbol, order, colour;
    glm::vec3 base, tip;  ///< as last seen
    float base_radius, tip_radius;
    std::uint32_t place;  ///< among those that lived at its last step
};

/// How many internodes there are whose modules were born at `step`.
std::size_t internodes_born(int step, const ModuleString& string, const Column<Internode>& internodes);

class InternodeLives {
public:
    /// Brings the lives to a step. `symbols` numbers the letters. Throws RunError if the string keeps no lineage.
    void record(int step, const PlantFrame& plant, std::span<const std::uint16_t> symbols);

    void save(std::ostream& out) const;
    void restore(std::istream& in);

    /// In the order of first appearance.
    const std::vector<InternodeLife>& all() const { return lives_; }

private:
    std::uint32_t begin_life(Identity identity, std::uint32_t part);
    /// The life of an internode older than a step. `expected` is where it likely stands in `living_`, and moves on.
    std::uint32_t life_of(Identity identity, std::uint32_t part, std::size_t& expected);
    bool is(std::uint32_t life, Identity identity, std::uint32_t part) const;
    std::size_t slot_of(Identity identity, std::uint32_t part) const;
    void complete_index();

    std::vector<InternodeLife> lives_;
    std::vector<std::uint32_t> index_;  ///< open addressing: number of a life, or `vacant`
    std::uint32_t indexed_ = 0;         ///< how many lives are in it; completed when something must be looked up
    int previous_step_ = -1;
    std::vector<std::uint32_t> living_;  ///< the lives seen one step ago, in string order
    std::vector<std::uint32_t> next_living_;
};

}  // namespace espalier::timeline
