// Points of a scan as files of other programs.
#pragma once

#include "study/scan/scan.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace espalier::study {

/// What is told of points, beside whom they belong to.
struct PointNames {
    std::vector<std::string> plants, symbols;  ///< by number
    int step = 0;                              ///< of the frame: age is counted from there
};

/// x, y, z (m), distance (m), intensity, return, returns, beam, plant, organ (identity), symbol, order, age (steps);
/// and, where they are asked for, echo_width (ns), time (s), zenith and azimuth (degrees) of the beam. Points of the
/// ground have the plant -1.
const std::vector<std::string>& point_columns();

struct PointFileOptions {
    std::vector<std::string> columns;  ///< empty: the usual ones; "helios++" alone: those of that program
    char up = 'y';                     ///< or 'z'
};

/// By the extension: .csv, .xyz (numbers between blanks, without a header), .ply (binary) or .vtp. Complete or not at
/// all. Throws UserError for other extensions and unknown columns, RunError.
void write_points(std::span<const ScanPoint> points, const ScannedPlants& plants, const PointNames& names,
                  const PointFileOptions& options, const std::filesystem::path& path);
/// Throws UserError for what write_points() would refuse.
void require_point_file(const std::filesystem::path& path, const PointFileOptions& options);

}  // namespace espalier::study
