#include "base/png_file.h"
#include "catch.h"
#include "geometry/drawn/faces.h"
#include "temporary_folder.h"
#include "turtle/foliage/bearing_nodes.h"
#include "turtle/foliage/cards.h"
#include "turtle/stages/tree.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>

using namespace espalier;
using namespace espalier::geometry;
using namespace espalier::turtle;
using namespace espalier::test;
using Catch::Contains;

namespace {

Tree chain(int internodes) {
    Tree tree;
    for (int i = 0; i < internodes; ++i) tree.grow({0.1 * (i % 7), 1, 0.05 * (i % 3)}, 0.1 / (1 + i));
    return tree;
}

Tree leafy(Tree tree, Settings parameters) {
    parameters.put("stage", "leaves");
    return tree.stage(parameters);
}

std::map<std::uint32_t, std::vector<Organ>> by_module(const Tree& tree) {
    std::map<std::uint32_t, std::vector<Organ>> organs;
    for (const Organ& organ : tree.geometry.organs) organs[organ.module].push_back(organ);
    return organs;
}

bool same_place(const Organ& a, const Organ& b) {
    return a.module == b.module && a.size == b.size && a.pose.position == b.pose.position &&
           a.pose.heading == b.pose.heading && a.pose.left == b.pose.left && a.pose.up == b.pose.up;
}

double off_segment(const glm::dvec3& p, const Internode& internode) {
    const glm::dvec3 along = internode.tip - internode.base;
    const double share = glm::dot(p - internode.base, along) / glm::dot(along, along);
    return glm::distance(p, internode.base + std::clamp(share, 0.0, 1.0) * along);
}

/// The internodes of these trees are modules 0, 1, 2, ...
double farthest_off(const Tree& tree) {
    double most = 0;
    for (const Organ& organ : tree.geometry.organs) {
        most = std::max(most, off_segment(organ.pose.position, tree[organ.module]));
    }
    return most;
}

const Tree& forest() {
    static const Tree tree = chain(100000);
    return tree;
}

}  // namespace

TEST_CASE("2.3 leaves a node are 2 or 3, and 2.3 in the mean", "[turtle][stages]") {
    const Tree tree = leafy(forest(), {{"per_node", 2.3}});
    CHECK(double(tree.geometry.organs.size()) / 1e5 == Approx(2.3).margin(0.01));
    const auto organs = by_module(tree);
    CHECK(organs.size() == 100000);
    for (const auto& [module, leaves] : organs) REQUIRE((leaves.size() == 2 || leaves.size() == 3));
}

TEST_CASE("a larger number keeps the leaves that are there", "[turtle][stages]") {
    std::map<std::uint32_t, std::vector<Organ>> fewer = by_module(leafy(chain(500), {{"per_node", 0.4}}));
    for (const double number : {0.8, 1.0, 1.7, 3.2}) {
        const auto more = by_module(leafy(chain(500), {{"per_node", number}}));
        for (const auto& [module, leaves] : fewer) {
            REQUIRE(more.contains(module));
            REQUIRE(more.at(module).size() >= leaves.size());
            for (std::size_t i = 0; i < leaves.size(); ++i) REQUIRE(same_place(leaves[i], more.at(module)[i]));
        }
        fewer = more;
    }
}

TEST_CASE("a plant that grows keeps its leaves", "[turtle][stages]") {
    const auto young = by_module(leafy(chain(40), {{"per_node", 1.5}, {"orientation", "out"}}));
    const auto old = by_module(leafy(chain(90), {{"per_node", 1.5}, {"orientation", "out"}}));
    for (const auto& [module, leaves] : young) {
        REQUIRE(old.at(module).size() == leaves.size());
        for (std::size_t i = 0; i < leaves.size(); ++i) CHECK(same_place(leaves[i], old.at(module)[i]));
    }
}

TEST_CASE("sizes are normal with a deviation of a fifth of their mean", "[turtle][stages]") {
    const Tree tree = leafy(forest(), {{"size", 0.3}});
    double sum = 0, squares = 0, below = 0;
    for (const Organ& organ : tree.geometry.organs) {
        REQUIRE(organ.size == glm::dvec3(organ.size.x));
        sum += organ.size.x;
        squares += organ.size.x * organ.size.x;
        below += organ.size.x < 0.3 - 0.06 ? 1 : 0;
    }
    const double n = double(tree.geometry.organs.size()), mean = sum / n;
    CHECK(mean == Approx(0.3).epsilon(0.005));
    CHECK(std::sqrt(squares / n - mean * mean) == Approx(0.06).epsilon(0.02));
    CHECK(below / n == Approx(0.1587).margin(0.005));
    for (const Organ& organ : leafy(chain(20), {{"spread", 0}}).geometry.organs) CHECK(organ.size.x == 0.1);
}

TEST_CASE("leaves stand on the internode that bears them, anywhere along it", "[turtle][stages]") {
    const Tree tree = leafy(chain(5000), {{"per_node", 2}});
    CHECK(farthest_off(tree) < 1e-9);
    std::array<int, 10> tenths{};
    for (const Organ& organ : tree.geometry.organs) {
        const double share = glm::distance(organ.pose.position, tree[organ.module].base) / tree.length(organ.module);
        ++tenths[std::size_t(std::min(share * 10, 9.0))];
    }
    for (const int count : tenths) CHECK(count == Approx(1000).margin(120));
}

TEST_CASE("random turns are uniform", "[turtle][stages]") {
    const Tree tree = leafy(forest(), {});
    const double n = double(tree.geometry.organs.size());
    std::array<std::array<double, 8>, 3> octants{};
    std::array<glm::dvec3, 3> sums{}, squares{};
    double trace = 0;
    for (const Organ& organ : tree.geometry.organs) {
        const std::array<glm::dvec3, 3> axes{organ.pose.left, organ.pose.heading, organ.pose.up};
        REQUIRE(glm::distance(glm::cross(axes[0], axes[1]), axes[2]) < 1e-12);
        for (std::size_t k = 0; k < 3; ++k) {
            REQUIRE(glm::length(axes[k]) == Approx(1));
            ++octants[k][(axes[k].x > 0 ? 1u : 0u) + (axes[k].y > 0 ? 2u : 0u) + (axes[k].z > 0 ? 4u : 0u)];
            sums[k] += axes[k];
            squares[k] += axes[k] * axes[k];
        }
        const double own = axes[0].x + axes[1].y + axes[2].z;
        trace += own * own;
    }
    for (std::size_t k = 0; k < 3; ++k) {
        CHECK(glm::length(sums[k]) / n < 0.01);
        for (int axis = 0; axis < 3; ++axis) CHECK(squares[k][axis] / n == Approx(1.0 / 3).margin(0.01));
        for (const double count : octants[k]) CHECK(count / n == Approx(0.125).margin(0.005));
    }
    // The mean square of the trace is 1 for turns that are uniform, and larger for those that prefer small angles.
    CHECK(trace / n == Approx(1).margin(0.02));
}

TEST_CASE("leaves turn their faces to the light", "[turtle][stages]") {
    const Tree tree = leafy(chain(2000), {{"orientation", "light"}, {"light", glm::dvec3(3, 4, 0)}});
    glm::dvec3 sum(0);
    for (const Organ& organ : tree.geometry.organs) {
        REQUIRE(glm::distance(organ.pose.up, {0.6, 0.8, 0}) < 1e-12);
        REQUIRE(glm::distance(glm::cross(organ.pose.left, organ.pose.heading), organ.pose.up) < 1e-12);
        sum += organ.pose.heading;
    }
    CHECK(glm::length(sum) / 2000 < 0.06);
}

TEST_CASE("leaves stand away from the internode, 137.5 degrees from one to the next", "[turtle][stages]") {
    Tree tree;
    for (int i = 0; i < 100; ++i) tree.grow({0, 1, 0});
    tree = leafy(tree, {{"orientation", "out"}, {"angle", 70}});
    const auto& organs = tree.geometry.organs;
    for (std::size_t i = 0; i < organs.size(); ++i) {
        const glm::dvec3& heading = organs[i].pose.heading;
        REQUIRE(heading.y == Approx(std::cos(glm::radians(70.0))));
        REQUIRE(organs[i].pose.up.y == Approx(std::sin(glm::radians(70.0))));
        if (i == 0) continue;
        const glm::dvec3 a = glm::normalize(organs[i - 1].pose.heading * glm::dvec3(1, 0, 1));
        const glm::dvec3 b = glm::normalize(heading * glm::dvec3(1, 0, 1));
        REQUIRE(glm::degrees(std::acos(glm::dot(a, b))) == Approx(137.5));
    }
}

TEST_CASE("no leaf stands on an internode above the limit", "[turtle][stages]") {
    const Tree tree = leafy(chain(100), {{"thickest", 0.1 / 50.5}, {"per_node", 3}});
    CHECK(by_module(tree).size() == 50);
    for (const Organ& organ : tree.geometry.organs) CHECK(tree[organ.module].tip_radius <= 0.1 / 50.5);
    CHECK(leafy(chain(100), {{"thickest", 1e-9}}).geometry.organs.empty());
}

TEST_CASE("blossoms and fruit are as many as asked, on allowed nodes", "[turtle][stages]") {
    for (const int number : {0, 1, 7, 50, 51, 173}) {
        const Tree tree = leafy(chain(100), {{"thickest", 0.1 / 50.5}, {"number", number}, {"kind", "sphere"}});
        CHECK(tree.geometry.organs.size() == std::size_t(number));
        for (const auto& [module, fruit] : by_module(tree)) {
            CHECK(module >= 50);
            CHECK(fruit.size() <= std::size_t(number) / 50 + 1);
        }
    }
    CHECK(leafy(chain(100), {{"thickest", 1e-9}, {"number", 7}}).geometry.organs.empty());
}

TEST_CASE("fewer leaves stand in the shade of others, none are fewer at the top", "[turtle][stages]") {
    Tree pole;
    for (int i = 0; i < 200; ++i) pole.grow({0, 0.1, 0});
    const auto halves = [&](double shade) {
        const Tree tree = leafy(pole, {{"per_node", 4}, {"size", 0.2}, {"shade", shade}});
        std::array<std::size_t, 2> counts{};
        for (const Organ& organ : tree.geometry.organs) ++counts[organ.module < 100 ? 0 : 1];
        CHECK(std::count_if(tree.geometry.organs.begin(), tree.geometry.organs.end(),
                            [](const Organ& organ) { return organ.module == 199; }) == 4);
        return counts;
    };
    CHECK(halves(0) == std::array<std::size_t, 2>{400, 400});
    std::size_t before = 400;
    for (const double shade : {0.1, 0.3, 1.0}) {
        const auto [below, above] = halves(shade);
        CHECK(below < above);
        CHECK(below < before);
        before = below;
    }
    // A crossed leaf has twice the area of its square, and 1.04 times that for its spread: c = 16 / 2.08 of them cover
    // the column. dL/dn = exp(-k L) / c: after n leaves, L is ln(1 + k n / c) / k.
    const auto [below, above] = halves(0.5);
    const double c = 16 / 2.08;
    CHECK(static_cast<double>(below + above) == Approx(c * std::log(1 + 0.5 * 800 / c) / 0.5).epsilon(0.1));
}

namespace {

/// Area of all leaves by that of the ground below the convex hull of their corners, each hull edge found by brute
/// force.
double leaf_area_index(const Tree& tree) {
    DrawnFaces faces;
    faces.add_leaves(0, tree.geometry);
    double area = 0, low = 1e9, high = -1e9;
    std::vector<glm::dvec2> points;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        area += glm::length(faces[i].area());
        for (const glm::dvec3& corner : faces[i].corners) {
            points.emplace_back(corner.x, corner.z);
            low = std::min(low, corner.x), high = std::max(high, corner.x);
        }
    }
    // By its support function h: the area is the integral of h^2 - h'^2 over half of all directions, on both sides.
    constexpr int directions = 720;
    const auto support = [&](int k) {
        const double angle = 2 * std::numbers::pi * k / directions;
        double most = -1e9;
        for (const glm::dvec2& p : points) most = std::max(most, p.x * std::cos(angle) + p.y * std::sin(angle));
        return most;
    };
    double ground = 0, before = support(0);
    for (int k = 1; k <= directions; ++k) {
        const double now = support(k), step = 2 * std::numbers::pi / directions, slope = (now - before) / step;
        ground += 0.5 * step * ((now * now + before * before) / 2 - slope * slope);
        before = now;
    }
    return area / ground;
}

}  // namespace

TEST_CASE("a leaf area index of leaves is the one that was asked for, by what their picture leaves opaque",
          "[turtle]") {
    const TemporaryFolder folder;
    OpacityPicture picture{4, 4, {}};
    for (int i = 0; i < 16; ++i)
        picture.pixels.push_back({90, 90, 90, static_cast<std::uint8_t>(i % 4 == 0 ? 255 : 0)});
    const std::string file = folder.write("quarter.png", png_bytes(picture)).string();
    Tree crown;
    for (int i = 0; i < 400; ++i) {
        crown.open();
        crown.grow({std::cos(2.4 * i) * std::sqrt(i) / 8, 0.5 + 0.001 * i, std::sin(2.4 * i) * std::sqrt(i) / 8}, 0.01);
        crown.close();
    }
    for (const double wanted : {0.7, 3.0, 8.0}) {
        CHECK(leaf_area_index(leafy(crown, {{"leaf_area_index", wanted}, {"size", 0.2}, {"thickest", 0.05}})) ==
              Approx(wanted).epsilon(0.05));
        CHECK(leaf_area_index(leafy(crown, {{"leaf_area_index", wanted}, {"size", 0.2}, {"texture", file}})) ==
              Approx(wanted).epsilon(0.05));
        CHECK(leaf_area_index(leafy(crown, {{"leaf_area_index", wanted}, {"kind", "card"}, {"shade", 0.3}})) ==
              Approx(wanted).epsilon(0.05));
    }
    CHECK_THROWS_WITH(leafy(crown, {{"leaf_area_index", 3}, {"number", 5}}), Contains("without 'number'"));
    CHECK_THROWS_WITH(leafy(crown, {{"leaf_area_index", 30}, {"size", 0.01}}),
                      Contains("needs more than 1000 leaves a node") && Contains("less shade"));
}

TEST_CASE("a fruit touches its internode", "[turtle][stages]") {
    const Tree tree = leafy(chain(100), {{"kind", "sphere"}, {"size", 0.4}});
    for (const Organ& organ : tree.geometry.organs) {
        CHECK(organ.shape == Organ::Shape::sphere);
        CHECK(off_segment(organ.pose.position - organ.size.x / 2 * organ.pose.heading, tree[organ.module]) < 1e-9);
    }
    CHECK_FALSE(tree.geometry.shapes);
}

TEST_CASE("stages of another id draw other samples, of the same id the same", "[turtle][stages]") {
    const Tree plain = leafy(chain(50), {}), again = leafy(chain(50), {}), other = leafy(chain(50), {{"id", "fruit"}});
    CHECK(same_place(plain.geometry.organs[9], again.geometry.organs[9]));
    CHECK_FALSE(same_place(plain.geometry.organs[9], other.geometry.organs[9]));
}

TEST_CASE("pieces of an internode bear together what it would alone", "[turtle][stages]") {
    Tree tree = chain(300);
    tree.stage({{"stage", "smooth"}, {"pieces", 8}});
    const Tree leaves = leafy(tree, {{"per_node", 2}});
    CHECK(leaves.geometry.organs.size() == 600);
    CHECK(by_module(leaves).size() == 300);
    for (const Organ& organ : leaves.geometry.organs) {
        double nearest = 1;
        for (std::size_t i = 8 * organ.module; i < 8 * organ.module + 8; ++i) {
            nearest = std::min(nearest, off_segment(organ.pose.position, leaves[i]));
        }
        REQUIRE(nearest < 1e-9);
    }
}

TEST_CASE("crossed cards have 8 vertices and 4 triangles, a card 4 and 2, with a whole picture each",
          "[turtle][stages]") {
    for (const auto& [surface, squares] : {std::pair{card(), 1u}, std::pair{crossed_cards(), 2u}}) {
        const SurfaceMesh mesh = mesh_of(surface);
        CHECK(mesh.vertices.size() == 4 * squares);
        CHECK(mesh.faces == std::vector<std::uint32_t>(squares, 4));  // two triangles each
        for (const SurfaceVertex& vertex : mesh.vertices) {
            const glm::dvec3& at = vertex.position;
            CHECK((at.y == 0 || at.y == Approx(1)));
            CHECK(std::abs(at.x) + std::abs(at.z) == Approx(0.5));
            CHECK(vertex.uv.y == Approx(at.y));
            CHECK(vertex.uv.x == Approx(0.5 + at.x + at.z));
        }
    }
    const SurfaceMesh cross = mesh_of(crossed_cards());
    CHECK(std::abs(cross.vertices[0].normal.z) == Approx(1));
    CHECK(std::abs(cross.vertices[4].normal.x) == Approx(1));
    CHECK(mesh_of(card()).vertices[0].normal.z == Approx(1));
}

TEST_CASE("cards join the shapes of the view file, the same in every step", "[turtle][stages]") {
    TemporaryFolder folder;
    folder.write("leaf.png", "P6 1 1 255 abc");
    Settings table = Settings::parse_toml("stage = 'leaves'\ntexture = 'leaf.png'", "a.toml", folder.path());
    const auto stage = read_geometry_stage(table);
    const auto shapes = std::make_shared<Shapes>();
    shapes->surfaces['l'] = {};
    shapes->textures.resize(2);
    std::shared_ptr<const Shapes> first;
    for (int step = 0; step < 3; ++step) {
        Tree tree = chain(3);
        tree.geometry.shapes = shapes;
        StagedPlant plant{tree.geometry, tree.string, {}};
        apply({stage}, plant);
        if (step == 0) first = tree.geometry.shapes;
        CHECK(tree.geometry.shapes == first);
        const Organ& organ = tree.geometry.organs.at(0);
        CHECK(organ.surface > 0x10FFFF);
        CHECK(organ.look.texture == 3);
    }
    CHECK(shapes->surfaces.size() == 1);
    REQUIRE(first->surfaces.size() == 2);
    CHECK(first->textures.at(2).file == folder.path() / "leaf.png");

    Tree both = chain(1);
    both.stage({{"stage", "leaves"}}).stage({{"stage", "leaves"}, {"kind", "card"}});
    CHECK(both.geometry.shapes->surfaces.size() == 2);
    CHECK(both.geometry.organs[0].surface != both.geometry.organs[1].surface);
}

TEST_CASE("leaves can be a surface of the view file", "[turtle][stages]") {
    Settings parameters{{"kind", "surface"}, {"surface", "λ"}};
    Tree tree = chain(3);
    auto shapes = std::make_shared<Shapes>();
    shapes->surfaces[0x3BB].texture = 4;
    tree.geometry.shapes = shapes;
    tree = leafy(tree, parameters);
    CHECK(tree.geometry.shapes == shapes);
    CHECK(tree.geometry.organs.at(2).surface == 0x3BB);
    CHECK(tree.geometry.organs.at(2).look.texture == 4);
    CHECK_THROWS_WITH(leafy(chain(3), parameters), Contains("no such surface"));
}

TEST_CASE("leaves need no lineage", "[turtle][stages]") {
    Tree tree = chain(10);
    tree.string.births.clear();
    CHECK(leafy(tree, {{"number", 7}}).geometry.organs.size() == 7);
}

TEST_CASE("leaves refuses what is no number, size or picture", "[turtle][stages]") {
    const auto error = [](const std::string& lines) { return refusal("stage = 'leaves'\n" + lines); };
    CHECK_THAT(error("per_node = nan"), Contains("'per_node' must be a finite number"));
    CHECK_THAT(error("per_node = -1"), Contains("'per_node' must be between 0 and 1000"));
    CHECK_THAT(error("number = 1.5"), Contains("'number' must be a whole number"));
    CHECK_THAT(error("number = 3\nper_node = 2"), Contains("stage.toml:2") && Contains("without 'per_node'"));
    CHECK_THAT(error("size = 0"), Contains("'size' must be greater than 0"));
    CHECK_THAT(error("spread = 0.6"), Contains("'spread' must be between 0 and 0.5"));
    CHECK_THAT(error("thickest = -0.1"), Contains("'thickest' must be greater than 0"));
    CHECK_THAT(error("kind = 'cros'"), Contains("did you mean 'cross'"));
    CHECK_THAT(error("kind = 'surface'\nsurface = 'leaf'"), Contains("must be one character"));
    CHECK_THAT(error("orientation = 'light'\nlight = [0, 0, 0]"), Contains("'light' must be a finite direction"));
    CHECK_THAT(error("orientation = 'out'\nangle = 181"), Contains("'angle' must be between 0 and 180"));
    CHECK_THAT(error("colour = 70000"), Contains("'colour' must be between 0 and 65535"));
    CHECK_THAT(error("texture = 'none.png'"), Contains("stage.toml:2") && Contains("there is no picture none.png"));
    const std::string text = ESPALIER_SOURCE_DIR "/LICENSE";
    CHECK_THAT(error("texture = '" + text + "'"),
               Contains("stage.toml:2") && Contains("LICENSE cannot be shown: it is"));
    CHECK_THAT(error("light = [0, 1, 0]"), Contains("'light'"));
}
