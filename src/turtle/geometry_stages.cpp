#include "espalier/turtle/geometry_stage.h"

#include "base/registered_part.h"
#include "geometry/drawn/bounds.h"

namespace espalier::turtle {

std::shared_ptr<const GeometryStage> read_geometry_stage(Settings& table) {
    const auto& type = registered_part<GeometryStageType>(table, "stage", "geometry stage");
    std::shared_ptr<const GeometryStage> stage = type.make(table);
    table.reject_unread();
    return stage;
}

void apply(const GeometryStages& stages, StagedPlant& plant) {
    for (const auto& stage : stages) stage->apply(plant);
    if (!stages.empty()) plant.geometry.bounds = drawn_bounds(plant.geometry);
}

}  // namespace espalier::turtle
