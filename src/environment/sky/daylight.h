// The light of a time: sun and sky as parallel beams, in photons.
#pragma once

#include "espalier/base/settings.h"

#include "environment/sky/radiance.h"
#include "environment/sky/sun.h"

#include <optional>
#include <string>
#include <vector>

namespace espalier::environment {

/// Light from one direction over a span of time.
struct LightBeam {
    glm::dvec3 towards;  ///< the light's source, a unit vector
    double photons = 0;  ///< mol of photosynthetically active photons per m2 across the direction
};

/// A span of time's light.
struct Daylight {
    std::vector<LightBeam> beams;
    double on_ground = 0;  ///< mol/m2 on open level ground
    double seconds = 0;    ///< how long there was light
};

/// Reads the table `sky` of a process (help in `sky_help`), and makes the light of any day.
class DaylightSeries {
public:
    /// Beams that come from lower than `least_rise`, the sine of their elevation, are left out. Throws UserError.
    DaylightSeries(const Settings& sky, double least_rise);

    /// Returns the light of `days` that begin `elapsed` days after the first; their middle day stands for all of them.
    Daylight over(double elapsed, double days) const;

private:
    void read_sky(const Settings& sky);
    void read_hours(const Settings& sky);
    SkyRadiance radiance(const glm::dvec3& sun) const;
    void add_sky(const glm::dvec3& sun, double on_ground, Daylight& light) const;
    void add_sun(const glm::dvec3& sun, double on_ground, Daylight& light) const;
    void add_hour(const CivilTime& time, double seconds, Daylight& light) const;
    Daylight given(double days) const;

    double least_rise_;
    std::string kind_;
    std::vector<SkyPart> parts_;
    std::optional<double> given_, diffuse_;
    glm::dvec3 sun_{0, 1, 0}, north_{0, 0, -1};
    GroundPlace place_;
    double year_ = 2025, day_ = 172, clearness_ = 0.5, photons_per_joule_ = 0;
    std::vector<double> hours_, spans_;  ///< hours of a day, and how many each stands for
};

/// What users read of the table.
const std::string& sky_help();

}  // namespace espalier::environment
