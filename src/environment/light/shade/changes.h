// What changed between the pyramids of two steps.
#pragma once

#include "environment/light/shade/pyramid.h"

namespace espalier::environment {

struct ShadeChanges {
    std::vector<ShadeCast> gone, come;
};

/// Leaves in `changes` pyramids that are only in `before` or only in `now`, perhaps with some that are in both: lists
/// are read once, side by side, for a plant keeps the order of its organs. False if there are more than `most`.
bool find_changes(std::span<const ShadeCast> before, std::span<const ShadeCast> now, std::size_t most,
                  ShadeChanges& changes);

}  // namespace espalier::environment
