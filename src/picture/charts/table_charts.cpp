#include "espalier/picture/table_charts.h"

#include "picture/charts/quantity.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

namespace espalier::picture {
namespace {

bool is_zero_throughout(const RecordedTable& table, std::size_t column) {
    return std::all_of(table.rows.begin(), table.rows.end(),
                       [&](const auto& row) { return !(std::abs(row[column]) > 0); });
}

/// "light.mean" is of the process light.
std::string process_of(const std::string& column) {
    const std::size_t dot = column.find('.');
    return dot == std::string::npos ? "" : column.substr(0, dot);
}

// The quantity that says most of a process.
std::string main_quantity(const std::vector<std::string>& of_process) {
    for (const char* ending : {".mean", ".uptake"}) {
        for (const std::string& name : of_process) {
            if (name.ends_with(ending)) return name;
        }
    }
    return of_process.front();
}

std::string species_of(const RecordedPlant& plant) {
    const std::string stem = std::filesystem::path(plant.model).stem().string();
    return stem.empty() ? plant.model : stem;
}

Lines lines_for(std::span<const PlottedTable> tables, Lines wanted) {
    if (wanted != Lines::chosen) return wanted;
    std::size_t most_plants = 0;
    std::set<std::string> species;
    for (const PlottedTable& table : tables) {
        most_plants = std::max(most_plants, table.plants.size());
        for (const RecordedPlant& plant : table.plants) species.insert(species_of(plant));
    }
    return most_plants <= 8 ? Lines::per_plant : species.size() > 1 ? Lines::per_species : Lines::total;
}

/// Which line each plant of a run belongs to.
std::map<double, std::string> groups_of(const PlottedTable& table, Lines lines) {
    std::map<double, std::string> groups;
    for (const RecordedPlant& plant : table.plants) {
        groups[plant.number] = lines == Lines::per_plant     ? plant.name
                               : lines == Lines::per_species ? species_of(plant)
                                                             : "";
    }
    return groups;
}

/// The page's keys. Of one run colours tell the lines, of several the runs, and dashes the lines.
class Keys {
public:
    Keys(std::span<const PlottedTable> tables, Lines lines) : several_runs_(tables.size() > 1) {
        for (std::size_t run = 0; run < tables.size(); ++run) {
            std::vector<std::string> names;
            for (const auto& [plant, group] : groups_of(tables[run], lines)) {
                if (std::find(names.begin(), names.end(), group) == names.end()) names.push_back(group);
            }
            for (const std::string& name : names) add(run, tables[run].run, name);
        }
    }

    const std::vector<Key>& all() const { return keys_; }
    std::size_t of(std::size_t run, const std::string& group) const { return numbers_.at({run, group}); }

private:
    void add(std::size_t run, const std::string& run_name, const std::string& group) {
        const auto line = groups_.emplace(group, groups_.size()).first->second;
        const std::size_t coloured = several_runs_ ? run : line;
        const std::size_t dashed = several_runs_ ? line + run / Key::colour_count : line / Key::colour_count;
        Key key{group, static_cast<int>(coloured % Key::colour_count), static_cast<int>(dashed % Key::dash_count)};
        if (several_runs_) key.name = group.empty() ? run_name : run_name + ": " + group;
        numbers_[{run, group}] = keys_.size();
        keys_.push_back(key);
    }

    bool several_runs_;
    std::vector<Key> keys_;
    std::map<std::string, std::size_t> groups_;
    std::map<std::pair<std::size_t, std::string>, std::size_t> numbers_;
};

void add_series(Chart& chart, const PlottedTable& table, std::size_t run, const std::string& quantity, const Keys& keys,
                const std::string& along, Lines lines, bool upright) {
    const QuantityColumn column(table.table, quantity);
    if (!column) return;
    if (!column_of(table.table, along)) return;  // of another run
    const std::size_t at_x = table.table.column(along), plant = table.table.column("plant");
    const std::map<double, std::string> groups = groups_of(table, lines);
    std::map<std::size_t, std::map<double, Merged>> values;  // values of each key, by x
    for (const std::vector<double>& row : table.table.rows) {
        const auto group = groups.find(row[plant]);
        if (group == groups.end() || !std::isfinite(row[at_x])) continue;
        Merged& merged = values[keys.of(run, group->second)].emplace(row[at_x], Merged(quantity)).first->second;
        merged.add(column.value(row), column.weight(row));
    }
    for (const auto& [key, by_step] : values) {
        Series series{key, {}, {}};
        for (const auto& [at, merged] : by_step) {
            series.x.push_back(at);
            series.y.push_back(merged.value());
        }
        if (upright) std::swap(series.x, series.y);
        chart.series.push_back(std::move(series));
    }
}

std::string title_of(const std::string& column, const PlotOptions& options) {
    const auto title = options.titles.find(column);
    return title == options.titles.end() ? quantity_title(column) : title->second;
}

}  // namespace

std::vector<std::string> default_quantities(std::span<const PlottedTable> tables) {
    std::vector<std::string> own, processes;
    std::map<std::string, std::vector<std::string>> of_processes;
    const auto shows = [&](const std::string& name) {
        return std::any_of(tables.begin(), tables.end(), [&](const PlottedTable& table) {
            const auto column = column_of(table.table, name);
            return column && !is_zero_throughout(table.table, *column);
        });
    };
    for (const char* name : {"height", "modules", "organs", "length", "volume", "born", "died"}) {
        if (shows(name)) own.emplace_back(name);
    }
    for (const PlottedTable& table : tables) {
        for (const std::string& name : table.table.columns) {
            const std::string process = process_of(name);
            if (process.empty() || !shows(name)) continue;
            std::vector<std::string>& names = of_processes[process];
            if (names.empty()) processes.push_back(process);
            if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
        }
    }
    constexpr std::size_t most_charts = 9;
    for (const std::string& process : processes) {
        if (own.size() < most_charts) own.push_back(main_quantity(of_processes[process]));
    }
    return own;
}

ChartPage chart_page(std::span<const PlottedTable> tables, const PlotOptions& options) {
    ChartPage page;
    page.dark = options.dark;
    if (tables.size() == 1) page.title = tables[0].run;
    const Lines lines = lines_for(tables, options.lines);
    const Keys keys(tables, lines);
    page.keys = keys.all();
    const std::vector<std::string> quantities =
        options.quantities.empty() ? default_quantities(tables) : options.quantities;
    for (const std::string& quantity : quantities) {
        require_quantity(tables, quantity);
        Chart chart{title_of(options.x, options), title_of(quantity, options), {}};
        for (std::size_t run = 0; run < tables.size(); ++run) {
            add_series(chart, tables[run], run, quantity, keys, options.x, lines, options.upright);
        }
        chart.upright = options.upright;
        if (chart.upright) std::swap(chart.x_title, chart.y_title);
        page.charts.push_back(std::move(chart));
    }
    return page;
}

}  // namespace espalier::picture
