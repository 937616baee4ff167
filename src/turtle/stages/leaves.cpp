// leaves: leaves, blossoms or fruit along internodes.
// Brzoska 2019, sections 3.5 and 5.1: a fractional number for each node, sizes of a normal distribution with a
// deviation of a fifth, on thin internodes alone. Random turns are those of Shoemake 1992.
#include "espalier/base/file.h"
#include "espalier/base/math.h"
#include "espalier/turtle/geometry_stage.h"

#include "base/picture_file.h"
#include "base/text.h"
#include "geometry/drawn/faces.h"
#include "geometry/surface_id.h"
#include "geometry/vectors.h"
#include "turtle/foliage/bearing_nodes.h"
#include "turtle/foliage/cards.h"
#include "turtle/foliage/crown_ground.h"
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

using Counts = std::vector<std::uint32_t>;

/// Which nodes bear how many.
class LeafCounts {
public:
    explicit LeafCounts(Settings& settings)
        : index_(settings.number_or("leaf_area_index", 0, Range::between(0, 30))),
          place_(settings.place("leaf_area_index")) {
        if (settings.has("number") && settings.has("per_node")) {
            throw UserError(settings.place("number"), "'number' counts all leaves of a plant: without 'per_node'");
        }
        if (settings.has("number") && index_ > 0) {
            throw UserError(place_, "'leaf_area_index' says how many leaves there are: without 'number'");
        }
        if (settings.has("number")) {
            number_ = static_cast<std::size_t>(settings.integer("number", Range::between(0, 1e7)));
        } else {
            per_node_ = settings.number_or("per_node", 1, Range::between(0, 1000));
        }
    }

    /// Leaf area that there is to be on the ground below the crown; 0: as many leaves as nodes should have.
    double index() const { return index_; }

    Counts of(const std::vector<BearingNode>& nodes, RandomKey key) const {
        if (nodes.empty()) return {};
        const std::vector<double> chances = this->chances(nodes, key);
        return number_ ? in_all(chances) : at_each(chances, per_node_);
    }

    /// The fewest leaves of nodes with which `total`, which keeps some of them, is what is wanted.
    template <class Total>
    Counts reaching(std::size_t wanted, const std::vector<BearingNode>& nodes, RandomKey key,
                    const Total& total) const {
        const std::vector<double> chances = this->chances(nodes, key);
        double low = 0, high = 1;
        while (total(at_each(chances, high)) < wanted) {
            if ((high *= 2) > most_per_node) {
                throw RunError(
                    fmt::format("{}: a leaf area index of {:g} needs more than {:g} leaves a node: give the "
                                "leaves less shade, a larger size or thicker twigs",
                                to_string(place_), index_, most_per_node));
            }
        }
        for (int i = 0; i < 30 && high - low > 1e-4 * high; ++i) {
            const double middle = (low + high) / 2;
            (total(at_each(chances, middle)) < wanted ? low : high) = middle;
        }
        return at_each(chances, high);
    }

private:
    static constexpr double most_per_node = 1000;

    static std::vector<double> chances(const std::vector<BearingNode>& nodes, RandomKey key) {
        std::vector<double> chances;
        for (const BearingNode& node : nodes) chances.push_back(RandomSamples(key, node.identity, 0).uniform());
        return chances;
    }

    static Counts at_each(const std::vector<double>& chances, double per_node) {
        const double sure = std::floor(per_node);
        Counts counts;
        for (const double chance : chances) {
            counts.push_back(static_cast<std::uint32_t>(sure) + (chance < per_node - sure ? 1 : 0));
        }
        return counts;
    }

    /// The same number at all nodes, and one more at those that drew the smallest chances.
    Counts in_all(const std::vector<double>& chances) const {
        const std::size_t nodes = chances.size();
        Counts counts(nodes, static_cast<std::uint32_t>(*number_ / nodes));
        std::vector<std::size_t> order(nodes);
        std::iota(order.begin(), order.end(), std::size_t{0});
        const auto rest = order.begin() + static_cast<std::ptrdiff_t>(*number_ % nodes);
        std::nth_element(order.begin(), rest, order.end(), [&](std::size_t a, std::size_t b) {
            return chances[a] != chances[b] ? chances[a] < chances[b] : a < b;
        });
        for (auto node = order.begin(); node != rest; ++node) ++counts[*node];
        return counts;
    }

    double per_node_ = 1, index_;
    std::optional<std::size_t> number_;
    Place place_;
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
        const Organ pattern = dress(plant.geometry);
        const double area = mean_area(plant.geometry, pattern);
        if (counts_.index() > 0 && !nodes.empty()) {
            add(plant.geometry, nodes, counts_for_index(plant.geometry, nodes, key, pattern, area), key, pattern);
        } else {
            add(plant.geometry, nodes, thinned(counts_.of(nodes, key), nodes, plant.geometry, area, key), key, pattern);
        }
    }

private:
    /// With its picture's holes left out, and that of a sphere as it looks from all directions.
    double mean_area(const PlantGeometry& geometry, Organ leaf) const {
        leaf.pose = {};
        leaf.size = glm::dvec3(1);
        PlantGeometry alone;
        alone.shapes = geometry.shapes;
        alone.organs = {leaf};
        DrawnFaces faces;
        faces.add_leaves(0, alone);
        double area = kind_ == "sphere" ? std::numbers::pi / 4 : 0;
        for (std::size_t i = 0; i < faces.size(); ++i) area += glm::length(faces[i].area());
        return area * size_ * size_ * (1 + spread_ * spread_);
    }

    Counts thinned(Counts counts, const std::vector<BearingNode>& nodes, const PlantGeometry& geometry, double area,
                   RandomKey key) const {
        if (shade_ > 0) thin_in_shade(counts, nodes, geometry, {shade_, size_, area}, key);
        return counts;
    }

    /// The crown's ground is that below its leaves: below one of each node first, then below those that this gives.
    Counts counts_for_index(PlantGeometry& geometry, const std::vector<BearingNode>& nodes, RandomKey key,
                            const Organ& pattern, double area) const {
        Counts counts(nodes.size(), area > 0 ? 1 : 0);
        for (int pass = 0; pass < 3 && area > 0; ++pass) {
            const double ground = ground_of(geometry, nodes, counts, key, pattern);
            const auto wanted = static_cast<std::size_t>(std::llround(counts_.index() * ground / area));
            const auto total = [&](const Counts& each) {
                const Counts kept = thinned(each, nodes, geometry, area, key);
                return std::accumulate(kept.begin(), kept.end(), std::size_t{0});
            };
            counts = thinned(counts_.reaching(wanted, nodes, key, total), nodes, geometry, area, key);
        }
        return counts;
    }

    double ground_of(PlantGeometry& geometry, const std::vector<BearingNode>& nodes, const Counts& counts,
                     RandomKey key, const Organ& pattern) const {
        PlantGeometry leaves;
        leaves.shapes = geometry.shapes;
        const std::size_t before = geometry.organs.size();
        add(geometry, nodes, counts, key, pattern);
        leaves.organs.assign(geometry.organs.begin() + static_cast<std::ptrdiff_t>(before), geometry.organs.end());
        geometry.organs.resize(before);
        return ground_below(leaves);
    }

    // One of each node at a time: readers of a run take neighbours of one module for one organ.
    void add(PlantGeometry& geometry, const std::vector<BearingNode>& nodes, const Counts& counts, RandomKey key,
             const Organ& pattern) const {
        const std::uint32_t most = counts.empty() ? 0 : *std::max_element(counts.begin(), counts.end());
        for (std::uint32_t leaf = 0; leaf < most; ++leaf) {
            for (std::size_t i = 0; i < nodes.size(); ++i) {
                if (leaf < counts[i]) add_leaf(geometry, nodes[i], leaf, key, pattern);
            }
        }
    }

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

    void add_leaf(PlantGeometry& geometry, const BearingNode& node, std::uint32_t leaf, RandomKey key,
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
leaf_area_index  0, 0 to 30; if above 0, instead of per_node: area of all leaves by that of the ground below the crown (the
             convex hull of its leaves, seen from above). Of leaves that wear a picture, what it leaves opaque counts
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
