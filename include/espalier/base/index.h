// Indices that the compiler keeps apart: the number of a point is taken for that of no internode.
#pragma once

#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace espalier {

/// The number of one of `Of`, from 0 on; without one it is none. It is the integer that it holds, in memory and in
/// time.
template <class Of>
struct Index {
    std::int32_t number = -1;

    constexpr Index() = default;
    template <std::integral Number>
    constexpr explicit Index(Number number_) : number(static_cast<std::int32_t>(number_)) {}

    constexpr bool is_none() const { return number < 0; }
    /// Row of a column that is indexed by any number.
    constexpr std::size_t row() const { return static_cast<std::size_t>(number); }
    constexpr Index& operator++() { return ++number, *this; }
    constexpr Index next() const { return Index(number + 1); }
    constexpr Index before() const { return Index(number - 1); }
    constexpr auto operator<=>(const Index&) const = default;
};

/// One value for each of `Of`: only their indices index it.
template <class Of, class T>
struct RowsOf : private std::vector<T> {
    using Vector = std::vector<T>;
    using Vector::back, Vector::begin, Vector::emplace_back, Vector::empty, Vector::end, Vector::front,
        Vector::push_back, Vector::size, Vector::Vector;

    decltype(auto) operator[](Index<Of> index) { return Vector::operator[](index.row()); }
    decltype(auto) operator[](Index<Of> index) const { return Vector::operator[](index.row()); }
    /// The index that the next to be added gets.
    Index<Of> next() const { return Index<Of>(size()); }
};

}  // namespace espalier

template <class Of>
struct std::hash<espalier::Index<Of>> {
    std::size_t operator()(espalier::Index<Of> index) const { return index.row(); }
};
