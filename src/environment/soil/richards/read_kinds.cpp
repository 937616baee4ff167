#include "environment/soil/richards/read_kinds.h"

#include "espalier/base/math.h"

#include "base/csv_rows.h"
#include "base/text.h"
#include "environment/soil/hydraulics/heads.h"
#include "environment/soil/hydraulics/saxton_rawls.h"
#include "environment/soil/hydraulics/soil_table.h"
#include "environment/soil/hydraulics/texture_library.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace espalier::environment {
namespace {

struct Texture {
    double sand, silt, clay;  ///< percentages
};

/// Two of sand, silt and clay, or all.
Texture read_texture(const Settings& table) {
    const Range percentages = Range::between(0, 100);
    const auto part = [&](const char* name) {
        return table.has(name) ? std::optional(table.number(name, percentages)) : std::nullopt;
    };
    const std::optional<double> sand = part("sand"), silt = part("silt"), clay = part("clay");
    if (sand.has_value() + silt.has_value() + clay.has_value() < 2) {
        throw UserError(table.place(), "a texture needs two of 'sand', 'silt' and 'clay', percentages of mass");
    }
    const double rest = 100 - sand.value_or(0) - silt.value_or(0) - clay.value_or(0);
    const bool is_whole = sand && silt && clay;
    if (is_whole ? std::abs(rest) > 1 : rest < 0) {
        throw UserError(table.place(), fmt::format("sand, silt and clay are {} % together, and must be 100 %",
                                                   format_general(100 - rest)));
    }
    return {sand.value_or(rest), silt.value_or(rest), clay.value_or(rest)};
}

SoilKind with_curves(std::shared_ptr<const SoilCurves> curves, double saturated, double conductivity) {
    SoilKind kind;
    kind.model = SoilKind::Model::curves;
    kind.residual = 0;
    kind.saturated = saturated;
    kind.conductivity = conductivity;
    kind.curves = std::move(curves);
    return kind;
}

SoilKind soil_of_texture(const Settings& table) {
    const Texture texture = read_texture(table);
    const std::string transfer =
        table.choice_or("transfer", "saxton-rawls", {"saxton-rawls", "rosetta", "carsel-parrish"});
    if (transfer == "saxton-rawls") {
        if (texture.clay > 60) {
            throw UserError(table.place("clay"),
                            "Saxton & Rawls (2006) describe soils of at most 60 % clay: take transfer = \"rosetta\"");
        }
        const double organic = table.number_or("organic_matter", 2.5, Range::between(0, 8));
        const auto curves = std::make_shared<SaxtonRawls>(texture.sand, texture.clay, organic);
        return with_curves(curves, curves->saturated(), curves->full_conductivity());
    }
    const std::string prefix = transfer == "rosetta" ? "rosetta " : "";
    const std::string name = prefix + std::string(texture_class(texture.sand, texture.clay));
    const auto found = std::find_if(texture_library().begin(), texture_library().end(),
                                    [&](const NamedSoil& soil) { return soil.name == name; });
    return found->soil;
}

std::vector<SoilTable::Row> read_rows(const Settings& table) {
    if (!table.has("file")) {
        const std::vector<double> heads = read_heads(table, "heads", Range::between(-1e9, 0));
        const std::vector<double> contents = table.numbers("theta"), conductivities = table.numbers("k");
        if (heads.size() != contents.size() || heads.size() != conductivities.size()) {
            throw UserError(table.place("heads"),
                            fmt::format("a table of a soil has as many 'heads' as 'theta' and 'k': {}, {} and {}",
                                        heads.size(), contents.size(), conductivities.size()));
        }
        std::vector<SoilTable::Row> rows;
        for (std::size_t i = 0; i < heads.size(); ++i) rows.push_back({heads[i], contents[i], conductivities[i]});
        return rows;
    }
    const std::filesystem::path path = table.path("file");
    const auto to_cm = head_unit(table.text_or("unit", "cm"), table.place("unit"));
    const CsvRows file(path);
    const std::vector<std::string> names{"head", "theta", "k"};
    if (file.rows().empty() || file.rows().front().cells != names) {
        throw UserError({path.string(), 1, 0}, "the first line of a soil's table is: head,theta,k");
    }
    std::vector<SoilTable::Row> rows;
    for (std::size_t i = 1; i < file.rows().size(); ++i) {
        const CsvRow& row = file.rows()[i];
        rows.push_back({to_cm(file.number(row, 0)), file.number(row, 1), file.number(row, 2)});
    }
    return rows;
}

SoilKind read_measured_soil(const Settings& table) {
    std::vector<SoilTable::Row> rows = read_rows(table);
    const Place place = table.place(table.has("file") ? "file" : "heads");
    std::sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.head > b.head; });
    if (std::count_if(rows.begin(), rows.end(), [](const auto& row) { return row.head < 0; }) < 2) {
        throw UserError(place, "a table of a soil needs two heads below 0, or more");
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const SoilTable::Row& row = rows[i];
        const bool is_sound = row.head <= 0 && row.content > 0 && row.content <= 1 && row.conductivity > 0;
        const SoilTable::Row* const wetter = i > 0 ? &rows[i - 1] : nullptr;
        const bool falls = !wetter || (wetter->head > row.head && wetter->content >= row.content &&
                                       wetter->conductivity > row.conductivity);
        if (is_sound && falls) continue;
        throw UserError(
            place,
            fmt::format("at a head of {} cm, theta is {} and k {} cm/d: heads are at most 0, theta is "
                        "above 0 and at most 1, k is above 0, and both fall as the soil dries",
                        format_general(row.head), format_general(row.content), format_general(row.conductivity)));
    }
    const SoilTable::Row &driest = rows.back(), &before = *(rows.end() - 2);
    if (math::log(before.conductivity / driest.conductivity) < 1.1 * math::log(driest.head / before.head)) {
        throw UserError(place, fmt::format("from {} to {} cm, k must fall faster than 1 / |h|, as it does in dry soil",
                                           format_general(before.head), format_general(driest.head)));
    }
    const double saturated = rows.front().content, conductivity = rows.front().conductivity;
    return with_curves(std::make_shared<SoilTable>(std::move(rows)), saturated, conductivity);
}

SoilKind read_table(const Settings& table) {
    if (table.has("heads") || table.has("file")) return read_measured_soil(table);
    if (table.has("sand") || table.has("silt") || table.has("clay")) return soil_of_texture(table);
    SoilKind kind;
    const std::string model = table.choice_or("model", "van-genuchten", {"van-genuchten", "brooks-corey", "gardner"});
    kind.residual = table.number("theta_r", Range::between(0, 1));
    kind.saturated = table.number("theta_s", Range{0, 1, true});
    if (kind.residual >= kind.saturated) {
        throw UserError(table.place("theta_s"), "'theta_s', the content of full soil, must be more than 'theta_r'");
    }
    kind.conductivity = table.number("ks", Range{0, 1e7, true});
    if (model == "brooks-corey") {
        kind.model = SoilKind::Model::brooks_corey;
        kind.alpha = -1 / read_head(table, "air_entry", Range::between(-1e5, -1e-3));
        kind.n = table.number("lambda", Range::between(0.05, 20));
        return kind;
    }
    kind.alpha = table.number("alpha", Range::between(1e-6, 10));
    if (model == "gardner") {
        kind.model = SoilKind::Model::gardner;
        return kind;
    }
    kind.n = table.number("n", Range::between(1.01, 20));
    kind.l = table.number_or("l", 0.5, Range::between(-6, 20));
    // K = Ks Se^l (...)^2 must fall in dry soil, with a finite integral: |h|^-((n - 1) l + 2 n).
    if ((kind.n - 1) * kind.l + 2 * kind.n < 1.1) {
        throw UserError(table.place("l"), "with this 'l' the conductivity of dry soil does not fall: use a larger one");
    }
    return kind;
}

std::size_t add(const SoilKind& kind, const std::string& name, SoilParameters& parameters) {
    for (std::size_t i = 0; i < parameters.kinds.size(); ++i) {
        if (parameters.kinds[i].soil() == kind) return i;
    }
    if (parameters.kinds.size() == 255) throw UserError(parameters.space.place, "a soil has at most 255 kinds");
    parameters.kinds.emplace_back(kind);
    parameters.kind_names.push_back(name);
    return parameters.kinds.size() - 1;
}

}  // namespace

std::size_t find_soil_kind(const std::string& name, const Place& place, const Settings& named_soils,
                           SoilParameters& parameters) {
    parameters.names_in_use.insert(name);
    const auto known = std::find(parameters.kind_names.begin(), parameters.kind_names.end(), name);
    if (known != parameters.kind_names.end()) return static_cast<std::size_t>(known - parameters.kind_names.begin());
    if (named_soils.is_table(name)) return add(read_table(named_soils.table(name)), name, parameters);
    std::vector<std::string> names = named_soils.keys();
    for (const NamedSoil& soil : texture_library()) {
        if (soil.name == name) return add(soil.soil, name, parameters);
        names.emplace_back(soil.name);
    }
    throw UserError(place, fmt::format("there is no soil '{}'{}: `espalier list processes soil-water` names them, and "
                                       "soils = {{ ... }} makes others",
                                       name, did_you_mean(name, names)));
}

std::size_t read_soil_kind(const Settings& settings, const std::string& key, const Settings& named_soils,
                           SoilParameters& parameters) {
    if (settings.is_table(key)) return add(read_table(settings.table(key)), "a soil of its own", parameters);
    return find_soil_kind(settings.text(key), settings.place(key), named_soils, parameters);
}

}  // namespace espalier::environment
