// A landscape: a terrain, species of recorded plants in several levels of detail, and where each plant stands.
#pragma once

#include "archive/landscape/terrain.h"
#include "archive/meshes/surface_mesh.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace espalier::archive {

/// Of a plant as a card, two triangles that turn to the eye and wear its picture (a billboard): what it covers around
/// the middle of a plant, in the plane across the line of sight: right and up, metres.
struct CardFrame {
    glm::dvec3 middle{0};  ///< in the plant's own space
    glm::dvec2 lower{0}, upper{0};
};

/// The rotation that turns +z from a place to the eye and keeps +y as upright as it can be.
glm::dquat towards_eye(const glm::dvec3& place, const glm::dvec3& eye);

/// Two triangles across z around the middle of the plant; u runs to the right, v up, from 0 to 1.
FrameMesh card_mesh(const CardFrame& frame, const std::string& texture);

/// A plant of a stand as the run that planted it recorded it: an internode, its base, radius and colour.
struct StandPlant {
    glm::dvec2 place;  ///< x and z, metres
    double radius;     ///< radius of its crown, metres
    int species;       ///< the colour
};

/// Every internode of a frame is a plant. Throws UserError if there is none, or one without a radius.
std::vector<StandPlant> stand_of(const FrameGeometry& geometry);

/// A recorded plant in its own space: it stands at the origin.
struct LandscapeSpecies {
    std::string name;
    int number;                     ///< its colour in the stand, which several individuals of a species have
    double radius;                  ///< radius of its crown, metres
    double height;                  ///< metres
    std::size_t triangles;          ///< triangles of all its detail
    std::vector<FrameMesh> levels;  ///< the nearest first, then coarser
    std::optional<double> cards;    ///< distance from which on it is a card, if it has its own
};

/// Seen from an eye at this distance (by the plant's own size: the distance by the scale) a plant has the level that
/// begins there.
struct LevelDistances {
    std::vector<double> levels;  ///< ascending; the first 0
    double cards;                ///< from here on plants are cards

    /// The number of a level, or of levels.size() for a card.
    std::size_t level(double distance) const;
};

struct PlantedPlant {
    glm::dvec3 position;
    float scale;
    std::uint16_t species, level,
        turn;  ///< level: `card_level` for a card; turn: one of `card_turns` about the vertical
    static constexpr std::uint16_t card_level = 0xffff;
};

/// Directions from which a species is seen, evenly about the vertical.
inline constexpr std::uint16_t card_turns = 6;
/// Degrees by which a plant of that turn is turned about the vertical.
constexpr double degrees_of_turn(std::uint16_t turn) {
    return 360.0 * turn / card_turns;
}

struct PlantedLandscape {
    Terrain terrain;
    std::vector<LandscapeSpecies> species;
    std::vector<PlantedPlant> plants;
    std::size_t outside = 0;  ///< plants of the stand that stand off the terrain, and are left out

    std::size_t count(std::size_t species_number, std::uint16_t level) const;
    /// Triangles of all plants: the sum over species and levels of their numbers by triangles; cards have two.
    std::size_t triangles() const;
    /// As if all had all their detail.
    std::size_t triangles_in_full() const;
};

/// Puts the stand onto the terrain: each plant as large as its crown says, an individual of its species and turned by
/// chance, with the level of its distance from the eye. Throws UserError for a species that is not there.
PlantedLandscape planted(Terrain terrain, std::vector<LandscapeSpecies> species, const std::vector<StandPlant>& stand,
                         const glm::dvec3& eye, const LevelDistances& distances, std::uint64_t seed);

/// A recorded plant moved to the origin, with levels that are `degrade`d for the distances. `radius` of its crown: none
/// is the mean distance of its outermost points from the middle, in twelve directions.
LandscapeSpecies species_of(const FrameGeometry& geometry, const std::string& name, int number,
                            std::optional<double> radius, const LevelDistances& distances);

}  // namespace espalier::archive
