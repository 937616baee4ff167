// Wavefront OBJ as the shape of an organ.
#include "espalier/base/file.h"

#include "base/text_cursor.h"
#include "geometry/polygon_triangles.h"
#include "geometry/side_files/side_files.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <cmath>
#include <cstdint>
#include <utility>

namespace espalier::geometry {
namespace {

constexpr std::string_view blanks = " \t\r";
constexpr std::string_view ends_of_word = " \t\r\n/";

class ObjReader {
public:
    ObjReader(std::string_view text, const std::string& name, double size) : text_(text, name), size_(size) {}

    Surface read() {
        while (!text_.at_end()) {
            TextCursor line = text_.line();
            line.skip(blanks);
            const TextCursor begin = line;
            const std::string_view key = line.word(ends_of_word);
            if (key == "v") positions_.push_back(take_vector(line, 3));
            if (key == "vt") uvs_.emplace_back(take_vector(line, 2));
            if (key == "vn") normals_.push_back(take_vector(line, 3));
            if (key == "f") take_face(line, begin);
        }
        if (surface_.triangles.empty()) text_.fail("there is no face in this file");
        return std::move(surface_);
    }

private:
    /// A corner of a face: 7, 7/3, 7//5 or 7/3/5. Negative numbers count from the last.
    struct Corner {
        std::size_t position;
        std::optional<std::size_t> uv, normal;
    };

    // As the file has x, y and z: at the origin of a plant, an organ stands as it was modelled.
    static glm::dvec3 in_turtle_frame(const glm::dvec3& v) { return {-v.x, v.y, -v.z}; }

    glm::dvec3 take_vector(TextCursor& line, int count) const {
        glm::dvec3 vector(0);
        for (int k = 0; k < count; ++k) {
            line.skip(blanks);
            const std::optional<double> value = line.number();
            if (!value || !std::isfinite(*value)) line.fail(fmt::format("expected {} numbers", count));
            vector[k] = *value;
        }
        return vector;
    }

    std::size_t take_index(TextCursor& line, std::size_t count, const char* what) const {
        const TextCursor begin = line;
        const std::optional<int> number = line.integer();
        if (!number) begin.fail("expected a number, as in f 1/1/1 2/2/1 3/3/1");
        const std::int64_t index = *number < 0 ? static_cast<std::int64_t>(count) + *number : *number - std::int64_t{1};
        if (index < 0 || index >= static_cast<std::int64_t>(count)) {
            begin.fail(fmt::format("there are {} {} above this face, not {}", count, what, *number));
        }
        return static_cast<std::size_t>(index);
    }

    Corner take_corner(TextCursor& line) const {
        Corner corner{take_index(line, positions_.size(), "vertices"), {}, {}};
        if (!line.accept("/")) return corner;
        if (!line.accept("/")) {
            corner.uv = take_index(line, uvs_.size(), "texture coordinates");
            if (!line.accept("/")) return corner;
        }
        corner.normal = take_index(line, normals_.size(), "normals");
        return corner;
    }

    void take_face(TextCursor& line, const TextCursor& begin) {
        std::vector<Corner> corners;
        for (line.skip(blanks); !line.at_end(); line.skip(blanks)) corners.push_back(take_corner(line));
        if (corners.size() < 3) begin.fail("a face has three corners or more");
        std::vector<glm::dvec3> places;
        for (const Corner& corner : corners) places.push_back(positions_[corner.position]);
        const std::vector<std::uint32_t> cut = cut_ears(places).triangles;
        for (std::size_t i = 0; i + 2 < cut.size(); i += 3) {
            add_triangle({corners[cut[i]], corners[cut[i + 1]], corners[cut[i + 2]]});
        }
    }

    void add_triangle(const std::array<Corner, 3>& corners) {
        const auto place = [&](std::size_t k) { return positions_[corners[k].position]; };
        const glm::dvec3 across = glm::cross(place(1) - place(0), place(2) - place(0));
        std::array<SurfaceVertex, 3> triangle;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 normal = corners[k].normal ? normals_[*corners[k].normal] : across;
            triangle[k].position = size_ * in_turtle_frame(place(k));
            triangle[k].normal =
                glm::length(normal) > 0 ? in_turtle_frame(glm::normalize(normal)) : glm::dvec3(0, 0, 1);
            if (corners[k].uv) triangle[k].uv = uvs_[*corners[k].uv];
        }
        surface_.triangles.push_back(triangle);
    }

    TextCursor text_;
    double size_;
    std::vector<glm::dvec3> positions_, normals_;
    std::vector<glm::dvec2> uvs_;
    Surface surface_;
};

}  // namespace

Surface read_object_text(std::string_view text, const std::string& name, double size) {
    return ObjReader(text, name, size).read();
}

Surface read_object(const std::filesystem::path& path, double size) {
    return read_object_text(read_text(path), path.string(), size);
}

}  // namespace espalier::geometry
