// What instruments measured of leaves: rows of gas exchange, in one set of units.
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace espalier::environment::leaf {

inline constexpr double not_measured = std::numeric_limits<double>::quiet_NaN();

/// One row of a file; what it does not tell is NaN. Per area of one side of the leaf.
struct LeafRecord {
    int line = 0;                          ///< of the file
    double assimilation = not_measured;    ///< A, umol m-2 s-1
    double conductance = not_measured;     ///< gs, of stomata to water vapour, mol m-2 s-1
    double transpiration = not_measured;   ///< E, mol m-2 s-1
    double internal = not_measured;        ///< Ci, umol mol-1
    double incident = not_measured;        ///< photons of PAR on the leaf, umol m-2 s-1
    double absorbed = not_measured;        ///< those that it absorbs, where the instrument says so
    double temperature = not_measured;     ///< of the leaf, degrees Celsius
    double deficit = not_measured;         ///< vapour pressure in the leaf less that of the chamber's air, kPa
    double pressure = not_measured;        ///< of the air, kPa
    double carbon_dioxide = not_measured;  ///< Ca, of the chamber's air, umol mol-1
    double boundary = not_measured;        ///< conductance of the chamber's air to water vapour, mol m-2 s-1
};

struct LeafRecords {
    std::string instrument;  ///< "LI-6800"
    std::vector<LeafRecord> rows;
    std::size_t left_out = 0;  ///< rows that lack a value that is needed
    std::string why;           ///< of the first of them
};

/// Reads a table of a LI-6400, LI-6800 (LI-COR), GFS-3000 (Walz) or CIRAS-4 (PP Systems), told by the names of its
/// columns. Units are those of the row below the names, or behind a name in brackets; else the instrument's own. Throws
/// UserError naming the line for a file of none of them, for units that are not known, where a needed column is
/// missing, and where conductance, transpiration, deficit and pressure cannot belong together.
LeafRecords read_leaf_records(const std::filesystem::path& path);

}  // namespace espalier::environment::leaf
