#include "formats/levels_file.h"

#include "espalier/base/file.h"

#include "formats/glb.h"

#include <fmt/format.h>

namespace espalier::formats {
namespace {

/// The height of the finest level's picture at which the next one takes its place, as a share of the viewer's.
constexpr double first_end = 0.5;

std::string texture_name(const LevelsFile& file, std::size_t card) {
    return fmt::format("{}-card-{}", file.name, card);
}

/// All cards as one mesh.
FrameMesh mesh_of_cards(const LevelsFile& file) {
    FrameMesh mesh;
    for (std::size_t i = 0; i < file.cards.size(); ++i) {
        const LevelCard& card = file.cards[i];
        const FrameMesh own = card_mesh(card.frame, texture_name(file, i));
        const auto first = static_cast<std::uint32_t>(mesh.points.size());
        for (const glm::vec3& point : own.points) {
            mesh.points.push_back(glm::vec3(card.frame.middle) + card.turn * point);
        }
        for (const glm::vec3& normal : own.normals) mesh.normals.push_back(card.turn * normal);
        mesh.uvs.insert(mesh.uvs.end(), own.uvs.begin(), own.uvs.end());
        for (const auto& [a, b, c] : own.triangles) {
            mesh.triangles.push_back({first + a, first + b, first + c});
            mesh.material_of.push_back(static_cast<std::uint32_t>(i));
        }
        mesh.materials.push_back(own.materials.front());
    }
    return mesh;
}

}  // namespace

std::vector<std::size_t> LevelsFile::triangles() const {
    std::vector<std::size_t> numbers;
    for (const FrameMesh& mesh : meshes) numbers.push_back(mesh.triangles.size());
    numbers.push_back(2 * cards.size());
    return numbers;
}

ExportedFile write_levels(const LevelsFile& file, const std::filesystem::path& path) {
    Glb glb(file.run);
    ExportedFile written;
    written.path = path;
    std::vector<std::size_t> nodes;
    const auto add = [&](const FrameMesh& mesh) {
        written.vertices += mesh.points.size();
        written.triangles += mesh.triangles.size();
        const std::size_t number =
            glb.add_mesh(mesh.points, mesh.normals, mesh.uvs, mesh.triangles, mesh.material_of, mesh.materials);
        nodes.push_back(
            glb.add_node({{"name", fmt::format("{}_level_{}", file.name, nodes.size())}, {"mesh", number}}));
    };
    for (std::size_t i = 0; i < file.cards.size(); ++i) glb.add_lit_picture(texture_name(file, i), file.cards[i].png);
    for (const FrameMesh& mesh : file.meshes) add(mesh);
    add(mesh_of_cards(file));
    // A level of a fourth of the triangles takes over at half of the height, where it covers a fourth of the pixels.
    std::vector<double> ends;
    double end = first_end;
    for (std::size_t level = 0; level + 1 < nodes.size(); ++level, end /= 2) ends.push_back(end);
    ends.push_back(0);  // the cards are seen from any distance
    glb.add_levels(nodes.front(), {nodes.begin() + 1, nodes.end()}, ends);
    write_text(path, glb.bytes({nodes.front()}));
    written.elements = nodes.size();
    written.noun = "levels of detail";
    written.hint = glb.hint();
    return written;
}

}  // namespace espalier::formats
