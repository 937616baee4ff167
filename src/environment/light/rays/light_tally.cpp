#include "environment/light/rays/light_tally.h"

#include <cmath>

namespace espalier::environment {
namespace {

std::uint64_t units(double weight) {
    return static_cast<std::uint64_t>(std::int64_t{std::llround(weight * 0x1p32)});
}

/// By the compiler's own function: libc++ has std::atomic_ref from version 19 on alone.
void add_atomically(std::uint64_t& sum, double weight) {
    __atomic_fetch_add(&sum, units(weight), __ATOMIC_RELAXED);
}

}  // namespace

void LightTally::begin(std::size_t slots, std::uint32_t paths) {
    paths_ = paths;
    for (Sums* sums : {&absorbed_, &front_, &back_}) sums->assign(slots * bands_, 0);
    direct_.assign(slots * of_slot(), 0);
    sun_.assign(slots, 0);
    towards_.assign(3 * slots, 0);
    through_sensors_.assign(through_sensors_.size(), 0);
    ends_ = {};
}

void LightTally::add(Sums& sums, std::size_t slot, const BandWeights& weights) const {
    for (std::size_t b = 0; b < bands_; ++b) add_atomically(sums[slot * bands_ + b], weights[b]);
}

void LightTally::add(OfBands& sums, const BandWeights& weights) const {
    for (std::size_t b = 0; b < bands_; ++b) sums[b] += units(weights[b]);
}

void LightTally::take(OfBands& sums, const BandWeights& weights) const {
    for (std::size_t b = 0; b < bands_; ++b) sums[b] -= units(weights[b]);
}

void LightTally::meet_first(std::size_t slot, const LightPath& path) {
    if (path.from_sun) add_atomically(sun_[slot], path.weights[0]);
    for (int k = 0; k < 3; ++k) {
        add_atomically(towards_[3 * slot + static_cast<std::size_t>(k)], -path.weights[0] * path.direction[k]);
    }
}

void LightTally::meet_directly(std::size_t slot, const LightPath& path, bool on_back, const BandWeights& kept) {
    double* const sums = &direct_[slot * of_slot()];
    for (std::size_t b = 0; b < bands_; ++b) {
        sums[3 * b + on_back] += path.weights[b];
        sums[3 * b + 2] += kept[b];
    }
    if (path.bounce > 0) return;  // what has been scattered is of no direction
    if (path.from_sun) sums[3 * bands_] += path.weights[0];
    for (int k = 0; k < 3; ++k)
        sums[3 * bands_ + 1 + static_cast<std::size_t>(k)] -= path.weights[0] * path.direction[k];
}

void LightTally::Ends::add(const Ends& other) {
    for (std::size_t b = 0; b < most_bands; ++b) {
        brought[b] += other.brought[b];
        soil[b] += other.soil[b];
        solids[b] += other.solids[b];
        escaped[b] += other.escaped[b];
    }
}

glm::dvec3 LightTally::towards(std::size_t slot) const {
    const double* const seen = direct(slot) + 3 * bands_ + 1;
    return {share(towards_[3 * slot], seen[0]), share(towards_[3 * slot + 1], seen[1]),
            share(towards_[3 * slot + 2], seen[2])};
}

}  // namespace espalier::environment
