#include "archive/meshes/mesh_pieces.h"

#include <algorithm>

namespace espalier::archive {
namespace {

class Cutter {
public:
    Cutter(const FrameMesh& mesh, const PieceLimit& limit) : mesh_(mesh), limit_(limit) {}

    std::vector<FrameMesh> pieces() {
        begin_piece();
        for (const MeshPart& part : mesh_.parts) add(part);
        if (pieces_.size() > 1 && pieces_.back().parts.empty()) pieces_.pop_back();
        return std::move(pieces_);
    }

private:
    static constexpr std::uint32_t unknown = std::numeric_limits<std::uint32_t>::max();

    FrameMesh& piece() { return pieces_.back(); }

    bool has_room(std::size_t vertices, std::size_t triangles) {
        return piece().points.size() + vertices <= limit_.vertices &&
               piece().triangles.size() + triangles <= limit_.triangles;
    }

    void begin_piece() { pieces_.emplace_back().materials = mesh_.materials; }

    void begin_part(const MeshPart& part) {
        MeshPart& here = piece().parts.emplace_back(part);
        here.first_vertex = piece().points.size();
        here.first_triangle = piece().triangles.size();
        number_.assign(part.vertices, unknown);
    }

    void end_part() {
        MeshPart& here = piece().parts.back();
        here.vertices = piece().points.size() - here.first_vertex;
        here.triangles = piece().triangles.size() - here.first_triangle;
    }

    void add(const MeshPart& part) {
        if (!piece().parts.empty() && !has_room(part.vertices, part.triangles)) begin_piece();
        begin_part(part);
        for (std::size_t i = 0; i < part.triangles; ++i) {
            const std::array<std::uint32_t, 3>& corners = mesh_.triangles[part.first_triangle + i];
            const auto is_new = [&](std::uint32_t corner) { return number_[corner - part.first_vertex] == unknown; };
            const auto more = static_cast<std::size_t>(std::count_if(corners.begin(), corners.end(), is_new));
            if (!has_room(more, 1)) {
                end_part();
                begin_piece();
                begin_part(part);
            }
            add_triangle(part, part.first_triangle + i);
        }
        end_part();
    }

    void add_triangle(const MeshPart& part, std::size_t triangle) {
        std::array<std::uint32_t, 3> moved{};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t corner = mesh_.triangles[triangle][k];
            std::uint32_t& number = number_[corner - part.first_vertex];
            if (number == unknown) {
                number = static_cast<std::uint32_t>(piece().points.size());
                piece().points.push_back(mesh_.points[corner]);
                piece().normals.push_back(mesh_.normals[corner]);
                piece().uvs.push_back(mesh_.uvs[corner]);
                piece().rgb.push_back(mesh_.rgb[corner]);
            }
            moved[k] = number;
        }
        piece().triangles.push_back(moved);
        piece().material_of.push_back(mesh_.material_of[triangle]);
    }

    const FrameMesh& mesh_;
    const PieceLimit& limit_;
    std::vector<FrameMesh> pieces_;
    std::vector<std::uint32_t> number_;  ///< numbers of the part's vertices within the piece
};

}  // namespace

std::vector<FrameMesh> pieces_of(const FrameMesh& mesh, const PieceLimit& limit) {
    return Cutter(mesh, limit).pieces();
}

}  // namespace espalier::archive
