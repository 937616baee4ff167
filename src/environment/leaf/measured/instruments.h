// Instruments for gas exchange, and what their columns are called.
#pragma once

#include "environment/leaf/measured/leaf_records.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace espalier::environment::leaf {

struct InstrumentColumn {
    enum class Kind { rate, water, concentration, temperature, pressure, deficit };

    double LeafRecord::*value;
    Kind kind;
    const char* name;  ///< the first of its columns that a file has counts
    const char* unit;  ///< where the file says none
    bool is_needed = false;
};

struct Instrument {
    const char* name;
    std::vector<const char*> told_by;  ///< columns that together no other has
    std::vector<InstrumentColumn> columns;
    const char* kind_of_row = nullptr;  ///< a column whose text tells measurements: it begins with `measurement`
    const char* measurement = nullptr;
};

std::span<const Instrument> instruments();

/// How a number of a file becomes one of a record: (value + offset) times factor, and, of a deficit that is a share of
/// the pressure, times the pressure.
struct UnitOfColumn {
    double factor = 1, offset = 0;
    bool is_of_pressure = false;
};
/// None for a unit that this kind does not have.
std::optional<UnitOfColumn> unit_of_column(InstrumentColumn::Kind kind, const std::string& unit);
/// "mol m-2 s-1, mmol m-2 s-1": what a user may write.
std::string units_of_column(InstrumentColumn::Kind kind);

/// What a leaf and its air can have; beyond, a sensor was not there.
struct PossibleValues {
    double lowest, highest;
};
PossibleValues possible_values(double LeafRecord::*value);

}  // namespace espalier::environment::leaf
