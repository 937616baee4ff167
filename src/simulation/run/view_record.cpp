#include "simulation/run/view_record.h"

#include <algorithm>

namespace espalier::simulation {

using Json = nlohmann::ordered_json;

Json vector_json(const glm::dvec3& vector) {
    return {vector.x, vector.y, vector.z};
}

Json view_json(const Scene& scene) {
    const auto has_view = [](const Plant& plant) { return plant.view != nullptr; };
    const auto plant = std::find_if(scene.plants.begin(), scene.plants.end(), has_view);
    if (plant == scene.plants.end()) return nullptr;
    const View& view = *plant->view;
    Json json;
    json["towards_eye"] = vector_json(view.camera.eye - view.camera.target);
    json["twist"] = view.camera.twist;
    json["perspective"] = view.camera.perspective;
    json["angle"] = view.camera.angle;
    if (!view.lights.empty()) {
        const Light& light = view.lights.front();
        json["towards_light"] = vector_json(light.directional ? light.vector : light.vector - view.camera.target);
    } else if (view.light_direction) {
        json["towards_light"] = vector_json(*view.light_direction);
    }
    if (view.background_colour) json["background"] = vector_json(*view.background_colour);
    return json;
}

}  // namespace espalier::simulation
