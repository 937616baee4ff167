#include "language/parser/names.h"

#include "base/characters.h"
#include "base/text.h"
#include "language/parser/visit.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

namespace espalier::language {
namespace {

constexpr std::size_t most_unassigned = 100;  // are warned about

std::optional<double> mathematical_constant(std::string_view name) {
    if (name == "pi") return std::numbers::pi;
    if (name == "e") return std::numbers::e;
    return std::nullopt;
}

}  // namespace

void Names::begin(LSystem& system, std::size_t number) {
    system_ = &system;
    system_number_ = number;
    ids_.clear();
    array_ids_.clear();
    variables_.clear();
    system.globals.clear();
    for (const char* predefined : {"Q", "Z"}) variables_[variable(predefined)].assigned = true;
}

std::uint32_t Names::variable(std::string_view name) {
    const auto [found, is_new] = ids_.try_emplace(std::string(name), static_cast<std::uint32_t>(variables_.size()));
    if (is_new) {
        variables_.emplace_back();
        system_->globals.emplace_back(name);
    }
    return found->second;
}

void Names::define_constant(std::string_view name, double value, Location at) {
    if (!constants_.try_emplace(std::string(name), value).second) {
        mistakes_.error(at, fmt::format("the constant '{}' is defined a second time", name));
    }
}

void Names::add_external(std::string_view name) {
    variables_[variable(name)].assigned = true;
    system_->external_globals.emplace_back(name);
    shared_.emplace(name);
}

void Names::add_array(ArrayDeclaration array, Location at) {
    const auto index = static_cast<std::uint32_t>(system_->arrays.size());
    if (array.dimensions.empty()) external_elements_.push_back({system_number_, index, 0, at});
    array_ids_.try_emplace(array.name, index);
    system_->arrays.push_back(std::move(array));
}

std::optional<std::uint32_t> Names::array(std::string_view name) const {
    const auto found = array_ids_.find(std::string(name));
    return found == array_ids_.end() ? std::nullopt : std::optional(found->second);
}

std::optional<std::uint32_t> Names::subscripted(std::string_view name, Location at) {
    std::vector<std::string>& external = system_->external_globals;
    const auto shared = std::find(external.begin(), external.end(), name);
    if (const std::optional<std::uint32_t> known = array(name); known || shared == external.end()) return known;
    external.erase(shared);
    ArrayDeclaration declared;
    declared.name = name;
    declared.external = true;
    declared.place = place(at);
    add_array(std::move(declared), at);
    return static_cast<std::uint32_t>(system_->arrays.size() - 1);
}

bool Names::take_formal(std::string_view name, Expression& result) const {
    if (!formals_) return false;
    const auto formal = std::find(formals_->begin(), formals_->end(), name);
    if (formal == formals_->end()) return false;
    result.kind = Expression::Kind::formal;
    result.index = static_cast<std::uint32_t>(formal - formals_->begin());
    return true;
}

Expression Names::read(std::string_view name, Location at) {
    Expression result;
    result.place = place(at);
    if (take_formal(name, result)) return result;
    if (const auto constant = constants_.find(name); constant != constants_.end()) {
        result.value = constant->second;
        return result;
    }
    if (constants_only_) {
        const std::optional<double> value = mathematical_constant(name);
        if (!value) throw SyntaxError{at, fmt::format("'{}' is not a constant{}", name, suggestion(name))};
        result.value = *value;
        return result;
    }
    if (array(name)) throw SyntaxError{at, fmt::format("'{0}' is an array: write {0}[index]", name)};
    result.kind = Expression::Kind::global;
    result.index = variable(name);
    Variable& read = variables_[result.index];
    if (!read.read) {
        read.read = at;
        if (formals_) read.formals = *formals_;
    }
    return result;
}

Expression Names::assigned(std::string_view name, Location at) {
    Expression result;
    result.place = place(at);
    if (take_formal(name, result)) return result;
    if (constants_.contains(name)) {
        mistakes_.error(at, fmt::format("'{}' is a constant and cannot be assigned", name));
    } else if (array(name)) {
        throw SyntaxError{at, fmt::format("'{0}' is an array: write {0}[index] = value", name)};
    }
    result.kind = Expression::Kind::global;
    result.index = variable(name);
    variables_[result.index].assigned = true;
    return result;
}

void Names::note_skipped(std::string_view text) {
    for (std::size_t i = 0; i < text.size();) {
        std::size_t end = i;
        while (end < text.size() && is_name_part(text[end])) ++end;
        const std::size_t next = std::min(text.find_first_not_of(" \t\n", end), text.size());
        const std::string_view sign = text.substr(next, 2);
        const bool compound = sign.size() == 2 && sign[1] == '=' && std::string_view("+-*/").find(sign[0]) != sign.npos;
        const bool assigns = (sign.starts_with('=') && sign != "==") || compound || sign == "++" || sign == "--";
        if (end > i && assigns) variables_[variable(text.substr(i, end - i))].assigned = true;
        i = std::max(end, i + 1);
    }
}

std::vector<std::string> Names::known_names(const std::vector<std::string>* formals) const {
    std::vector<std::string> known;
    if (formals) known = *formals;
    for (const auto& [name, value] : constants_) known.push_back(name);
    for (std::size_t i = 0; i < variables_.size(); ++i) {
        if (variables_[i].assigned) known.push_back(system_->globals[i]);
    }
    for (const ArrayDeclaration& array : system_->arrays) known.push_back(array.name);
    known.insert(known.end(), macros_.begin(), macros_.end());
    return known;
}

std::string Names::suggestion(std::string_view name) const {
    return did_you_mean(name, known_names(formals_));
}

std::string Names::unknown(std::string_view name, const std::vector<std::string>* formals) const {
    if (macros_.contains(std::string(name))) {
        return fmt::format(
            "macro '{}' is not expanded here: it is defined later, or takes arguments, or there is an "
            "apostrophe before it on the line; its value is 0",
            name);
    }
    return fmt::format("'{}' is no parameter here and never assigned, so its value is 0{}", name,
                       did_you_mean(name, known_names(formals)));
}

void Names::finish() {
    bool constants_used = false;
    for (std::size_t i = 0; i < variables_.size(); ++i) {
        const Variable& variable = variables_[i];
        if (variable.assigned || !variable.read) continue;
        if (mathematical_constant(system_->globals[i])) {
            constants_used = true;
        } else if (unassigned_.size() < most_unassigned) {
            unassigned_.push_back(
                {*variable.read, system_->globals[i], unknown(system_->globals[i], &variable.formals)});
        }
    }
    if (constants_used) put_in_constants();
}

void Names::finish_model(Model& model) {
    for (const Unassigned& variable : unassigned_) {
        if (!shared_.contains(variable.name)) mistakes_.warning(variable.at, variable.message);
    }
    for (const ExternalElement& element : external_elements_) {
        ArrayDeclaration& array = model.systems[element.system].arrays[element.array];
        if (array.dimensions.empty()) size_external_array(model, array);
        if (array.dimensions.empty()) {
            mistakes_.error(element.at, fmt::format("no L-system of this file declares an array '{}'", array.name));
            array.dimensions.resize(std::max<std::size_t>(element.count, 1));  // said once
        }
        const bool used = element.count > 0;
        if (used && array.dimensions.size() != element.count) wrong_subscripts(array, element.count, element.at);
    }
}

void Names::size_external_array(const Model& model, ArrayDeclaration& array) {
    for (const LSystem& system : model.systems) {
        for (const ArrayDeclaration& declared : system.arrays) {
            if (declared.external || declared.name != array.name) continue;
            array.dimensions = declared.dimensions;
            return;
        }
    }
}

void Names::check_subscripts(std::uint32_t array, std::size_t count, Location at) {
    const ArrayDeclaration& declared = system_->arrays[array];
    if (declared.dimensions.empty()) {
        external_elements_.push_back({system_number_, array, count, at});
    } else if (declared.dimensions.size() != count) {
        wrong_subscripts(declared, count, at);
    }
}

void Names::wrong_subscripts(const ArrayDeclaration& array, std::size_t count, Location at) {
    const std::size_t dimensions = array.dimensions.size();
    mistakes_.error(at, fmt::format("array '{}' has {} dimension{}, not {}", array.name, dimensions,
                                    dimensions == 1 ? "" : "s", count));
}

// pi and e are variables where the model assigns them, numbers where it does not.
void Names::put_in_constants() {
    std::vector<std::optional<double>> values(variables_.size());
    std::vector<std::uint32_t> new_index(variables_.size());
    std::vector<std::string> kept;
    for (std::size_t i = 0; i < variables_.size(); ++i) {
        if (!variables_[i].assigned) values[i] = mathematical_constant(system_->globals[i]);
        new_index[i] = static_cast<std::uint32_t>(kept.size());
        if (!values[i]) kept.push_back(system_->globals[i]);
    }
    for_each_expression(*system_, [&](Expression& expression) {
        if (expression.kind != Expression::Kind::global) return;
        if (const std::optional<double> value = values[expression.index]) {
            expression.kind = Expression::Kind::number;
            expression.value = *value;
            expression.index = 0;
        } else {
            expression.index = new_index[expression.index];
        }
    });
    system_->globals = std::move(kept);
}

}  // namespace espalier::language
