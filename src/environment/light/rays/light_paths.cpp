#include "environment/light/rays/light_paths.h"

#include "espalier/base/math.h"
#include "espalier/base/random.h"

#include "base/parallel.h"
#include "base/sobol.h"
#include "geometry/vectors.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>

namespace espalier::environment {
namespace {

constexpr double far = std::numeric_limits<double>::infinity();
constexpr int most_periods = 100'000;

/// By the compiler's own function: libc++ has std::atomic_ref from version 19 on alone.
void add_atomically(std::uint64_t& sum, std::uint64_t amount) {
    __atomic_fetch_add(&sum, amount, __ATOMIC_RELAXED);
}

/// A direction of Lambert's law about a normal.
glm::dvec3 lambertian(const glm::dvec3& normal, double u, double v) {
    const glm::dvec3 x = any_across(normal), y = glm::cross(normal, x);
    const double across = std::sqrt(u), angle = 2 * std::numbers::pi * v;
    return across * math::cos(angle) * x + across * math::sin(angle) * y + std::sqrt(1 - u) * normal;
}

}  // namespace

LightPaths::LightPaths(const Optics& optics, std::vector<LightSensor> sensors, Options options)
    : optics_(optics), sensors_(std::move(sensors)), options_(std::move(options)) {
    std::size_t cells = 0;
    for (const LightSensor& sensor : sensors_) {
        first_cells_.push_back(cells);
        cells += sensor.count();
    }
    through_sensors_.resize(cells * bands());
}

Box LightPaths::lit_box(const LitTriangles& triangles) const {
    Box box = triangles.bounds();
    for (const LightSensor& sensor : sensors_) {
        for (const double u : {-0.5, 0.5}) {
            for (const double v : {-0.5, 0.5}) {
                box.add(sensor.middle + u * sensor.size[0] * sensor.x + v * sensor.size[1] * sensor.y);
            }
        }
    }
    if (box.empty()) box.add(glm::dvec3(0, options_.ground, 0));
    if (options_.period) {
        for (const int axis : {0, 2}) {
            box.lower[axis] = options_.period->lower[axis];
            box.upper[axis] = options_.period->upper[axis];
        }
    }
    box.upper.y = std::max(box.upper.y, options_.ground);
    return box;
}

std::size_t LightPaths::set(const LitTriangles& triangles, std::size_t slots, const Daylight& light,
                            std::span<const Lamp> lamps, double lamp_seconds, std::span<const double> factors) {
    triangles_ = &triangles;
    const Box box = lit_box(triangles);
    const std::size_t built = scene_.set_parts(triangles.parts(options_.period));
    centre_ = (box.lower + box.upper) / 2.0;
    radius_ = glm::length(box.upper - box.lower) / 2 + 1e-3;
    top_ = centre_.y + radius_;
    for (const Lamp& lamp : lamps) top_ = std::max(top_, lamp.place.y + 1e-3);
    const glm::dvec3 farthest = glm::max(glm::abs(box.lower), glm::abs(box.upper));
    near_ = 1e-5 * std::max({farthest.x, farthest.y, farthest.z, 1e-3});
    soil_ = options_.ground - 2 * near_;  // light that the soil scatters meets what lies on it
    for (Sums* sums : {&absorbed_, &front_, &back_}) sums->resize(slots * bands());
    sun_.resize(slots);
    towards_.resize(3 * slots);
    set_sources(light, lamps, lamp_seconds, factors, box.upper - box.lower);
    return built;
}

void LightPaths::set_sources(const Daylight& light, std::span<const Lamp> lamps, double lamp_seconds,
                             std::span<const double> factors, const glm::dvec3& size) {
    beams_.clear();
    powers_.clear();
    lamp_weights_.clear();
    lamps_ = lamps;
    light_ = 0;
    const double across = 4 * radius_ * radius_;
    for (const LightBeam& beam : light.beams) {
        if (beam.photons <= 0) continue;
        light_ += beam.photons * (options_.period ? size.x * size.z * beam.towards.y : across);
        const glm::dvec3 x = any_across(beam.towards);
        beams_.push_back({beam, x, glm::cross(beam.towards, x)});
        powers_.push_back(light_);
    }
    for (const Lamp& lamp : lamps) {
        std::array<double, most_bands> photons{};
        double most = 0;
        for (std::size_t b = 0; b < bands(); ++b) {
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

void LightPaths::trace(std::uint32_t paths, std::uint32_t seed) {
    paths_ = paths;
    for (Sums* sums : {&absorbed_, &front_, &back_, &sun_, &towards_, &through_sensors_}) {
        std::fill(sums->begin(), sums->end(), 0);
    }
    ends_ = {};
    if (powers_.empty()) return;
    std::mutex adding;
    for_in_parallel(tbb::blocked_range<std::uint32_t>(0, paths), [&](const tbb::blocked_range<std::uint32_t>& part) {
        Ends ends;
        for (std::uint32_t number = part.begin(); number != part.end(); ++number) {
            end_if_asked();
            follow(number, seed, ends);
        }
        const std::lock_guard guard(adding);
        ends_.add(ends);
    });
}

LightPaths::Path LightPaths::from_beam(const Source& source, const std::array<double, 4>& sample) const {
    const auto& [beam, x, y] = source;
    const glm::dvec3& towards = beam.towards;
    Path path{{}, -towards};
    path.weights.fill(1);
    path.from_sun = beam.is_sun;
    if (options_.period) {
        const Box& period = *options_.period;
        const glm::dvec3 size = period.upper - period.lower;
        path.origin = {period.lower.x + sample[1] * size.x, centre_.y + radius_, period.lower.z + sample[2] * size.z};
    } else {
        path.origin = centre_ + radius_ * (towards + (2 * sample[1] - 1) * x + (2 * sample[2] - 1) * y);
    }
    return path;
}

LightPaths::Path LightPaths::first_of(const std::array<double, 4>& sample) const {
    const auto source =
        static_cast<std::size_t>(std::upper_bound(powers_.begin(), powers_.end() - 1, sample[0]) - powers_.begin());
    if (source < beams_.size()) return from_beam(beams_[source], sample);
    // The number that chose the lamp serves again: within the lamp's share it is as even as before.
    const double below = source > 0 ? powers_[source - 1] : 0;
    const double again = std::clamp((sample[0] - below) / (powers_[source] - below), 0.0, 1 - 1e-12);
    const Lamp::Ray ray = lamps_[source - beams_.size()].ray({sample[1], sample[2], sample[3], again});
    Path path{ray.origin, ray.direction};
    path.weights = lamp_weights_[source - beams_.size()];
    if (!options_.period) return path;
    const Box& period = *options_.period;
    for (const int axis : {0, 2}) {
        const double size = period.upper[axis] - period.lower[axis];
        path.origin[axis] -= size * std::floor((path.origin[axis] - period.lower[axis]) / size);
    }
    return path;
}

void LightPaths::follow(std::uint32_t number, std::uint32_t seed, Ends& ends) {
    const auto sample_of = [&](std::uint32_t bounce) {
        const auto own = static_cast<std::uint32_t>(mix(seed, bounce));
        return options_.evenly ? scrambled_sobol(number, own) : independent_numbers(number, own);
    };
    Path path = first_of(sample_of(0));
    add(ends.brought, path);
    if (path.origin.y < soil_) return add(ends.soil, path);  // it met the soil before
    for (std::uint32_t bounce = 1;; ++bounce) {
        const Met met = advance_with(path, [&](double to) { count_at_sensors(path, to); });
        if (met.kind == Met::Kind::sky) return add(ends.escaped, path);
        const auto sample = [&] { return sample_of(bounce); };  // where the path ends, nobody asks for it
        const bool goes_on =
            met.kind == Met::Kind::soil ? scatter_from_soil(path, sample, ends) : scatter(path, met.hit, sample, ends);
        if (!goes_on) return;
        if (bounce == options_.depth) return add(ends.escaped, path);
        path.is_first = false;
    }
}

/// Goes on to what is met next: a triangle, the soil or the sky. pass(to) is called before each stretch.
template <class Pass>
LightPaths::Met LightPaths::advance_with(Path& path, const Pass& pass) const {
    for (int periods = 0; periods < most_periods; ++periods) {
        const bool goes_down = path.direction.y < 0;
        const double to_soil = goes_down ? std::max(0.0, (soil_ - path.origin.y) / path.direction.y) : far;
        const double side = to_side(path);
        const double limit = std::min(to_soil, side);
        const auto hit = scene_.first_hit(glm::vec3(path.origin), glm::vec3(path.direction),
                                          static_cast<float>(path.near), static_cast<float>(limit));
        pass(hit ? static_cast<double>(hit->distance) : limit);
        if (hit) {
            path.origin += static_cast<double>(hit->distance) * path.direction;
            return {Met::Kind::triangle, *hit};
        }
        if (limit == far) return {};
        path.origin += limit * path.direction;
        if (to_soil <= side) return {Met::Kind::soil, {}};
        if (path.direction.y >= 0 && path.origin.y > top_) return {};
        enter_opposite(path);
    }
    return {};
}

void LightPaths::count_at_sensors(const Path& path, double to) {
    for (std::size_t k = 0; k < sensors_.size(); ++k) {
        const auto crossing = sensors_[k].crossing(path.origin, path.direction, path.near, to);
        if (crossing && crossing->from_front) add(through_sensors_, first_cells_[k] + crossing->cell, path);
    }
}

double LightPaths::to_side(const Path& path) const {
    double nearest = far;
    if (!options_.period) return nearest;
    for (const int axis : {0, 2}) {
        const double along = path.direction[axis];
        if (along == 0) continue;
        const double side = along > 0 ? options_.period->upper[axis] : options_.period->lower[axis];
        nearest = std::min(nearest, std::max(0.0, (side - path.origin[axis]) / along));
    }
    return nearest;
}

/// From a side of the period to the other.
void LightPaths::enter_opposite(Path& path) const {
    for (const int axis : {0, 2}) {
        const double along = path.direction[axis], low = options_.period->lower[axis],
                     high = options_.period->upper[axis];
        const double left = along > 0 ? high - path.origin[axis] : along < 0 ? path.origin[axis] - low : far;
        if (left <= 1e-12 * (high - low)) path.origin[axis] = along > 0 ? low : high;
    }
    path.near = 0;
}

SideOptics LightPaths::optics_of(const LitTriangles::Owner& owner, bool on_back, std::size_t band) const {
    if (owner.kind == LitKind::solid) return {optics_.solid(band), 0};
    return optics_.of(owner.kind, owner.material, band)[on_back];
}

void LightPaths::note_meeting(const Path& path, const LitTriangles::Owner& owner, bool on_back) {
    if (owner.kind == LitKind::solid || (options_.only_scattered && path.is_first)) return;
    add(on_back && owner.kind == LitKind::leaf ? back_ : front_, owner.slot, path);
    if (!path.is_first) return;
    const auto add_units = [](std::uint64_t& sum, double weight) {
        add_atomically(sum, static_cast<std::uint64_t>(units(weight)));
    };
    if (path.from_sun) add_units(sun_[owner.slot], path.weights[0]);
    for (int k = 0; k < 3; ++k) {
        add_units(towards_[3 * owner.slot + static_cast<std::size_t>(k)], -path.weights[0] * path.direction[k]);
    }
}

/// False where the path ends.
template <class Sample>
bool LightPaths::scatter(Path& path, const RayScene::Hit& hit, const Sample& sample_of, Ends& ends) {
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
    Path absorbed = path;
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
    path.near = near_;
    return true;
}

template <class Sample>
bool LightPaths::scatter_from_soil(Path& path, const Sample& sample_of, Ends& ends) {
    Path absorbed = path;
    for (std::size_t b = 0; b < bands(); ++b) {
        const double reflectance = optics_.soil(path.origin, b);
        absorbed.weights[b] *= 1 - reflectance;
        path.weights[b] *= reflectance;
    }
    add(ends.soil, absorbed);
    if (is_spent(path)) {
        add(ends.soil, path);
        return false;
    }
    const std::array<double, 4> sample = sample_of();
    path.direction = lambertian({0, 1, 0}, sample[1], sample[2]);
    path.near = near_;
    return true;
}

bool LightPaths::is_spent(const Path& path) const {
    const auto of_band = path.weights.begin();
    return *std::max_element(of_band, of_band + static_cast<std::ptrdiff_t>(bands())) < options_.residual;
}

std::int64_t LightPaths::units(double weight) {
    return std::llround(weight * 0x1p32);
}

void LightPaths::add(Sums& sums, std::size_t slot, const Path& path) const {
    for (std::size_t b = 0; b < bands(); ++b) {
        add_atomically(sums[slot * bands() + b], static_cast<std::uint64_t>(units(path.weights[b])));
    }
}

void LightPaths::add(OfBands& sums, const Path& path) const {
    for (std::size_t b = 0; b < bands(); ++b) sums[b] += static_cast<std::uint64_t>(units(path.weights[b]));
}

void LightPaths::absorb(const LitTriangles::Owner& owner, const Path& path, Ends& ends) {
    if (owner.kind == LitKind::solid) return add(ends.solids, path);
    if (options_.only_scattered && path.is_first) return add(ends.escaped, path);
    add(absorbed_, owner.slot, path);
}

void LightPaths::Ends::add(const Ends& other) {
    for (std::size_t b = 0; b < most_bands; ++b) {
        brought[b] += other.brought[b];
        soil[b] += other.soil[b];
        solids[b] += other.solids[b];
        escaped[b] += other.escaped[b];
    }
}

glm::dvec3 LightPaths::towards(std::size_t slot) const {
    return {share(towards_[3 * slot]), share(towards_[3 * slot + 1]), share(towards_[3 * slot + 2])};
}

double LightPaths::open_light(const glm::dvec3& place) const {
    double sum = 0;
    for (const auto& [beam, x, y] : beams_) {
        Path path{place, beam.towards, near_};
        constexpr double seen = 0.5;  // the mean of a small leaf's area over all directions, as the light sees it
        if (advance_with(path, [](double) {}).kind == Met::Kind::sky) sum += seen * beam.photons;
    }
    return sum;
}

}  // namespace espalier::environment
