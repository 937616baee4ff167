// Where a walk puts rows of one kind: at the end of a column, or in a stretch of it that was counted before.
#pragma once

#include "espalier/base/stations.h"

#include <cstddef>
#include <span>

namespace espalier::turtle {

/// What a walk throws that meets more rows than were counted for it: its plan was wrong.
struct WrongPlan {};

/// How many rows there is room for after so many: of few, which thousands of plants keep between steps, a quarter more;
/// twice as many of more, which are copied each time.
constexpr std::size_t room_after(std::size_t rows) {
    constexpr std::size_t few = 4096;
    return rows < few ? rows + rows / 4 + 16 : 2 * rows;
}

/// `Rows` is a column whose resize() leaves new rows unwritten.
template <class Rows>
class RowWriter {
public:
    using Row = typename Rows::value_type;

    RowWriter() = default;
    RowWriter(const RowWriter&) = delete;
    RowWriter& operator=(const RowWriter&) = delete;

    /// Writes from the column's beginning; close() cuts off what was not written.
    void open(Rows& rows) {
        rows.resize(rows.capacity());
        open(std::span<Row>(rows));
        rows_ = &rows;
    }
    void open(std::span<Row> room) {
        rows_ = nullptr;
        begin_ = next_ = room.data();
        end_ = begin_ + room.size();
    }
    void close() {
        if (rows_) rows_->resize(size());
        rows_ = nullptr;
    }

    Row& add() {
        if (next_ == end_) make_room();
        return *next_++;
    }
    /// Those written from this one on.
    std::span<Row> from(std::size_t first) { return {begin_ + first, next_}; }
    std::size_t size() const { return std::size_t(next_ - begin_); }
    bool full() const { return next_ == end_; }

private:
    void make_room() {
        if (!rows_) throw WrongPlan();
        const std::size_t written = size();
        rows_->reserve(room_after(written));  // resize() alone would double it
        rows_->resize(rows_->capacity());
        begin_ = rows_->data();
        next_ = begin_ + written;
        end_ = begin_ + rows_->size();
    }

    Rows* rows_ = nullptr;
    Row *begin_ = nullptr, *next_ = nullptr, *end_ = nullptr;
};

}  // namespace espalier::turtle
