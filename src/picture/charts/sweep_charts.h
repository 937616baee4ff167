// Charts of a sweep: what its runs ended with, over what was varied.
#pragma once

#include "espalier/archive/recorded_run.h"
#include "espalier/picture/chart_page.h"

#include <string>
#include <vector>

namespace espalier::picture {

struct SweptRun {
    std::vector<std::string> values;  ///< value of each key
    RecordedTable table;              ///< its statistics; the last step's rows are drawn
};

struct SweptRuns {
    std::string title;
    std::vector<std::string> keys;  ///< what was varied
    std::vector<SweptRun> runs;     ///< one at least
};

/// A chart for each quantity (empty: the main ones); several plants are merged as `chart_page` does. Runs that differ
/// in nothing but `simulation.seed` are drawn as their mean, a band of a standard deviation to each side, and dots. The
/// key with the most numbers goes along x and each value of the others is a line; where that would be more than seven
/// lines of two keys, it is a heat map of the means. Throws UserError for a quantity that no run has.
ChartPage sweep_page(const SweptRuns& sweep, const std::vector<std::string>& quantities, bool dark);

}  // namespace espalier::picture
