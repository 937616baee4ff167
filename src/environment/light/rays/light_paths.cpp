#include "environment/light/rays/light_paths.h"

#include "espalier/base/math.h"
#include "espalier/base/random.h"

#include "base/parallel.h"
#include "base/sobol.h"
#include "geometry/vectors.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>

namespace espalier::environment {
namespace {

/// A direction of Lambert's law about a normal.
glm::dvec3 lambertian(const glm::dvec3& normal, double u, double v) {
    const glm::dvec3 x = any_across(normal), y = glm::cross(normal, x);
    const double across = std::sqrt(u), angle = 2 * std::numbers::pi * v;
    return across * math::cos(angle) * x + across * math::sin(angle) * y + std::sqrt(1 - u) * normal;
}

std::size_t count_cells(std::span<const LightSensor> sensors) {
    std::size_t cells = 0;
    for (const LightSensor& sensor : sensors) cells += sensor.count();
    return cells;
}

}  // namespace

LightPaths::LightPaths(const Optics& optics, std::vector<LightSensor> sensors, Options options)
    : optics_(optics),
      sensors_(std::move(sensors)),
      options_(std::move(options)),
      space_(options_.ground, options_.period),
      tally_(bands(), count_cells(sensors_)) {
    for (std::size_t k = 0; k < sensors_.size(); ++k) first_cells_.push_back(count_cells({sensors_.data(), k}));
}

std::size_t LightPaths::set(const LitTriangles& triangles, std::size_t slots, const Daylight& light,
                            std::span<const Lamp> lamps, double lamp_seconds, std::span<const double> factors) {
    triangles_ = &triangles;
    slots_ = slots;
    double highest = -std::numeric_limits<double>::infinity();
    for (const Lamp& lamp : lamps) highest = std::max(highest, lamp.place.y + 1e-3);
    const std::size_t built = space_.set(triangles, sensors_, highest);
    sources_.set(light, lamps, lamp_seconds, factors, {space_.centre(), space_.radius(), space_.period()});
    tally_.begin(slots, 1);
    return built;
}

void LightPaths::trace(std::uint32_t paths, std::uint32_t seed) {
    tally_.begin(slots_, paths);
    if (sources_.empty()) return;
    std::mutex adding;
    for_in_parallel(tbb::blocked_range<std::uint32_t>(0, paths), [&](const tbb::blocked_range<std::uint32_t>& part) {
        Ends ends;
        for (std::uint32_t number = part.begin(); number != part.end(); ++number) {
            end_if_asked();
            follow(number, seed, ends);
        }
        const std::lock_guard guard(adding);
        tally_.add(ends);
    });
}

/// A path begins with all light of its source. Wherever it meets something, a part of it is absorbed there, and the
/// rest goes on in one direction, by chance that of what is reflected or of what is transmitted, until little is left:
/// absorbed (leaves, stems, solids) + soil + escaped = incoming.
void LightPaths::follow(std::uint32_t number, std::uint32_t seed, Ends& ends) {
    const auto sample_of = [&](std::uint32_t bounce) {
        const auto own = static_cast<std::uint32_t>(mix(seed, bounce));
        return options_.evenly ? scrambled_sobol(number, own) : independent_numbers(number, own);
    };
    LightPath path = sources_.path(sample_of(0));
    tally_.add(ends.brought, path.weights);
    if (path.origin.y < space_.soil()) return tally_.add(ends.soil, path.weights);  // it met the soil before
    for (std::uint32_t bounce = 1;; ++bounce) {
        const LitSpace::Met met = space_.advance(path, [&](double to) { count_at_sensors(path, to); });
        if (met.kind == LitSpace::Met::Kind::sky) return tally_.add(ends.escaped, path.weights);
        const auto sample = [&] { return sample_of(bounce); };  // where the path ends, nobody asks for it
        const bool goes_on = met.kind == LitSpace::Met::Kind::soil ? scatter_from_soil(path, sample, ends)
                                                                   : scatter(path, met.hit, sample, ends);
        if (!goes_on) return;
        if (bounce == options_.depth) return tally_.add(ends.escaped, path.weights);
        path.is_first = false;
    }
}

void LightPaths::count_at_sensors(const LightPath& path, double to) {
    for (std::size_t k = 0; k < sensors_.size(); ++k) {
        const auto crossing = sensors_[k].crossing(path.origin, path.direction, path.near, to);
        if (crossing && crossing->from_front) tally_.pass_cell(first_cells_[k] + crossing->cell, path.weights);
    }
}

SideOptics LightPaths::optics_of(const LitTriangles::Owner& owner, bool on_back, std::size_t band) const {
    if (owner.kind == LitKind::solid) return {optics_.solid(band), 0};
    return optics_.of(owner.kind, owner.material, band)[on_back];
}

void LightPaths::note_meeting(const LightPath& path, const LitTriangles::Owner& owner, bool on_back) {
    if (owner.kind == LitKind::solid || (options_.only_scattered && path.is_first)) return;
    if (on_back && owner.kind == LitKind::leaf) {
        tally_.meet_back(owner.slot, path.weights);
    } else {
        tally_.meet_front(owner.slot, path.weights);
    }
    if (path.is_first) tally_.meet_first(owner.slot, path);
}

/// False where the path ends.
template <class Sample>
bool LightPaths::scatter(LightPath& path, const RayScene::Hit& hit, const Sample& sample_of, Ends& ends) {
    const LitTriangles::Owner& owner = triangles_->owner(hit);
    const glm::dvec3 normal = triangles_->normal(hit);
    const bool on_back = glm::dot(path.direction, normal) > 0;
    note_meeting(path, owner, on_back);
    std::array<SideOptics, most_bands> optics;
    double back = 0, through = 0;
    for (std::size_t b = 0; b < bands(); ++b) {
        optics[b] = optics_of(owner, on_back, b);
        back += path.weights[b] * optics[b].reflectance;
        through += path.weights[b] * optics[b].transmittance;
    }
    if (!(back + through > 0) || normal == glm::dvec3(0)) {
        absorb(owner, path, ends);
        return false;
    }
    const std::array<double, 4> sample = sample_of();
    const double chance = back / (back + through);
    const bool turns_back = sample[0] < chance;
    LightPath absorbed = path;
    for (std::size_t b = 0; b < bands(); ++b) {
        const auto [reflected, transmitted] = optics[b];
        absorbed.weights[b] *= 1 - reflected - transmitted;
        path.weights[b] *= turns_back ? reflected / chance : transmitted / (1 - chance);
    }
    absorb(owner, absorbed, ends);
    if (is_spent(path)) {
        absorb(owner, path, ends);
        return false;
    }
    const glm::dvec3 facing = on_back ? -normal : normal;
    path.direction = lambertian(turns_back ? facing : -facing, sample[1], sample[2]);
    path.near = space_.near();
    return true;
}

template <class Sample>
bool LightPaths::scatter_from_soil(LightPath& path, const Sample& sample_of, Ends& ends) {
    LightPath absorbed = path;
    for (std::size_t b = 0; b < bands(); ++b) {
        const double reflectance = optics_.soil(path.origin, b);
        absorbed.weights[b] *= 1 - reflectance;
        path.weights[b] *= reflectance;
    }
    tally_.add(ends.soil, absorbed.weights);
    if (is_spent(path)) {
        tally_.add(ends.soil, path.weights);
        return false;
    }
    const std::array<double, 4> sample = sample_of();
    path.direction = lambertian({0, 1, 0}, sample[1], sample[2]);
    path.near = space_.near();
    return true;
}

bool LightPaths::is_spent(const LightPath& path) const {
    const auto of_band = path.weights.begin();
    return *std::max_element(of_band, of_band + static_cast<std::ptrdiff_t>(bands())) < options_.residual;
}

void LightPaths::absorb(const LitTriangles::Owner& owner, const LightPath& path, Ends& ends) {
    if (owner.kind == LitKind::solid) return tally_.add(ends.solids, path.weights);
    if (options_.only_scattered && path.is_first) return tally_.add(ends.escaped, path.weights);
    tally_.absorb(owner.slot, path.weights);
}

double LightPaths::open_light(const glm::dvec3& place) const {
    double sum = 0;
    sources_.for_beams([&](const LightBeam& beam) {
        LightPath path{place, beam.towards, space_.near()};
        constexpr double seen = 0.5;  // the mean of a small leaf's area over all directions, as the light sees it
        const LitSpace::Met met = space_.advance(path, [](double) {});
        if (met.kind == LitSpace::Met::Kind::sky) sum += seen * beam.photons;
    });
    return sum;
}

}  // namespace espalier::environment
