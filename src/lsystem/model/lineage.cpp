#include "espalier/lsystem/lineage.h"

#include <algorithm>

namespace espalier::lsystem {

SiblingTable SiblingTable::grown(std::size_t more) const {
    SiblingTable table = *this;
    table.size_ += more;
    std::size_t used = size_;
    // If another string has grown behind this one already, its rows are not to be written over.
    const bool has_room = memory_ && memory_->rows.size() - size_ >= more;
    if (more == 0 || (has_room && memory_->used.compare_exchange_strong(used, table.size_))) return table;
    table.memory_ = std::make_shared<Memory>(table.size_ + table.size_ / 2);
    table.memory_->used = table.size_;
    if (size_ > 0) std::copy_n(memory_->rows.data(), size_, table.memory_->rows.data());
    return table;
}

}  // namespace espalier::lsystem
