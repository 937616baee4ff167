#include "lsystem/derive/sub_systems.h"

#include <fmt/format.h>

namespace espalier::lsystem {

void put_variables(std::ostream& out, const Variables& variables) {
    put_values(out, variables.globals);
    put(out, static_cast<std::uint64_t>(variables.arrays.size()));
    for (const std::vector<double>& array : variables.arrays) put_values(out, array);
}

void get_variables(std::istream& in, Variables& variables) {
    get_values(in, variables.globals);
    if (get<std::uint64_t>(in) != variables.arrays.size()) throw RunError("the checkpoint belongs to another model");
    for (std::vector<double>& array : variables.arrays) get_values(in, array);
}

Variables* SubSystems::find(const Scope& scope) {
    const auto found = instances_.find(key(scope));
    return found == instances_.end() ? nullptr : &found->second;
}

const Variables* SubSystems::find(const Scope& scope) const {
    const auto found = instances_.find(key(scope));
    return found == instances_.end() ? nullptr : &found->second;
}

Variables& SubSystems::make(const Scope& scope, std::size_t memory) {
    const std::size_t bytes = scope.system->bytes_of_arrays();
    made_ += bytes;
    if (made_ > memory) require_arrays(*scope.system, bytes == 0 ? 1 : made_ / bytes, memory);
    bytes_ += bytes;
    return instances_[key(scope)] = scope.system->variables();
}

void SubSystems::erase(const Scope& scope) {
    if (instances_.erase(key(scope)) > 0) bytes_ -= scope.system->bytes_of_arrays();
}

void SubSystems::clear() {
    instances_.clear();
    bytes_ = made_ = 0;
}

Variables* SubSystems::lend(const std::vector<Scope>& scopes, std::uint32_t scope, Variables& main) {
    if (scope == 0) return &main;
    const Scope& own = scopes[scope];
    Variables* const variables = find(own);
    Variables* const around = variables ? lend(scopes, own.parent, main) : nullptr;
    if (!around) return nullptr;
    borrow(*own.system, *variables, *scopes[own.parent].system, *around);
    return variables;
}

void SubSystems::save(std::ostream& out) const {
    put(out, static_cast<std::uint64_t>(instances_.size()));
    for (const auto& [key, variables] : instances_) {
        put(out, key.first);
        put(out, static_cast<std::uint64_t>(key.second));
        put_variables(out, variables);
    }
}

void SubSystems::restore(std::istream& in, const CompiledModel& model) {
    clear();
    for (auto count = get<std::uint64_t>(in); count > 0; --count) {
        const auto identity = get<Identity>(in);
        const auto system = get<std::uint64_t>(in);
        if (system >= model.systems.size()) throw RunError("the checkpoint belongs to another model");
        Variables variables = model.systems[system]->variables();
        bytes_ += model.systems[system]->bytes_of_arrays();
        get_variables(in, variables);
        instances_[{identity, system}] = std::move(variables);
    }
}

}  // namespace espalier::lsystem
