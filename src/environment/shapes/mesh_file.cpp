#include "environment/shapes/mesh_file.h"

#include "espalier/base/file.h"

#include "base/picture_bytes.h"
#include "base/platform.h"
#include "environment/shapes/mesh_formats.h"
#include "geometry/polygon_triangles.h"
#include "geometry/side_files/obj_mesh.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace espalier::environment {
namespace {

std::string lower_case_extension(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

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
    const std::string extension = lower_case_extension(file);
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
    std::vector<glm::dvec3> points() && { return std::move(points_); }

private:
    struct Hash {
        std::size_t operator()(const glm::dvec3& point) const {
            std::size_t hash = 0;
            for (int axis = 0; axis < 3; ++axis) {
                const auto bits = std::bit_cast<std::uint64_t>(point[axis] + 0.0);  // -0 is 0
                hash = (hash ^ bits) * 0x9E3779B97F4A7C15u;
                hash ^= hash >> 32;
            }
            return hash;
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
    const glm::dvec3 extent = box.upper - box.lower;
    double six_volumes = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        six_volumes +=
            glm::dot(mesh.points[a] - box.lower, glm::cross(mesh.points[b] - box.lower, mesh.points[c] - box.lower));
    }
    const double longest = std::max({extent.x, extent.y, extent.z});
    return std::abs(six_volumes) > 1e-9 * longest * longest * longest;
}

}  // namespace

TriangleMesh read_mesh_file(const std::filesystem::path& file, const Place& place) {
    require_file(file, place);
    const PolygonMesh polygons = read_polygons(file, place);
    require_sound(polygons, file, place);
    TriangleMesh mesh = triangulated(polygons);
    if (mesh.triangles.empty()) throw UserError(place, fmt::format("{} has no triangle with an area", file.string()));
    if (const std::size_t open = open_edges(mesh)) {
        throw UserError(place, fmt::format("{} is not closed: {} of its edges {} open, so it has no inside",
                                           file.string(), open, open == 1 ? "is" : "are"));
    }
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
    const std::string extension = lower_case_extension(file);
    const PictureBytes bytes(file);
    if (extension == ".png" || bytes.begins_with("\x89PNG")) return heights_of(read_png(bytes));  // with all 16 bits
    if (extension == ".rgb" || extension == ".tga") return heights_of(read_picture(file));
    throw UserError(place,
                    fmt::format("{} is no picture of heights that can be read: its name must end in .png, .rgb or "
                                ".tga",
                                file.string()));
}

}  // namespace espalier::environment
