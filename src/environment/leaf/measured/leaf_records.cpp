#include "environment/leaf/measured/leaf_records.h"

#include "base/csv_rows.h"
#include "base/number.h"
#include "base/text.h"
#include "base/unit_text.h"
#include "environment/leaf/measured/instruments.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace espalier::environment::leaf {
namespace {

/// A column of an instrument where a file has it.
struct FoundColumn {
    const InstrumentColumn* column;
    std::size_t cell;
    UnitOfColumn unit;
    std::string written;  ///< the unit
};

std::optional<std::size_t> cell_named(const std::vector<std::string>& cells, const std::string& name) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (cells[i] == name || name_and_unit(cells[i]).name == name) return i;
    }
    return std::nullopt;
}

const Instrument* instrument_of(const std::vector<std::string>& names) {
    for (const Instrument& one : instruments()) {
        const bool has_all = std::all_of(one.told_by.begin(), one.told_by.end(),
                                         [&](const char* name) { return cell_named(names, name).has_value(); });
        if (has_all) return &one;
    }
    return nullptr;
}

class LeafFile {
public:
    explicit LeafFile(const std::filesystem::path& path) : path_(path), text_(table_text(path)) {}

    LeafRecords read() {
        find_names();
        const CsvRows table(path_, text_);
        find_columns(table);
        records_.instrument = instrument_->name;
        for (std::size_t i = first_; i < table.rows().size(); ++i) add(table.rows()[i]);
        if (records_.rows.empty()) {
            throw UserError({path_.string(), 0, 0},
                            fmt::format("this table of a {} has no measurement with all of {}{}", instrument_->name,
                                        needed_names(), records_.why.empty() ? "" : ": " + records_.why));
        }
        require_agreement();
        return std::move(records_);
    }

private:
    /// Empties the lines above the names of the columns: the rest is a table.
    void find_names() {
        constexpr int most_lines = 2000;
        std::size_t begin = 0;
        for (int line = 1; line <= most_lines && begin < text_.size(); ++line) {
            const std::size_t end = std::min(text_.find('\n', begin), text_.size());
            const CsvRows row(path_, text_.substr(begin, end - begin));
            instrument_ = row.rows().empty() ? nullptr : instrument_of(row.rows().front().cells);
            if (instrument_) {
                text_ = std::string(static_cast<std::size_t>(line - 1), '\n') + text_.substr(begin);
                return;
            }
            begin = end + 1;
        }
        std::vector<std::string> forms;
        for (const Instrument& one : instruments()) {
            forms.push_back(fmt::format("{} ({})", one.name, fmt::join(one.told_by, ", ")));
        }
        throw UserError(
            {path_.string(), 0, 0},
            fmt::format("no line of this file names the columns of an instrument: {}", fmt::join(forms, ", ")));
    }

    void find_columns(const CsvRows& table) {
        const CsvRow& names = table.rows().front();
        const CsvRow* const units = has_units(table) ? &table.rows()[1] : nullptr;
        first_ = units ? 2 : 1;
        for (const InstrumentColumn& column : instrument_->columns) {
            if (has(column.value)) continue;
            const std::optional<std::size_t> cell = cell_named(names.cells, column.name);
            if (!cell) continue;
            std::string unit = name_and_unit(names.cells[*cell]).unit;
            if (unit.empty() && units && *cell < units->cells.size()) unit = units->cells[*cell];
            if (unit.empty()) unit = column.unit;
            columns_.push_back({&column, *cell, known_unit(names, *cell, column, unit), plain_unit(unit)});
        }
        for (const InstrumentColumn& column : instrument_->columns) {
            if (!column.is_needed || has(column.value)) continue;
            throw UserError(
                {path_.string(), names.line, 0},
                fmt::format("this table of a {} has no column '{}': export it, too", instrument_->name, column.name));
        }
        if (instrument_->kind_of_row) kind_of_row_ = cell_named(names.cells, instrument_->kind_of_row);
    }

    bool has(double LeafRecord::*value) const {
        return std::any_of(columns_.begin(), columns_.end(),
                           [&](const FoundColumn& one) { return one.column->value == value; });
    }

    UnitOfColumn known_unit(const CsvRow& names, std::size_t cell, const InstrumentColumn& column,
                            const std::string& unit) const {
        if (const auto known = unit_of_column(column.kind, unit)) return *known;
        throw UserError({path_.string(), names.line, static_cast<int>(cell) + 1},
                        fmt::format("the column '{}' has the unit '{}': write one of {}", column.name,
                                    escaped(plain_unit(unit)), units_of_column(column.kind)));
    }

    /// The row below the names, if no measure of it is a number and some say a unit.
    bool has_units(const CsvRows& table) const {
        if (table.rows().size() < 2) return false;
        const CsvRow &names = table.rows()[0], &row = table.rows()[1];
        bool says_unit = false;
        for (const InstrumentColumn& column : instrument_->columns) {
            const std::optional<std::size_t> cell = cell_named(names.cells, column.name);
            if (!cell || *cell >= row.cells.size()) continue;
            if (row.number(*cell)) return false;
            says_unit = says_unit || !row.is_missing(*cell);
        }
        return says_unit;
    }

    void add(const CsvRow& row) {
        if (kind_of_row_ && *kind_of_row_ < row.cells.size() &&
            !row.cells[*kind_of_row_].starts_with(instrument_->measurement)) {
            return;
        }
        const bool has_numbers = std::any_of(columns_.begin(), columns_.end(), [&](const FoundColumn& one) {
            return one.column->is_needed && row.number(one.cell).has_value();
        });
        if (!has_numbers) return;  // a remark
        LeafRecord record;
        record.line = row.line;
        for (const FoundColumn& column : columns_) record.*column.column->value = value_in(row, column);
        for (const FoundColumn& column : columns_) {
            if (column.unit.is_of_pressure) record.*column.column->value *= record.pressure;
        }
        for (const FoundColumn& column : columns_) {
            const double value = record.*column.column->value;
            const PossibleValues possible = possible_values(column.column->value);
            if (value >= possible.lowest && value <= possible.highest) continue;
            record.*column.column->value = not_measured;
            if (column.column->is_needed) return leave_out(row, column);
        }
        records_.rows.push_back(record);
    }

    static double value_in(const CsvRow& row, const FoundColumn& column) {
        const std::optional<double> value = row.is_missing(column.cell) ? std::nullopt : row.number(column.cell);
        return value ? (*value + column.unit.offset) * column.unit.factor : not_measured;
    }

    void leave_out(const CsvRow& row, const FoundColumn& column) {
        if (records_.left_out++ > 0) return;
        records_.why = fmt::format("in line {} '{}' is '{}'", row.line, column.column->name,
                                   column.cell < row.cells.size() ? escaped(row.cells[column.cell]) : "");
    }

    std::string needed_names() const {
        std::vector<std::string> names;
        for (const FoundColumn& one : columns_) {
            if (one.column->is_needed) names.emplace_back(one.column->name);
        }
        return fmt::format("{}", fmt::join(names, ", "));
    }

    /// E = g D / P with g of stomata and air: units that are wrong are wrong by 10 or 1,000.
    void require_agreement() const {
        constexpr double most = 4;
        std::vector<double> ratios;
        for (const LeafRecord& row : records_.rows) {
            double g = row.conductance;
            if (row.boundary > 0) g = g * row.boundary / (g + row.boundary);
            const double ratio = row.transpiration * row.pressure / (row.deficit * g);
            if (row.deficit > 0.1 && g > 0 && std::isfinite(ratio) && ratio > 0) ratios.push_back(ratio);
        }
        if (ratios.empty()) return;
        std::nth_element(ratios.begin(), ratios.begin() + static_cast<long>(ratios.size() / 2), ratios.end());
        const double ratio = ratios[ratios.size() / 2];
        if (ratio < most && ratio > 1 / most) return;
        std::vector<std::string> units;
        for (const FoundColumn& one : columns_) {
            for (double LeafRecord::*const value :
                 {&LeafRecord::conductance, &LeafRecord::transpiration, &LeafRecord::deficit, &LeafRecord::pressure}) {
                if (one.column->value == value) units.push_back(fmt::format("{} ({})", one.column->name, one.written));
            }
        }
        throw UserError({path_.string(), 0, 0},
                        fmt::format("{} do not belong together: transpiration is {:.3g} times what the others give; "
                                    "write the unit that is meant behind the name of its column",
                                    fmt::join(units, ", "), ratio));
    }

    std::filesystem::path path_;
    std::string text_;
    const Instrument* instrument_ = nullptr;
    std::vector<FoundColumn> columns_;
    std::optional<std::size_t> kind_of_row_;
    std::size_t first_ = 1;  ///< row of the table with a measurement
    LeafRecords records_;
};

}  // namespace

LeafRecords read_leaf_records(const std::filesystem::path& path) {
    return LeafFile(path).read();
}

}  // namespace espalier::environment::leaf
