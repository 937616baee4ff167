// What an instrument records of plants: points of known origin.
#pragma once

#include "study/scan/instruments.h"
#include "study/scan/scanned_plants.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace espalier::study {

struct ScanOptions {
    double range = 100;         ///< m
    double divergence = 0;      ///< full angle of a beam's cone, degrees; 0: a line
    int rays = 1;               ///< by which a beam's cone is sampled
    double resolution = 0.1;    ///< m along a beam, below which two returns are one
    double distance_noise = 0;  ///< standard deviation, m
    double angle_noise = 0;     ///< standard deviation, degrees
    std::uint64_t seed = 0;
    double pulse_rate = 300'000;  ///< beams a second; changes nothing but the times of points
};

struct ScanPoint {
    glm::dvec3 place;  ///< m, where the instrument takes it to be
    std::size_t beam = 0;
    std::uint16_t number = 1, of = 1;  ///< of the returns of its beam
    float distance = 0;                ///< m, as measured
    float depth = 0;                   ///< m between the nearest and the farthest ray of it
    double time = 0;                   ///< s, of its beam
    glm::vec3 direction{0};            ///< in which the instrument takes the beam to go
    float intensity = 0;               ///< share of the beam that met it, times the cosine of its angle
    std::optional<std::size_t> organ;  ///< none: the ground
};

/// Points beam after beam, nearest first; the same for any number of threads. Rays of one beam that meet within
/// `resolution` are one return, at their mean distance, of the organ that most of them met. `wants_stop`: asked now and
/// then; true ends it, and what there is so far is returned.
std::vector<ScanPoint> scan(const ScannedPlants& plants, std::span<const Beam> beams, const ScanOptions& options,
                            const std::function<bool(std::size_t done)>& wants_stop = {});

}  // namespace espalier::study
