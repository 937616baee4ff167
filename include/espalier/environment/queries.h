// The questions to a process, read where the plants asked them.
#pragma once

#include "espalier/base/stations.h"
#include "espalier/turtle/query.h"

#include <compare>
#include <concepts>
#include <cstddef>
#include <iterator>
#include <span>

namespace espalier::environment {

/// In plant order, then string order. What it points to lasts as long as the exchange.
class Queries {
public:
    class Iterator {
    public:
        using iterator_category = std::random_access_iterator_tag;
        using value_type = Query;
        using difference_type = std::ptrdiff_t;
        using pointer = const Query*;
        using reference = const Query&;

        Iterator() = default;
        Iterator(const Query* rows, const Query* const* places, std::ptrdiff_t at)
            : rows_(rows), places_(places), at_(at) {}

        reference operator*() const { return (*this)[0]; }
        pointer operator->() const { return &(*this)[0]; }
        reference operator[](difference_type by) const { return places_ ? *places_[at_ + by] : rows_[at_ + by]; }
        Iterator& operator+=(difference_type by) {
            at_ += by;
            return *this;
        }
        Iterator& operator-=(difference_type by) { return *this += -by; }
        Iterator& operator++() { return *this += 1; }
        Iterator& operator--() { return *this -= 1; }
        Iterator operator++(int) { return {rows_, places_, at_++}; }
        Iterator operator--(int) { return {rows_, places_, at_--}; }
        friend Iterator operator+(Iterator from, difference_type by) { return from += by; }
        friend Iterator operator+(difference_type by, Iterator from) { return from += by; }
        friend Iterator operator-(Iterator from, difference_type by) { return from -= by; }
        friend difference_type operator-(const Iterator& a, const Iterator& b) { return a.at_ - b.at_; }
        friend bool operator==(const Iterator& a, const Iterator& b) { return a.at_ == b.at_; }
        friend auto operator<=>(const Iterator& a, const Iterator& b) { return a.at_ <=> b.at_; }

    private:
        const Query* rows_ = nullptr;
        const Query* const* places_ = nullptr;
        std::ptrdiff_t at_ = 0;
    };

    Queries() = default;
    /// Those of one plant, or copies.
    Queries(std::span<const Query> rows) : rows_(rows.data()), size_(rows.size()) {}
    template <class Rows>
    requires std::convertible_to<const Rows&, std::span<const Query>> Queries(const Rows& rows)
        : Queries(std::span<const Query>(rows)) {}
    /// Those of many plants.
    explicit Queries(std::span<const Query* const> places) : places_(places.data()), size_(places.size()) {}

    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    const Query& operator[](std::size_t i) const { return places_ ? *places_[i] : rows_[i]; }
    const Query& front() const { return (*this)[0]; }
    const Query& back() const { return (*this)[size_ - 1]; }
    Iterator begin() const { return {rows_, places_, 0}; }
    Iterator end() const { return {rows_, places_, static_cast<std::ptrdiff_t>(size_)}; }
    Queries subspan(std::size_t first, std::size_t count) const {
        Queries part;
        part.rows_ = places_ ? nullptr : rows_ + first;
        part.places_ = places_ ? places_ + first : nullptr;
        part.size_ = count;
        return part;
    }

private:
    const Query* rows_ = nullptr;
    const Query* const* places_ = nullptr;  ///< null: they are rows, one behind the other
    std::size_t size_ = 0;
};

}  // namespace espalier::environment
