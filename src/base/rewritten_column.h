// A column that every frame writes anew, over the values of the frame before.
#pragma once

#include "espalier/base/column.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

namespace espalier {

/// True also of the same numbers that are none.
template <class T>
bool same_bits(T a, T b) {
    if constexpr (std::is_same_v<T, float>)
        return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
    else if constexpr (std::is_same_v<T, double>)
        return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
    else
        return a == b;
}

/// Detects whether the values are those of the frame before, without keeping both.
template <class T>
class RewrittenColumn {
public:
    void begin() {
        before_ = size_;
        size_ = 0;
        changed_ = false;
    }
    /// Makes room for so many values in all.
    void reserve(std::size_t count) {
        if (count > values_.size()) values_.resize(count);
    }
    void add(const T& value) {
        add_tuples<1>(1, [&value](std::size_t, T* at) { *at = value; });
    }
    /// `write(i, at)` writes the N values of the i-th tuple.
    template <std::size_t N, class Write>
    void add_tuples(std::size_t count, const Write& write) {
        const std::size_t end = size_ + N * count;
        if (end > values_.size()) reserve(std::max(end, 2 * values_.size()));
        T* at = values_.data() + size_;
        if (end > before_) {
            for (std::size_t i = 0; i < count; ++i, at += N) write(i, at);
        } else {
            bool differs = false;
            for (std::size_t i = 0; i < count; ++i, at += N) {
                T tuple[N];
                write(i, tuple);
                for (std::size_t k = 0; k < N; ++k) differs |= !same_bits(at[k], tuple[k]);
                std::copy_n(tuple, N, at);
            }
            changed_ = changed_ || differs;
        }
        size_ = end;
    }

    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    const T& back() const { return values_[size_ - 1]; }
    /// What this frame has written so far.
    std::span<const T> values() const { return {values_.data(), size_}; }
    /// Asked when everything is written.
    bool changed() const { return changed_ || size_ != before_; }

private:
    Column<T> values_;  ///< longer than what is written
    std::size_t size_ = 0, before_ = 0;
    bool changed_ = false;
};

}  // namespace espalier
