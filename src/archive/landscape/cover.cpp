#include "archive/landscape/cover.h"

#include "espalier/base/error.h"
#include "espalier/base/random.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

namespace espalier::archive {
namespace {

constexpr std::uint64_t salt_of_cover = 0x636f766572;
constexpr double most_plants = 1e6;

/// Cells along an axis that are nearer to a place than the distance, or might be.
struct Cells {
    Cells(double middle, double distance, double edge)
        : first(static_cast<std::int64_t>(std::floor((middle - distance) / edge))),
          last(static_cast<std::int64_t>(std::ceil((middle + distance) / edge))) {}
    std::int64_t first, last;
};

}  // namespace

// One plant in each cell of a grid, anywhere in it.
std::vector<StandPlant> plants_of(const Cover& cover, const glm::dvec3& eye, std::uint64_t seed) {
    const double number = cover.density * std::numbers::pi * cover.distance * cover.distance;
    if (!(number <= most_plants)) {
        throw UserError(fmt::format("a cover of {:.3g} plants; a lower `density` or `distance` needs fewer", number));
    }
    const double edge = 1 / std::sqrt(cover.density);
    const Cells rows(eye.z, cover.distance, edge), columns(eye.x, cover.distance, edge);
    const RandomKey key(seed, static_cast<std::uint32_t>(cover.species), Stream::placement, salt_of_cover);
    std::vector<StandPlant> plants;
    for (std::int64_t row = rows.first; row < rows.last; ++row) {
        for (std::int64_t column = columns.first; column < columns.last; ++column) {
            RandomSamples samples(key, mix(static_cast<std::uint64_t>(row), static_cast<std::uint64_t>(column)), 0);
            const double across = samples.uniform(), along = samples.uniform();
            const glm::dvec2 place = edge * glm::dvec2(double(column) + across, double(row) + along);
            const double radius = cover.radius * (0.6 + 0.8 * samples.uniform());
            const double away = glm::distance(place, glm::dvec2(eye.x, eye.z)) / cover.distance;
            if (samples.uniform() < 2 - 2 * away) plants.push_back({place, radius, cover.species});
        }
    }
    return plants;
}

}  // namespace espalier::archive
