#include "espalier/lsystem/lineage.h"

#include "base/parallel.h"

#include <algorithm>

namespace espalier::lsystem {
namespace {

/// Rows that a table of so many has room for: where memory costs nothing before it is touched, as that of small blocks
/// does, copies are what is spared.
std::size_t room_for(std::size_t rows) {
    constexpr std::size_t few = 4096, many = 1'500'000;
    const std::size_t grown = rows + rows / 2;
    return rows < few ? grown : std::max(grown, std::min(4 * rows, many));
}

/// Of many rows part by part, so that it can be stopped: it takes seconds where strings have tens of millions of modules.
void copy_rows(const Siblings* from, std::size_t rows, Siblings* to) {
    constexpr std::size_t part = std::size_t{1} << 16;
    if (rows <= part) {
        std::copy_n(from, rows, to);
        return;
    }
    for_in_parallel(std::size_t{0}, (rows + part - 1) / part, [&](std::size_t k) {
        std::copy_n(from + k * part, std::min(part, rows - k * part), to + k * part);
    });
}

}  // namespace

SiblingTable SiblingTable::grown(std::size_t more) const {
    SiblingTable table = *this;
    if (more == 0) return table;
    table.size_ += more;
    std::size_t used = size_;
    // If another string has grown behind this one already, its rows are not to be written over.
    const bool has_room = memory_ && memory_->rows.size() - size_ >= more;
    if (has_room && memory_->used.compare_exchange_strong(used, table.size_)) return table;
    table.memory_ = std::make_shared<Memory>(room_for(table.size_));
    table.memory_->used = table.size_;
    if (size_ > 0) copy_rows(memory_->rows.data(), size_, table.memory_->rows.data());
    return table;
}

}  // namespace espalier::lsystem
