// The light of a time: sun and sky as parallel beams, in photons and joules.
#pragma once

#include "espalier/base/settings.h"

#include "environment/given/weather/weather.h"
#include "environment/light/sky/bands.h"
#include "environment/light/sky/light_series.h"
#include "environment/light/sun/sun.h"
#include "geometry/sky/radiance.h"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace espalier::environment {

/// Light from one direction over a span of time.
struct LightBeam {
    glm::dvec3 towards;   ///< the light's source, a unit vector
    double photons = 0;   ///< mol of photosynthetically active photons (PAR) per m2 across the direction
    bool is_sun = false;  ///< or a part of the sky
    SkyWindow window{};   ///< of that part

    /// mol/m2 that it brings to open level ground.
    double on_ground() const { return photons * towards.y; }
};

/// A span of time's light.
struct Daylight {
    std::vector<LightBeam> beams;
    double on_ground = 0;  ///< mol/m2 of PAR on open level ground
    double energy = 0;     ///< J/m2 of all wavelengths there
    double seconds = 0;    ///< how long there was light

    /// mol/m2 and J/m2 of a band on open level ground.
    double photons(const LightBand& band) const {
        return band.is_par() ? on_ground : 1e-6 * band.photons * joules(band);
    }
    double joules(const LightBand& band) const {
        return band.is_par() ? 1e6 * on_ground / band.photons : energy * band.share;
    }
};

/// Reads the table `sky` of a process (help in `sky_help`), and makes the light of any day.
class DaylightSeries {
public:
    /// Beams that come from lower than `lowest_rise`, the sine of their elevation, are left out. Throws UserError.
    DaylightSeries(const Settings& sky, double lowest_rise, std::vector<Diagnostic>* warnings = nullptr);
    /// The same where `sky` may name a weather of the scene; null: it names none.
    DaylightSeries(const Settings& sky, double lowest_rise, const std::shared_ptr<const Weather>& weather,
                   std::vector<Diagnostic>* warnings);

    /// The day on which the light begins, counted from 1 on 1 January.
    double first_day() const { return day_; }

    /// Returns the light of `days` that begin `elapsed` days after the first; their middle day stands for all of them,
    /// but of a measured series, of which every row counts. Throws RunError beyond the series.
    Daylight over(double elapsed, double days) const;
    /// The light between a step and the one before, `days` apart. Step 0 is the beginning, at which no time has passed:
    /// it has the light of step 1, for what is asked per area or second.
    Daylight of_step(int step, double days) const { return over(std::max(0, step - 1) * days, days); }

private:
    /// A short time with one place of the sun.
    struct Moment {
        glm::dvec3 sun;
        double seconds;
        double par, global;  ///< umol m-2 s-1 and W/m2 on level ground
        double diffuse_share;
        int slot;  ///< suns of one slot become one beam
    };
    struct SunSum {
        glm::dvec3 direction{0, 0, 0};
        double on_ground = 0;
    };
    /// What is added up to a Daylight.
    struct Sums {
        Daylight light;
        std::map<int, SunSum> suns;
    };
    struct GivenSun {
        glm::dvec3 towards;
        double share;  ///< of the direct light on level ground
    };
    struct Hour {
        double at, span;
    };

    void read_sky(const Settings& sky);
    void read_steady(const Settings& sky);
    void read_suns(const Settings& sky);
    void read_path(const Settings& sky, std::vector<Diagnostic>* warnings);
    void read_hours(const Settings& sky);
    void read_weather(const Settings& sky, const Weather& weather);
    void read_series(const Settings& sky);
    void require_light_by_day() const;
    SkyRadiance radiance(const glm::dvec3& sun) const;
    void add(const Moment& moment, Sums& sums) const;
    Moment at_hour(double day, const Hour& hour, int slot) const;
    std::vector<Hour> hours_of(double day) const;
    std::vector<Hour> hours_between(double rise, double set, double day) const;
    void add_steady(double days, Sums& sums) const;
    void add_days(double elapsed, double days, Sums& sums) const;
    void add_series(double elapsed, double days, Sums& sums) const;
    Moment measured(double hours, double seconds) const;
    double series_hours(double hours) const;

    double least_rise_;
    std::string kind_;
    std::vector<SkyPart> parts_;
    std::optional<double> steady_, diffuse_;  ///< umol m-2 s-1 of PAR; share of it
    std::optional<LightSeries> series_;
    bool repeats_ = false;
    double sample_ = 0.5;         ///< hours
    std::vector<GivenSun> suns_;  ///< of steady light
    glm::dvec3 north_{0, 0, -1};
    GroundPlace place_;
    double year_ = 2025, day_ = 172, clearness_ = 0.5;
    /// umol of PAR per joule of PAR, and of all wavelengths.
    struct Photons {
        double of_par = 4.57;
        double of_global = 0.5 * 4.57;
    } photons_;
    bool adaptive_ = false;
    std::vector<Hour> hours_;  ///< of a day, and how many each stands for
};

/// What users read of the table.
const std::string& sky_help();

}  // namespace espalier::environment
