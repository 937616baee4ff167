#include "geometry/side_files/obj_mesh.h"

#include "base/text_cursor.h"

#include <fmt/format.h>

#include <cstdint>
#include <utility>

namespace espalier::geometry {
namespace {

// Behind a backslash a line goes on in the next one.
constexpr std::string_view blanks = " \t\r\n\\";
constexpr std::string_view ends_of_word = " \t\r\n/\\";

class ObjReader {
public:
    ObjReader(std::string_view text, const std::string& name) : text_(text, name) {}

    ObjMesh read() {
        while (!text_.at_end()) {
            TextCursor line = text_.continued_line();
            line.skip(blanks);
            const TextCursor begin = line;
            const std::string_view key = line.word(ends_of_word);
            if (key == "v") mesh_.positions.push_back(take_vector(line, 3));
            if (key == "vt") mesh_.uvs.emplace_back(take_vector(line, 2));
            if (key == "vn") mesh_.normals.push_back(take_vector(line, 3));
            if (key == "f") take_face(line, begin);
        }
        return std::move(mesh_);
    }

private:
    glm::dvec3 take_vector(TextCursor& line, int count) const {
        glm::dvec3 vector(0);
        for (int k = 0; k < count; ++k) {
            line.skip(blanks);
            const std::optional<double> value = line.exact_number();
            if (!value) line.fail(fmt::format("expected {} numbers", count));
            vector[k] = *value;
        }
        return vector;
    }

    /// Negative numbers count from the last.
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

    /// 7, 7/3, 7//5 or 7/3/5: position, texture coordinates and normal.
    ObjMesh::Corner take_corner(TextCursor& line) const {
        ObjMesh::Corner corner{take_index(line, mesh_.positions.size(), "vertices"), {}, {}};
        if (!line.accept("/")) return corner;
        if (!line.accept("/")) {
            corner.uv = take_index(line, mesh_.uvs.size(), "texture coordinates");
            if (!line.accept("/")) return corner;
        }
        corner.normal = take_index(line, mesh_.normals.size(), "normals");
        return corner;
    }

    void take_face(TextCursor& line, const TextCursor& begin) {
        const std::size_t first = mesh_.corners.size();
        for (line.skip(blanks); !line.at_end(); line.skip(blanks)) mesh_.corners.push_back(take_corner(line));
        if (mesh_.corners.size() < first + 3) begin.fail("a face has three corners or more");
        mesh_.ends.push_back(mesh_.corners.size());
    }

    TextCursor text_;
    ObjMesh mesh_;
};

}  // namespace

ObjMesh read_obj_mesh(std::string_view text, const std::string& name) {
    return ObjReader(text, name).read();
}

}  // namespace espalier::geometry
