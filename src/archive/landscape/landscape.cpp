#include "archive/landscape/landscape.h"

#include "espalier/base/error.h"
#include "espalier/base/random.h"

#include "archive/meshes/axis_tree.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace espalier::archive {
namespace {

constexpr std::uint64_t salt = 0x6c616e64;

/// Returns the mean distance of the outermost points in directions around the origin.
double crown_radius(const std::vector<glm::vec3>& points) {
    std::array<double, 12> furthest{};
    for (const glm::vec3& point : points) {
        const double angle = std::atan2(point.z, point.x) / (2 * std::numbers::pi) + 0.5;
        const auto sector = std::min(furthest.size() - 1, static_cast<std::size_t>(angle * furthest.size()));
        furthest[sector] = std::max(furthest[sector], std::hypot(double(point.x), double(point.z)));
    }
    double sum = 0;
    for (const double distance : furthest) sum += distance;
    return sum / furthest.size();
}

/// Where the plant's first axis stands; of a plant without axes, its lowest point.
glm::vec3 foot_of(const FrameGeometry& geometry, const FrameMesh& mesh) {
    const AxisTree tree = axis_tree(geometry, {});
    if (!tree.axes.empty()) return tree.internodes[tree.axes.front().first].base;
    const auto lower = [](const glm::vec3& a, const glm::vec3& b) { return a.y < b.y; };
    return *std::min_element(mesh.points.begin(), mesh.points.end(), lower);
}

UserError no_species(int number, const std::vector<LandscapeSpecies>& species) {
    std::vector<int> known;
    for (const LandscapeSpecies& one : species) {
        if (one.number >= 0) known.push_back(one.number);  // those of covers are below
    }
    return UserError(
        fmt::format("the stand has plants of colour {}, and no [[species]] has this `colour`; there are {}", number,
                    fmt::join(known, ", ")));
}

}  // namespace

std::vector<StandPlant> stand_of(const FrameGeometry& geometry) {
    std::vector<StandPlant> stand;
    for (const FrameInternode& internode : internodes_of(geometry)) {
        if (!(internode.base_radius > 0)) {
            throw UserError(
                fmt::format("a plant of the stand at x = {:.6g}, z = {:.6g} has no radius; the model says "
                            "it as the width of its line: !(2 * radius)",
                            internode.base.x, internode.base.z));
        }
        stand.push_back({{internode.base.x, internode.base.z}, internode.base_radius, internode.colour});
    }
    if (stand.empty()) throw UserError("the stand has no plants: its frame has no internodes");
    return stand;
}

std::size_t LevelDistances::level(double distance) const {
    if (distance >= cards) return levels.size();
    const auto next = std::upper_bound(levels.begin(), levels.end(), distance);
    return next == levels.begin() ? 0 : static_cast<std::size_t>(next - levels.begin()) - 1;
}

std::size_t PlantedLandscape::count(std::size_t species_number, std::uint16_t level) const {
    return static_cast<std::size_t>(std::count_if(plants.begin(), plants.end(), [&](const PlantedPlant& plant) {
        return plant.species == species_number && plant.level == level;
    }));
}

std::size_t PlantedLandscape::triangles() const {
    std::size_t sum = 0;
    for (const PlantedPlant& plant : plants) {
        const bool is_card = plant.level == PlantedPlant::card_level;
        sum += is_card ? 2 : species[plant.species].levels[plant.level].triangles.size();
    }
    return sum;
}

std::size_t PlantedLandscape::triangles_in_full() const {
    std::size_t sum = 0;
    for (const PlantedPlant& plant : plants) sum += species[plant.species].triangles;
    return sum;
}

PlantedLandscape planted(Terrain terrain, std::vector<LandscapeSpecies> species, const std::vector<StandPlant>& stand,
                         const glm::dvec3& eye, const LevelDistances& distances, std::uint64_t seed) {
    std::map<int, std::vector<std::uint16_t>> individuals;
    for (std::size_t i = 0; i < species.size(); ++i) {
        individuals[species[i].number].push_back(static_cast<std::uint16_t>(i));
    }
    PlantedLandscape landscape{std::move(terrain), std::move(species), {}};
    const RandomKey key(seed, 0, Stream::placement, salt);
    for (std::size_t i = 0; i < stand.size(); ++i) {
        const StandPlant& plant = stand[i];
        const auto found = individuals.find(plant.species);
        if (found == individuals.end()) throw no_species(plant.species, landscape.species);
        if (!landscape.terrain.holds(plant.place.x, plant.place.y)) {
            ++landscape.outside;
            continue;
        }
        RandomSamples samples(key, i, 0);
        const auto turn = static_cast<std::uint16_t>(card_turns * samples.uniform());
        const std::vector<std::uint16_t>& alike = found->second;
        const std::uint16_t one = alike[static_cast<std::size_t>(samples.uniform() * double(alike.size()))];
        const LandscapeSpecies& kind = landscape.species[one];
        const double scale = plant.radius / kind.radius;
        const glm::dvec3 foot(plant.place.x, landscape.terrain.height(plant.place.x, plant.place.y), plant.place.y);
        const double distance = glm::distance(foot, eye) / scale;
        const bool is_card = kind.cards && distance >= *kind.cards;
        const std::size_t level = is_card ? kind.levels.size() : distances.level(distance);
        landscape.plants.push_back(
            {foot, static_cast<float>(scale), one,
             level < kind.levels.size() ? static_cast<std::uint16_t>(level) : PlantedPlant::card_level, turn});
    }
    return landscape;
}

LandscapeSpecies species_of(const FrameGeometry& geometry, const std::string& name, int number,
                            std::optional<double> radius, const LevelDistances& distances) {
    LandscapeSpecies species{name, number, 0, 0, 0, {}, {}};
    glm::vec3 foot(0);
    for (const double distance : distances.levels) {
        MeshOptions options;
        options.distance = distance;
        FrameMesh mesh = mesh_of(geometry, options);
        if (species.levels.empty()) {
            if (mesh.triangles.empty()) throw UserError(fmt::format("species '{}': there is nothing to draw", name));
            foot = foot_of(geometry, mesh);
            species.triangles = mesh.triangles.size();
        }
        for (glm::vec3& point : mesh.points) point -= foot;
        species.levels.push_back(std::move(mesh));
    }
    const std::vector<glm::vec3>& points = species.levels.front().points;
    species.radius = radius.value_or(crown_radius(points));
    for (const glm::vec3& point : points) species.height = std::max(species.height, double(point.y));
    if (!(species.radius > 0)) {
        throw UserError(fmt::format("species '{}': its crown has no radius; give one as `radius`", name));
    }
    return species;
}

glm::dquat towards_eye(const glm::dvec3& place, const glm::dvec3& eye) {
    const glm::dvec3 line = eye - place;
    if (glm::length(line) == 0) return {1, 0, 0, 0};
    const glm::dvec3 forward = glm::normalize(line);
    glm::dvec3 right = glm::cross(glm::dvec3(0, 1, 0), forward);
    right = glm::length(right) > 1e-9 ? glm::normalize(right) : glm::dvec3(1, 0, 0);
    return glm::quat_cast(glm::dmat3(right, glm::cross(forward, right), forward));
}

FrameMesh card_mesh(const CardFrame& frame, const std::string& texture) {
    FrameMesh mesh;
    mesh.materials.push_back({{255, 255, 255}, texture});
    for (const glm::vec2 corner : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)}) {
        const glm::dvec2 at = frame.lower + glm::dvec2(corner) * (frame.upper - frame.lower);
        mesh.points.emplace_back(at.x, at.y, 0);
        mesh.normals.emplace_back(0, 0, 1);
        mesh.uvs.push_back(corner);
        mesh.rgb.push_back({255, 255, 255});
    }
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.material_of = {0, 0};
    return mesh;
}

}  // namespace espalier::archive
