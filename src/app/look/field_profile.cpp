#include "field_profile.h"

#include "espalier/base/error.h"

#include "analysis/field_profile.h"
#include "base/csv_file.h"
#include "picture/charts/quantity.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace espalier::app {

FieldProfile::FieldProfile(CLI::App& app) : app_(app) {
    CLI::Option* field =
        app.add_option("--field", field_, "measure a recorded field instead of the plants, over one axis");
    app.add_option("--profile", axis_, "the axis of --field: x, y (default: over height and depth) or z")
        ->check(CLI::IsMember({"x", "y", "z"}))
        ->needs(field);
}

void FieldProfile::exclude(std::initializer_list<const char*> options) {
    for (const char* option : options) app_.get_option("--field")->excludes(app_.get_option(option));
}

RecordedTable FieldProfile::table(const RecordedRun& run, const std::vector<const RecordedFrame*>& frames) const {
    RecordedTable table = field_profile(run, frames, field_, axis_);
    if (!table.rows.empty()) return table;
    throw UserError(fmt::format("{} has no field '{}' at these steps", run.folder().string(), field_));
}

ChartPage FieldProfile::page(const RecordedRun& run, const RecordedTable& table, bool dark) const {
    constexpr std::size_t most_lines = 5;
    std::vector<double> steps;
    for (const auto& row : table.rows) {
        if (steps.empty() || steps.back() != row[0]) steps.push_back(row[0]);
    }
    const std::size_t lines = std::min(steps.size(), most_lines);
    const std::string unit = run.field(run.frame(static_cast<int>(steps.back())), field_).unit;
    const std::string value =
        unit.empty() || unit == "1" ? field_ : fmt::format("{} ({})", field_, picture::with_powers(unit));
    const std::string place = axis_ + " (m)";
    const bool upwards = axis_ == "y";
    ChartPage page{run.scene(), {}, {{upwards ? value : place, upwards ? place : value, {}}}, dark};
    for (std::size_t k = 0; k < lines; ++k) {
        const double step = steps[lines > 1 ? k * (steps.size() - 1) / (lines - 1) : 0];
        page.keys.push_back({fmt::format("step {}", step), static_cast<int>(k), 0});
        Series series{k, {}, {}};
        for (const auto& row : table.rows) {
            if (row[0] != step) continue;
            (upwards ? series.y : series.x).push_back(row[1]);
            (upwards ? series.x : series.y).push_back(row[2]);
        }
        page.charts[0].series.push_back(std::move(series));
    }
    return page;
}

std::string csv_of(const RecordedTable& table) {
    std::string text = fmt::format("{}\n", fmt::join(table.columns, ","));
    for (const std::vector<double>& row : table.rows) {
        std::vector<std::string> cells;
        for (const double value : row) cells.push_back(csv_number(value));
        text += fmt::format("{}\n", fmt::join(cells, ","));
    }
    return text;
}

}  // namespace espalier::app
