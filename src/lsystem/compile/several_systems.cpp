// The L-systems of a model by their numbers, and the variables they lend each other.
#include "lsystem/compile/compiled_model.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace espalier::lsystem {
namespace {

std::optional<long long> number_of(const LSystem& system) {
    long long number = 0;
    const char* const begin = system.label.data();
    const auto [end, error] = std::from_chars(begin, begin + system.label.size(), number);
    return error == std::errc() && end != begin ? std::optional(number) : std::nullopt;
}

std::string label_of(const CompiledSystem& system) {
    return system.system->label.empty() ? "without a number" : system.system->label;
}

/// True if another L-system than `borrower` has a variable or array of its own by this name.
bool another_owns(const CompiledModel& model, const CompiledSystem& borrower, const std::string& name, bool array) {
    return std::any_of(model.systems.begin(), model.systems.end(), [&](const auto& system) {
        const auto& indices = array ? system->array_indices : system->global_indices;
        const auto& borrowed = array ? system->external_arrays : system->external_globals;
        const bool borrows = std::any_of(borrowed.begin(), borrowed.end(),
                                         [&](const External& external) { return external.name == name; });
        return system.get() != &borrower && indices.contains(name) && !borrows;
    });
}

[[noreturn]] void refuse_to_borrow(const CompiledSystem& system, const CompiledSystem& around, const External& what,
                                   const char* why) {
    throw RunError(fmt::format("{}: '{}' is external in L-system {}, but {} L-system {} around it", system.source->name,
                               what.name, label_of(system), why, label_of(around)));
}

}  // namespace

Enclosure enclosure_of(const Alphabet& alphabet) {
    return {alphabet.find("?", 1).value_or(no_letter), alphabet.find("?", 2).value_or(no_letter),
            alphabet.find("$", 0).value_or(no_letter)};
}

void require_lenders(const CompiledModel& model) {
    for (const auto& system : model.systems) {
        const auto require = [&](const External& external, bool array, const Place& place) {
            if (another_owns(model, *system, external.name, array)) return;
            throw UserError(place, fmt::format("'{}' is external in L-system {}, but no other L-system has {} of that "
                                               "name; there are L-systems {}",
                                               external.name, label_of(*system), array ? "an array" : "a variable",
                                               model.labels()));
        };
        for (const External& external : system->external_globals) {
            if (external.index >= 2) require(external, false, {model.source->name});
        }
        for (const External& external : system->external_arrays) {
            require(external, true, system->system->arrays[external.index].place);
        }
    }
}

void borrow(const CompiledSystem& system, Variables& own, const CompiledSystem& around, Variables& theirs) {
    own.external_globals.assign(own.globals.size(), nullptr);
    own.external_arrays.assign(own.arrays.size(), nullptr);
    for (const External& external : system.external_globals) {
        const auto found = around.global_indices.find(external.name);
        if (found == around.global_indices.end()) refuse_to_borrow(system, around, external, "there is none in");
        const std::uint32_t g = found->second;
        const bool lent_on = !theirs.external_globals.empty() && theirs.external_globals[g];
        own.external_globals[external.index] = lent_on ? theirs.external_globals[g] : &theirs.globals[g];
    }
    for (const External& external : system.external_arrays) {
        const auto found = around.array_indices.find(external.name);
        if (found == around.array_indices.end()) refuse_to_borrow(system, around, external, "there is none in");
        const std::uint32_t a = found->second;
        if (around.arrays[a].dimensions != system.arrays[external.index].dimensions) {
            refuse_to_borrow(system, around, external, "it has another size in");
        }
        own.external_arrays[external.index] = around.arrays[a].external ? theirs.external_arrays[a] : &theirs.arrays[a];
    }
}

const CompiledSystem* CompiledModel::labelled(double id) const {
    const double whole = std::trunc(id);
    for (const auto& system : systems) {
        const std::optional<long long> number = number_of(*system->system);
        if (number && static_cast<double>(*number) == whole) return system.get();
    }
    return nullptr;
}

std::string CompiledModel::labels() const {
    std::string list;
    for (std::size_t k = 0; k < systems.size(); ++k) {
        list += fmt::format("{}{}", k == 0 ? "" : k + 1 == systems.size() ? " and " : ", ", label_of(*systems[k]));
    }
    return list;
}

}  // namespace espalier::lsystem
