#include "tree_levels.h"

#include "espalier/base/error.h"

#include "archive/meshes/texture_picture.h"
#include "picture/landscape/landscape_picture.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>

namespace espalier::app {
namespace {

constexpr std::size_t coarser = 4, pixels_of_card = 512;

std::vector<LevelCard> crossed_cards(const FrameMesh& mesh, const RecordedRun& run) {
    double height = 0;
    for (const glm::vec3& point : mesh.points) height = std::max(height, double(point.y));
    LandscapeSpecies species{};
    species.height = height;
    species.levels = {mesh};
    const auto texture_of = [&](const std::string& file) { return texture_picture(run.folder(), file); };
    std::vector<LevelCard> cards;
    for (const glm::dvec3 towards : {glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0)}) {
        const RayLight light{glm::normalize(glm::vec3(0, 0.7F, 0) + glm::vec3(towards))};  // each card is lit alike
        const CardPicture card = card_picture(species, towards, light, pixels_of_card, texture_of);
        cards.push_back({png_bytes(*card.picture), card.frame, glm::quat(towards_eye(glm::dvec3(0), towards))});
    }
    return cards;
}

}  // namespace

LevelsFile tree_levels(const ExportJob& job, std::size_t levels) {
    if (job.instances || job.most_vertices > 0 || job.options.skin.smooth) {
        throw UserError("--lod makes meshes coarser as wholes: leave out --instances, --split and --skin smooth");
    }
    const FrameGeometry geometry = job.geometry(*job.frames.front());
    MeshOptions options = job.options;
    options.up = 'y';
    LevelsFile file{job.run, job.name, {mesh_of(geometry, options)}, {}};
    const std::size_t most = file.meshes.front().triangles.size();
    for (std::size_t level = 1, share = coarser; level + 1 < levels; ++level, share *= coarser) {
        options.triangles = std::max<std::size_t>(1, most / share);
        file.meshes.push_back(mesh_of(geometry, options));
        if (file.meshes.back().triangles.size() >= file.meshes[level - 1].triangles.size()) {
            throw UserError(
                fmt::format("--lod {}: the tree has only {} triangles; ask for fewer levels", levels, most));
        }
    }
    file.cards = crossed_cards(file.meshes.front(), job.run);
    return file;
}

}  // namespace espalier::app
