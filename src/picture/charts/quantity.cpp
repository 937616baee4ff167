#include "picture/charts/quantity.h"

#include "espalier/base/error.h"

#include "base/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace espalier::picture {

std::string with_powers(const std::string& unit) {
    std::string text;
    for (const char c : unit) text += c == '2' ? "²" : c == '3' ? "³" : std::string(1, c);
    return text;
}

std::string quantity_title(const std::string& column) {
    if (column == "length" || column == "height") return column + " (m)";
    if (column == "volume") return "volume (m³)";
    if (column == "born" || column == "died") return column + " in the step";
    return column;
}

void require_quantity(std::span<const PlottedTable> tables, const std::string& quantity) {
    std::set<std::string> names;
    for (const PlottedTable& table : tables) {
        for (const std::string& name : table.table.columns) {
            if (name == quantity) return;
            if (name != "step" && name != "time" && name != "plant") names.insert(name);
        }
    }
    const std::string meant = did_you_mean(quantity, std::vector<std::string>(names.begin(), names.end()));
    throw UserError(fmt::format("there is no quantity '{}'{}", quantity,
                                meant.empty() ? fmt::format("; there are {}", fmt::join(names, ", ")) : meant));
}

std::optional<std::size_t> column_of(const RecordedTable& table, const std::string& name) {
    const auto found = std::find(table.columns.begin(), table.columns.end(), name);
    if (found == table.columns.end()) return std::nullopt;
    return static_cast<std::size_t>(found - table.columns.begin());
}

QuantityColumn::QuantityColumn(const RecordedTable& table, const std::string& quantity) {
    value_ = column_of(table, quantity);
    for (const auto& [of_some, count] : {std::pair{".mean", ".queries"}, std::pair{".min", ".queries"},
                                         std::pair{".max", ".queries"}, std::pair{".chosen", ".grown"}}) {
        if (!quantity.ends_with(of_some)) continue;
        weight_ = column_of(table, quantity.substr(0, quantity.rfind('.')) + count);
    }
}

void Merged::add(double value, double weight) {
    if (std::isnan(value) || !(weight > 0)) return;
    if (way_ == Way::mean)
        value_ += weight * value;
    else if (way_ == Way::sum)
        value_ += value;
    else if (weights_ == 0)
        value_ = value;
    else
        value_ = way_ == Way::greatest ? std::max(value_, value) : std::min(value_, value);
    weights_ += weight;
}

double Merged::value() const {
    if (weights_ == 0) return std::numeric_limits<double>::quiet_NaN();
    return way_ == Way::mean ? value_ / weights_ : value_;
}

Merged::Way Merged::way_of(const std::string& quantity) {
    static const std::set<std::string> sums{"modules", "queries", "internodes", "organs",    "length", "volume", "born",
                                            "died",    "tips",    "forks",      "leaf_area", "leaves", "surface"};
    if (sums.contains(quantity)) return Way::sum;
    if (quantity == "height" || quantity.ends_with(".max") || quantity.ends_with(".maximum")) return Way::greatest;
    if (quantity.ends_with(".min") || quantity.ends_with(".minimum")) return Way::least;
    return Way::mean;
}

}  // namespace espalier::picture
