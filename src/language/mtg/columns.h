// The columns of features: which are read, as what, and how often the others hold something.
#pragma once

#include "language/measured/notes.h"
#include "language/mtg/graph.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::language::mtg {

class Columns {
public:
    /// A line below FEATURES: a name and a type, and perhaps a unit of length.
    void declare(const std::vector<std::string>& words);
    /// The header's names, of which those of features begin at `first`.
    void head(const std::vector<std::string_view>& cells, std::size_t first);

    /// What the cells of a row say. Throws UserError for a date that is none, without place.
    Measures read(const std::vector<std::string_view>& cells, const Place& place, measured::Notes& notes);
    /// The cell of a column of this name, which then counts as read; "" if there is none.
    std::string_view cell(const std::vector<std::string_view>& cells, std::string_view name);

    /// Names what was not read.
    void tell_unused(measured::Notes& notes) const;
    /// The unit that was declared for a measure; "" if there is none.
    std::string unit_of(Measure measure) const;
    std::vector<std::string> names() const;
    std::vector<Measure> measures_read() const;
    bool has_days() const { return has_days_; }
    bool has_dates() const { return has_dates_; }  ///< its days are counted from 1970

private:
    struct Column {
        std::string name, small, type, unit;
        std::optional<Measure> measure = {};
        double factor = 1;
        int rank = 0;
        bool is_date = false, is_read = false;
        std::size_t filled = 0;
        Place first;
    };
    struct Declared {
        std::string name, type, unit;
    };

    void give_measure(Column& column);
    std::optional<double> number_in(const Column& column, std::string_view cell) const;

    std::vector<Declared> declared_;
    std::vector<Column> columns_;
    std::size_t first_ = 0;
    bool has_days_ = false, has_dates_ = false;
};

}  // namespace espalier::language::mtg
