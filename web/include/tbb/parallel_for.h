#pragma once

#include <tbb/blocked_range.h>

#include <type_traits>

namespace tbb {

template <class Range, class Body, class... Partitioner>
    requires(!std::is_integral_v<Range>)
void parallel_for(const Range& range, const Body& body, const Partitioner&...) {
    if (!range.empty()) body(range);
}

template <class Index, class Body, class... Partitioner>
    requires std::is_integral_v<Index>
void parallel_for(Index first, Index end, const Body& body, const Partitioner&...) {
    for (Index i = first; i < end; ++i) body(i);
}

}  // namespace tbb
