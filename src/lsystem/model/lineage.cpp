#include "espalier/lsystem/lineage.h"

#include "espalier/base/stop.h"

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

/// Makes room for rows part by part, so that it can be stopped: where strings have tens of millions of modules it takes
/// seconds.
void make_room(Column<Siblings>& table, std::size_t rows) {
    constexpr std::size_t part = std::size_t{1} << 16;
    table.reserve(rows);
    while (table.size() < rows) {
        end_if_asked();
        table.resize(std::min(table.size() + part, rows));
    }
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
    table.memory_ = std::make_shared<Memory>(0);
    make_room(table.memory_->rows, room_for(table.size_));
    table.memory_->used = table.size_;
    if (size_ > 0) std::copy_n(memory_->rows.data(), size_, table.memory_->rows.data());
    return table;
}

}  // namespace espalier::lsystem
