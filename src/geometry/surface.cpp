#include "espalier/geometry/surface.h"

#include "base/cubic_basis.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <map>

namespace espalier::geometry {
namespace {

using Weights = std::array<double, 4>;

/// What the four control points of a row or column count at u.
Weights weights(BicubicPatch::Basis basis, double u) {
    const double v = 1 - u;
    switch (basis) {
        case BicubicPatch::Basis::bezier:
            return {v * v * v, 3 * u * v * v, 3 * u * u * v, u * u * u};
        case BicubicPatch::Basis::b_spline:
            return b_spline_weights(u);
        case BicubicPatch::Basis::cardinal:
            return {(-u + 2 * u * u - u * u * u) / 2, (2 - 5 * u * u + 3 * u * u * u) / 2,
                    (u + 4 * u * u - 3 * u * u * u) / 2, (u * u * u - u * u) / 2};
    }
    return {};
}

/// The derivatives of the weights.
Weights slopes(BicubicPatch::Basis basis, double u) {
    const double v = 1 - u;
    switch (basis) {
        case BicubicPatch::Basis::bezier:
            return {-3 * v * v, 3 * v * v - 6 * u * v, 6 * u * v - 3 * u * u, 3 * u * u};
        case BicubicPatch::Basis::b_spline:
            return b_spline_slopes(u);
        case BicubicPatch::Basis::cardinal:
            return {(-1 + 4 * u - 3 * u * u) / 2, (-10 * u + 9 * u * u) / 2, (1 + 8 * u - 9 * u * u) / 2,
                    (3 * u * u - 2 * u) / 2};
    }
    return {};
}

glm::dvec3 combined(const BicubicPatch& patch, const Weights& of_rows, const Weights& of_columns) {
    glm::dvec3 sum(0);
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) sum += of_rows[i] * of_columns[j] * patch.points[i][j];
    }
    return sum;
}

/// The largest distance of a control point from the first: what lengths are compared with.
double extent(const BicubicPatch& patch) {
    double largest = 0;
    for (const auto& row : patch.points) {
        for (const glm::dvec3& point : row) largest = std::max(largest, glm::distance(point, patch.points[0][0]));
    }
    return largest;
}

glm::dvec3 cross_of_derivatives(const BicubicPatch& patch, double s, double t) {
    const Weights in_s = weights(patch.basis, s), in_t = weights(patch.basis, t);
    return glm::cross(combined(patch, slopes(patch.basis, s), in_t), combined(patch, in_s, slopes(patch.basis, t)));
}

/// Where rows or columns of control points coincide, the normal is that of a place a little further inside.
glm::dvec3 unit_normal(const BicubicPatch& patch, double s, double t) {
    const double size = extent(patch);
    for (const double inside : {0.0, 1e-4, 1e-2}) {
        const glm::dvec3 normal = cross_of_derivatives(patch, s + (0.5 - s) * inside, t + (0.5 - t) * inside);
        const double length = glm::length(normal);
        if (length > 1e-9 * size * size) return normal / length;
    }
    return {0, 0, 1};
}

/// The vertices of the patches lie one patch after the other, row by row.
class Lattice {
public:
    explicit Lattice(const Surface& surface)
        : rows_(std::uint32_t(std::max(surface.precision_s, 1))),
          columns_(std::uint32_t(std::max(surface.precision_t, 1))) {}

    std::uint32_t rows() const { return rows_; }
    std::uint32_t columns() const { return columns_; }
    std::uint32_t at(std::size_t patch, std::uint32_t i, std::uint32_t j) const {
        return std::uint32_t(patch) * (rows_ + 1) * (columns_ + 1) + i * (columns_ + 1) + j;
    }

private:
    std::uint32_t rows_, columns_;
};

void add_patch(SurfaceMesh& mesh, const BicubicPatch& patch, std::size_t number, const Lattice& lattice) {
    for (std::uint32_t i = 0; i <= lattice.rows(); ++i) {
        for (std::uint32_t j = 0; j <= lattice.columns(); ++j) {
            mesh.vertices.push_back(evaluate(patch, double(i) / lattice.rows(), double(j) / lattice.columns()));
        }
    }
    for (std::uint32_t i = 0; i < lattice.rows(); ++i) {
        for (std::uint32_t j = 0; j < lattice.columns(); ++j) {
            for (const auto index : {lattice.at(number, i, j), lattice.at(number, i + 1, j),
                                     lattice.at(number, i + 1, j + 1), lattice.at(number, i, j + 1)}) {
                mesh.indices.push_back(index);
            }
            mesh.faces.push_back(4);
            mesh.patches.push_back(std::uint32_t(number));
        }
    }
}

/// The vertex of a neighbour that lies on vertex (i, j) of a patch, for every neighbour that has one there.
template <class Visit>
void for_each_twin(const Lattice& lattice, const BicubicPatch& patch, std::uint32_t i, std::uint32_t j,
                   std::size_t patches, Visit visit) {
    const std::uint32_t S = lattice.rows(), T = lattice.columns();
    const auto neighbour = [&](BicubicPatch::Neighbour side, std::uint32_t row, std::uint32_t column) {
        const int number = patch.neighbours[side];
        if (number >= 0 && std::size_t(number) < patches) visit(lattice.at(std::size_t(number), row, column));
    };
    if (i == 0) neighbour(BicubicPatch::above, S, j);
    if (i == S) neighbour(BicubicPatch::below, 0, j);
    if (j == 0) neighbour(BicubicPatch::left, i, T);
    if (j == T) neighbour(BicubicPatch::right, i, 0);
    if (i == 0 && j == 0) neighbour(BicubicPatch::above_left, S, T);
    if (i == 0 && j == T) neighbour(BicubicPatch::above_right, S, 0);
    if (i == S && j == 0) neighbour(BicubicPatch::below_left, 0, T);
    if (i == S && j == T) neighbour(BicubicPatch::below_right, 0, 0);
}

void average_along_edges(SurfaceMesh& mesh, const Surface& surface, const Lattice& lattice) {
    const std::vector<SurfaceVertex> before = mesh.vertices;
    for (std::size_t number = 0; number < surface.patches.size(); ++number) {
        for (std::uint32_t i = 0; i <= lattice.rows(); ++i) {
            for (std::uint32_t j = 0; j <= lattice.columns(); ++j) {
                glm::dvec3& normal = mesh.vertices[lattice.at(number, i, j)].normal;
                glm::dvec3 sum = normal;
                for_each_twin(lattice, surface.patches[number], i, j, surface.patches.size(),
                              [&](std::uint32_t twin) { sum += before[twin].normal; });
                if (const double length = glm::length(sum); length > 1e-9) normal = sum / length;
            }
        }
    }
}

}  // namespace

SurfaceVertex evaluate(const BicubicPatch& patch, double s, double t) {
    return {combined(patch, weights(patch.basis, s), weights(patch.basis, t)), unit_normal(patch, s, t), {s, t}};
}

SurfaceMesh mesh_of(const Surface& surface) {
    SurfaceMesh mesh;
    std::map<std::array<double, 8>, std::uint32_t> known;
    for (const auto& triangle : surface.triangles) {
        for (const SurfaceVertex& vertex : triangle) {
            const auto& [p, n, uv] = vertex;
            const auto number = static_cast<std::uint32_t>(mesh.vertices.size());
            const auto [at, is_new] = known.try_emplace({p.x, p.y, p.z, n.x, n.y, n.z, uv.x, uv.y}, number);
            if (is_new) mesh.vertices.push_back(vertex);
            mesh.indices.push_back(at->second);
        }
        mesh.faces.push_back(3);
    }
    if (!surface.triangles.empty()) return mesh;
    const Lattice lattice(surface);
    for (std::size_t i = 0; i < surface.patches.size(); ++i) add_patch(mesh, surface.patches[i], i, lattice);
    average_along_edges(mesh, surface, lattice);
    return mesh;
}

}  // namespace espalier::geometry
