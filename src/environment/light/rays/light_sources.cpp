#include "environment/light/rays/light_sources.h"

#include "geometry/vectors.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace espalier::environment {
namespace {

constexpr double golden_section = 0.6180339887498949;
constexpr double shifts = 8;  // of views of the sky, from one to the next that is the same
constexpr double almost_one = 1 - 1e-12;

/// Of a part of the sky whose middle stands in a surface's plane, something lies before the surface.
constexpr double least_cosine = 0.03;

}  // namespace

glm::dvec3 LightSources::direction(const LightBeam& beam, double u, double v) {
    return beam.window.direction(beam.towards, beam.window.rise_across(u), v);
}

/// mol/m2 across its directions.
double LightSources::across(const LightBeam& beam) {
    return beam.window.is_point() ? beam.photons : beam.on_ground() / beam.window.mean_rise();
}

void LightSources::set(const Daylight& light, std::span<const Lamp> lamps, double lamp_seconds,
                       std::span<const double> factors, const Target& target) {
    target_ = target;
    beams_.clear();
    powers_.clear();
    lamp_light_.clear();
    lamp_weights_.clear();
    lamps_ = lamps;
    light_ = 0;
    const double square = 4 * target.radius * target.radius;
    const glm::dvec3 size = target.period ? target.period->upper - target.period->lower : glm::dvec3(0);
    for (const LightBeam& beam : light.beams) {
        if (beam.photons <= 0) continue;
        light_ += target.period ? size.x * size.z * beam.on_ground() : square * across(beam);
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
        lamp_light_.push_back(most);
        lamp_weights_.push_back(photons);
        light_ += most;
        powers_.push_back(light_);
    }
    for (double& sum : powers_) sum /= light_;
}

LightPath LightSources::path(const std::array<double, 4>& sample) const {
    const auto chosen = std::upper_bound(powers_.begin(), powers_.end() - 1, sample[0]);
    const auto source = static_cast<std::size_t>(chosen - powers_.begin());
    // The number that chose the source serves again: within the source's share it is as even as before.
    const double below = source > 0 ? powers_[source - 1] : 0;
    const double again = std::clamp((sample[0] - below) / (powers_[source] - below), 0.0, almost_one);
    return source < beams_.size() ? from_beam(beams_[source], again, sample)
                                  : from_lamp(source - beams_.size(), again, sample);
}

LightPath LightSources::from_beam(const Beam& beam, double again, const std::array<double, 4>& sample) const {
    const auto& [centre, radius, period] = target_;
    const SkyWindow& window = beam.light.window;
    const glm::dvec3 towards = period ? window.direction(beam.light.towards, window.rise_on_ground(again), sample[3])
                                      : direction(beam.light, again, sample[3]);
    LightPath path{{}, -towards};
    path.weights.fill(1);
    path.can_be_sought = true;
    path.from_sun = beam.light.is_sun;
    if (period) {
        const glm::dvec3 size = period->upper - period->lower;
        path.origin = {period->lower.x + sample[1] * size.x, centre.y + radius, period->lower.z + sample[2] * size.z};
        return path;
    }
    const glm::dvec3 x = window.is_point() ? beam.x : any_across(towards);
    const glm::dvec3 y = window.is_point() ? beam.y : glm::cross(towards, x);
    path.origin = centre + radius * (towards + (2 * sample[1] - 1) * x + (2 * sample[2] - 1) * y);
    return path;
}

LightPath LightSources::from_lamp(std::size_t lamp, double again, const std::array<double, 4>& sample) const {
    const Lamp::Ray ray = lamps_[lamp].ray({sample[1], sample[2], sample[3], again});
    LightPath path{ray.origin, ray.direction};
    path.weights = lamp_weights_[lamp];
    path.can_be_sought = can_be_sought(SourceKind::lamp);
    if (target_.period) path.origin = wrapped(path.origin, *target_.period);
    return path;
}

bool LightSources::can_be_sought(SourceKind kind) const {
    if (kind == SourceKind::lamp) return !lamps_.empty() && !target_.period;
    return std::any_of(beams_.begin(), beams_.end(), [&](const Beam& beam) { return holds(kind, beam); });
}

std::vector<LightSources::Parallel> LightSources::parallels(SourceKind kind, std::uint32_t count, double shift,
                                                            double turn) const {
    const auto light_of = [&](const LightBeam& beam) { return target_.period ? beam.on_ground() : across(beam); };
    std::vector<Parallel> each, chosen;
    double light = 0, before = 0;
    bool are_points = true;
    for (const Beam& beam : beams_) {
        if (!holds(kind, beam)) continue;
        each.push_back({beam.light.towards, beam.light.on_ground(), light_of(beam.light)});
        light += each.back().light;
        are_points = are_points && beam.light.window.is_point();
    }
    if (are_points && each.size() <= count) return each;
    const double step = light / count;
    for (const Beam& beam : beams_) {
        if (!holds(kind, beam)) continue;
        const double own = light_of(beam.light);
        while (chosen.size() < count) {
            const double number = static_cast<double>(chosen.size()) + shift, at = number * step - before;
            if (at >= own) break;
            const SkyWindow& window = beam.light.window;
            const double rise = target_.period ? window.rise_on_ground(at / own) : window.rise_across(at / own);
            const double turned = turn + golden_section * shifts * number;
            const glm::dvec3 towards = window.direction(beam.light.towards, rise, turned - std::floor(turned));
            chosen.push_back({towards, target_.period ? step : step * towards.y, step});
        }
        before += own;
    }
    return chosen;
}

bool LightSources::reaches(const glm::dvec3& place, const glm::dvec3& towards) const {
    if (target_.period) return true;
    const glm::dvec3 x = any_across(towards), y = glm::cross(towards, x), from = place - target_.centre;
    return std::abs(glm::dot(from, x)) <= target_.radius && std::abs(glm::dot(from, y)) <= target_.radius;
}

double LightSources::chance_of(const Beam& beam, const LitPatch& patch) const {
    const double cosine = std::abs(glm::dot(patch.normal, beam.light.towards));
    return beam.light.photons * (beam.light.window.is_point() ? cosine : std::max(cosine, least_cosine));
}

/// Without the lamp's directions and the surface's, which may differ within the surface.
double LightSources::chance_of(std::size_t lamp, const LitPatch& patch) const {
    const glm::dvec3 way = lamps_[lamp].place - patch.middle;
    const auto [x, y] = lamps_[lamp].size;
    return lamp_light_[lamp] / (glm::dot(way, way) + patch.area + x * x + y * y);
}

template <class Visit>
void LightSources::visit(SourceKind kind, const LitPatch& patch, const Visit& visit) const {
    if (kind == SourceKind::lamp) {
        for (std::size_t lamp = 0; lamp < lamps_.size(); ++lamp) {
            if (visit(lamp, chance_of(lamp, patch))) return;
        }
        return;
    }
    for (std::size_t beam = 0; beam < beams_.size(); ++beam) {
        if (holds(kind, beams_[beam]) && visit(beam, chance_of(beams_[beam], patch))) return;
    }
}

double LightSources::open_light(SourceKind kind, const LitPatch& patch) const {
    double sum = 0;
    visit(kind, patch, [&](std::size_t, double chance) {
        sum += chance;
        return false;
    });
    return patch.area * sum;
}

SourceRay LightSources::seek(SourceKind kind, const LitPatch& patch, double open, const glm::dvec3& place, double u,
                             double v) const {
    double left = u * open / patch.area, again = 0;
    std::size_t chosen = 0;
    visit(kind, patch, [&](std::size_t source, double chance) {
        if (!(chance > 0)) return false;
        chosen = source;
        again = std::clamp(left / chance, 0.0, almost_one);
        left -= chance;
        return left < 0;
    });
    return kind == SourceKind::lamp ? to_lamp(chosen, patch, place, again, v) : to_sky(beams_[chosen], patch, again, v);
}

SourceRay LightSources::to_sky(const Beam& beam, const LitPatch& patch, double u, double v) const {
    const SkyWindow& window = beam.light.window;
    SourceRay ray{beam.light.towards, std::numeric_limits<double>::infinity(), {}};
    double light = 1;
    if (!window.is_point()) {
        const double rise = window.rise_on_ground(u);
        ray.towards = window.direction(beam.light.towards, rise, v);
        const double per_area = beam.light.on_ground() / rise * std::abs(glm::dot(patch.normal, ray.towards));
        light = per_area / chance_of(beam, patch);
    }
    ray.light.fill(light);
    return ray;
}

SourceRay LightSources::to_lamp(std::size_t lamp, const LitPatch& patch, const glm::dvec3& place, double u,
                                double v) const {
    const glm::dvec3 way = lamps_[lamp].place_of_light(u, v) - place;
    const double length = glm::length(way);
    SourceRay ray{unit_or(way, patch.normal), length, {}};
    if (!(length > 0)) return ray;
    const double per_area = lamp_light_[lamp] * lamps_[lamp].per_steradian(-ray.towards) / (length * length) *
                            std::abs(glm::dot(patch.normal, ray.towards));
    for (std::size_t b = 0; b < ray.light.size(); ++b) {
        ray.light[b] = lamp_weights_[lamp][b] * per_area / chance_of(lamp, patch);
    }
    return ray;
}

}  // namespace espalier::environment
