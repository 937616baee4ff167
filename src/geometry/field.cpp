#include "espalier/geometry/field.h"

#include "espalier/base/error.h"

#include "base/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace espalier::geometry {
namespace {

void bring_up_to_date(Field& field) {
    if (field.current) field.grid = field.current();
}

}  // namespace

void Fields::provide(Field field) {
    std::string name = field.name;
    fields_.insert_or_assign(std::move(name), std::move(field));
}

const Field& Fields::need(const std::string& name) const {
    if (const Field* field = find(name)) return *field;
    std::vector<std::string> names;
    for (const auto& entry : fields_) names.push_back(entry.first);
    const std::string known =
        names.empty() ? "so far no process provides any" : fmt::format("there are: {}", fmt::join(names, ", "));
    throw UserError(fmt::format("there is no field '{}'{}; {}", name, did_you_mean(name, names), known));
}

const Field* Fields::find(const std::string& name) const {
    const auto found = fields_.find(name);
    if (found == fields_.end()) return nullptr;
    bring_up_to_date(found->second);
    return &found->second;
}

FieldSource* Fields::shared(const std::string& name) const {
    const auto found = shared_.find(name);
    return found == shared_.end() ? nullptr : found->second;
}

const std::map<std::string, Field>& Fields::all() const {
    for (auto& [name, field] : fields_) bring_up_to_date(field);
    return fields_;
}

}  // namespace espalier::geometry
