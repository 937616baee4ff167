#include "espalier/lsystem/lineage.h"

#include "espalier/base/stop.h"

#include <algorithm>

namespace espalier::lsystem {
namespace {

/// Rows that a table of so many has room for. Memory costs nothing before it is touched, which that of small blocks
/// mostly has been; copies are what is spared.
std::size_t room_for(std::size_t rows) {
    constexpr std::size_t few = 4096, many = 1'500'000;
    const std::size_t grown = rows + rows / 2;
    return rows < few ? grown : std::max(grown, std::min(4 * rows, many));
}

/// Part by part, so that it can be stopped: tens of millions of rows take a moment.
void copy_rows(const Column<Siblings>& from, std::size_t rows, Column<Siblings>& to) {
    constexpr std::size_t part = std::size_t{1} << 16;
    for (std::size_t begin = 0; begin < rows; begin += part) {
        end_if_asked();
        std::copy_n(from.data() + begin, std::min(part, rows - begin), to.data() + begin);
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
    table.memory_ = std::make_shared<Memory>(room_for(table.size_));
    table.memory_->used = table.size_;
    if (size_ > 0) copy_rows(memory_->rows, size_, table.memory_->rows);
    return table;
}

}  // namespace espalier::lsystem
