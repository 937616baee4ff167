#include "environment/sky/daylight.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace espalier::environment {
namespace {

constexpr double seconds_of_day = 86400;

std::vector<std::string> kinds_of_sky() {
    std::vector<std::string> kinds{"uniform", "overcast"};
    for (int type = 1; type <= 15; ++type) kinds.push_back("cie-" + std::to_string(type));
    return kinds;
}

/// How long each hour stands for: to the middles between it and its neighbours, around the clock.
std::vector<double> spans_of(const std::vector<double>& hours) {
    std::vector<double> spans;
    const std::size_t count = hours.size();
    for (std::size_t i = 0; i < count; ++i) {
        const double before = i > 0 ? hours[i - 1] : hours.back() - 24;
        const double after = i + 1 < count ? hours[i + 1] : hours.front() + 24;
        spans.push_back((after - before) / 2);
    }
    return spans;
}

glm::dvec3 unit_vector(const Settings& sky, const char* key, const glm::dvec3& fallback) {
    const glm::dvec3 given = sky.vector_or(key, fallback);
    if (!(glm::length(given) > 0)) {
        throw UserError(sky.place(key), std::string("'") + key + "' must not be the vector of zeros");
    }
    return glm::normalize(given);
}

}  // namespace

DaylightSeries::DaylightSeries(const Settings& sky, double least_rise) : least_rise_(least_rise) {
    read_sky(sky);
    north_ = unit_vector(sky, "north", {0, 0, -1});
    if (north_.y != 0) throw UserError(sky.place("north"), "'north' must be horizontal: [x, 0, z]");
    if (sky.has("diffuse")) diffuse_ = sky.number("diffuse", Range::between(0, 1));
    if (sky.has("par")) {
        given_ = sky.number("par", Range::not_negative());
        sun_ = unit_vector(sky, "sun", {0, 1, 0});
        if (sun_.y < least_rise_ && diffuse_.value_or(1) < 1) {
            throw UserError(sky.place("sun"), "the sun must stand at least 2 degrees above the horizon");
        }
        return;
    }
    place_.latitude = sky.number_or("latitude", 50, Range::between(-90, 90));
    place_.longitude = sky.number_or("longitude", 0, Range::between(-180, 180));
    place_.zone = sky.number_or("zone", 0, Range::between(-14, 14));
    year_ = static_cast<double>(sky.integer_or("year", 2025, Range::between(1950, 2050)));
    day_ = sky.number_or("day", 172, Range::between(1, 366));
    clearness_ = sky.number_or("clearness", 0.5, Range::between(0, 1));
    photons_per_joule_ = 1e-6 * sky.number_or("photons", 4.57, Range::positive()) *
                         sky.number_or("par_share", 0.5, Range::between(0, 1));
    read_hours(sky);
}

void DaylightSeries::read_sky(const Settings& sky) {
    kind_ = sky.choice_or("radiance", "overcast", kinds_of_sky());
    parts_ = sky_parts(sky.integer_or("rings", 5, Range::between(1, 64)),
                       sky.integer_or("around", 8, Range::between(3, 720)));
    std::erase_if(parts_, [&](const SkyPart& part) { return part.towards.y < least_rise_; });
}

void DaylightSeries::read_hours(const Settings& sky) {
    std::vector<double> each;
    for (int hour = 0; hour < 24; ++hour) each.push_back(hour + 0.5);
    hours_ = sky.numbers_or("hours", each);
    if (hours_.empty()) throw UserError(sky.place("hours"), "'hours' must name at least one hour of the day");
    for (std::size_t i = 0; i < hours_.size(); ++i) {
        if (hours_[i] >= 0 && hours_[i] < 24 && (i == 0 || hours_[i] > hours_[i - 1])) continue;
        throw UserError(sky.place("hours"), "'hours' must rise, and lie from 0 to before 24");
    }
    spans_ = spans_of(hours_);
}

SkyRadiance DaylightSeries::radiance(const glm::dvec3& sun) const {
    if (kind_ == "uniform") return SkyRadiance::uniform();
    if (kind_ == "overcast") return SkyRadiance::overcast();
    return SkyRadiance::cie(std::stoi(kind_.substr(4)), sun);
}

Daylight DaylightSeries::over(double elapsed, double days) const {
    if (given_) return given(days);
    Daylight light;
    for (const SkyPart& part : parts_) light.beams.push_back({part.towards});
    const double day = std::floor(day_ + elapsed + days / 2);
    for (std::size_t i = 0; i < hours_.size(); ++i) add_hour({year_, day, hours_[i]}, spans_[i] * 3600 * days, light);
    return light;
}

Daylight DaylightSeries::given(double days) const {
    Daylight light;
    for (const SkyPart& part : parts_) light.beams.push_back({part.towards});
    const double photons = *given_ * 1e-6 * seconds_of_day * days, diffuse = diffuse_.value_or(1);
    add_sky(sun_, photons * diffuse, light);
    if (diffuse < 1) add_sun(sun_, photons * (1 - diffuse), light);
    light.seconds = seconds_of_day * days;
    return light;
}

void DaylightSeries::add_hour(const CivilTime& time, double seconds, Daylight& light) const {
    const SunPosition position = sun_position(place_, time);
    const glm::dvec3 sun = towards_sun(position, north_);
    if (sun.y < least_rise_) return;
    const double photons = clearness_ * extraterrestrial_flux(position) * sun.y * seconds * photons_per_joule_;
    const double diffuse = diffuse_.value_or(diffuse_share(clearness_));
    add_sky(sun, photons * diffuse, light);
    add_sun(sun, photons * (1 - diffuse), light);
    light.seconds += seconds;
}

void DaylightSeries::add_sky(const glm::dvec3& sun, double on_ground, Daylight& light) const {
    const std::vector<double> shares = shares_on_ground(radiance(sun), parts_);
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        light.beams[i].photons += on_ground * shares[i] / parts_[i].towards.y;
    }
    light.on_ground += on_ground;
}

void DaylightSeries::add_sun(const glm::dvec3& sun, double on_ground, Daylight& light) const {
    if (on_ground <= 0) return;
    light.beams.push_back({sun, on_ground / sun.y});
    light.on_ground += on_ground;
}

const std::string& sky_help() {
    static const std::string text =
        R"(The table `sky` says what light there is. PAR are the photosynthetically active photons, 400 to 700 nm.
radiance      "overcast" (1 + 2 cos zenith angle; Moon & Spencer 1942), "uniform", or "cie-1" to "cie-15": the skies of
              ISO 15469:2004, of which cie-12 is the clear one
rings         5: rings of the sky, and `around`, 8 parts of each; so 40 directions. Of light from below 2 degrees above
              the horizon nothing is counted
north         [0, 0, -1]: horizontal direction to the north
diffuse       the share of the light on level ground that comes from the sky; the rest comes from the sun

With par, the light is the same at all times:
par           umol m-2 s-1 on open level ground
sun           [0, 1, 0]: direction to the sun
diffuse       1; share of the light that comes from the sky

Without it, the sun goes its way (Michalsky 1988), and a share of the light above the air reaches the ground:
latitude      50 degrees to the north
longitude     0 degrees to the east
zone          0: hours by which civil time is ahead of Greenwich
year          2025: of the first day
day           172: the first day, counted from 1 on 1 January
hours         [0.5, 1.5, ... 23.5]: hours of civil time at which the sun is looked at; each stands for the time
              to the middles between it and its neighbours. Of a step of several days, the middle day stands for all
clearness     0.5: light on level ground over that above the air (1361 W/m2 across it)
diffuse       after Erbs et al. 1982, from the clearness
par_share     0.5: share of PAR in the light's energy
photons       4.57 umol per joule of PAR (McCree 1972)
)";
    return text;
}

}  // namespace espalier::environment
