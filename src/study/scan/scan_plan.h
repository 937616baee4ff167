// A scan as a table of a file says it: the instrument, its beams, and what the points tell.
#pragma once

#include "espalier/base/settings.h"

#include "study/scan/point_files.h"

#include <optional>
#include <string>
#include <vector>

namespace espalier::study {

struct ScanPlan {
    std::vector<Beam> beams;
    ScanOptions options;
    int sides = 12;
    std::optional<double> ground = 0;  ///< m; none: there is none
    std::string extension = ".ply";
    PointFileOptions points;
};

/// Keys are the options of `espalier scan` with _ for -: at = [[x, y, z], ...], or fly = [[x, y, z], [x, y,
/// z]], or eye = [x, y, z] with target; angle, elevations = [low, high], ...; bare = true for no ground. Throws
/// UserError with file, line and column.
ScanPlan read_scan(const Settings& table);

/// Throws UserError beyond so many beams as fit into the memory of most machines.
void require_few_beams(double beams);

}  // namespace espalier::study
