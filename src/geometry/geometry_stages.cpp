#include "espalier/geometry/geometry_stage.h"

#include "base/text.h"
#include "geometry/drawn_bounds.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace espalier::geometry {

std::shared_ptr<const GeometryStage> read_geometry_stage(Settings& table) {
    const auto& types = registered<GeometryStageType>();
    const std::string kind = table.text("stage");
    const auto found = types.find(kind);
    if (found == types.end()) {
        std::vector<std::string> kinds;
        for (const auto& type : types) kinds.push_back(type.first);
        throw UserError(table.place("stage"), fmt::format("there is no geometry stage '{}'{}; there are: {}", kind,
                                                          did_you_mean(kind, kinds), fmt::join(kinds, ", ")));
    }
    std::shared_ptr<const GeometryStage> stage = found->second->make(table);
    table.reject_unread();
    return stage;
}

void apply(const GeometryStages& stages, StagedPlant& plant) {
    for (const auto& stage : stages) stage->apply(plant);
    if (!stages.empty()) plant.geometry.bounds = drawn_bounds(plant.geometry);
}

}  // namespace espalier::geometry
