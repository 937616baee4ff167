// Fractal dimension, hulls, crowns and profiles of bodies whose answers are known.
#include "espalier/base/error.h"

#include "analysis/convex_hull.h"
#include "analysis/crown.h"
#include "analysis/fractal_dimension.h"
#include "analysis/plant_analysis.h"
#include "analysis/profile.h"
#include "analysis/trees.h"
#include "analysis/voxels.h"
#include "catch.h"

#include <glm/geometric.hpp>

#include <numbers>
#include <random>

using namespace espalier;
using namespace espalier::analysis;

namespace {

/// Rows of unit internodes along x that fill size^dimensions places.
BranchTree rows(int size, int dimensions) {
    BranchTree tree;
    for (int z = 0; z < (dimensions > 2 ? size : 1); ++z) {
        for (int y = 0; y < (dimensions > 1 ? size : 1); ++y) {
            for (int x = 0; x + 1 < size; ++x) {
                tree.add(BranchTree::ground, {x, y, z}, {x + 1, y, z}, 0.1, 0.1);
            }
        }
    }
    return tree;
}

std::vector<glm::dvec3> on_sphere(int count, double radius) {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    std::vector<glm::dvec3> points;
    for (int i = 0; i < count; ++i) {
        points.push_back(glm::normalize(glm::dvec3(normal(random), normal(random), normal(random))) * radius);
    }
    return points;
}

Leaves leaves_at(const std::vector<glm::dvec3>& places, double area = 1) {
    Leaves leaves;
    for (const glm::dvec3& place : places) leaves.leaves.push_back({place, area});
    leaves.corners = places;
    return leaves;
}

}  // namespace

TEST_CASE("fractal dimension: a line has 1, a filled square 2, a filled cube 3", "[analysis]") {
    for (const auto& [dimension, size] : {std::pair(1, 1024), std::pair(2, 257), std::pair(3, 65)}) {
        const FractalDimension fractal = fractal_dimension(rows(size, dimension));
        CAPTURE(dimension);
        CHECK(fractal.dimension == Approx(dimension).margin(0.03));
        CHECK(fractal.error < 0.02);
        CHECK(fractal.largest_box == Approx((size - 1) / 4.0).epsilon(1e-6));
        CHECK(fractal.smallest_box >= 0.99);
        CHECK(std::is_sorted(fractal.counts.rbegin(), fractal.counts.rend()));
    }
    const FractalDimension oblique = fractal_dimension([] {
        BranchTree tree;
        tree.add(BranchTree::ground, {0, 0, 0}, {3, 4, 5}, 0.1, 0.1);
        return tree;
    }());
    CHECK(oblique.dimension == Approx(1).margin(0.05));
    CHECK(std::isnan(fractal_dimension({}).dimension));
}

TEST_CASE("fractal dimension: the Koch curve has ln 4 / ln 3", "[analysis]") {
    std::vector<glm::dvec3> points{{0, 0, 0}, {1, 0, 0}};
    for (int generation = 0; generation < 7; ++generation) {
        std::vector<glm::dvec3> finer;
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            const glm::dvec3 third = (points[i + 1] - points[i]) / 3.0;
            const glm::dvec3 peak = points[i] + 1.5 * third + glm::dvec3(-third.y, third.x, 0) * std::sqrt(0.75);
            finer.insert(finer.end(), {points[i], points[i] + third, peak, points[i] + 2.0 * third});
        }
        finer.push_back(points.back());
        points = std::move(finer);
    }
    BranchTree curve;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        curve.add(static_cast<std::int32_t>(i) - 1, points[i], points[i + 1], 0.1, 0.1);
    }
    const FractalDimension fractal = fractal_dimension(curve);
    CHECK(fractal.dimension == Approx(std::log(4) / std::log(3)).margin(0.05));
    CHECK(fractal.counts.size() == 9);
}

TEST_CASE("voxels: a segment touches every box it passes, once, and coarser boxes hold the finer ones", "[analysis]") {
    VoxelSet along({0, 0, 0}, 1);
    along.add_segment({0.5, 0.5, 0.5}, {9.5, 0.5, 0.5});
    along.add_segment({9.5, 0.5, 0.5}, {0.5, 0.5, 0.5});
    CHECK(along.count() == 10);
    along.coarsen();
    CHECK(along.count() == 5);
    VoxelSet across({0, 0, 0}, 1);
    across.add_segment({0.1, 0.2, 0.3}, {7.4, 5.6, 3.9});
    CHECK(across.count() == 7 + 5 + 3 + 1);
    across.add_point({-100, 1e30, 0.5});
    CHECK(across.count() == 7 + 5 + 3 + 2);
}

TEST_CASE("convex hull: volumes of a tetrahedron, a cube full of points, a sphere, and flat or few points",
          "[analysis]") {
    const std::vector<glm::dvec3> tetrahedron{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    CHECK(convex_hull_volume(tetrahedron) == Approx(1.0 / 6));
    std::vector<glm::dvec3> cube;
    for (int i = 0; i < 11 * 11 * 11; ++i) cube.emplace_back(5 + i % 11, i / 11 % 11, i / 121 - 20);
    CHECK(convex_hull_volume(cube) == Approx(1000).epsilon(1e-9));
    const double volume = convex_hull_volume(on_sphere(20000, 3));
    CHECK(volume == Approx(4.0 / 3 * std::numbers::pi * 27).epsilon(0.002));
    CHECK(volume < 4.0 / 3 * std::numbers::pi * 27);
    std::vector<glm::dvec3> flat;
    for (int i = 0; i < 100; ++i) flat.emplace_back(i % 10, 2 * (i % 10) + i / 10, i / 10);
    CHECK(convex_hull_volume(flat) == 0);
    CHECK(convex_hull_volume(std::vector<glm::dvec3>(50, {1, 2, 3})) == 0);
    CHECK(convex_hull_volume(std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}}) == 0);
}

TEST_CASE("convex hull: an area, whatever the order of the points and however many repeat", "[analysis]") {
    std::vector<glm::dvec2> square;
    for (int i = 0; i < 121; ++i) square.emplace_back(i * 7 % 11, i * 3 % 121 / 11);
    square.insert(square.end(), {{0, 0}, {10, 0}, {0, 10}, {10, 10}, {10, 10}});
    CHECK(convex_hull_area(square) == Approx(100));
    CHECK(convex_hull_area(std::vector<glm::dvec2>{{0, 0}, {1, 1}, {2, 2}}) == 0);
    CHECK(convex_hull_area(std::vector<glm::dvec2>{}) == 0);
    // A root that grows straight down, seen from above.
    std::vector<glm::dvec2> upright;
    for (int i = 0; i < 10; ++i) upright.emplace_back(i * 1e-17, (i % 3) * 2e-17);
    CHECK(convex_hull_area(upright) == Approx(0).margin(1e-30));
    CHECK(convex_hull_area(std::vector<glm::dvec2>{{0, 0}, {4, 0}, {0, 3}}) == Approx(6));
}

TEST_CASE("crown: leaves on a sphere have its volume, projection and extents, and lean nowhere", "[analysis]") {
    BranchTree tree;
    tree.add(BranchTree::ground, {10, 0, 0}, {10, 8, 0}, 0.2, 0.2);
    std::vector<glm::dvec3> places = on_sphere(5000, 3);
    for (glm::dvec3& place : places) place += glm::dvec3(10, 10, 0);
    const Crown crown = measure_crown(tree, leaves_at(places));
    CHECK(crown.volume == Approx(4.0 / 3 * std::numbers::pi * 27).epsilon(0.01));
    CHECK(crown.projection == Approx(9 * std::numbers::pi).epsilon(0.01));
    CHECK(crown.base == Approx(7).margin(0.01));
    CHECK(crown.top == Approx(13).margin(0.01));
    CHECK(crown.width_x == Approx(6).margin(0.01));
    CHECK(std::abs(crown.asymmetry_x) < 0.05);
    CHECK(crown.voxel == Approx(6.0 / 32).epsilon(0.01));
    CHECK(crown.occupied < crown.volume);
    const PlantAnalysis analysis = analyse(0, tree, leaves_at(places, 0.01));
    CHECK(analysis.leaf_area == Approx(50));
    CHECK(analysis.leaf_area_index() == Approx(50 / (9 * std::numbers::pi)).epsilon(0.01));
    CHECK(analysis.height == Approx(13).margin(0.01));
}

TEST_CASE("crown: asymmetry counts leaves on both sides of the foot; without leaves tips; the trunk is no crown",
          "[analysis]") {
    BranchTree tree;
    tree.add(BranchTree::ground, {1, 0, 0}, {1, 5, 0}, 0.2, 0.2);
    CHECK(measure_crown(tree, {}).base == 0);
    CHECK(measure_crown(tree, leaves_at({{0, 6, 1}, {2, 6, 1}, {3, 7, 1}, {4, 6, 1}})).asymmetry_x == 0.5);
    CHECK(measure_crown(tree, leaves_at({{0, 6, 1}, {2, 6, 1}, {3, 7, 1}, {1, 6, -1}})).asymmetry_z == 0.5);
    CHECK(measure_crown(tree, leaves_at({{0, 6, 1}, {2, 7, 1}})).base == 6);
    for (const double x : {0.0, -1.0, -2.0}) tree.add(0, {1, 5, 0}, {x, 6, 0}, 0.1, 0.1);
    CHECK(measure_crown(tree, {}).asymmetry_x == -1);
    CHECK(measure_crown(tree, {}).base == 5);
    CHECK(std::isnan(measure_crown({}, {}).asymmetry_x));
}

TEST_CASE("crown: voxels of a given size fill a solid crown", "[analysis]") {
    std::vector<glm::dvec3> solid;
    for (int i = 0; i < 1000; ++i) solid.emplace_back(i % 10 + 0.5, i / 10 % 10 + 0.5, i / 100 + 0.5);
    const Crown crown = measure_crown({}, leaves_at(solid), 1);
    CHECK(crown.occupied == 1000);
    CHECK(crown.voxel == 1);
}

TEST_CASE("layers: lengths are shared where internodes pass, sums are kept, heights are those of the world",
          "[analysis]") {
    BranchTree tree;
    tree.add(BranchTree::ground, {0, 10, 0}, {0, 7.5, 0}, 0.1, 0.1);  // a root down
    tree.add(0, {0, 7.5, 0}, {2, 7.5, 0}, 0.1, 0.1);                  // level
    tree.add(0, {0, 7.5, 0}, {0, 7.5, 2}, 0.1, 0.1);
    tree.add(BranchTree::ground, {0, 10, 0}, {0, 11, 0}, 0.1, 0.1);  // a shoot
    const std::vector<Layer> spread = layers(tree, leaves_at({{0, 10.7, 0}}, 3), 1);
    REQUIRE(spread.size() == 4);
    CHECK(spread[0].from == 7);
    CHECK(spread[3].to == 11);
    CHECK(spread[0].length == Approx(0.5 + 4));
    CHECK(spread[1].length == Approx(1));
    CHECK(spread[2].length == Approx(1));
    CHECK(spread[3].length == Approx(1));
    CHECK(spread[3].leaf_area == 3);
    CHECK(spread[1].surface == Approx(0.2 * std::numbers::pi));
    CHECK(spread[1].density == Approx(1 / 2.0));  // the shadow is a triangle of 2 m2
    // A root that begins deeper reaches into deeper layers of the same soil, between the bounds of its water's.
    for (const double base : {0.0, -0.13, -0.4, 0.27}) {
        BranchTree root;
        root.add(BranchTree::ground, {0, base, 0}, {0, base - 1, 0}, 0.01, 0.01);
        double sum = 0;
        for (const Layer& layer : layers(root, {}, 0.25)) {
            const double there = std::min(layer.to, base) - std::max(layer.from, base - 1);
            CHECK(layer.length == Approx(std::max(there, 0.0)).margin(1e-12));
            CHECK(std::remainder(layer.from, 0.25) == Approx(0).margin(1e-12));
            sum += layer.length;
        }
        CHECK(sum == Approx(1));
    }
    for (const double thickness : {0.0, 0.1, 0.33, 7.0}) {
        double sum = 0;
        for (const Layer& layer : layers(tree, {}, thickness)) sum += layer.length;
        CHECK(sum == Approx(total_length(tree)));
    }
    CHECK(layers(tree, {}).size() <= 20);
    CHECK(layers({}, {}).empty());
    CHECK_THROWS_AS(layers(tree, {}, 1e-9), UserError);
}

TEST_CASE("internode lengths: moments and a histogram", "[analysis]") {
    BranchTree tree;
    for (const double length : {1.0, 2.0, 3.0, 4.0}) tree.add(BranchTree::ground, {0, 0, 0}, {0, length, 0}, 0.1, 0.1);
    const LengthDistribution of = length_distribution(tree);
    CHECK(of.least == 1);
    CHECK(of.median == 2.5);
    CHECK(of.mean == 2.5);
    CHECK(of.greatest == 4);
    CHECK(of.deviation == Approx(std::sqrt(1.25)));
    REQUIRE(of.bins.size() == 16);
    for (const std::size_t bin : {4, 8, 12, 15}) CHECK(of.bins[bin].internodes == 1);
    CHECK(of.bins[0].internodes == 0);
    CHECK(std::isnan(length_distribution({}).mean));
}

TEST_CASE("roots below the foot are no part of the crown, and a root system alone is its own", "[analysis]") {
    const Crown bare = measure_crown(binary_tree(4), {});
    BranchTree rooted = binary_tree(4), roots;
    for (const double x : {-3.0, 2.0, 5.0}) {
        rooted.add(BranchTree::ground, {0, 0, 0}, {x, -1, 0.3 * x}, 0.1, 0.1);
        roots.add(BranchTree::ground, {0, 0, 0}, {x, -1, 0.3 * x}, 0.1, 0.1);
    }
    const Crown crown = measure_crown(rooted, {}), below = measure_crown(roots, {});
    CHECK(crown.base == bare.base);
    CHECK(crown.width_x == bare.width_x);
    CHECK(crown.projection == bare.projection);
    CHECK(crown.asymmetry_x == bare.asymmetry_x);
    CHECK(below.base == -1);
    CHECK(below.width_x == 8);
}

TEST_CASE("sums: a frustum has its lateral surface and volume", "[analysis]") {
    BranchTree tree;
    tree.add(BranchTree::ground, {0, 0, 0}, {0, 4, 0}, 4, 1);
    CHECK(total_length(tree) == 4);
    CHECK(total_surface(tree) == Approx(std::numbers::pi * 5 * 5));
    CHECK(total_volume(tree) == Approx(std::numbers::pi * 4 / 3 * 21));
}
