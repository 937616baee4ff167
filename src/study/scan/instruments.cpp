#include "study/scan/instruments.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>

namespace espalier::study {
namespace {

glm::dvec3 direction(double azimuth, double elevation) {
    const double turn = glm::radians(azimuth), rise = glm::radians(elevation);
    return {std::cos(rise) * std::sin(turn), std::sin(rise), -std::cos(rise) * std::cos(turn)};
}

std::size_t steps_between(double low, double high, double step) {
    return static_cast<std::size_t>(std::floor((high - low) / step + 1e-9)) + 1;
}

}  // namespace

std::vector<Beam> TripodScanner::beams() const {
    std::vector<Beam> all;
    const bool is_whole_turn = last_azimuth - first_azimuth >= 360;
    const std::size_t rows = steps_between(lowest, highest, step);
    const std::size_t columns = steps_between(first_azimuth, last_azimuth, step) - (is_whole_turn ? 1 : 0);
    all.reserve(rows * columns);
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t column = 0; column < columns; ++column) {
            all.push_back({place, direction(first_azimuth + static_cast<double>(column) * step,
                                            lowest + static_cast<double>(row) * step)});
        }
    }
    return all;
}

double FlyingScanner::expected_beams() const {
    const double width = 2 * std::max(from.y, to.y) * std::tan(glm::radians(half_angle));
    return density * width * std::max(1.0, glm::distance(from, to));
}

std::vector<Beam> FlyingScanner::beams() const {
    std::vector<Beam> all;
    const double spacing = 1 / std::sqrt(density);
    const glm::dvec3 path = to - from;
    const double length = glm::length(path);
    const glm::dvec3 along = length > 0 ? path / length : glm::dvec3(1, 0, 0);
    const glm::dvec3 aside = glm::normalize(glm::cross(along, glm::dvec3(0, 1, 0)));
    const std::size_t lines = steps_between(0, length, spacing);
    for (std::size_t line = 0; line < lines; ++line) {
        const glm::dvec3 place = from + along * (static_cast<double>(line) * spacing);
        const double reach = place.y * std::tan(glm::radians(half_angle));
        const std::size_t beams = steps_between(-reach, reach, spacing);
        for (std::size_t i = 0; i < beams; ++i) {
            const double offset = -reach + static_cast<double>(i) * spacing;
            all.push_back({place, glm::normalize(aside * offset - glm::dvec3(0, place.y, 0))});
        }
    }
    return all;
}

std::vector<Beam> DepthCamera::beams() const {
    std::vector<Beam> all;
    all.reserve(width * height);
    const glm::dvec3 ahead = glm::normalize(target - eye);
    const glm::dvec3 up = std::abs(ahead.y) < 0.999 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, -1);
    const glm::dvec3 right = glm::normalize(glm::cross(ahead, up)), above = glm::cross(right, ahead);
    const double half = std::tan(glm::radians(angle) / 2), pixel = 2 * half / static_cast<double>(height);
    for (std::size_t row = 0; row < height; ++row) {
        for (std::size_t column = 0; column < width; ++column) {
            const double x = (static_cast<double>(column) + 0.5 - static_cast<double>(width) / 2) * pixel;
            const double y = (static_cast<double>(height) / 2 - static_cast<double>(row) - 0.5) * pixel;
            all.push_back({eye, glm::normalize(ahead + x * right + y * above)});
        }
    }
    return all;
}

}  // namespace espalier::study
