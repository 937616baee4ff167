// Loops over several threads.
#pragma once

#include "espalier/base/stop.h"

#include "base/shared_work.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <cstddef>
#include <type_traits>
#include <utility>

namespace espalier {

/// tbb::parallel_for.
template <class Range, class Body, class... Partitioner>
void for_all_in_parallel(const Range& range, const Body& body, const Partitioner&... partitioner) {
    SharedWork work;
    tbb::parallel_for(
        range,
        [&](const Range& part) {
            const SharedWork::Part shared(work);
            body(part);
        },
        partitioner...);
}

/// The same, with parts that belong to the work around it: they end when it is asked to.
template <class Range, class Body, class... Partitioner>
void for_in_parallel(const Range& range, const Body& body, const Partitioner&... partitioner) {
    const StopRequest* const request = StopRequest::current();
    const auto part_of_work = [&](const Range& part) {
        const StopRequest::Scope scope(request);
        end_if_asked();
        body(part);
    };
    for_all_in_parallel(range, part_of_work, partitioner...);
}

/// The same with body(i) for each i from `first` to before `end`.
template <class Index, class Body, class... Partitioner>
requires std::is_integral_v<Index>
void for_in_parallel(Index first, Index end, const Body& body, const Partitioner&... partitioner) {
    const auto each = [&](const tbb::blocked_range<Index>& part) {
        for (Index i = part.begin(); i != part.end(); ++i) {
            end_if_asked();
            body(i);
        }
    };
    for_in_parallel(tbb::blocked_range<Index>(first, end), each, partitioner...);
}

/// tbb::parallel_reduce of values: add(range, value) adds a part to a value, join(a, b) makes one of two.
template <class Range, class Value, class Add, class Join>
Value reduce_in_parallel(const Range& range, const Value& identity, const Add& add, const Join& join) {
    SharedWork work;
    return tbb::parallel_reduce(
        range, identity,
        [&](const Range& part, Value value) {
            const SharedWork::Part shared(work);
            return add(part, std::move(value));
        },
        [&](Value a, const Value& b) {
            const SharedWork::Part shared(work);
            return join(std::move(a), b);
        });
}

/// body(i) for each i below `count`, by this thread alone if there is little to do; `work` is about how many simple
/// things all of them do.
template <class Body>
void for_each_if_worth(std::size_t count, std::size_t work, const Body& body) {
    constexpr std::size_t worth_sharing = 20000;
    if (work >= worth_sharing) return for_in_parallel(std::size_t{0}, count, body);
    for (std::size_t i = 0; i < count; ++i) body(i);
}

}  // namespace espalier
