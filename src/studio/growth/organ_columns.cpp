#include "studio/growth/organ_columns.h"

#include "espalier/base/error.h"

#include "studio/packets/packet_parts.h"

#include <algorithm>
#include <limits>
#include <set>

namespace espalier::studio {
namespace {

// What `run` would refuse is told when it is run.
std::vector<std::string> recorded_names(const Scene& scene) {
    try {
        return scene.timeline.texts_or("organs", {});
    } catch (const UserError&) {
        return {};
    }
}

std::string process_of(const std::string& name) {
    return name.substr(0, name.find('.'));
}

}  // namespace

std::vector<OrganColumn> organ_columns(const Scene& scene, const Environment& environment) {
    const std::vector<std::string> recorded = recorded_names(scene);
    std::vector<OrganColumn> columns;
    std::set<std::string> processes;
    for (const OrganQuantity& quantity : environment.organ_quantities()) {
        const bool is_first = processes.insert(process_of(quantity.name)).second;
        const bool is_recorded = std::find(recorded.begin(), recorded.end(), quantity.name) != recorded.end();
        if (quantity.components == 1 && (is_first || is_recorded)) columns.push_back({quantity.name, quantity.unit});
    }
    return columns;
}

std::string organ_column(const Frame& frame, std::uint32_t growth, const std::string& name) {
    std::vector<float> values;
    for (const auto& plant : frame.plants) {
        const auto known = frame.environment->organ_values(name, plant.plant);
        if (known)
            values.insert(values.end(), known->begin(), known->end());
        else
            values.insert(values.end(), plant.string->size(), std::numeric_limits<float>::quiet_NaN());
    }
    return column_message(growth, 0, name, values);
}

}  // namespace espalier::studio
