// Clouds of attraction points: what a scene says of them, and the points.
#pragma once

#include "espalier/base/random.h"
#include "espalier/environment/environment_process.h"

#include <cstddef>
#include <vector>

namespace espalier::environment {

/// The points of the clouds that `table` describes: `cloud` (one table or several), each an ellipsoid, a shape or a
/// list. `most` bounds their number. Throws UserError that names the key and its range for clouds without points, with
/// more than `most`, and shapes that enclose nothing.
std::vector<glm::dvec3> read_clouds(const Settings& table, const EnvironmentContext& context, std::size_t most);

/// The text that documents clouds.
extern const char* const cloud_help;

/// The layer of the unit ball between heights, its volume in m3: pi (z - z^3 / 3) between them.
double ball_layer_volume(double lower, double upper);

}  // namespace espalier::environment
