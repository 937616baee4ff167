#include "environment/leaf/measured/instruments.h"

#include "base/unit_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

namespace espalier::environment::leaf {
namespace {

using Kind = InstrumentColumn::Kind;
using Record = LeafRecord;

std::vector<Instrument> all_instruments() {
    return {
        {"LI-6400",
         {"Photo", "Cond", "Ci"},
         {{&Record::assimilation, Kind::rate, "Photo", "umol", true},
          {&Record::internal, Kind::concentration, "Ci", "umol/mol", true},
          {&Record::temperature, Kind::temperature, "Tleaf", "C", true},
          {&Record::incident, Kind::rate, "PARi", "umol", true},
          {&Record::pressure, Kind::pressure, "Press", "kPa", true},
          {&Record::conductance, Kind::water, "Cond", "mol"},
          {&Record::transpiration, Kind::water, "Trmmol", "mmol"},
          {&Record::deficit, Kind::deficit, "VpdL", "kPa"},
          {&Record::carbon_dioxide, Kind::concentration, "CO2S", "umol/mol"},
          {&Record::boundary, Kind::water, "BLCond", "mol"}}},
        {"LI-6800",
         {"A", "gsw", "Ci"},
         {{&Record::assimilation, Kind::rate, "A", "umol", true},
          {&Record::internal, Kind::concentration, "Ci", "umol/mol", true},
          {&Record::temperature, Kind::temperature, "Tleaf", "C", true},
          {&Record::temperature, Kind::temperature, "TleafCnd", "C", true},
          {&Record::incident, Kind::rate, "Qin", "umol", true},
          {&Record::absorbed, Kind::rate, "Qabs", "umol"},
          {&Record::pressure, Kind::pressure, "Pa", "kPa", true},
          {&Record::conductance, Kind::water, "gsw", "mol"},
          {&Record::transpiration, Kind::water, "E", "mol"},
          {&Record::transpiration, Kind::water, "Emm", "mmol"},
          {&Record::deficit, Kind::deficit, "VPDleaf", "kPa"},
          {&Record::carbon_dioxide, Kind::concentration, "Ca", "umol/mol"},
          {&Record::boundary, Kind::water, "gbw", "mol"}}},
        {"GFS-3000",
         {"A", "GH2O", "PARtop"},
         {{&Record::assimilation, Kind::rate, "A", "umol", true},
          {&Record::internal, Kind::concentration, "ci", "umol/mol", true},
          {&Record::temperature, Kind::temperature, "Tleaf", "C", true},
          {&Record::incident, Kind::rate, "PARtop", "umol", true},
          {&Record::pressure, Kind::pressure, "Pamb", "kPa", true},
          {&Record::conductance, Kind::water, "GH2O", "mmol"},
          {&Record::transpiration, Kind::water, "E", "mmol"},
          {&Record::deficit, Kind::deficit, "VPD", "Pa/kPa"},
          {&Record::carbon_dioxide, Kind::concentration, "ca", "umol/mol"}},
         "Code",
         "MP"},
        {"CIRAS-4",
         {"A", "gs", "Patm"},
         {{&Record::assimilation, Kind::rate, "A", "umol", true},
          {&Record::internal, Kind::concentration, "Ci", "umol/mol", true},
          {&Record::temperature, Kind::temperature, "Tleaf", "C", true},
          {&Record::incident, Kind::rate, "PARi", "umol", true},
          {&Record::pressure, Kind::pressure, "Patm", "hPa", true},
          {&Record::conductance, Kind::water, "gs", "mmol"},
          {&Record::transpiration, Kind::water, "E", "mmol"},
          {&Record::deficit, Kind::deficit, "VPD", "kPa"},
          {&Record::carbon_dioxide, Kind::concentration, "CO2a", "umol/mol"}}},
    };
}

struct NamedUnit {
    Kind kind;
    const char* name;  ///< what a unit of the file begins with
    UnitOfColumn unit;
};

/// The longest first where one is the beginning of another.
const std::vector<NamedUnit>& named_units() {
    static const std::vector<NamedUnit> all{
        {Kind::rate, "umol", {}},
        {Kind::water, "umol", {1e-6}},
        {Kind::water, "mmol", {1e-3}},
        {Kind::water, "mol", {}},
        {Kind::concentration, "umol", {}},
        {Kind::concentration, "ppm", {}},
        {Kind::concentration, "vpm", {}},
        {Kind::temperature, "degC", {}},
        {Kind::temperature, "C", {}},
        {Kind::temperature, "K", {1, -273.15}},
        {Kind::deficit, "Pa/kPa", {1e-3, 0, true}},
        {Kind::deficit, "mmol", {1e-3, 0, true}},
        {Kind::deficit, "kPa", {}},
        {Kind::deficit, "hPa", {0.1}},
        {Kind::deficit, "mbar", {0.1}},
        {Kind::deficit, "Pa", {1e-3}},
        {Kind::pressure, "kPa", {}},
        {Kind::pressure, "hPa", {0.1}},
        {Kind::pressure, "mbar", {0.1}},
        {Kind::pressure, "Pa", {1e-3}},
    };
    return all;
}

/// "umol m-2 s-1" begins with "umol", "Pa/kPa" does not with "Pa".
bool begins_with_unit(const std::string& text, const std::string& unit) {
    if (!text.starts_with(unit)) return false;
    static const std::string behind = " _.-*";
    if (text.size() == unit.size()) return true;
    const bool is_per_amount = unit.ends_with("mol") && text[unit.size()] == '/';
    return is_per_amount || behind.find(text[unit.size()]) != std::string::npos;
}

}  // namespace

std::span<const Instrument> instruments() {
    static const std::vector<Instrument> all = all_instruments();
    return all;
}

std::optional<UnitOfColumn> unit_of_column(InstrumentColumn::Kind kind, const std::string& unit) {
    const std::string plain = plain_unit(unit);
    for (const NamedUnit& one : named_units()) {
        if (one.kind == kind && begins_with_unit(plain, one.name)) return one.unit;
    }
    return std::nullopt;
}

std::string units_of_column(InstrumentColumn::Kind kind) {
    const char* const behind = kind == Kind::rate || kind == Kind::water ? " m-2 s-1" : "";
    std::vector<std::string> names;
    for (const NamedUnit& one : named_units()) {
        if (one.kind != kind) continue;
        const std::string name = one.name;
        const bool is_share = !*behind && name.ends_with("mol");
        names.push_back(name + (is_share ? "/mol" : behind));
    }
    return fmt::format("{}", fmt::join(names, ", "));
}

PossibleValues possible_values(double LeafRecord::*value) {
    struct Possible {
        double LeafRecord::*value;
        PossibleValues values;
    };
    static const std::array<Possible, 11> all{{{&Record::assimilation, {-100, 200}},
                                               {&Record::conductance, {-1, 20}},
                                               {&Record::transpiration, {-0.05, 0.2}},
                                               {&Record::internal, {-500, 20000}},
                                               {&Record::incident, {-20, 5000}},
                                               {&Record::absorbed, {-20, 5000}},
                                               {&Record::temperature, {-30, 80}},
                                               {&Record::deficit, {-5, 30}},
                                               {&Record::pressure, {20, 120}},
                                               {&Record::carbon_dioxide, {-50, 20000}},
                                               {&Record::boundary, {0, 100}}}};
    return std::find_if(all.begin(), all.end(), [&](const Possible& one) { return one.value == value; })->values;
}

}  // namespace espalier::environment::leaf
