#include "timeline/internode_lives.h"

#include "espalier/base/error.h"
#include "espalier/base/random.h"

#include <fmt/format.h>

#include <algorithm>

namespace espalier {

namespace {

constexpr std::uint32_t vacant = 0xFFFFFFFF;

}  // namespace

std::size_t InternodeLives::slot_of(Identity identity, std::uint32_t part) const {
    const std::size_t mask = index_.size() - 1;
    for (std::size_t slot = mix(identity + part) & mask;; slot = (slot + 1) & mask) {
        if (index_[slot] == vacant) return slot;
        const InternodeLife& life = lives_[index_[slot]];
        if (life.identity == identity && life.part == part) return slot;
    }
}

void InternodeLives::enlarge_index() {
    index_.assign(std::max<std::size_t>(64, 2 * index_.size()), vacant);
    for (std::uint32_t i = 0; i < lives_.size(); ++i) index_[slot_of(lives_[i].identity, lives_[i].part)] = i;
}

// Modules keep their order in the string from step to step, so most internodes are found where the last one's
// neighbour stood; only the others are looked up.
std::uint32_t InternodeLives::life_of(Identity identity, std::uint32_t part, std::size_t& expected) {
    if (expected < living_.size()) {
        const InternodeLife& life = lives_[living_[expected]];
        if (life.identity == identity && life.part == part) return living_[expected++];
    }
    if (2 * (lives_.size() + 1) > index_.size()) enlarge_index();
    std::uint32_t& found = index_[slot_of(identity, part)];
    if (found == vacant) {
        found = static_cast<std::uint32_t>(lives_.size());
        lives_.push_back({});
    } else {
        expected = std::size_t{lives_[found].place} + 1;
    }
    return found;
}

void InternodeLives::record(int step, const PlantFrame& plant, std::span<const std::uint16_t> symbols) {
    const ModuleString& string = *plant.string;
    const std::vector<Internode>& internodes = plant.interpretation->geometry.internodes;
    if (!internodes.empty() && !string.has_lineage()) {
        throw RunError(fmt::format("lifespans need the lineage of plant '{}', which is not kept", plant.name));
    }
    for (const std::uint32_t life : living_) lives_[life].alive = false;
    next_living_.clear();
    std::size_t expected = 0;
    std::uint32_t part = 0;
    for (std::size_t i = 0; i < internodes.size(); ++i) {
        const Internode& internode = internodes[i];
        const std::uint32_t module = internode.module;
        part = i > 0 && internodes[i - 1].module == module ? part + 1 : 0;
        const std::uint32_t at = life_of(string.identities[module], part, expected);
        lives_[at] = {string.identities[module],
                      string.parents[module],
                      part,
                      static_cast<std::int32_t>(string.births[module]),
                      0,
                      true,
                      symbols[string.letters[module]],
                      internode.order,
                      internode.colour,
                      glm::vec3(internode.base),
                      glm::vec3(internode.tip),
                      static_cast<float>(internode.base_radius),
                      static_cast<float>(internode.tip_radius),
                      static_cast<std::uint32_t>(next_living_.size())};
        next_living_.push_back(at);
    }
    for (const std::uint32_t life : living_) {
        if (!lives_[life].alive) lives_[life].death = step;
    }
    living_.swap(next_living_);
}

}  // namespace espalier
