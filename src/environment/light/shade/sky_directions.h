// Directions from which light comes, with their shares of it.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace espalier::environment {

struct SkyDirection {
    glm::dvec3 towards;  ///< where the light comes from, of unit length
    double weight;       ///< all weights of a sky add up to 1
};

/// The middles of the faces of an octahedron whose faces are divided in four until there are `samples` or more.
/// Those above the horizon share 1 / (1 + lower_to_upper), those below the rest.
std::vector<SkyDirection> uniform_sky(std::int64_t samples, double lower_to_upper);

/// So many directions of equal solid angle over the upper half of the sphere (a Fibonacci lattice): for any number of
/// samples, where `uniform_sky` has 4, 16, 64, ... above the horizon.
std::vector<glm::dvec3> sky_hemisphere(std::int64_t samples);

/// The directions of `uniform_sky`, those above the horizon weighted as cpfg's program chiba does where it is asked for
/// the "CIE formula": by (1 + c) / 3 * (8.6 c + 0.123) / 0.203, where c = y / sqrt(x^2 + y^2).
std::vector<SkyDirection> chiba_overcast_sky(std::int64_t samples, double lower_to_upper);

/// Given directions, of any length, with weights of any sum.
std::vector<SkyDirection> normalised_sky(std::vector<SkyDirection> directions);

}  // namespace espalier::environment
