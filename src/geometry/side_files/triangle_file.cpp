#include "espalier/base/file.h"

#include "base/text_cursor.h"
#include "geometry/side_files/side_files.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <utility>

namespace espalier::geometry {
namespace {

constexpr std::string_view separators = " \t\r,:";
constexpr std::string_view ends = " \t\r,:\n";
constexpr std::size_t most_values = 8;  // x y z nx ny nz u v

class TriangleReader {
public:
    TriangleReader(std::string_view text, const std::string& name, double size, std::vector<Diagnostic>& diagnostics)
        : text_(text, name), size_(size), diagnostics_(diagnostics) {}

    std::optional<Surface> read() {
        const TextCursor start = text_;
        std::size_t announced = 0;
        while (!text_.at_end()) {
            TextCursor line = text_.line();
            line.skip(separators);
            if (line.accept("triangle")) {
                line.word(ends);
                line.skip(separators);
                ++announced;
                count_ = 0;
            }
            if (announced > 0 && count_ < 3) take_vertex(line);
        }
        if (surface_.triangles.size() == announced && announced > 0) return std::move(surface_);
        diagnostics_.push_back(start.diagnostic(
            announced == 0 ? "there is no triangle in this file; the surface is left out"
                           : fmt::format("{} of {} triangles have fewer than three vertices; the surface is left out",
                                         announced - surface_.triangles.size(), announced)));
        return std::nullopt;
    }

private:
    // Lines with fewer than three values are no vertices.
    void take_vertex(TextCursor& line) {
        std::array<double, most_values> values{};
        std::size_t count = 0;
        for (line.skip(separators); !line.at_end() && count < most_values; line.skip(separators)) {
            const std::optional<double> value = line.number();
            if (!value) line.fail(fmt::format("'{}' is no number", TextCursor(line).word(ends)));
            values[count++] = *value;
        }
        if (count < 3) return;
        SurfaceVertex& vertex = triangle_[std::size_t(count_)];
        vertex.position = size_ * glm::dvec3(values[0], values[1], values[2]);
        vertex.normal = {values[3], values[4], values[5]};
        vertex.uv = {values[6], values[7]};
        if (++count_ == 3) finish();
    }

    // Vertices without a normal have the triangle's.
    void finish() {
        const glm::dvec3 across =
            glm::cross(triangle_[1].position - triangle_[0].position, triangle_[2].position - triangle_[0].position);
        for (SurfaceVertex& vertex : triangle_) {
            const glm::dvec3 normal = glm::length(vertex.normal) > 0 ? vertex.normal : across;
            vertex.normal = glm::length(normal) > 0 ? glm::normalize(normal) : glm::dvec3(0, 0, 1);
        }
        surface_.triangles.push_back(triangle_);
    }

    TextCursor text_;
    double size_;
    std::vector<Diagnostic>& diagnostics_;
    Surface surface_;
    std::array<SurfaceVertex, 3> triangle_;
    int count_ = 3;
};

}  // namespace

std::optional<Surface> read_triangles_text(std::string_view text, const std::string& name, double size,
                                           std::vector<Diagnostic>& diagnostics) {
    return TriangleReader(text, name, size, diagnostics).read();
}

std::optional<Surface> read_triangles(const std::filesystem::path& path, double size,
                                      std::vector<Diagnostic>& diagnostics) {
    return read_triangles_text(read_text(path), path.string(), size, diagnostics);
}

}  // namespace espalier::geometry
