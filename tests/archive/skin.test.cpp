// Limbs under one skin: closed, saddles in forks, at the distance of its radius from each axis.
#include "archive/meshes/skin.h"

#include "espalier/base/error.h"

#include "archive/meshes/limb_level_set.h"
#include "archive/meshes/texture_file.h"
#include "catch.h"
#include "temporary_folder.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <tbb/global_control.h>

#include <cmath>
#include <map>
#include <numbers>
#include <set>

using namespace espalier;
using namespace espalier::archive;
using Catch::Contains;

namespace {

AxisLine axis(const std::vector<glm::vec3>& points, const std::vector<float>& radii, bool stands_free = false) {
    AxisLine axis{{}, 0, 0};
    for (std::size_t i = 0; i < points.size(); ++i) {
        axis.line.nodes.push_back({points[i], radii[i % radii.size()], PointIndex(i)});
    }
    axis.line.stands_free = stands_free;
    return axis;
}

/// Two limbs from the end of a third, so many degrees apart.
std::vector<AxisLine> fork(double degrees, float left = 0.09f, float right = 0.08f) {
    const double half = degrees / 360 * std::numbers::pi;
    const auto x = static_cast<float>(std::sin(half)), y = static_cast<float>(std::cos(half));
    return {axis({{0, 0, 0}, {0, 0.5f, 0}, {0, 1, 0}}, {0.12f}, true), axis({{0, 1, 0}, {-x, 1 + y, 0}}, {left}),
            axis({{0, 1, 0}, {x, 1 + y, 0}}, {right})};
}

/// Roots that run down side by side within a trunk and part at its foot.
std::vector<AxisLine> flare() {
    std::vector<AxisLine> axes{axis({{0, 0, 0}, {0, 2, 0}}, {0.3f}, true)};
    for (int i = 0; i < 5; ++i) {
        const double angle = 2 * std::numbers::pi * i / 5;
        const auto at = [&](double far, double height) {
            return glm::vec3(far * std::cos(angle), height, far * std::sin(angle));
        };
        axes.push_back(axis({at(0.1, 0.9), at(0.2, 0.5), at(0.4, 0.2), at(0.8, 0.08), at(1.3, 0.05)},
                            {0.16f, 0.15f, 0.13f, 0.1f, 0.06f}));
    }
    return axes;
}

/// All patches with vertices in one place taken for one.
struct Whole {
    std::vector<glm::dvec3> points;
    std::vector<std::array<std::size_t, 3>> triangles;

    explicit Whole(const std::vector<Tube>& tubes) {
        std::map<std::array<float, 3>, std::size_t> number;
        for (const Tube& tube : tubes) {
            for (const TubeTriangle& triangle : tube.triangles) {
                std::array<std::size_t, 3> corners{};
                for (std::size_t k = 0; k < 3; ++k) {
                    const glm::vec3& p = tube.vertices[triangle.corners[k]].position;
                    const auto [at, is_new] = number.try_emplace({p.x, p.y, p.z}, points.size());
                    if (is_new) points.emplace_back(p);
                    corners[k] = at->second;
                }
                triangles.push_back(corners);
            }
        }
    }

    glm::dvec3 corner(std::size_t triangle, std::size_t k) const { return points[triangles[triangle][k]]; }

    /// Edges that two triangles do not run through once each way.
    std::size_t open_edges() const {
        std::map<std::pair<std::size_t, std::size_t>, int> count;
        for (const auto& t : triangles) {
            for (std::size_t k = 0; k < 3; ++k) ++count[{t[k], t[(k + 1) % 3]}];
        }
        std::size_t open = 0;
        for (const auto& [edge, times] : count) {
            const auto back = count.find({edge.second, edge.first});
            open += times != 1 || back == count.end() || back->second != 1;
        }
        return open;
    }

    double volume() const {
        double sum = 0;
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            sum += glm::dot(corner(i, 0), glm::cross(corner(i, 1), corner(i, 2))) / 6;
        }
        return sum;
    }
};

/// Whether a segment runs through the inside of a triangle.
bool pierces(const glm::dvec3& from, const glm::dvec3& to, const Whole& whole, std::size_t triangle) {
    const glm::dvec3 a = whole.corner(triangle, 0), u = whole.corner(triangle, 1) - a,
                     v = whole.corner(triangle, 2) - a, along = to - from;
    const double span = glm::dot(along, glm::cross(u, v));
    if (std::abs(span) < 1e-18) return false;
    const double t = -glm::dot(from - a, glm::cross(u, v)) / span;
    const glm::dvec3 off = from + t * along - a;
    const glm::dmat3 basis(u, v, glm::cross(u, v));
    const glm::dvec3 share = glm::inverse(basis) * off;
    constexpr double rim = 1e-6;
    return t > rim && t < 1 - rim && share.x > rim && share.y > rim && share.x + share.y < 1 - rim;
}

/// Triangles without a common corner one of which an edge of the other pierces.
std::size_t intersections(const Whole& whole) {
    std::size_t found = 0;
    const double cell = 0.05;
    std::map<std::array<int, 3>, std::vector<std::size_t>> cells;
    for (std::size_t i = 0; i < whole.triangles.size(); ++i) {
        glm::dvec3 lower = whole.corner(i, 0), upper = lower;
        for (std::size_t k = 1; k < 3; ++k) {
            lower = glm::min(lower, whole.corner(i, k));
            upper = glm::max(upper, whole.corner(i, k));
        }
        const glm::ivec3 low(glm::floor(lower / cell)), high(glm::floor(upper / cell));
        for (int x = low.x; x <= high.x; ++x) {
            for (int y = low.y; y <= high.y; ++y) {
                for (int z = low.z; z <= high.z; ++z) cells[{x, y, z}].push_back(i);
            }
        }
    }
    std::set<std::pair<std::size_t, std::size_t>> pairs;
    for (const auto& [place, members] : cells) {
        for (const std::size_t a : members) {
            for (const std::size_t b : members) {
                const auto &ta = whole.triangles[a], &tb = whole.triangles[b];
                const bool touch = std::find_first_of(ta.begin(), ta.end(), tb.begin(), tb.end()) != ta.end();
                if (a != b && !touch) pairs.emplace(a, b);
            }
        }
    }
    for (const auto& [a, b] : pairs) {
        for (std::size_t k = 0; k < 3; ++k)
            found += pierces(whole.corner(a, k), whole.corner(a, (k + 1) % 3), whole, b);
    }
    return found;
}

std::vector<Tube> covered(const std::vector<AxisLine>& axes, const AxisSkin& skin = {true}) {
    return skin_of(axes, std::vector<int>(axes.size(), 8), skin);
}

/// Principal curvatures at a vertex, by the quadric of least squares over its neighbourhood; positive: bent away from
/// `outward`.
std::array<double, 2> curvatures(const Whole& whole, const glm::dvec3& at, const glm::dvec3& outward, double radius) {
    const glm::dvec3 u = glm::normalize(glm::cross(outward, glm::dvec3(0.3, 0.2, 0.9))), v = glm::cross(outward, u);
    glm::dmat3 squares(0);
    glm::dvec3 sums(0);
    for (const glm::dvec3& point : whole.points) {
        const glm::dvec3 off = point - at;
        if (glm::length(off) > radius) continue;
        const double x = glm::dot(off, u), y = glm::dot(off, v);
        const glm::dvec3 row(x * x / 2, x * y, y * y / 2);
        for (int i = 0; i < 3; ++i) squares[i] += row * row[i];
        sums -= row * glm::dot(off, outward);
    }
    const glm::dvec3 quadric = glm::inverse(squares) * sums;
    const double mean = (quadric.x + quadric.z) / 2;
    const double spread = std::hypot((quadric.x - quadric.z) / 2, quadric.y);
    return {mean - spread, mean + spread};
}

LimbPiece piece_between(const TubeNode& base, const TubeNode& tip, std::uint32_t limb) {
    const glm::dvec3 along = glm::normalize(glm::dvec3(tip.position) - glm::dvec3(base.position));
    return {base.position, tip.position, base.radius, tip.radius, limb, 1, along, along};
}

double sphere_volume(double radius) {
    return 4.0 / 3 * std::numbers::pi * radius * radius * radius;
}

}  // namespace

TEST_CASE("a skin is closed whatever limbs meet: every edge has two faces", "[skin]") {
    for (const double degrees : {20.0, 50.0, 90.0, 150.0}) {
        for (const double blend : {0.0, 1.0, 2.0}) {
            INFO(degrees << " degrees, blend " << blend);
            const Whole whole(covered(fork(degrees), {true, blend, 0}));
            CHECK(whole.triangles.size() > 1000);
            CHECK(whole.open_edges() == 0);
        }
    }
    CHECK(Whole(covered(flare())).open_edges() == 0);
}

TEST_CASE("the skins of forks do not run through themselves", "[skin]") {
    for (const double degrees : {20.0, 50.0, 90.0, 150.0}) {
        INFO(degrees);
        CHECK(intersections(Whole(covered(fork(degrees), {true, 1, 0.02}))) == 0);
    }
}

TEST_CASE("the crotch is a saddle: its principal curvatures have opposite signs", "[skin]") {
    for (const double degrees : {30.0, 60.0, 90.0}) {
        for (const auto& [left, right] : {std::pair{0.09f, 0.09f}, {0.1f, 0.06f}}) {
            INFO(degrees << " degrees, radii " << left << " and " << right);
            const Whole whole(covered(fork(degrees, left, right), {true, 1, 0.01}));
            // The lowest point between the limbs, in their plane.
            glm::dvec3 crotch(0, 1e9, 0);
            for (const glm::dvec3& point : whole.points) {
                const bool is_between = std::abs(point.z) < 0.01 && std::abs(point.x) < 0.03 && point.y > 1.05;
                if (is_between && point.y < crotch.y) crotch = point;
            }
            REQUIRE(crotch.y < 2);
            const auto [least, most] = curvatures(whole, crotch, {0, 1, 0}, 0.03);
            CHECK(least < -1);  // the fillet: its radius is that of a limb, or less
            CHECK(most > 1);    // across: that of a limb
            const Whole sharp(covered(fork(degrees, left, right), {true, 0, 0.01}));
            CHECK(whole.volume() > sharp.volume());
        }
    }
}

TEST_CASE("nothing bulges where limbs go on beside each other", "[skin]") {
    // On the far sides of a narrow fork of equal limbs the surface keeps its distance from the axes.
    const Whole whole(covered(fork(40, 0.09f, 0.09f), {true, 1, 0.01}));
    double farthest = 0;
    for (const glm::dvec3& point : whole.points) {
        if (point.y > 1.02 && point.y < 1.2 && std::abs(point.x) < 0.02)
            farthest = std::max(farthest, std::abs(point.z));
    }
    CHECK(farthest < 0.12 * 1.02);
    CHECK(farthest > 0.08);
}

TEST_CASE("every vertex lies at its radius from the skeleton curves, to half a voxel", "[skin]") {
    for (const double voxel : {0.02, 0.04}) {
        std::vector<AxisLine> axes = flare();
        axes.front().line.stands_free = false;
        LimbUnion limbs(
            [&] {
                std::vector<LimbPiece> pieces;
                for (std::uint32_t i = 0; i < axes.size(); ++i) {
                    const auto& nodes = axes[i].line.nodes;
                    for (std::uint32_t k = 1; k < nodes.size(); ++k) {
                        pieces.push_back(piece_between(nodes[k - 1], nodes[k], i));
                    }
                }
                return pieces;
            }(),
            0);
        const LimbMesh mesh = LimbLevelSet(limbs, voxel).mesh();
        REQUIRE(mesh.points.size() > 1000);
        for (std::size_t i = 0; i < mesh.points.size(); ++i) {
            double least = 1e9;
            for (const LimbPiece& piece : limbs.pieces()) {
                // By brute force along the curve.
                for (int step = 0; step <= 200; ++step) {
                    const double share = step / 200.0;
                    const glm::dvec3 centre = piece.base + share * (piece.tip - piece.base);
                    const double radius = piece.base_radius + share * (piece.tip_radius - piece.base_radius);
                    least = std::min(least, glm::distance(mesh.points[i], centre) - radius);
                }
            }
            if (std::abs(least) < voxel / 2) continue;
            FAIL_CHECK("a vertex is " << least << " m from the surface");
            break;
        }
    }
}

TEST_CASE("the level set of a sphere and of a capsule has their volume, to 1 %", "[skin]") {
    const double radius = 0.5, length = 2;
    const double capsule = sphere_volume(radius) + std::numbers::pi * radius * radius * length;
    const auto volume = [&](double long_as) {
        const glm::dvec3 base(0.1, 0.2, 0.3), up(0, 1, 0);
        const LimbUnion limbs({{base, base + long_as * up, radius, radius, 0, 1, up, up}}, 1);
        const LimbLevelSet set(limbs, 0.04);
        const Whole whole(covered({axis({{0, 0, 0}, {0, static_cast<float>(long_as), 0}}, {0.5f})}, {true, 1, 0.04}));
        CHECK(whole.volume() == Approx(set.volume()).epsilon(0.01));
        return set.volume();
    };
    CHECK(volume(1e-9) == Approx(sphere_volume(radius)).epsilon(0.01));
    CHECK(volume(length) == Approx(capsule).epsilon(0.01));
}

TEST_CASE("the texture of a limb is continuous except at one seam", "[skin]") {
    std::vector<AxisLine> axes = fork(60);
    for (AxisLine& each : axes) each.line.pictures_around = 2;
    const std::vector<Tube> tubes = covered(axes);
    for (std::size_t limb = 0; limb < tubes.size(); ++limb) {
        const Tube& tube = tubes[limb];
        const glm::vec3 base = axes[limb].line.nodes.front().position,
                        along = axes[limb].line.nodes.back().position - base;
        std::map<std::array<float, 3>, std::set<std::array<float, 2>>> places;
        for (const TubeVertex& vertex : tube.vertices) {
            places[{vertex.position.x, vertex.position.y, vertex.position.z}].insert({vertex.uv.x, vertex.uv.y});
        }
        for (const auto& [place, uvs] : places) {
            REQUIRE(uvs.size() <= 2);
            if (uvs.size() == 1) continue;
            // Two whole pictures apart, so that nothing is seen of it.
            CHECK(uvs.rbegin()->at(0) - uvs.begin()->at(0) == Approx(2));
            CHECK(uvs.rbegin()->at(1) == uvs.begin()->at(1));
        }
        for (const TubeTriangle& triangle : tube.triangles) {
            float least = 1e9f, most = -1e9f;
            bool is_beside = true;  // not at an end, where all of the texture meets in a point
            for (const std::uint32_t corner : triangle.corners) {
                const float share = glm::dot(tube.vertices[corner].position - base, along);
                is_beside = is_beside && share > 0.02f && share < 0.98f;
                least = std::min(least, tube.vertices[corner].uv.x);
                most = std::max(most, tube.vertices[corner].uv.x);
            }
            if (is_beside) CHECK(most - least < 0.3f);
        }
    }
}

TEST_CASE("twigs stay closed tubes that begin inside, and a limb keeps its rows", "[skin]") {
    std::vector<AxisLine> axes = fork(60);
    axes.push_back(axis({{0, 0.5f, 0}, {0, 0.5f, 0.6f}}, {0.004f}));
    const std::vector<Tube> tubes = covered(axes, {true, 1, 0.02});
    CHECK(tubes[3].triangles.size() == sweep(axes[3].line, 8).triangles.size());
    CHECK(Whole({tubes[3]}).open_edges() == 0);
    CHECK(Whole(tubes).open_edges() == 0);
    for (const TubeVertex& vertex : tubes[0].vertices) CHECK(vertex.node == (vertex.position.y > 0.5f ? 2 : 1));
}

TEST_CASE("many short pieces give the same skin as a long one", "[skin]") {
    std::vector<glm::vec3> points;
    for (int i = 0; i <= 20000; ++i) points.emplace_back(0, 0.0001f * float(i), 0);
    const Whole fine(covered({axis(points, {0.2f})})), coarse(covered({axis({{0, 0, 0}, {0, 2, 0}}, {0.2f})}));
    CHECK(fine.volume() == Approx(coarse.volume()).epsilon(1e-3));
    CHECK(fine.open_edges() == 0);
}

TEST_CASE("a trunk stands on a flat base", "[skin]") {
    const Whole whole(covered(fork(60)));
    for (const glm::dvec3& point : whole.points) CHECK(point.y > -1e-3);
}

TEST_CASE("the order of limbs and the number of threads change nothing", "[skin]") {
    std::vector<AxisLine> axes = flare();
    const Whole first(covered(axes));
    {
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        const Whole again(covered(axes));
        CHECK(first.points == again.points);
        CHECK(first.triangles == again.triangles);
    }
    std::reverse(axes.begin(), axes.end());
    CHECK(Whole(covered(axes)).volume() == Approx(first.volume()).epsilon(1e-5));
}

TEST_CASE("a voxel is chosen for the thinnest limb and for a surface that fits memory; a wrong one is refused",
          "[skin]") {
    const std::vector<AxisLine> axes = fork(60);
    CHECK(skin_voxel(axes, {true}) == Approx(0.02));
    std::vector<AxisLine> wide = axes;
    wide.push_back(axis({{0, 0, 0}, {0, 1000, 0}}, {0.5f}));
    const double coarse = skin_voxel(wide, {true});
    CHECK(2 * std::numbers::pi * 0.5 * 1000 / (coarse * coarse) < 150'000);
    CHECK_THROWS_WITH(skin_voxel(axes, {true, 1, 1e-5}),
                      Contains("--voxel 1e-05") && Contains("the smallest voxel is"));
    CHECK_THROWS_AS(skin_voxel(axes, {true, 1, 1e-5}), UserError);
}

TEST_CASE("bark moves the vertices of a skin into its furrows, and leaves it closed", "[skin]") {
    const TemporaryFolder folder;
    folder.write("deep.bark", "stripes = 4\nwaviness = 0\nroughness = 0\ndepth = 0.1\nsize = 64\n");
    std::vector<AxisLine> axes = fork(60);
    for (AxisLine& each : axes) {
        each.texture = "deep.bark";
        each.line.pictures_around = 2;
    }
    const std::vector<int> sides(axes.size(), 8);
    AxisSkin skin{true, 1.5, 0.012};
    const std::vector<Tube> smooth = skin_of(axes, sides, skin);
    skin.displaced = true;
    skin.folder = folder.path();
    const std::vector<Tube> rough = skin_of(axes, sides, skin);
    CHECK(Whole(rough).open_edges() == 0);
    const double deepest = 0.1 * std::numbers::pi * 0.12;  // two pictures around a trunk of 0.12 m
    double most = 0;
    std::size_t moved = 0;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        REQUIRE(rough[i].vertices.size() == smooth[i].vertices.size());
        for (std::size_t k = 0; k < smooth[i].vertices.size(); ++k) {
            const TubeVertex &before = smooth[i].vertices[k], &after = rough[i].vertices[k];
            CHECK(after.uv == before.uv);
            const glm::dvec3 by = after.position - before.position;
            CHECK(glm::dot(by, glm::dvec3(before.normal)) <= 1e-6);  // inwards
            CHECK(glm::length(by) <= deepest + 1e-6);
            most = std::max(most, glm::length(by));
            moved += glm::length(by) > 1e-4;
            // The flat foot stays flat.
            if (before.normal.y < -0.999) CHECK(glm::length(by) < 1e-4);
        }
    }
    CHECK(most > 0.95 * deepest);
    CHECK(moved > 1000);
}

TEST_CASE("on a limb of its own, the outline is the radius less the furrow", "[skin]") {
    const TemporaryFolder folder;
    folder.write("deep.bark", "stripes = 4\nwaviness = 0\nroughness = 0\ndepth = 0.1\nsize = 64\n");
    std::vector<AxisLine> axes{axis({{0, 0, 0}, {0, 0.5f, 0}, {0, 1, 0}}, {0.2f}, true)};
    axes[0].texture = "deep.bark";
    axes[0].line.pictures_around = 2;
    const std::vector<int> sides{8};
    AxisSkin skin{true, 1.5, 0.01};
    skin.displaced = true;
    skin.folder = folder.path();
    const BarkRelief relief = *bark_relief(folder.path(), "deep.bark");
    const double picture = std::numbers::pi * 0.2;
    const std::vector<Tube> tubes = skin_of(axes, sides, skin);
    for (const TubeVertex& vertex : tubes[0].vertices) {
        if (vertex.position.y < 0.2 || vertex.position.y > 0.8) continue;
        const double radius = std::hypot(double(vertex.position.x), double(vertex.position.z));
        CHECK(radius == Approx(0.2 - picture * relief.furrow(vertex.uv.x, vertex.uv.y)).margin(0.0005));
    }
}
