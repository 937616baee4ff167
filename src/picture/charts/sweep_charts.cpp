#include "picture/charts/sweep_charts.h"

#include "base/number.h"
#include "picture/charts/quantity.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>

namespace espalier::picture {
namespace {

constexpr const char* seed_key = "simulation.seed";

/// A key that was varied, and its values in the order in which they are drawn.
struct Axis {
    std::size_t column;  ///< column of SweptRun::values
    std::string title;
    std::vector<std::string> names;
    std::vector<double> numbers;  ///< numbers that the names stand for; empty if they are none

    std::size_t index(const SweptRun& run) const {
        const auto found = std::find(names.begin(), names.end(), run.values[column]);
        return static_cast<std::size_t>(found - names.begin());
    }
    double place(std::size_t i) const { return numbers.empty() ? static_cast<double>(i) : numbers[i]; }
};

Axis axis_of(const SweptRuns& sweep, std::size_t column) {
    Axis axis{column, sweep.keys[column], {}, {}};
    for (const SweptRun& run : sweep.runs) {
        if (axis.index(run) == axis.names.size()) axis.names.push_back(run.values[column]);
    }
    const auto is_number = [](const std::string& name) { return finite_number(name).has_value(); };
    if (!std::all_of(axis.names.begin(), axis.names.end(), is_number)) return axis;
    std::sort(axis.names.begin(), axis.names.end(),
              [](const std::string& a, const std::string& b) { return *finite_number(a) < *finite_number(b); });
    for (const std::string& name : axis.names) axis.numbers.push_back(*finite_number(name));
    return axis;
}

/// What is varied, the key along x first: of those with numbers the one with the most values. Seeds make repetitions.
std::vector<Axis> axes_of(const SweptRuns& sweep) {
    std::vector<Axis> axes;
    for (std::size_t column = 0; column < sweep.keys.size(); ++column) {
        if (sweep.keys[column] != seed_key) axes.push_back(axis_of(sweep, column));
    }
    std::stable_sort(axes.begin(), axes.end(), [](const Axis& a, const Axis& b) {
        return std::pair(a.numbers.empty(), b.names.size()) < std::pair(b.numbers.empty(), a.names.size());
    });
    return axes;
}

/// The value a run ended with.
double value_of(const SweptRun& run, const std::string& quantity) {
    Merged merged(quantity);
    const QuantityColumn column(run.table, quantity);
    if (!column) return std::numeric_limits<double>::quiet_NaN();
    for (const std::vector<double>& row : run.table.last_rows()) merged.add(column.value(row), column.weight(row));
    return merged.value();
}

struct Spread {
    double mean = std::numeric_limits<double>::quiet_NaN(), deviation = 0;
};

/// With the standard deviation of a sample.
Spread spread_of(const std::vector<double>& values) {
    if (values.empty()) return {};
    const auto count = static_cast<double>(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
    double squares = 0;
    for (const double value : values) squares += (value - mean) * (value - mean);
    return {mean, values.size() < 2 ? 0 : std::sqrt(squares / (count - 1))};
}

/// Values of the runs of each place: along x, and of each line or row.
class Values {
public:
    Values(const SweptRuns& sweep, const std::vector<Axis>& axes, const std::string& quantity) {
        for (const SweptRun& run : sweep.runs) {
            const double value = value_of(run, quantity);
            std::vector<std::size_t> line;
            for (std::size_t i = 1; i < axes.size(); ++i) line.push_back(axes[i].index(run));
            std::vector<double>& there = values_[line][axes.empty() ? 0 : axes.front().index(run)];
            if (!std::isfinite(value)) continue;
            there.push_back(value);
            least_ = std::min(least_, value);
        }
    }
    /// Where bands end: what is never negative has none below 0.
    double lowest() const { return least_ >= 0 ? 0 : -std::numeric_limits<double>::infinity(); }
    const std::map<std::vector<std::size_t>, std::map<std::size_t, std::vector<double>>>& lines() const {
        return values_;
    }
    std::size_t size() const {
        std::size_t runs = 0;
        for (const auto& [line, places] : values_) {
            for (const auto& [place, values] : places) runs += values.size();
        }
        return runs;
    }
    bool has_repetitions() const {
        for (const auto& [line, places] : values_) {
            for (const auto& [place, values] : places) {
                if (values.size() > 1) return true;
            }
        }
        return false;
    }

private:
    std::map<std::vector<std::size_t>, std::map<std::size_t, std::vector<double>>> values_;
    double least_ = std::numeric_limits<double>::infinity();
};

std::string last_part(const std::string& key) {
    return key.substr(key.rfind('.') + 1);
}

/// "voxel=0.5, mode=add"
std::string line_name(const std::vector<Axis>& axes, const std::vector<std::size_t>& line) {
    std::vector<std::string> parts;
    for (std::size_t i = 0; i < line.size(); ++i) {
        parts.push_back(last_part(axes[i + 1].title) + "=" + axes[i + 1].names[line[i]]);
    }
    return fmt::format("{}", fmt::join(parts, ", "));
}

Chart line_chart(const std::vector<Axis>& axes, const Values& values, const std::string& title) {
    const Axis nothing{0, "", {fmt::format("{} runs", values.size())}, {}};
    const Axis& x = axes.empty() ? nothing : axes.front();
    Chart chart{x.title, title, {}, x.numbers.empty() ? x.names : std::vector<std::string>{}, {}};
    const bool repeated = values.has_repetitions();
    std::size_t key = 0;
    for (const auto& [line, places] : values.lines()) {
        Series means{key, {}, {}, {}, {}, true}, dots{key, {}, {}, {}, {}, false};
        for (const auto& [place, repetitions] : places) {
            const Spread spread = spread_of(repetitions);
            means.x.push_back(x.place(place));
            means.y.push_back(spread.mean);
            if (!repeated) continue;
            means.low.push_back(std::max(spread.mean - spread.deviation, values.lowest()));
            means.high.push_back(spread.mean + spread.deviation);
            for (const double value : repetitions) dots.x.push_back(x.place(place)), dots.y.push_back(value);
        }
        chart.series.push_back(std::move(means));
        if (repeated) chart.series.push_back(std::move(dots));
        ++key;
    }
    return chart;
}

Chart map_chart(const std::vector<Axis>& axes, const Values& values, const std::string& title) {
    HeatMap map{axes[0].names, axes[1].names, {}, title};
    map.values.assign(map.columns.size() * map.rows.size(), std::numeric_limits<double>::quiet_NaN());
    for (const auto& [line, places] : values.lines()) {
        for (const auto& [place, repetitions] : places) {
            map.values[line[0] * map.columns.size() + place] = spread_of(repetitions).mean;
        }
    }
    return {axes[0].title, axes[1].title, {}, {}, std::move(map)};
}

std::vector<Key> keys_of(const std::vector<Axis>& axes, const Values& values) {
    std::vector<Key> keys;
    for (const auto& [line, places] : values.lines()) {
        const auto number = static_cast<int>(keys.size());
        keys.push_back(
            {line_name(axes, line), number % Key::colour_count, number / Key::colour_count % Key::dash_count});
    }
    return keys;
}

}  // namespace

ChartPage sweep_page(const SweptRuns& sweep, const std::vector<std::string>& quantities, bool dark) {
    std::vector<PlottedTable> tables;
    for (const SweptRun& run : sweep.runs) tables.push_back({"", run.table, {}});
    const std::vector<std::string> shown = quantities.empty() ? default_quantities(tables) : quantities;
    const std::vector<Axis> axes = axes_of(sweep);
    const bool as_map = axes.size() == 2 && axes[1].names.size() > Key::colour_count;
    ChartPage page;
    page.title = sweep.title;
    page.dark = dark;
    for (const std::string& quantity : shown) {
        require_quantity(tables, quantity);
        const Values values(sweep, axes, quantity);
        const std::string title = quantity_title(quantity);
        page.charts.push_back(as_map ? map_chart(axes, values, title) : line_chart(axes, values, title));
        if (!as_map && page.keys.empty()) page.keys = keys_of(axes, values);
    }
    return page;
}

}  // namespace espalier::picture
