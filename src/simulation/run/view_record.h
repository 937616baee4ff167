// How the author of a model looked at it, as runs record it and the studio tells its pages.
#pragma once

#include "espalier/simulation/scene.h"

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

namespace espalier::simulation {

nlohmann::ordered_json vector_json(const glm::dvec3& vector);

/// Describes the first plant with a view file; null if there is none.
nlohmann::ordered_json view_json(const Scene& scene);

}  // namespace espalier::simulation
