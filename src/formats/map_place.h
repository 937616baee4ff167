// Where 0 of a run lies on the map, for files that can say it.
#pragma once

#include "espalier/archive/recorded_run.h"

#include <glm/vec3.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace espalier::formats {

/// In the axes of a file in which `up` ('y' or 'z') points upwards, m; none: at 0.
std::optional<glm::dvec3> origin_of(const RecordedRun& run, char up = 'y');
/// "# origin: 592700 0 -5432100" and a line break; "" if there is none.
std::string origin_line(std::string_view before, const RecordedRun& run, char up = 'y');

/// What the head of a USD layer says of it; "" if there is none.
std::string origin_data(const RecordedRun& run, char up);

}  // namespace espalier::formats
