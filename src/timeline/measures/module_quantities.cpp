#include "timeline/measures/module_quantities.h"

#include "base/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

namespace espalier::timeline {
namespace {

const std::vector<std::string> functions{"sum", "mean", "min", "max", "count"};

/// Sums up the values met so far.
struct Total {
    double sum = 0, least = std::numeric_limits<double>::infinity(), greatest = -least;
    std::size_t count = 0;

    void add(double value) {
        sum += value;
        least = std::min(least, value);
        greatest = std::max(greatest, value);
        ++count;
    }
};

}  // namespace

ModuleQuantities::ModuleQuantities(const Settings& table) {
    for (const std::string& name : table.keys()) {
        const std::string text = table.text(name);
        const Place place = table.place(name);
        const std::size_t open = text.find('(');
        if (open == std::string::npos || !text.ends_with(')')) {
            throw UserError(place, fmt::format("'{}' must be a function of a parameter, as in \"sum(F.2)\", not \"{}\"",
                                               name, text));
        }
        const std::string function = text.substr(0, open);
        const auto found = std::find(functions.begin(), functions.end(), function);
        if (found == functions.end()) {
            throw UserError(place, fmt::format("there is no function '{}'{}; there are {}", function,
                                               did_you_mean(function, functions), fmt::join(functions, ", ")));
        }
        functions_.push_back(static_cast<Function>(found - functions.begin()));
        parameters_.push_back(chosen_parameter(text.substr(open + 1, text.size() - open - 2), name, place));
    }
}

std::vector<std::string> ModuleQuantities::names() const {
    std::vector<std::string> names;
    for (const ChosenParameter& parameter : parameters_) names.push_back(parameter.name);
    return names;
}

void ModuleQuantities::require_known(std::span<const Model* const> models) const {
    timeline::require_known(parameters_, models);
}

std::vector<double> ModuleQuantities::of(const PlantFrame& plant) const {
    if (parameters_.empty()) return {};
    const Alphabet& alphabet = plant.model->alphabet;
    std::vector<ParameterSlots> slots;
    for (const ChosenParameter& parameter : parameters_) slots.emplace_back(parameter, alphabet);
    std::vector<Total> totals(slots.size());
    const double* values = plant.string->parameters.data();
    for (std::size_t module = 0; module < plant.string->size(); ++module) {
        for (std::size_t k = 0; k < slots.size(); ++k) {
            const int slot = slots[k].find(*plant.string, module);
            if (slot >= 0) totals[k].add(values[slot]);
        }
        values += alphabet.arity(plant.string->letters[module]);
    }
    std::vector<double> results;
    for (std::size_t k = 0; k < totals.size(); ++k) {
        const Total& total = totals[k];
        const auto count = static_cast<double>(total.count);
        const double values_of[] = {total.sum, total.sum / count, total.least, total.greatest, count};
        const bool is_none = total.count == 0 && functions_[k] != Function::sum && functions_[k] != Function::count;
        results.push_back(is_none ? std::numeric_limits<double>::quiet_NaN()
                                  : values_of[static_cast<std::size_t>(functions_[k])]);
    }
    return results;
}

}  // namespace espalier::timeline
