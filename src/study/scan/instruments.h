// Instruments that send beams: a scanner on a tripod, one that flies, a depth camera. Metres, degrees, y upwards.
#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace espalier::study {

struct Beam {
    glm::dvec3 origin, direction;  ///< the direction has the length 1
};

/// Of a scanner that turns about the vertical: rows of equal elevation, each from the first azimuth on.
struct TripodScanner {
    glm::dvec3 place{0};
    double step = 0.2;                                ///< degrees between beams
    double lowest = -60, highest = 90;                ///< elevations
    double first_azimuth = -180, last_azimuth = 180;  ///< from the direction -z, towards +x

    /// About how many beams() makes.
    double expected_beams() const { return (last_azimuth - first_azimuth) / step * ((highest - lowest) / step + 1); }
    std::vector<Beam> beams() const;
};

/// Of one that flies straight and swings from side to side: parallel lines of beams on the ground.
struct FlyingScanner {
    glm::dvec3 from{0}, to{0};
    double density = 10;     ///< beams per m2 of level ground at height 0
    double half_angle = 20;  ///< degrees, to each side

    double expected_beams() const;
    std::vector<Beam> beams() const;
};

/// Of a camera: a beam a pixel, row after row from the upper left.
struct DepthCamera {
    glm::dvec3 eye{0}, target{0, 0, -1};
    double angle = 40;  ///< degrees, of the height of the picture
    std::size_t width = 640, height = 480;

    std::vector<Beam> beams() const;
};

}  // namespace espalier::study
