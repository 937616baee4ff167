// Who the modules of a string are, who bore them and when: eight bytes a module, and a row for each set of siblings.
#pragma once

#include "espalier/base/column.h"
#include "espalier/base/random.h"
#include "espalier/base/stations.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace espalier::lsystem {

/// A module's name for life: a hash of its parent's identity, the step of its birth and its place among its siblings.
using Identity = std::uint64_t;

/// What modules share that were born of one parent in one step.
struct Siblings {
    static constexpr std::uint32_t axiom = 0xFFFFFFFF;

    Identity parent;      ///< identity of the parent; for the axiom, what its identities are made from
    std::uint32_t step;   ///< step of birth
    std::uint32_t depth;  ///< level of the decomposition that made them, 0: the production itself; or `axiom`
    /// With a module's place it is the module's number, once these are given (birth_numbers.h): it may be below 0,
    /// which wraps around. It has no value of its own, so that rows that a table has room for are not touched.
    std::uint64_t first_number;

    Identity identity(std::uint32_t place) const { return mix(origin() ^ place); }
    /// What the identities of all siblings are made from.
    std::uint64_t origin() const {
        const std::uint64_t level = depth == axiom ? 0 : depth;
        return mix(parent, step) ^ level << 32;
    }
    /// Whether these are the same siblings, though in another row.
    bool is_same_as(const Siblings& other) const {
        return parent == other.parent && step == other.step && depth == other.depth;
    }
};

/// Where a module stands in its lineage: the row of its siblings, and its place among them.
struct Birth {
    std::uint32_t siblings;
    std::uint32_t place;

    friend bool operator==(const Birth&, const Birth&) = default;
};

/// The rows of siblings that a string's modules were born in. It grows at its end only, so strings that were made from
/// one another share its memory; rows of older strings stay as they are while a step adds its own.
class SiblingTable {
public:
    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    const Siblings& operator[](std::size_t row) const { return memory_->rows[row]; }
    std::size_t bytes() const { return size_ * sizeof(Siblings); }

    /// This table and so many more rows, which the caller writes before they are read. Throws std::bad_alloc.
    SiblingTable grown(std::size_t more) const;
    /// To write a row that grown() added.
    Siblings& added(std::size_t row) { return memory_->rows[row]; }
    void clear() { *this = {}; }

private:
    struct Memory {
        explicit Memory(std::size_t capacity) : rows(capacity) {}

        Column<Siblings> rows;
        std::atomic<std::size_t> used = 0;  ///< by the string that has most of them
    };

    std::shared_ptr<Memory> memory_;
    std::size_t size_ = 0;
};

}  // namespace espalier::lsystem
