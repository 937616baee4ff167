// Small plants that cover the ground around an eye, where a stand of its own would be too large.
#pragma once

#include "archive/landscape/landscape.h"

namespace espalier::archive {

struct Cover {
    int species;      ///< the colour of its species
    double density;   ///< plants per square metre up to half of `distance`; from there on fewer and fewer
    double distance;  ///< from the eye, metres
    double radius;    ///< mean radius of a plant, metres; each has 0.6 to 1.4 times it
};

/// The plants of a cover. They are by chance, and the same for two eyes where both see them at full density. Throws
/// UserError for more than a million.
std::vector<StandPlant> plants_of(const Cover& cover, const glm::dvec3& eye, std::uint64_t seed);

}  // namespace espalier::archive
