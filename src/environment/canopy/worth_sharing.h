// Loops that are shared among threads only if there is much to do.
#pragma once

#include "base/parallel.h"

#include <cstddef>

namespace espalier::environment {

/// body(i) for each i below `count`; `work` is about how many simple things all of them do.
template <class Body>
void for_each_if_worth(std::size_t count, std::size_t work, const Body& body) {
    constexpr std::size_t worth_sharing = 20000;
    if (work >= worth_sharing) return for_in_parallel(std::size_t{0}, count, body);
    for (std::size_t i = 0; i < count; ++i) body(i);
}

}  // namespace espalier::environment
