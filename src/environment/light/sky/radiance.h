// How bright each part of the sky is, and directions that stand for all of it.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace espalier::environment {

/// A sky's radiance towards a direction, as a multiple of an unknown that all directions share.
class SkyRadiance {
public:
    /// The same everywhere.
    static SkyRadiance uniform();
    /// 1 + 2 cos(zenith angle): Moon & Spencer 1942, Illumination from a non-uniform sky.
    static SkyRadiance overcast();
    /// The skies 1 (overcast) to 15 (white-blue turbid sky with a clear solar corona) of ISO 15469:2004 / CIE S 011;
    /// 12 is the clear sky. `sun` is the unit vector towards the sun.
    static SkyRadiance cie(int type, const glm::dvec3& sun);

    /// Towards a unit vector above the horizon.
    double operator()(const glm::dvec3& towards) const;

private:
    struct Gradation {
        double a, b;
    };
    struct Indicatrix {
        double c, d, e;
    };
    enum class Kind : std::uint8_t { uniform, overcast, cie };

    Kind kind_ = Kind::uniform;
    Gradation gradation_{};
    Indicatrix indicatrix_{};
    glm::dvec3 sun_{0, 1, 0};
};

/// A point of Gauss's quadrature over 0 .. 1; the weights add up to 1.
struct GaussPoint {
    double at, weight;
};
std::vector<GaussPoint> gauss_points(std::int64_t count);

/// A part of the sky.
struct SkyPart {
    glm::dvec3 towards;  ///< its middle, a unit vector
    double solid_angle;  ///< sr
};

/// The upper half of the sphere in `rings` (1 to 64) by `around` parts. The cosines of the rings' zenith angles and
/// their solid angles are those of Gauss's quadrature, so sums over polynomials of the cosine are exact: the cosines
/// themselves add up to pi.
std::vector<SkyPart> sky_parts(std::int64_t rings, std::int64_t around);

/// The share of each part in the light that falls on level ground from a sky; they add up to 1.
std::vector<double> shares_on_ground(const SkyRadiance& radiance, const std::vector<SkyPart>& parts);

}  // namespace espalier::environment
