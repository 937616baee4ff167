#include "espalier/geometry/field_values.h"

#include "base/bytes.h"
#include "geometry/grid_operations.h"

namespace espalier::geometry {

void FieldValues::take(const Fields& fields, const std::vector<std::string>& names) {
    forget();
    for (const std::string& name : names) {
        const Field* field = fields.find(name);
        if (field && field->grid && grid_operations().has_values(*field->grid)) grids_[name] = field->grid;
    }
}

const FieldGrid* FieldValues::find(const std::string& name) const {
    const auto found = grids_.find(name);
    return found == grids_.end() ? nullptr : found->second.get();
}

double FieldValues::value(const std::string& name, const glm::dvec3& position) const {
    const FieldGrid* field = find(name);
    return field ? grid_operations().value(*field, position) : 0;
}

glm::dvec3 FieldValues::gradient(const std::string& name, const glm::dvec3& position) const {
    const FieldGrid* field = find(name);
    return field ? grid_operations().gradient(*field, position) : glm::dvec3(0);
}

void FieldValues::save(std::ostream& out) const {
    put(out, static_cast<std::uint64_t>(grids_.size()));
    for (const auto& [name, field] : grids_) {
        put_text(out, name);
        put_text(out, grid_operations().bytes(*field));
    }
}

void FieldValues::restore(std::istream& in) {
    constexpr std::uint64_t longest_name = 1 << 16, largest_grid = std::uint64_t{1} << 36;
    forget();
    for (auto left = get<std::uint64_t>(in); left > 0; --left) {
        const std::string name = get_text(in, longest_name);
        grids_[name] = grid_operations().from_bytes(get_text(in, largest_grid));
    }
}

}  // namespace espalier::geometry
