#include "environment/light/rays/light_sources.h"

#include "geometry/vectors.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace espalier::environment {

void LightSources::set(const Daylight& light, std::span<const Lamp> lamps, double lamp_seconds,
                       std::span<const double> factors, const Target& target) {
    target_ = target;
    beams_.clear();
    powers_.clear();
    lamp_weights_.clear();
    lamps_ = lamps;
    light_ = 0;
    const double across = 4 * target.radius * target.radius;
    const glm::dvec3 size = target.period ? target.period->upper - target.period->lower : glm::dvec3(0);
    for (const LightBeam& beam : light.beams) {
        if (beam.photons <= 0) continue;
        light_ += beam.photons * (target.period ? size.x * size.z * beam.towards.y : across);
        const glm::dvec3 x = any_across(beam.towards);
        beams_.push_back({beam, x, glm::cross(beam.towards, x)});
        powers_.push_back(light_);
    }
    for (const Lamp& lamp : lamps) {
        BandWeights photons{};
        double most = 0;
        for (std::size_t b = 0; b < factors.size(); ++b) {
            photons[b] = 1e-6 * lamp.photons[b] * lamp_seconds / factors[b];
            most = std::max(most, photons[b]);
        }
        for (double& of_band : photons) of_band /= most;
        lamp_weights_.push_back(photons);
        light_ += most;
        powers_.push_back(light_);
    }
    for (double& sum : powers_) sum /= light_;
}

LightPath LightSources::path(const std::array<double, 4>& sample) const {
    const auto chosen = std::upper_bound(powers_.begin(), powers_.end() - 1, sample[0]);
    const auto source = static_cast<std::size_t>(chosen - powers_.begin());
    return source < beams_.size() ? from_beam(beams_[source], sample) : from_lamp(source - beams_.size(), sample);
}

LightPath LightSources::from_beam(const Beam& beam, const std::array<double, 4>& sample) const {
    const auto& [light, x, y] = beam;
    const auto& [centre, radius, period] = target_;
    LightPath path{{}, -light.towards};
    path.weights.fill(1);
    path.from_sun = light.is_sun;
    if (period) {
        const glm::dvec3 size = period->upper - period->lower;
        path.origin = {period->lower.x + sample[1] * size.x, centre.y + radius, period->lower.z + sample[2] * size.z};
    } else {
        path.origin = centre + radius * (light.towards + (2 * sample[1] - 1) * x + (2 * sample[2] - 1) * y);
    }
    return path;
}

LightPath LightSources::from_lamp(std::size_t lamp, const std::array<double, 4>& sample) const {
    // The number that chose the lamp serves again: within the lamp's share it is as even as before.
    const std::size_t source = beams_.size() + lamp;
    const double below = source > 0 ? powers_[source - 1] : 0;
    const double again = std::clamp((sample[0] - below) / (powers_[source] - below), 0.0, 1 - 1e-12);
    const Lamp::Ray ray = lamps_[lamp].ray({sample[1], sample[2], sample[3], again});
    LightPath path{ray.origin, ray.direction};
    path.weights = lamp_weights_[lamp];
    if (!target_.period) return path;
    for (const int axis : {0, 2}) {
        const double low = target_.period->lower[axis], size = target_.period->upper[axis] - low;
        path.origin[axis] -= size * std::floor((path.origin[axis] - low) / size);
    }
    return path;
}

}  // namespace espalier::environment
