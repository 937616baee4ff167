// leaves: leaves, blossoms or fruit along internodes.
// Brzoska 2019, sections 3.5 and 5.1: a fractional number for each node, sizes of a normal distribution with a
// deviation of a fifth, on thin internodes alone. Random turns are those of Shoemake 1992.
#include "espalier/base/file.h"
#include "espalier/base/math.h"
#include "espalier/turtle/geometry_stage.h"

#include "base/picture_file.h"
#include "base/text.h"
#include "geometry/surface_id.h"
#include "geometry/vectors.h"
#include "turtle/foliage/bearing_nodes.h"
#include "turtle/foliage/cards.h"
#include "turtle/foliage/leaf_shade.h"
#include "turtle/foliage/leaf_shapes.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace espalier::turtle {
namespace {

namespace fs = std::filesystem;

constexpr double golden_angle = std::numbers::pi * 137.5 / 180;

/// Uniform among all turns.
glm::dquat random_turn(RandomSamples& samples) {
    const double share = samples.uniform(), a = 2 * std::numbers::pi * samples.uniform(),
                 b = 2 * std::numbers::pi * samples.uniform();
    const double s = std::sqrt(1 - share), c = std::sqrt(share);
    return {c * math::cos(b), s * math::sin(a), s * math::cos(a), c * math::sin(b)};
}

/// Which nodes bear how many.
class LeafCounts {
public:
    explicit LeafCounts(Settings& settings) {
        if (settings.has("number") && settings.has("per_node")) {
            throw UserError(settings.place("number"), "'number' counts all leaves of a plant: without 'per_node'");
        }
        if (settings.has("number")) {
            number_ = static_cast<std::size_t>(settings.integer("number", Range::between(0, 1e7)));
        } else {
            per_node_ = settings.number_or("per_node", 1, Range::between(0, 1000));
        }
    }

    std::vector<std::uint32_t> of(const std::vector<BearingNode>& nodes, RandomKey key) const {
        if (nodes.empty()) return {};
        std::vector<double> chances;
        for (const BearingNode& node : nodes) chances.push_back(RandomSamples(key, node.identity, 0).uniform());
        return number_ ? in_all(chances) : at_each(chances);
    }

private:
    std::vector<std::uint32_t> at_each(const std::vector<double>& chances) const {
        const double sure = std::floor(per_node_);
        std::vector<std::uint32_t> counts;
        for (const double chance : chances) {
            counts.push_back(static_cast<std::uint32_t>(sure) + (chance < per_node_ - sure ? 1 : 0));
        }
        return counts;
    }

    /// The same number at all nodes, and one more at those that drew the smallest chances.
    std::vector<std::uint32_t> in_all(const std::vector<double>& chances) const {
        const std::size_t nodes = chances.size();
        std::vector<std::uint32_t> counts(nodes, static_cast<std::uint32_t>(*number_ / nodes));
        std::vector<std::size_t> order(nodes);
        std::iota(order.begin(), order.end(), std::size_t{0});
        const auto rest = order.begin() + static_cast<std::ptrdiff_t>(*number_ % nodes);
        std::nth_element(order.begin(), rest, order.end(), [&](std::size_t a, std::size_t b) {
            return chances[a] != chances[b] ? chances[a] < chances[b] : a < b;
        });
        for (auto node = order.begin(); node != rest; ++node) ++counts[*node];
        return counts;
    }

    double per_node_ = 1;
    std::optional<std::size_t> number_;
};

/// How leaves are turned.
class LeafTurns {
public:
    explicit LeafTurns(Settings& settings)
        : kind_(settings.choice_or("orientation", "random", {"random", "light", "out"})) {
        if (kind_ == "light") {
            light_ = settings.vector_or("light", light_);
            const double length = glm::length(light_);
            if (!(length > 0) || !std::isfinite(length)) {
                throw UserError(settings.place("light"), "'light' must be a finite direction and not zero");
            }
            light_ /= length;
        } else if (kind_ == "out") {
            const double degrees = settings.number_or("angle", 60, Range::between(0, 180));
            angle_ = degrees * std::numbers::pi / 180;
        }
    }

    Pose pose(const BearingNode& node, const BearingPlace& place, std::uint32_t leaf, RandomSamples& samples) const {
        if (kind_ == "random") return turned(place.position, random_turn(samples));
        if (kind_ == "light") return facing_light(place.position, 2 * std::numbers::pi * samples.uniform());
        return outward(place, node.reference, golden_angle * (double(node.number) + leaf));
    }

private:
    static Pose turned(const glm::dvec3& position, const glm::dquat& turn) {
        return {position, turn * glm::dvec3(0, 1, 0), turn * glm::dvec3(1, 0, 0), turn * glm::dvec3(0, 0, 1)};
    }

    Pose facing_light(const glm::dvec3& position, double around) const {
        const glm::dvec3 a = glm::normalize(glm::cross(light_, axis_apart_from(light_))), b = glm::cross(light_, a);
        const glm::dvec3 heading = math::cos(around) * a + math::sin(around) * b;
        return {position, heading, glm::cross(heading, light_), light_};
    }

    /// The upper side towards the tip of the internode.
    Pose outward(const BearingPlace& place, const glm::dvec3& reference, double around) const {
        const glm::dvec3& along = place.direction;
        const glm::dvec3 a = glm::normalize(reference - along * glm::dot(reference, along)), b = glm::cross(along, a);
        const glm::dvec3 away = math::cos(around) * a + math::sin(around) * b;
        const glm::dvec3 heading = math::cos(angle_) * along + math::sin(angle_) * away;
        const glm::dvec3 up = math::sin(angle_) * along - math::cos(angle_) * away;
        return {place.position, heading, glm::cross(heading, up), up};
    }

    std::string kind_;
    glm::dvec3 light_{0, 1, 0};
    double angle_ = 0;
};

fs::path read_texture(const Settings& settings) {
    const fs::path file = settings.path_if_any("texture").value_or(fs::path());
    if (file.empty()) return file;
    if (!is_readable(file)) {
        throw UserError(settings.place("texture"), fmt::format("there is no picture {}", file.string()));
    }
    if (const std::string why = reason_not_to_show(file); !why.empty() && file.extension() != ".bark") {
        throw UserError(settings.place("texture"), fmt::format("{} cannot be shown: {}", file.string(), why));
    }
    read_text(file);  // so that run.json keeps it
    return file;
}

std::optional<Surface> card_of(const std::string& kind) {
    if (kind == "cross") return crossed_cards();
    if (kind == "card") return card();
    return std::nullopt;
}

class Leaves final : public GeometryStage {
public:
    explicit Leaves(Settings& settings)
        : counts_(settings),
          turns_(settings),
          kind_(settings.choice_or("kind", "cross", {"cross", "card", "surface", "sphere"})),
          shapes_(card_of(kind_), read_texture(settings)),
          size_(settings.number_or("size", 0.1, Range::positive())),
          spread_(settings.number_or("spread", 0.2, Range::between(0, 0.5))),
          shade_(settings.number_or("shade", 0, Range::between(0, 10))),
          colour_(static_cast<std::uint16_t>(settings.integer_or("colour", 2, Range::between(0, 65535)))),
          salt_(salt_of(settings.text_or("id", ""))) {
        if (settings.has("thickest")) thickest_ = settings.number("thickest", Range::positive());
        if (kind_ == "surface") read_surface(settings);
    }

    void apply(StagedPlant& plant) const override {
        const RandomKey key(plant.key.value(), 0, Stream::stage, salt_);
        const std::vector<BearingNode> nodes = bearing_nodes(plant, thickest_);
        std::vector<std::uint32_t> counts = counts_.of(nodes, key);
        if (shade_ > 0) thin_in_shade(counts, nodes, plant.geometry, {shade_, size_}, key);
        const std::uint32_t most = counts.empty() ? 0 : *std::max_element(counts.begin(), counts.end());
        const Organ pattern = dress(plant.geometry);
        // One of each node at a time: readers of a run take neighbours of one module for one organ.
        for (std::uint32_t leaf = 0; leaf < most; ++leaf) {
            for (std::size_t i = 0; i < nodes.size(); ++i) {
                if (leaf < counts[i]) add(plant.geometry, nodes[i], leaf, key, pattern);
            }
        }
    }

private:
    static std::uint64_t salt_of(const std::string& id) {
        std::uint64_t salt = 0;
        for (const char letter : id) salt = mix(salt, static_cast<unsigned char>(letter));
        return salt;
    }

    void read_surface(const Settings& settings) {
        const std::string name = settings.text("surface");
        const std::vector<std::string> letters = code_points(name);
        place_ = settings.place("surface");
        if (letters.size() != 1) {
            throw UserError(place_, fmt::format("'surface' must be one character, as ~ has it, not '{}'", name));
        }
        surface_ = surface_id(name);
    }

    /// A leaf without its place; the plant's shapes get what it looks like.
    Organ dress(PlantGeometry& geometry) const {
        const LeafShapes shapes = shapes_.to(geometry.shapes);
        Organ organ{};
        organ.shape = kind_ == "sphere" ? Organ::Shape::sphere : Organ::Shape::surface;
        organ.colour = colour_;
        organ.surface = shapes.surface;
        organ.look = {colour_, shapes.texture};
        if (kind_ == "surface") {
            const Surface& surface = find_surface(geometry);
            organ.surface = surface_;
            if (shapes.texture == 0) organ.look.texture = std::uint16_t(std::max(surface.texture.value_or(0), 0));
        }
        geometry.shapes = shapes.with;
        return organ;
    }

    const Surface& find_surface(const PlantGeometry& geometry) const {
        if (geometry.shapes) {
            const auto found = geometry.shapes->surfaces.find(surface_);
            if (found != geometry.shapes->surfaces.end()) return found->second;
        }
        throw UserError(place_,
                        "the view file of this plant has no such surface: name one that it has, or another kind");
    }

    void add(PlantGeometry& geometry, const BearingNode& node, std::uint32_t leaf, RandomKey key,
             const Organ& pattern) const {
        RandomSamples samples(key, node.identity, leaf + 1);
        const BearingPlace place = place_on(node, geometry, samples.uniform());
        const double size = size_ * std::max(1 + spread_ * samples.normal(), 0.0);
        Organ& organ = geometry.organs.emplace_back(pattern);
        organ.module = geometry.internodes[place.internode].module;
        organ.order = geometry.internodes[place.internode].order;
        organ.size = glm::dvec3(size);
        organ.pose = turns_.pose(node, place, leaf, samples);
        if (kind_ == "sphere") organ.pose.position += size / 2 * organ.pose.heading;
    }

    LeafCounts counts_;
    LeafTurns turns_;
    std::string kind_;
    LeafShapeAdder shapes_;
    double size_, spread_, shade_;
    std::uint16_t colour_;
    std::uint64_t salt_;
    double thickest_ = std::numeric_limits<double>::infinity();
    std::uint32_t surface_ = 0;
    Place place_;
};

const Registered<GeometryStageType> entry{
    {"leaves", "leaves, blossoms or fruit along internodes (Brzoska 2019)",
     R"(per_node     1, 0 to 1000; leaves of each node: the integer part is sure, the rest is a probability. A larger number keeps
             the leaves that are there
number       none, 0 to 1e7; instead of per_node: so many in all
kind         "cross", or "card", "surface", "sphere"; cross: two squares at right angles, 8 vertices and 4 triangles;
             card: one square, 4 and 2; surface: one of the view file; sphere: a fruit
surface      none; of kind "surface": the character that names it behind ~
size         0.1 m, > 0; the mean of a normal distribution: side of a square, diameter of a sphere, factor of a surface
spread       0.2, 0 to 0.5; its standard deviation by its mean
shade        0, 0 to 10; fewer leaves where others stand above: exp(-shade L) of them, L being the area of those above
             by the ground they cover, as light falls (Monsi & Saeki 1953)
thickest     none, m, > 0; only on internodes whose tip has at most this radius; none: on all
orientation  "random", or "light", "out"; random: all turns are equally probable; light: the face is turned to the light;
             out: away from the internode, each 137.5 degrees about it from the leaf of the node before
light        [0, 1, 0]; direction towards the light, for "light"
angle        60 degrees, 0 to 180; angle between leaf and internode, for "out"
colour       2, 0 to 65535; index of the colour
texture      none; a picture, relative to the scene
id           ""; stages with another id draw other random numbers
A node is what one module drew. Leaves stand anywhere along it and belong to that module; a node keeps its leaves as the
plant grows. Put stages that turn or divide internodes before this one.
)",
     construct<Leaves>}};

}  // namespace
}  // namespace espalier::turtle
