// Between two frames: lengths change continuously, axes stay whole, and the frames themselves are met.
#include "archive/unfolding.h"

#include "catch.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <initializer_list>

using namespace espalier;
using namespace espalier::archive;

namespace {

struct Node {
    std::uint64_t identity;  ///< identity of the module that drew the internode which ends here
    glm::vec3 place;
    float radius;
};

/// A plant drawn by hand: axes first, then one triangle for each organ.
class HandDrawn {
public:
    HandDrawn() { geometry.symbol_names = {"F"}; }

    HandDrawn& axis(std::initializer_list<Node> nodes) {
        for (const Node& node : nodes) point(node.identity, node.place, node.radius);
        cell(geometry.lines, nodes.size(), Kind::axis);
        return *this;
    }
    HandDrawn& organ(std::uint64_t identity, std::initializer_list<glm::vec3> corners) {
        for (const glm::vec3& corner : corners) point(identity, corner, 0);
        cell(geometry.polygons, corners.size(), Kind::polygon);
        geometry.polygons.first = geometry.lines.size();
        return *this;
    }

    FrameGeometry geometry;

private:
    void point(std::uint64_t identity, const glm::vec3& place, float radius) {
        geometry.points.push_back(place);
        geometry.radii.push_back(radius);
        add(geometry.of_points, identity, Kind::axis);
    }
    void cell(FrameCells& cells, std::size_t count, Kind kind) {
        for (std::size_t i = geometry.points.size() - count; i < geometry.points.size(); ++i) {
            cells.connectivity.push_back(static_cast<std::int32_t>(i));
        }
        cells.offsets.push_back(static_cast<std::int32_t>(cells.connectivity.size()));
        add(geometry.of_cells, 0, kind);
    }
    static void add(FrameAttributes& of, std::uint64_t identity, Kind kind) {
        of.identities.push_back(identity);
        of.parents.push_back(0);
        of.plants.push_back(0);
        of.symbols.push_back(0);
        of.births.push_back(0);
        of.orders.push_back(0);
        of.colours.push_back(0);
        of.kinds.push_back(kind);
    }
};

/// A shoot that grows and bends to the right, and its branch; in the late frame there is one internode more.
FrameGeometry early() {
    return HandDrawn()
        .axis({{1, {0, 0, 0}, 0.2F}, {1, {0, 1, 0}, 0.2F}, {2, {0, 2, 0}, 0.1F}})
        .axis({{3, {0, 1, 0}, 0.1F}, {3, {1, 1, 0}, 0.1F}})
        .organ(7, {{0, 2, 0}, {0.1F, 2, 0}, {0, 2.1F, 0}})
        .geometry;
}
FrameGeometry late() {
    return HandDrawn()
        .axis({{1, {0, 0, 0}, 0.4F}, {1, {0, 2, 0}, 0.4F}, {2, {1, 2, 0}, 0.3F}, {4, {1.5F, 2, 0}, 0.1F}})
        .axis({{3, {0, 2, 0}, 0.1F}, {3, {3, 2, 0}, 0.1F}})
        .organ(7, {{1.5F, 2, 0}, {1.7F, 2, 0}, {1.5F, 2.2F, 0}})
        .organ(8, {{3, 2, 0}, {3, 2.4F, 0}, {3.4F, 2, 0}})
        .geometry;
}

float length_of(const FrameInternode& internode) {
    return glm::length(internode.tip - internode.base);
}

void check_same(const glm::vec3& found, const glm::vec3& expected) {
    for (int k = 0; k < 3; ++k) CHECK(found[k] == Approx(expected[k]).margin(1e-5));
}

}  // namespace

TEST_CASE("lengths and radii change linearly between two frames, and what is new begins at nothing", "[reading]") {
    const Unfolding unfolding(early(), late());
    for (const float share : {0.1F, 0.25F, 0.5F, 0.9F}) {
        const std::vector<FrameInternode> internodes = internodes_of(unfolding.at(share));
        REQUIRE(internodes.size() == 4);
        CHECK(length_of(internodes[0]) == Approx(1 + share));
        CHECK(length_of(internodes[1]) == Approx(1));
        CHECK(length_of(internodes[2]) == Approx(0.5 * share));
        CHECK(length_of(internodes[3]) == Approx(1 + 2 * share));
        CHECK(internodes[0].tip_radius == Approx(0.2 + 0.2 * share));
        CHECK(internodes[2].tip_radius == Approx(0.1 * share));
    }
}

TEST_CASE("axes stay whole and turn evenly between two frames", "[reading]") {
    const std::vector<FrameInternode> internodes = internodes_of(Unfolding(early(), late()).at(0.5));
    CHECK(internodes[1].base == internodes[0].tip);
    CHECK(internodes[3].base == internodes[0].tip);
    // From upright to a right angle: half a right angle.
    check_same(internodes[1].tip - internodes[1].base, {std::sqrt(0.5F), std::sqrt(0.5F), 0});
}

TEST_CASE("organs go with the internode they stand on, and new ones unfold from it", "[reading]") {
    const FrameGeometry half = Unfolding(early(), late()).at(0.5);
    const std::vector<FrameInternode> internodes = internodes_of(half);
    const auto old_organ = half.polygons[0], new_organ = half.polygons[1];
    const auto place = [&](std::int32_t point) { return half.points[static_cast<std::size_t>(point)]; };
    check_same(place(old_organ[0]), internodes[2].tip);
    check_same(place(old_organ[1]) - place(old_organ[0]), {0.15F, 0, 0});
    check_same(place(new_organ[0]), internodes[3].tip);
    check_same(place(new_organ[1]) - place(new_organ[0]), {0, 0.2F, 0});
}

TEST_CASE("at the end of the step everything is where the later frame has it", "[reading]") {
    const FrameGeometry met = Unfolding(early(), late()).at(1), expected = late();
    for (std::size_t i = 0; i < expected.points.size(); ++i) {
        check_same(met.points[i], expected.points[i]);
        CHECK(met.radii[i] == Approx(expected.radii[i]));
    }
}

TEST_CASE("an empty frame unfolds to the first thing drawn, and a thing to nothing", "[reading]") {
    const Unfolding first(HandDrawn().geometry, late());
    CHECK(length_of(internodes_of(first.at(0.5)).front()) == Approx(1));
    CHECK(Unfolding(early(), HandDrawn().geometry).at(0.5).points.empty());
}
