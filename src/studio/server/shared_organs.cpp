#include "studio/server/shared_organs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace espalier::studio {
namespace {

using Json = nlohmann::ordered_json;

/// Six digits are more than a page shows, and make the page half as large as all digits.
Json rounded(double value) {
    if (!std::isfinite(value)) return nullptr;
    return std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr);
}

}  // namespace

std::int64_t SharedOrgans::number_of(const DrawnFrame& frame, const RecordedModule& module) {
    const auto [known, is_new] = numbers_.try_emplace(module.organ, static_cast<std::int64_t>(organs_.size()));
    if (!is_new) return known->second;
    const std::string& symbol = frame.symbol_name(module.symbol);
    const auto named = std::find(symbols_.begin(), symbols_.end(), symbol);
    organs_.push_back(module);
    organs_.back().symbol = static_cast<std::uint16_t>(named - symbols_.begin());
    if (named == symbols_.end()) symbols_.push_back(symbol);
    return known->second;
}

Json SharedOrgans::add(const DrawnFrame& frame) {
    Json organ = Json::array(), parameters = Json::object();
    std::int64_t before = 0;
    for (const RecordedModule& module : frame.modules()) {
        const std::int64_t number = number_of(frame, module);
        organ.push_back(number - before);
        before = number;
    }
    for (const auto& [name, values] : frame.parameter_columns()) {
        Json& column = parameters[name] = Json::array();
        for (const RecordedModule& module : frame.modules()) {
            column.push_back(module.point ? rounded(values[*module.point]) : Json());
        }
    }
    return {{"organ", organ}, {"parameters", parameters}, {"units", frame.units()}};
}

Json SharedOrgans::table() const {
    Json plants = Json::object(), identity = Json::array(), symbol = Json::array(), plant = Json::array();
    Json born = Json::array(), order = Json::array(), parent = Json::array();
    for (const RecordedPlant& one : run_.plants()) plants[std::to_string(one.number)] = one.name;
    for (const RecordedModule& organ : organs_) {
        const auto bearer = numbers_.find({organ.organ.plant, organ.parent});
        identity.push_back(fmt::format("{:016x}", organ.organ.identity));
        symbol.push_back(organ.symbol);
        plant.push_back(organ.organ.plant);
        born.push_back(organ.birth);
        order.push_back(organ.order);
        parent.push_back(bearer == numbers_.end() ? -1 : bearer->second);
    }
    return {{"symbols", symbols_}, {"plants", plants}, {"identity", identity}, {"symbol", symbol},
            {"plant", plant},      {"born", born},     {"order", order},       {"parent", parent}};
}

}  // namespace espalier::studio
