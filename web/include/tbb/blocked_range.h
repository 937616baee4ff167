// What Espalier takes of oneTBB, on the one thread that a worker of a page has.
#pragma once

#include <cstddef>

namespace tbb {

struct split {};

template <class Value>
class blocked_range {
public:
    using const_iterator = Value;
    using size_type = std::size_t;

    blocked_range(Value begin, Value end, size_type grain = 1) : begin_(begin), end_(end), grain_(grain) {}

    Value begin() const { return begin_; }
    Value end() const { return end_; }
    size_type size() const { return static_cast<size_type>(end_ - begin_); }
    size_type grainsize() const { return grain_; }
    bool empty() const { return !(begin_ < end_); }

private:
    Value begin_, end_;
    size_type grain_;
};

struct auto_partitioner {};
struct simple_partitioner {};
struct static_partitioner {};

}  // namespace tbb
