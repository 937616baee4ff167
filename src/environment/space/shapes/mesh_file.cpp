#include "environment/space/shapes/mesh_file.h"

#include "espalier/base/file.h"

#include "base/picture_bytes.h"
#include "base/platform.h"
#include "base/text.h"
#include "environment/space/shapes/mesh_formats.h"
#include "geometry/polygon_triangles.h"
#include "geometry/side_files/obj_mesh.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <compare>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <utility>

namespace espalier::environment {
namespace {

void require_file(const std::filesystem::path& file, const Place& place) {
    std::error_code error;
    if (!std::filesystem::exists(file, error)) {
        throw UserError(place, fmt::format("there is no file {}", file.string()));
    }
    if (!std::filesystem::is_regular_file(file, error) || platform::denied(file, platform::Access::read)) {
        throw UserError(place, fmt::format("{} cannot be read", file.string()));
    }
}

PolygonMesh read_obj(const std::filesystem::path& file) {
    geometry::ObjMesh read = geometry::read_obj_mesh(read_text(file), file.string());
    PolygonMesh mesh{std::move(read.positions), {}, std::move(read.ends)};
    for (const geometry::ObjMesh::Corner& corner : read.corners) {
        mesh.corners.push_back(static_cast<std::int64_t>(corner.position));
    }
    return mesh;
}

PolygonMesh read_polygons(const std::filesystem::path& file, const Place& place) {
    const std::string extension = in_small_letters(file.extension().string());
    if (extension == ".obj") return read_obj(file);
    const auto parse = extension == ".ply" ? parse_ply : extension == ".stl" ? parse_stl : nullptr;
    if (!parse) {
        throw UserError(place, fmt::format("{} is no mesh that can be read: its name must end in .obj, .stl or .ply",
                                           file.string()));
    }
    try {
        return parse(read_text(file));
    } catch (const MeshFormatError& error) {
        throw UserError(place,
                        fmt::format("{} is not a whole {} mesh: {}", file.string(), extension.substr(1), error.what()));
    }
}

/// A file may number points that it does not have, and have points that are nowhere.
void require_sound(const PolygonMesh& mesh, const std::filesystem::path& file, const Place& place) {
    if (mesh.points.empty() || mesh.ends.empty()) {
        throw UserError(place, fmt::format("{} is empty: it has {} points and {} polygons", file.string(),
                                           mesh.points.size(), mesh.ends.size()));
    }
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        const glm::dvec3& point = mesh.points[i];
        const auto countable = [](double coordinate) { return std::abs(coordinate) < 1e30; };  // not so NaN
        if (!countable(point.x) || !countable(point.y) || !countable(point.z)) {
            throw UserError(place, fmt::format("point {} of {} is not finite", i + 1, file.string()));
        }
    }
    const auto points = static_cast<std::int64_t>(mesh.points.size());
    for (std::int64_t corner : mesh.corners) {
        if (corner < 0 || corner >= points) {
            throw UserError(place, fmt::format("a polygon of {} has a corner at point {}, but there are {} points",
                                               file.string(), corner + 1, points));
        }
    }
}

/// Numbers points in the order they first come in; those that coincide have one number.
class PointNumbers {
public:
    std::uint32_t number(const glm::dvec3& point) {
        const auto [at, is_new] = numbers_.try_emplace(point, static_cast<std::uint32_t>(points_.size()));
        if (is_new) points_.push_back(point);
        return at->second;
    }
    std::optional<std::uint32_t> find(const glm::dvec3& point) const {
        const auto at = numbers_.find(point);
        return at == numbers_.end() ? std::nullopt : std::optional(at->second);
    }
    std::vector<glm::dvec3> points() && { return std::move(points_); }

private:
    struct Hash {
        std::size_t operator()(const glm::dvec3& point) const {
            std::uint64_t hash = 0;
            for (int axis = 0; axis < 3; ++axis) {
                const auto bits = std::bit_cast<std::uint64_t>(point[axis] + 0.0);  // -0 is 0
                hash = (hash ^ bits) * 0x9E3779B97F4A7C15u;
                hash ^= hash >> 32;
            }
            return static_cast<std::size_t>(hash);
        }
    };

    std::unordered_map<glm::dvec3, std::uint32_t, Hash> numbers_;
    std::vector<glm::dvec3> points_;
};

/// Triangles between points that are merged where they coincide: STL and OBJ repeat them. Degenerate ones are left out.
TriangleMesh triangulated(const PolygonMesh& polygons) {
    TriangleMesh mesh;
    PointNumbers numbers;
    std::vector<glm::dvec3> corners;
    std::size_t begin = 0;
    for (const std::size_t end : polygons.ends) {
        corners.clear();
        for (; begin < end; ++begin)
            corners.push_back(polygons.points[static_cast<std::size_t>(polygons.corners[begin])]);
        const std::vector<std::uint32_t> cut = cut_ears(corners).triangles;
        for (std::size_t i = 0; i < cut.size(); i += 3) {
            const std::uint32_t a = numbers.number(corners[cut[i]]), b = numbers.number(corners[cut[i + 1]]),
                                c = numbers.number(corners[cut[i + 2]]);
            if (a != b && b != c && c != a) mesh.triangles.push_back({a, b, c});
        }
    }
    mesh.points = std::move(numbers).points();
    return mesh;
}

double longest_side(const Box& box) {
    const glm::dvec3 extent = box.upper - box.lower;
    return std::max({extent.x, extent.y, extent.z});
}

/// Joins points as near to each other as the rounding of a writer with seven digits leaves copies of one.
TriangleMesh welded(const TriangleMesh& mesh) {
    const Box box = mesh.bounds();
    const double tolerance = 1e-6 * longest_side(box);
    const auto cell_of = [&](const glm::dvec3& point) { return glm::floor((point - box.lower) / tolerance); };
    PointNumbers cells;
    std::vector<std::vector<std::uint32_t>> points_of;  // by cell: those of the points that are kept
    TriangleMesh result;
    const auto known_near = [&](const glm::dvec3& point) -> std::optional<std::uint32_t> {
        for (int k = 0; k < 27; ++k) {
            const std::optional<std::uint32_t> cell =
                cells.find(cell_of(point) + glm::dvec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1));
            if (!cell) continue;
            for (const std::uint32_t other : points_of[*cell]) {
                if (glm::distance(result.points[other], point) <= tolerance) return other;
            }
        }
        return {};
    };
    std::vector<std::uint32_t> now;
    for (const glm::dvec3& point : mesh.points) {
        std::optional<std::uint32_t> number = known_near(point);
        if (!number) {
            number = static_cast<std::uint32_t>(result.points.size());
            result.points.push_back(point);
            points_of.resize(std::max<std::size_t>(points_of.size(), cells.number(cell_of(point)) + 1));
            points_of[cells.number(cell_of(point))].push_back(*number);
        }
        now.push_back(*number);
    }
    for (const auto& corners : mesh.triangles) {
        const std::uint32_t a = now[corners[0]], b = now[corners[1]], c = now[corners[2]];
        if (a != b && b != c && c != a) result.triangles.push_back({a, b, c});
    }
    return result;
}

/// Turns triangles so that neighbours face the same way, and every part of the mesh outward. Some programs write
/// triangles either way around.
class Facing {
public:
    explicit Facing(TriangleMesh& mesh) : mesh_(mesh), is_done_(mesh.triangles.size()) {
        for (std::uint32_t triangle = 0; triangle < mesh.triangles.size(); ++triangle) {
            for (int i = 0; i < 3; ++i) sides_.push_back({edge(triangle, i), triangle});
        }
        std::sort(sides_.begin(), sides_.end());
    }

    void run() {
        for (std::uint32_t triangle = 0; triangle < mesh_.triangles.size(); ++triangle) {
            if (!is_done_[triangle]) turn_part(triangle);
        }
    }

private:
    struct Side {
        std::uint64_t edge;
        std::uint32_t triangle;
        auto operator<=>(const Side&) const = default;
    };

    std::uint64_t edge(std::uint32_t triangle, int side) const {
        const auto& corners = mesh_.triangles[triangle];
        const auto [low, high] =
            std::minmax(corners[static_cast<std::size_t>(side)], corners[static_cast<std::size_t>((side + 1) % 3)]);
        return std::uint64_t{low} << 32 | high;
    }

    /// Whether the triangle runs along an edge from its lower to its higher point.
    bool ascends(std::uint32_t triangle, std::uint64_t edge) const {
        const auto low = static_cast<std::uint32_t>(edge >> 32), high = static_cast<std::uint32_t>(edge);
        const auto& [a, b, c] = mesh_.triangles[triangle];
        return (a == low && b == high) || (b == low && c == high) || (c == low && a == high);
    }

    void turn(std::uint32_t triangle) { std::swap(mesh_.triangles[triangle][1], mesh_.triangles[triangle][2]); }

    /// The triangles that are reached over edges of two triangles, which say how both must face.
    void turn_part(std::uint32_t first) {
        std::vector<std::uint32_t> part{first};
        is_done_[first] = true;
        for (std::size_t k = 0; k < part.size(); ++k) {
            for (int side = 0; side < 3; ++side) visit_neighbour(part[k], edge(part[k], side), part);
        }
        double volume = 0;
        const glm::dvec3 origin = mesh_.points[mesh_.triangles[first][0]];
        for (const std::uint32_t triangle : part) {
            const auto& [a, b, c] = mesh_.triangles[triangle];
            volume +=
                glm::dot(mesh_.points[a] - origin, glm::cross(mesh_.points[b] - origin, mesh_.points[c] - origin));
        }
        if (volume >= 0) return;
        for (const std::uint32_t triangle : part) turn(triangle);
    }

    void visit_neighbour(std::uint32_t triangle, std::uint64_t edge, std::vector<std::uint32_t>& part) {
        const auto begin = std::lower_bound(sides_.begin(), sides_.end(), Side{edge, 0});
        if (sides_.end() - begin < 2 || begin[1].edge != edge) return;
        if (sides_.end() - begin > 2 && begin[2].edge == edge) return;
        const std::uint32_t other = begin[0].triangle == triangle ? begin[1].triangle : begin[0].triangle;
        if (is_done_[other]) return;
        is_done_[other] = true;
        if (ascends(triangle, edge) == ascends(other, edge)) turn(other);
        part.push_back(other);
    }

    TriangleMesh& mesh_;
    std::vector<Side> sides_;
    std::vector<bool> is_done_;
};

void face_outward(TriangleMesh& mesh) {
    Facing(mesh).run();
}

/// Edges that an odd number of triangles share: past them one can walk from outside to inside.
std::size_t open_edges(const TriangleMesh& mesh) {
    std::vector<std::uint64_t> edges;
    edges.reserve(3 * mesh.triangles.size());
    for (const auto& corners : mesh.triangles) {
        for (int i = 0; i < 3; ++i) {
            const auto [low, high] = std::minmax(corners[i], corners[(i + 1) % 3]);
            edges.push_back(std::uint64_t{low} << 32 | high);
        }
    }
    std::sort(edges.begin(), edges.end());
    std::size_t open = 0;
    for (auto edge = edges.begin(); edge != edges.end();) {
        const auto next = std::upper_bound(edge, edges.end(), *edge);
        open += (next - edge) % 2;
        edge = next;
    }
    return open;
}

/// Flat meshes are closed and hold nothing. Relative to the extent, because metres or millimetres are the user's.
bool has_volume(const TriangleMesh& mesh) {
    const Box box = mesh.bounds();
    double six_volumes = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        six_volumes +=
            glm::dot(mesh.points[a] - box.lower, glm::cross(mesh.points[b] - box.lower, mesh.points[c] - box.lower));
    }
    const double longest = longest_side(box);
    return std::abs(six_volumes) > 1e-9 * longest * longest * longest;
}

}  // namespace

TriangleMesh read_mesh_file(const std::filesystem::path& file, double scale, const Place& place) {
    require_file(file, place);
    const PolygonMesh polygons = read_polygons(file, place);
    require_sound(polygons, file, place);
    TriangleMesh mesh = triangulated(polygons);
    for (glm::dvec3& point : mesh.points) point *= scale;
    if (!mesh.triangles.empty() && open_edges(mesh) > 0) mesh = welded(mesh);
    if (mesh.triangles.empty()) throw UserError(place, fmt::format("{} has no triangle with an area", file.string()));
    if (const std::size_t open = open_edges(mesh)) {
        throw UserError(place, fmt::format("{} is not closed: {} of its edges {} open, so it has no inside",
                                           file.string(), open, open == 1 ? "is" : "are"));
    }
    face_outward(mesh);
    if (!has_volume(mesh)) throw UserError(place, fmt::format("{} is flat: it encloses no volume", file.string()));
    return mesh;
}

namespace {

HeightImage heights_of(const PngPicture& picture) {
    HeightImage image{picture.width, {}};
    for (std::size_t y = 0; y < picture.height; ++y) {
        for (std::size_t x = 0; x < picture.width; ++x) {
            double sum = 0;
            for (std::size_t k = 0; k < 3; ++k) sum += picture.at(x, y, k);
            image.brightness.push_back(sum / (3.0 * picture.greatest));
        }
    }
    return image;
}

HeightImage heights_of(const Picture& picture) {
    HeightImage image{picture.width, {}};
    for (std::size_t row = picture.height; row-- > 0;) {
        for (std::size_t column = 0; column < picture.width; ++column) {
            const auto& [red, green, blue] = picture.pixels[row * picture.width + column];
            image.brightness.push_back((red + green + blue) / (3.0 * 255));
        }
    }
    return image;
}

}  // namespace

HeightImage read_height_image(const std::filesystem::path& file, const Place& place) {
    require_file(file, place);
    const std::string extension = in_small_letters(file.extension().string());
    const PictureBytes bytes(file);
    if (extension == ".png" || bytes.begins_with("\x89PNG")) return heights_of(read_png(bytes));  // with all 16 bits
    if (extension == ".rgb" || extension == ".tga") return heights_of(read_picture(file));
    throw UserError(place,
                    fmt::format("{} is no picture of heights that can be read: its name must end in .png, .rgb or "
                                ".tga",
                                file.string()));
}

}  // namespace espalier::environment
