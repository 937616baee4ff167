#include "studio/session/statistics.h"

#include "base/csv_file.h"
#include "base/number.h"

#include <string_view>
#include <utility>

namespace espalier::studio {
namespace {

struct StatisticsRows {
    static constexpr TypeName type{"Statistics", "rows of a table over time"};
    std::uint32_t growth = 0;
    std::vector<std::string> columns;
    std::map<std::string, std::string> units;
    std::vector<std::vector<Cell>> rows;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("growth", self.growth, "number of the growth");
        field("columns", self.columns, "the first is `step`; `plants` names the plants");
        field("units", self.units, "of columns that have one");
        field("rows", self.rows, "rows to add; those of a step that is known replace it");
    }
};

const Message<StatisticsRows> statistics_message{"statistics",
                                                 "rows of the table of the growth; some may come after it is done"};

Cell cell_of(const std::string& text) {
    if (const std::optional<double> value = whole_text_as<double>(text)) return *value;
    if (text.empty()) return nullptr;
    return text;
}

}  // namespace

void Statistics::add(const std::string& rows, const std::map<std::string, std::string>& units) {
    for (const auto& [column, unit] : units) {
        if (!unit.empty() && unit != "1") units_[column] = unit;
    }
    std::size_t begin = 0;
    for (std::size_t end; (end = rows.find('\n', begin)) != std::string::npos; begin = end + 1) {
        std::vector<std::string> cells = csv_cells(std::string_view(rows).substr(begin, end - begin));
        if (columns_.empty()) {
            columns_ = std::move(cells);
            untold_ = 0;
        } else {
            rows_.push_back(std::move(cells));
        }
    }
}

void Statistics::clear() {
    columns_.clear();
    rows_.clear();
}

Json Statistics::message(std::uint32_t growth, std::size_t first) const {
    StatisticsRows table{growth, columns_, units_, {}};
    for (std::size_t i = first; i < rows_.size(); ++i) {
        std::vector<Cell>& row = table.rows.emplace_back();
        for (const std::string& text : rows_[i]) row.push_back(cell_of(text));
    }
    return statistics_message(table);
}

Json Statistics::take_untold(std::uint32_t growth) {
    return message(growth, std::exchange(untold_, rows_.size()));
}

}  // namespace espalier::studio
