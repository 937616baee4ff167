#include "environment/leaf/leaves/leaf_kinds.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace espalier::environment::leaf {
namespace {

std::size_t plant_number(const Settings& table, double plant, std::uint32_t plants) {
    if (plant >= 0 && plant < plants && plant == std::floor(plant)) return static_cast<std::size_t>(plant);
    throw UserError(table.place("plants"),
                    fmt::format("there is no plant {:g}: they are numbered from 0 to {}, as in statistics.csv", plant,
                                static_cast<int>(plants) - 1));
}

std::uint16_t colour_number(const Settings& table, double colour) {
    if (colour >= 0 && colour <= 65535 && colour == std::floor(colour)) return static_cast<std::uint16_t>(colour);
    throw UserError(table.place("colours"),
                    fmt::format("there is no colour {:g}: the turtle's are numbered from 0", colour));
}

constexpr OwnParameterRange ranges[own_parameters] = {{"v", "umol m-2 s-1", of_carboxylation},
                                                      {"jmax", "umol m-2 s-1", of_electron_transport},
                                                      {"rd", "umol m-2 s-1", of_respiration},
                                                      {"g1", "", of_slope},
                                                      {"width", "m", of_width}};

}  // namespace

LeafKinds::LeafKinds(const Settings& settings, std::uint32_t plants) : kinds_{read_leaf_kind(settings)} {
    for (const Settings& table : settings.tables("kinds")) {
        Chosen chosen;
        if (!table.has("plants") && !table.has("colours")) {
            throw UserError(table.place(),
                            "a table of 'kinds' says which leaves it means: plants = [1], colours = [4]");
        }
        if (table.has("plants")) chosen.plants.assign(plants, false);
        for (const double plant : table.numbers_or("plants", {}))
            chosen.plants[plant_number(table, plant, plants)] = true;
        for (const double colour : table.numbers_or("colours", {})) {
            chosen.colours.push_back(colour_number(table, colour));
        }
        know_colours_ = know_colours_ || table.has("colours");
        kinds_.push_back(read_leaf_kind(table, kinds_.front()));
        chosen_.push_back(std::move(chosen));
    }
}

std::uint16_t LeafKinds::of(std::uint32_t plant, std::uint16_t colour) const {
    for (std::size_t k = chosen_.size(); k > 0; --k) {
        const Chosen& chosen = chosen_[k - 1];
        const bool is_plant = chosen.plants.empty() || (plant < chosen.plants.size() && chosen.plants[plant]);
        const bool is_colour =
            chosen.colours.empty() || std::count(chosen.colours.begin(), chosen.colours.end(), colour);
        if (is_plant && is_colour) return static_cast<std::uint16_t>(k);
    }
    return 0;
}

const OwnParameterRange& range_of(OwnParameter parameter) {
    return ranges[static_cast<std::size_t>(parameter)];
}

const std::vector<std::string>& QueryForm::answered() {
    static const std::vector<std::string> all{"gain", "water", "A", "E", "gs", "T", "Ci", "psi"};
    return all;
}

QueryForm::QueryForm(const Settings& settings, std::string process) : process_(std::move(process)) {
    const std::vector<std::string> names = settings.texts_or("query", answered());
    for (const std::string& name : names) {
        const auto answer = std::find(answered().begin(), answered().end(), name);
        const auto own = std::find_if(std::begin(ranges), std::end(ranges),
                                      [&](const OwnParameterRange& one) { return name == one.name; });
        if (answer == answered().end() && own == std::end(ranges)) {
            throw UserError(settings.place("query"),
                            fmt::format("'{}' is not what a query may have: answers are {}; a model may say v, jmax, "
                                        "rd, g1, width",
                                        name, fmt::join(answered(), ", ")));
        }
        if (std::count(names.begin(), names.end(), name) > 1) {
            throw UserError(settings.place("query"), fmt::format("'{}' stands there twice", name));
        }
        const bool says = own != std::end(ranges);
        says_something_ = says_something_ || says;
        roles_.push_back(says ? -1 - static_cast<int>(own - std::begin(ranges))
                              : static_cast<int>(answer - answered().begin()));
    }
    if (roles_.empty())
        throw UserError(settings.place("query"), "a query has a parameter at least: query = [\"gain\"]");
}

void QueryForm::read(const Query& query, std::size_t leaves, std::size_t row, OwnParameters& own) const {
    for (std::size_t i = 0; i < std::min(roles_.size(), query.parameters.size()); ++i) {
        const double said = query.parameters[i];
        if (roles_[i] >= 0 || said == 0) continue;
        const auto parameter = static_cast<std::size_t>(-1 - roles_[i]);
        const auto& [name, unit, range] = ranges[parameter];
        if (!(said >= range.lowest && said <= range.highest)) {
            throw RunError(
                fmt::format("'?{}' of plant {} says {} = {:g} of a leaf: write 0 for that of the scene, or "
                            "{} {:g} to {:g}{}{}",
                            process_, query.plant, name, said, range.open_below ? "above" : "from", range.lowest,
                            range.highest, *unit ? " " : "", unit));
        }
        if (own[parameter].empty()) own[parameter].assign(leaves, std::nanf(""));
        own[parameter][row] = static_cast<float>(said);
    }
}

}  // namespace espalier::environment::leaf
