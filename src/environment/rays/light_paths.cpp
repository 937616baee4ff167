#include "environment/rays/light_paths.h"

#include "espalier/base/math.h"
#include "espalier/base/random.h"

#include "base/parallel.h"
#include "environment/rays/sobol.h"
#include "geometry/vectors.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>

namespace espalier::environment {
namespace {

constexpr double far = std::numeric_limits<double>::infinity();
constexpr std::uint32_t soil = 0xFFFFFFFF, sky = 0xFFFFFFFE;
constexpr int most_periods = 100'000;

/// A direction of Lambert's law about a normal.
glm::dvec3 lambertian(const glm::dvec3& normal, double u, double v) {
    const glm::dvec3 x = any_across(normal), y = glm::cross(normal, x);
    const double across = std::sqrt(u), angle = 2 * std::numbers::pi * v;
    return across * math::cos(angle) * x + across * math::sin(angle) * y + std::sqrt(1 - u) * normal;
}

}  // namespace

void LightPaths::set(LitTriangles& triangles, const Daylight& light) {
    triangles_ = &triangles;
    Box box = triangles.bounds();
    if (box.empty()) box.add(glm::dvec3(0, ground_, 0));
    if (period_) {
        triangles.repeat(*period_);
        for (const int axis : {0, 2}) {
            box.lower[axis] = period_->lower[axis];
            box.upper[axis] = period_->upper[axis];
        }
    }
    box.upper.y = std::max(box.upper.y, ground_);
    scene_.set_triangles(triangles.corners());
    centre_ = (box.lower + box.upper) / 2.0;
    radius_ = glm::length(box.upper - box.lower) / 2 + 1e-3;
    const glm::dvec3 farthest = glm::max(glm::abs(box.lower), glm::abs(box.upper));
    near_ = 1e-5 * std::max({farthest.x, farthest.y, farthest.z, 1e-3});

    beams_.clear();
    powers_.clear();
    double power = 0;
    const double across = 4 * radius_ * radius_;
    const glm::dvec3 size = box.upper - box.lower;
    for (const LightBeam& beam : light.beams) {
        if (beam.photons <= 0) continue;
        power += beam.photons * (period_ ? size.x * size.z * beam.towards.y : across);
        beams_.push_back(beam);
        powers_.push_back(power);
    }
    for (double& sum : powers_) sum /= power;
    on_ground_ = light.on_ground;
    area_lit_ = on_ground_ > 0 ? power / on_ground_ : 0;
}

void LightPaths::trace(std::uint32_t paths, std::uint32_t seed) {
    paths_ = paths;
    absorbed_.assign(triangles_->leaf_areas().size() * bands_.size(), 0);
    by_soil_.assign(bands_.size(), 0);
    escaped_.assign(bands_.size(), 0);
    if (beams_.empty()) return;
    for_in_parallel(std::uint32_t{0}, paths, [&](std::uint32_t number) { follow(number, seed); });
}

LightPaths::Path LightPaths::first_of(const std::array<double, 4>& sample) const {
    const auto beam =
        static_cast<std::size_t>(std::upper_bound(powers_.begin(), powers_.end() - 1, sample[0]) - powers_.begin());
    const glm::dvec3& towards = beams_[beam].towards;
    Path path{{}, -towards};
    path.weights.fill(1);
    if (period_) {
        const glm::dvec3 size = period_->upper - period_->lower;
        path.origin = {period_->lower.x + sample[1] * size.x, centre_.y + radius_,
                       period_->lower.z + sample[2] * size.z};
    } else {
        const glm::dvec3 x = any_across(towards), y = glm::cross(towards, x);
        path.origin = centre_ + radius_ * (towards + (2 * sample[1] - 1) * x + (2 * sample[2] - 1) * y);
    }
    return path;
}

void LightPaths::follow(std::uint32_t number, std::uint32_t seed) {
    const auto sample = [&](std::uint32_t bounce) {
        return scrambled_sobol(number, static_cast<std::uint32_t>(mix(seed, bounce)));
    };
    Path path = first_of(sample(0));
    if (path.origin.y < ground_) return add(by_soil_, 0, path);  // it met the soil before
    for (std::uint32_t bounce = 1;; ++bounce) {
        const std::uint32_t met = advance(path);
        if (met == sky) return add(escaped_, 0, path);
        const bool goes_on = met == soil ? scatter_from_soil(path, sample(bounce)) : scatter(path, met, sample(bounce));
        if (!goes_on) return;
    }
}

/// Goes on to what is met next: a triangle, the soil or the sky.
std::uint32_t LightPaths::advance(Path& path) const {
    for (int periods = 0; periods < most_periods; ++periods) {
        const double down = path.direction.y < 0 ? (ground_ - path.origin.y) / path.direction.y : far;
        const double to_soil = down >= path.near ? down : far, side = to_side(path);
        const double limit = std::min(to_soil, side);
        const auto hit = scene_.first_hit(glm::vec3(path.origin), glm::vec3(path.direction),
                                          static_cast<float>(path.near), static_cast<float>(limit));
        if (hit) {
            path.origin += static_cast<double>(hit->distance) * path.direction;
            return hit->triangle;
        }
        if (limit == far) return sky;
        path.origin += limit * path.direction;
        if (to_soil <= side) return soil;
        if (path.direction.y >= 0 && path.origin.y > centre_.y + radius_) return sky;
        enter_opposite(path);
    }
    return sky;
}

double LightPaths::to_side(const Path& path) const {
    double nearest = far;
    if (!period_) return nearest;
    for (const int axis : {0, 2}) {
        const double along = path.direction[axis];
        if (along == 0) continue;
        const double side = along > 0 ? period_->upper[axis] : period_->lower[axis];
        nearest = std::min(nearest, std::max(0.0, (side - path.origin[axis]) / along));
    }
    return nearest;
}

/// From a side of the period to the other.
void LightPaths::enter_opposite(Path& path) const {
    for (const int axis : {0, 2}) {
        const double along = path.direction[axis], low = period_->lower[axis], high = period_->upper[axis];
        const double left = along > 0 ? high - path.origin[axis] : along < 0 ? path.origin[axis] - low : far;
        if (left <= 1e-12 * (high - low)) path.origin[axis] = along > 0 ? low : high;
    }
    path.near = 0;
}

/// False where the path ends.
bool LightPaths::scatter(Path& path, std::uint32_t triangle, const std::array<double, 4>& sample) {
    const LitTriangles::Owner& owner = triangles_->owner(triangle);
    const glm::dvec3 normal = triangles_->normal(triangle);
    double back = 0, through = 0;
    for (const OpticalBand& band : bands_) {
        back += owner.kind == LitKind::leaf ? band.leaf_reflectance : band.stem_reflectance;
        through += owner.kind == LitKind::leaf ? band.leaf_transmittance : 0;
    }
    if (!(back + through > 0) || normal == glm::dvec3(0)) {
        add(absorbed_, owner.slot, path);
        return false;
    }
    const double chance = back / (back + through);
    const bool turns_back = sample[0] < chance;
    Path absorbed = path;
    for (std::size_t b = 0; b < bands_.size(); ++b) {
        const OpticalBand& band = bands_[b];
        const double reflected = owner.kind == LitKind::leaf ? band.leaf_reflectance : band.stem_reflectance;
        const double transmitted = owner.kind == LitKind::leaf ? band.leaf_transmittance : 0;
        absorbed.weights[b] *= 1 - reflected - transmitted;
        path.weights[b] *= turns_back ? reflected / chance : transmitted / (1 - chance);
    }
    add(absorbed_, owner.slot, absorbed);
    if (ends(path)) {
        add(absorbed_, owner.slot, path);
        return false;
    }
    const glm::dvec3 facing = glm::dot(path.direction, normal) < 0 ? normal : -normal;
    path.direction = lambertian(turns_back ? facing : -facing, sample[1], sample[2]);
    path.near = near_;
    return true;
}

bool LightPaths::scatter_from_soil(Path& path, const std::array<double, 4>& sample) {
    Path absorbed = path;
    for (std::size_t b = 0; b < bands_.size(); ++b) {
        absorbed.weights[b] *= 1 - bands_[b].soil_reflectance;
        path.weights[b] *= bands_[b].soil_reflectance;
    }
    add(by_soil_, 0, absorbed);
    if (ends(path)) {
        add(by_soil_, 0, path);
        return false;
    }
    path.direction = lambertian({0, 1, 0}, sample[1], sample[2]);
    path.near = near_;
    return true;
}

bool LightPaths::ends(const Path& path) const {
    const auto of_band = path.weights.begin();
    return *std::max_element(of_band, of_band + static_cast<std::ptrdiff_t>(bands_.size())) < residual_;
}

void LightPaths::add(Sums& sums, std::size_t slot, const Path& path) const {
    for (std::size_t b = 0; b < bands_.size(); ++b) {
        const auto share = static_cast<std::uint64_t>(std::llround(path.weights[b] * 0x1p32));
        std::atomic_ref(sums[slot * bands_.size() + b]).fetch_add(share, std::memory_order_relaxed);
    }
}

double LightPaths::open_share(const glm::dvec3& place) const {
    double sum = 0;
    for (const LightBeam& beam : beams_) {
        Path path{place, beam.towards, near_};
        constexpr double seen = 0.5;  // the mean of a small leaf's area over all directions, as the light sees it
        if (advance(path) == sky) sum += seen * beam.photons;
    }
    return on_ground_ > 0 ? sum / on_ground_ : 0;
}

}  // namespace espalier::environment
