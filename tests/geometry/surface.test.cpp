#include "espalier/geometry/surface.h"

#include "catch.h"

#include <glm/geometric.hpp>

#include <cmath>

using namespace espalier;
using namespace espalier::geometry;

namespace {

/// Control points on a plane grid one apart, lifted by `height`.
template <class Height>
BicubicPatch grid(Height height, glm::dvec3 origin = {0, 0, 0}) {
    BicubicPatch patch;
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) patch.points[i][j] = origin + glm::dvec3(i, j, height(i, j));
    }
    return patch;
}

BicubicPatch flat(glm::dvec3 origin = {0, 0, 0}) {
    return grid([](int, int) { return 0; }, origin);
}

}  // namespace

TEST_CASE("a Bezier patch goes through its corners, along the tangents of its control points", "[geometry]") {
    const BicubicPatch patch = grid([](int i, int j) { return i * j; });
    CHECK(evaluate(patch, 0, 0).position == patch.points[0][0]);
    CHECK(evaluate(patch, 1, 0).position == patch.points[3][0]);
    CHECK(evaluate(patch, 0, 1).position == patch.points[0][3]);
    CHECK(evaluate(patch, 1, 1).position == patch.points[3][3]);
    // At s = t = 1 the derivatives are 3 (P33 - P23) and 3 (P33 - P32): (3, 0, 9) and (0, 3, 9).
    const glm::dvec3 expected = glm::normalize(glm::cross(glm::dvec3(1, 0, 3), glm::dvec3(0, 1, 3)));
    CHECK(glm::distance(evaluate(patch, 1, 1).normal, expected) < 1e-14);
}

TEST_CASE("a Bezier patch takes the Bernstein weights, rows by s and columns by t", "[geometry]") {
    BicubicPatch patch;
    patch.points[1][2] = {1, 0, 0};  // B1(s) B2(t) = 3 s (1-s)^2 * 3 t^2 (1-t)
    CHECK(evaluate(patch, 0.25, 0.5).position.x == Approx(0.421875 * 0.375));
}

TEST_CASE("all bases give a plane for a plane, and the right speed", "[geometry]") {
    using enum BicubicPatch::Basis;
    BicubicPatch patch = flat();
    for (const auto basis : {bezier, b_spline, cardinal}) {
        patch.basis = basis;
        const double step = basis == bezier ? 3 : 1;  // the others span only the middle of the grid
        const double start = basis == bezier ? 0 : 1;
        for (const double u : {0.0, 0.3, 1.0}) {
            const SurfaceVertex vertex = evaluate(patch, u, 0.5);
            CHECK(vertex.position.x == Approx(start + step * u).margin(1e-14));
            CHECK(vertex.position.z == 0);
            CHECK(glm::distance(vertex.normal, {0, 0, 1}) < 1e-14);
        }
    }
}

TEST_CASE("a cardinal patch goes through its inner points, a B-spline patch does not", "[geometry]") {
    BicubicPatch patch = grid([](int i, int j) { return i == 1 && j == 1 ? 1 : 0; });
    patch.basis = BicubicPatch::Basis::cardinal;
    CHECK(evaluate(patch, 0, 0).position == patch.points[1][1]);
    patch.basis = BicubicPatch::Basis::b_spline;
    CHECK(evaluate(patch, 0, 0).position.z == Approx(4.0 / 9));  // (4/6)^2
}

TEST_CASE("a patch whose edge is one point has the normal of its neighbourhood there", "[geometry]") {
    BicubicPatch patch = flat();
    for (int j = 0; j < 4; ++j) patch.points[0][j] = {0, 1.5, 0};
    CHECK(glm::distance(evaluate(patch, 0, 0.5).normal, {0, 0, 1}) < 1e-6);
    CHECK(glm::length(evaluate(BicubicPatch{}, 0, 0).normal) == 1);  // sixteen times the origin
}

TEST_CASE("the mesh of a surface has its precision in quadrilaterals along each side", "[geometry]") {
    Surface surface;
    surface.patches = {flat(), flat({3, 0, 0})};
    surface.precision_s = 2;
    surface.precision_t = 3;
    const SurfaceMesh mesh = mesh_of(surface);
    CHECK(mesh.vertices.size() == 2 * 3 * 4);
    CHECK(mesh.faces == std::vector<std::uint32_t>(12, 4));
    CHECK(mesh.patches.at(5) == 0);
    CHECK(mesh.patches.at(6) == 1);
    CHECK(mesh.vertices[7].uv.x == 0.5);
    CHECK(mesh.vertices[7].uv.y == 1);
    // Faces turn as their normals say.
    for (std::size_t i = 0; i < mesh.indices.size(); i += 4) {
        const auto at = [&](std::size_t k) { return mesh.vertices[mesh.indices[i + k]].position; };
        CHECK(glm::cross(at(1) - at(0), at(2) - at(0)).z > 0);
    }
}

TEST_CASE("normals along the common edge of neighbours are the same on both sides", "[geometry]") {
    // Two planes that meet at a ridge x = 3, one rising, one falling by 45 degrees.
    Surface surface;
    surface.patches = {grid([](int i, int) { return i; }), grid([](int i, int) { return 3 - i; }, {3, 0, 0})};
    SurfaceMesh apart = mesh_of(surface);
    CHECK(glm::dot(apart.vertices[5 * 6].normal, apart.vertices[36].normal) == Approx(0).margin(1e-14));
    surface.patches[0].neighbours[BicubicPatch::below] = 1;
    surface.patches[1].neighbours[BicubicPatch::above] = 0;
    const SurfaceMesh joined = mesh_of(surface);
    for (std::size_t j = 0; j < 6; ++j) {
        CHECK(glm::distance(joined.vertices[5 * 6 + j].normal, {0, 0, 1}) < 1e-14);
        CHECK(glm::distance(joined.vertices[36 + j].normal, {0, 0, 1}) < 1e-14);
    }
    CHECK(joined.vertices[0].normal == apart.vertices[0].normal);  // the other edges keep theirs
}

TEST_CASE("four neighbours share one normal at their common corner", "[geometry]") {
    using enum BicubicPatch::Neighbour;
    Surface surface;
    const auto pyramid = [](double x, double y) {
        return [=](int i, int j) { return -std::abs(x + i) - std::abs(y + j); };
    };
    surface.patches = {grid(pyramid(-3, -3), {-3, -3, 0}), grid(pyramid(-3, 0), {-3, 0, 0}),
                       grid(pyramid(0, -3), {0, -3, 0}), grid(pyramid(0, 0))};
    const auto link = [&](int a, BicubicPatch::Neighbour side, int b, BicubicPatch::Neighbour back) {
        surface.patches[a].neighbours[side] = b;
        surface.patches[b].neighbours[back] = a;
    };
    link(0, right, 1, left);
    link(2, right, 3, left);
    link(0, below, 2, above);
    link(1, below, 3, above);
    link(0, below_right, 3, above_left);
    link(1, below_left, 2, above_right);
    const SurfaceMesh mesh = mesh_of(surface);
    for (const SurfaceVertex& vertex : mesh.vertices) {
        if (glm::length(vertex.position) < 1e-9) CHECK(glm::distance(vertex.normal, {0, 0, 1}) < 1e-12);
    }
}

TEST_CASE("a neighbour that does not exist is no neighbour", "[geometry]") {
    Surface surface;
    surface.patches = {flat()};
    surface.patches[0].neighbours.fill(7);
    CHECK(mesh_of(surface).vertices.size() == 36);
}

TEST_CASE("a surface of triangles keeps its vertices", "[geometry]") {
    Surface surface;
    surface.triangles.push_back({SurfaceVertex{{0, 0, 0}, {0, 0, 1}, {0, 0}}, SurfaceVertex{{1, 0, 0}, {0, 1, 0}, {}},
                                 SurfaceVertex{{0, 1, 0}, {1, 0, 0}, {0.25, 0.5}}});
    const SurfaceMesh mesh = mesh_of(surface);
    CHECK(mesh.faces == std::vector<std::uint32_t>{3});
    CHECK(mesh.vertices[2].uv.y == 0.5);
    CHECK(mesh.vertices[1].normal.y == 1);
    CHECK(mesh_of(Surface{}).faces.empty());
}
