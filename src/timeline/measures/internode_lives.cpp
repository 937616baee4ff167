#include "timeline/measures/internode_lives.h"

#include "espalier/base/error.h"
#include "espalier/base/random.h"

#include "base/bytes.h"
#include "base/parallel.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>

#include <algorithm>
#include <bit>
#include <functional>

namespace espalier::timeline {

namespace {

constexpr std::uint32_t vacant = 0xFFFFFFFF;
constexpr std::size_t look_ahead = 64;

}  // namespace

std::size_t internodes_born(int step, const ModuleString& string, const Column<Internode>& internodes) {
    if (!string.has_lineage()) return 0;
    const auto born = static_cast<std::uint32_t>(step);
    const auto count = [&](const tbb::blocked_range<std::size_t>& range, std::size_t sum) {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
            sum += string.step_of_birth(internodes[i].module) == born;
        return sum;
    };
    constexpr std::size_t worth_sharing = std::size_t{1} << 15;
    const tbb::blocked_range<std::size_t> all(0, internodes.size(), worth_sharing);
    if (internodes.size() < 2 * worth_sharing) return count(all, 0);
    return reduce_in_parallel(all, std::size_t{0}, count, std::plus<>());
}

bool InternodeLives::is(std::uint32_t life, Identity identity, std::uint32_t part) const {
    return lives_[life].identity == identity && lives_[life].part == part;
}

std::size_t InternodeLives::slot_of(Identity identity, std::uint32_t part) const {
    const std::size_t mask = index_.size() - 1;
    std::size_t slot = mix(identity + part) & mask;
    while (index_[slot] != vacant && !is(index_[slot], identity, part)) slot = (slot + 1) & mask;
    return slot;
}

void InternodeLives::complete_index() {
    if (2 * (lives_.size() + 1) > index_.size()) {
        index_.assign(std::bit_ceil(4 * (lives_.size() + 1)), vacant);
        indexed_ = 0;
    }
    for (; indexed_ < lives_.size(); ++indexed_) {
        index_[slot_of(lives_[indexed_].identity, lives_[indexed_].part)] = indexed_;
    }
}

std::uint32_t InternodeLives::begin_life(Identity identity, std::uint32_t part) {
    lives_.push_back({});
    lives_.back().identity = identity;
    lives_.back().part = part;
    return static_cast<std::uint32_t>(lives_.size() - 1);
}

// Modules keep their order in the string from step to step, so an internode is found a little ahead of its neighbour,
// behind what died between them. Only what was not drawn for a while has to be looked up.
std::uint32_t InternodeLives::life_of(Identity identity, std::uint32_t part, std::size_t& expected) {
    const std::size_t end = std::min(living_.size(), expected + look_ahead);
    for (std::size_t i = expected; i < end; ++i) {
        if (!is(living_[i], identity, part)) continue;
        expected = i + 1;
        return living_[i];
    }
    complete_index();
    const std::uint32_t found = index_[slot_of(identity, part)];
    if (found == vacant) return begin_life(identity, part);
    expected = std::size_t{lives_[found].place} + 1;
    return found;
}

void InternodeLives::record(int step, const PlantFrame& plant, std::span<const std::uint16_t> symbols) {
    const ModuleString& string = *plant.string;
    const Column<Internode>& internodes = plant.interpretation->geometry.internodes;
    if (!internodes.empty() && !string.has_lineage()) {
        throw RunError(fmt::format("lifespans need the lineage of plant '{}', which is not kept", plant.name));
    }
    for (const std::uint32_t life : living_) lives_[life].alive = 0;
    next_living_.clear();
    std::size_t expected = 0;
    std::uint32_t part = 0;
    for (std::size_t i = 0; i < internodes.size(); ++i) {
        const Internode& internode = internodes[i];
        const std::uint32_t module = internode.module;
        part = i > 0 && internodes[i - 1].module == module ? part + 1 : 0;
        const Identity identity = string.identity(module);
        const bool is_new = static_cast<std::int64_t>(string.step_of_birth(module)) > previous_step_;
        const std::uint32_t at = is_new ? begin_life(identity, part) : life_of(identity, part, expected);
        lives_[at] = {identity,
                      string.parent(module),
                      string.birth_number(module),
                      part,
                      static_cast<std::int32_t>(string.step_of_birth(module)),
                      0,
                      1,
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
    previous_step_ = step;
}

void InternodeLives::save(std::ostream& out) const {
    put(out, previous_step_);
    put(out, static_cast<std::uint64_t>(lives_.size()));
    for (const InternodeLife& life : lives_) put(out, life);
    put(out, static_cast<std::uint64_t>(living_.size()));
    for (const std::uint32_t life : living_) put(out, life);
}

void InternodeLives::restore(std::istream& in) {
    previous_step_ = get<int>(in);
    for (auto lives = get<std::uint64_t>(in); lives > 0; --lives) {
        lives_.push_back(get<InternodeLife>(in));
        if (lives_.back().alive > 1) throw RunError("the checkpoint is damaged");
    }
    for (auto living = get<std::uint64_t>(in); living > 0; --living) {
        living_.push_back(get<std::uint32_t>(in));
        if (living_.back() >= lives_.size()) throw RunError("the checkpoint is damaged");
    }
}

}  // namespace espalier::timeline
