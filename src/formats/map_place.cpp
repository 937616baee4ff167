#include "formats/map_place.h"

#include "base/text.h"

#include <fmt/format.h>

namespace espalier::formats {

std::optional<glm::dvec3> origin_of(const RecordedRun& run, char up) {
    const std::optional<glm::dvec3>& origin = run.origin();
    return origin && up == 'z' ? std::optional(glm::dvec3(origin->x, -origin->z, origin->y)) : origin;
}

std::string origin_line(std::string_view before, const RecordedRun& run, char up) {
    const std::optional<glm::dvec3> origin = origin_of(run, up);
    if (!origin) return "";
    return fmt::format("{}origin: {} {} {}\n", before, format_exact(origin->x), format_exact(origin->y),
                       format_exact(origin->z));
}

std::string origin_data(const RecordedRun& run, char up) {
    const std::optional<glm::dvec3> origin = origin_of(run, up);
    if (!origin) return "";
    return fmt::format("    customLayerData = {{\n        double3 origin = ({}, {}, {})\n    }}\n",
                       format_exact(origin->x), format_exact(origin->y), format_exact(origin->z));
}

}  // namespace espalier::formats
