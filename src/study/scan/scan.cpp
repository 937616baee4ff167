#include "study/scan/scan.h"

#include "espalier/base/random.h"

#include "geometry/vectors.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace espalier::study {
namespace {

constexpr std::size_t beams_together = 4096, turns_together = 64;

/// Rays over the cone, evenly by a sunflower's spiral (Vogel 1979); the first is its middle.
glm::dvec3 ray_of_cone(const glm::dvec3& direction, double half_angle, int ray, int rays) {
    if (ray == 0 || half_angle == 0) return direction;
    constexpr double golden = 2.39996322972865332;
    const double away = std::tan(half_angle) * std::sqrt((ray + 0.5) / rays), turn = golden * ray;
    const glm::dvec3 x = geometry::any_across(direction), y = glm::cross(direction, x);
    return glm::normalize(direction + away * (std::cos(turn) * x + std::sin(turn) * y));
}

/// Rays of a beam that met something at about one distance.
struct Return {
    double distance = 0;  ///< sum of distances
    float nearest = 0, farthest = 0;
    double facing = 0;  ///< sum of cosines
    int rays = 0;
    std::map<std::size_t, int> organs;  ///< rays that met each; the ground is the last number
};

std::vector<Return> returns_of(std::vector<Touch>& touches, double resolution) {
    constexpr std::size_t ground = -1;
    std::stable_sort(touches.begin(), touches.end(),
                     [](const Touch& a, const Touch& b) { return a.distance < b.distance; });
    std::vector<Return> returns;
    double last = -std::numeric_limits<double>::infinity();
    for (const Touch& touch : touches) {
        if (touch.distance - last > resolution) returns.emplace_back().nearest = touch.distance;
        last = touch.distance;
        Return& current = returns.back();
        current.farthest = touch.distance;
        current.distance += touch.distance;
        current.facing += touch.facing;
        ++current.rays;
        ++current.organs[touch.organ.value_or(ground)];
    }
    return returns;
}

class Scanner {
public:
    Scanner(const ScannedPlants& plants, std::span<const Beam> beams, const ScanOptions& options)
        : plants_(plants), beams_(beams), options_(options), key_(options.seed, 0, Stream::process, 0x7363616E) {}

    void send(std::size_t number, std::vector<ScanPoint>& points) const {
        const Beam& beam = beams_[number];
        RandomSamples samples(key_, number, 0);
        std::vector<Touch> touches;
        const double half = glm::radians(options_.divergence) / 2;
        for (int ray = 0; ray < options_.rays; ++ray) {
            const glm::dvec3 along = ray_of_cone(beam.direction, half, ray, options_.rays);
            const auto touch =
                plants_.touch(glm::vec3(beam.origin), glm::vec3(along), static_cast<float>(options_.range));
            if (touch) touches.push_back(*touch);
        }
        if (touches.empty()) return;
        const glm::dvec3 believed = believed_direction(beam.direction, samples);
        const std::vector<Return> returns = returns_of(touches, options_.resolution);
        for (std::size_t i = 0; i < returns.size(); ++i) {
            ScanPoint& point = points.emplace_back(point_of(returns[i]));
            const double noise = options_.distance_noise > 0 ? options_.distance_noise * samples.normal() : 0;
            const double distance = std::max(0.0, point.distance + noise);
            point.distance = static_cast<float>(distance);
            point.place = beam.origin + believed * distance;
            point.beam = number;
            point.time = static_cast<double>(number) / options_.pulse_rate;
            point.direction = glm::vec3(believed);
            point.number = static_cast<std::uint16_t>(i + 1);
            point.of = static_cast<std::uint16_t>(returns.size());
        }
    }

private:
    glm::dvec3 believed_direction(const glm::dvec3& direction, RandomSamples& samples) const {
        if (!(options_.angle_noise > 0)) return direction;
        const double noise = glm::radians(options_.angle_noise);
        const glm::dvec3 across = geometry::any_across(direction), other = glm::cross(direction, across);
        const double x = noise * samples.normal(), y = noise * samples.normal();
        return glm::normalize(direction + x * across + y * other);
    }

    ScanPoint point_of(const Return& met) const {
        const auto most = std::max_element(met.organs.begin(), met.organs.end(),
                                           [](const auto& a, const auto& b) { return a.second < b.second; });
        ScanPoint point;
        point.distance = static_cast<float>(met.distance / met.rays);
        point.depth = met.farthest - met.nearest;
        point.intensity = static_cast<float>(met.facing / options_.rays);
        if (most->first != std::size_t(-1)) point.organ = most->first;
        return point;
    }

    const ScannedPlants& plants_;
    std::span<const Beam> beams_;
    const ScanOptions& options_;
    RandomKey key_;
};

}  // namespace

std::vector<ScanPoint> scan(const ScannedPlants& plants, std::span<const Beam> beams, const ScanOptions& options,
                            const std::function<bool(std::size_t)>& wants_stop) {
    const Scanner scanner(plants, beams, options);
    std::vector<ScanPoint> points;
    const std::size_t turn = beams_together * turns_together;
    for (std::size_t begin = 0; begin < beams.size(); begin += turn) {
        if (wants_stop && wants_stop(begin)) return points;
        const std::size_t end = std::min(begin + turn, beams.size());
        std::vector<std::vector<ScanPoint>> pieces((end - begin + beams_together - 1) / beams_together);
        tbb::parallel_for(std::size_t{0}, pieces.size(), [&](std::size_t piece) {
            const std::size_t first = begin + piece * beams_together;
            for (std::size_t beam = first; beam < std::min(first + beams_together, end); ++beam) {
                scanner.send(beam, pieces[piece]);
            }
        });
        for (const auto& piece : pieces) points.insert(points.end(), piece.begin(), piece.end());
    }
    return points;
}

}  // namespace espalier::study
