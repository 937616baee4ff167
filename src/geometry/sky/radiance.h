// How bright each part of the sky is, and directions that stand for all of it.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace espalier::geometry {

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

    /// (1 + a exp(b / rise)) (1 + c exp(d s) + e cos2 s), s being the angle to the sun: Perez, Seals & Michalsky 1993,
    /// All-weather model for sky luminance distribution.
    static SkyRadiance perez(const std::array<double, 5>& a_to_e, const glm::dvec3& sun);

    /// Towards a unit vector above the horizon.
    double operator()(const glm::dvec3& towards) const;
    /// Of CIE's and Perez' skies, where the zenith angle has the cosine `rise`, so many radians from the sun.
    double at(double rise, double from_sun) const;

private:
    struct Gradation {
        double a, b;
    };
    struct Indicatrix {
        double c, d, e;
        double across;  ///< what exp(d s) is taken beyond
    };
    enum class Kind : std::uint8_t { uniform, overcast, by_sun };

    Kind kind_ = Kind::uniform;
    Gradation gradation_{};
    Indicatrix indicatrix_{};
    glm::dvec3 sun_{0, 1, 0};
};

/// Direction `i` of some that are spread evenly over the sphere if the heights of all are (sunflower pattern; Vogel
/// 1979).
glm::dvec3 sunflower_direction(std::size_t i, double height);

/// A point of Gauss's quadrature over 0 .. 1; the weights add up to 1.
struct GaussPoint {
    double at, weight;
};
std::vector<GaussPoint> gauss_points(std::int64_t count);

/// The directions between two heights and two turns about the vertical, in which the radiance is in proportion to
/// 1 + `gradient` times the sine of the elevation; by default, one direction.
struct SkyWindow {
    double lowest = 0, highest = 0;  ///< sines of the elevation; both 0: there is but the middle
    double half_turn = 0;            ///< radians to both sides of the middle
    double gradient = 0;

    bool is_point() const { return !(highest > lowest); }
    /// The sine of the elevation below which a share of the light on level ground comes from, or of that across its
    /// directions.
    double rise_on_ground(double share) const;
    double rise_across(double share) const;
    /// The mean of that sine in the light across the directions.
    double mean_rise() const;
    /// The direction that rises so far, at a share of the turn; `middle` is a unit vector that is not vertical. The
    /// middle itself where there is no other.
    glm::dvec3 direction(const glm::dvec3& middle, double rise, double turn) const;
};

/// A part of the sky. The windows of all of them cover it without gaps.
struct SkyPart {
    glm::dvec3 towards;  ///< its middle, a unit vector
    double solid_angle;  ///< sr
    SkyWindow window{};
};

/// The upper half of the sphere in `rings` (1 to 64) by `around` parts. The cosines of the rings' zenith angles and
/// their solid angles are those of Gauss's quadrature, so sums over polynomials of the cosine are exact: the cosines
/// themselves add up to pi. In a sky whose radiance is in proportion to 1 + `gradient` times the cosine, each window
/// has the light of its part on level ground.
std::vector<SkyPart> sky_parts(std::int64_t rings, std::int64_t around, double gradient = 0);

/// The share of each part in the light that falls on level ground from a sky; they add up to 1.
std::vector<double> shares_on_ground(const SkyRadiance& radiance, const std::vector<SkyPart>& parts);

}  // namespace espalier::geometry
