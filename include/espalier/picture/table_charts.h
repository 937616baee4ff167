// Charts of the tables of runs: a line per plant, species or run, over the steps or another column.
#pragma once

#include "espalier/archive/recorded_run.h"
#include "espalier/base/stations.h"
#include "espalier/picture/chart_page.h"

#include <map>
#include <span>
#include <string>
#include <vector>

namespace espalier::picture {

/// A run's table with a column "plant" and one to draw over, such as its statistics over "step".
struct PlottedTable {
    std::string run;
    RecordedTable table;
    std::vector<RecordedPlant> plants;
};

enum class Lines { chosen, per_plant, per_species, total };

struct PlotOptions {
    std::vector<std::string> quantities;  ///< columns, one chart each; empty: `default_quantities`
    /// `chosen`: per plant up to 8 plants, else per species if there are several, else in total. A species is a model.
    Lines lines = Lines::chosen;
    std::string x = "step";                     ///< the column along the horizontal axis
    bool upright = false;                       ///< that column, a height, goes up instead
    std::map<std::string, std::string> titles;  ///< titles of columns: "crown volume (m3)"; else their names
    bool dark = false;
};

/// Chooses columns of statistics.csv: sizes, births and deaths, and one of each process (`mean` or `uptake` if it has
/// it), without those that are 0 throughout; at most 9.
std::vector<std::string> default_quantities(std::span<const PlottedTable> tables);

/// Lines of several plants in one: counts, lengths, areas and volumes are added up; of `height`, `*.max` and
/// `*.maximum` the greatest is shown, of `*.min` and `*.minimum` the least, of everything else the mean.
/// Throws UserError for a quantity that no table has, naming the nearest.
ChartPage chart_page(std::span<const PlottedTable> tables, const PlotOptions& options);

}  // namespace espalier::picture
