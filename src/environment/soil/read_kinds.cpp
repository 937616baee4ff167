#include "environment/soil/read_kinds.h"

#include "base/text.h"
#include "environment/soil/texture_library.h"

#include <fmt/format.h>

namespace espalier::environment {
namespace {

SoilKind read_table(const Settings& table) {
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
        kind.alpha = -1 / table.number("air_entry", Range::between(-1e5, -1e-3));
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
    if (parameters.kinds.size() == 255)
        throw UserError(parameters.water.settings_place, "a soil has at most 255 kinds");
    parameters.kinds.emplace_back(kind);
    parameters.kind_names.push_back(name);
    return parameters.kinds.size() - 1;
}

}  // namespace

std::size_t find_soil_kind(const std::string& name, const Place& place, const Settings& named_soils,
                           SoilParameters& parameters) {
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
