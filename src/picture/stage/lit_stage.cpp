#include "picture/stage/lit_stage.h"

#include "archive/meshes/texture_file.h"

#include <vtkImageData.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace espalier::picture {
namespace {

Rgb rgb_of(const glm::dvec3& share) {
    const auto byte = [](double part) { return static_cast<std::uint8_t>(std::lround(255 * part)); };
    return {byte(share.x), byte(share.y), byte(share.z)};
}

/// Null where the picture cannot be read.
std::shared_ptr<const LitTexture> lit_texture(vtkImageData* image) {
    if (!image || image->GetScalarType() != VTK_UNSIGNED_CHAR) return nullptr;
    const int* size = image->GetDimensions();
    const int channels = image->GetNumberOfScalarComponents();
    auto texture = std::make_shared<LitTexture>();
    texture->width = size[0];
    texture->height = size[1];
    const auto* from = static_cast<const unsigned char*>(image->GetScalarPointer());
    const auto count = static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]);
    texture->pixels.reserve(count);
    for (std::size_t i = 0; i < count; ++i, from += channels) {
        const bool is_grey = channels < 3, has_opacity = channels == 2 || channels == 4;
        const std::uint8_t opacity = has_opacity ? from[channels - 1] : std::uint8_t{255};
        texture->pixels.push_back({from[0], from[is_grey ? 0 : 1], from[is_grey ? 0 : 2], opacity});
    }
    return texture;
}

/// Colours of the model that glow or are seen through.
void add_materials(const RecordedRun& run, LitPart& part) {
    std::map<Rgb, RecordedMaterial> known;
    const auto material = [&](const Rgb& rgb) -> const RecordedMaterial& {
        const auto [at, is_new] = known.try_emplace(rgb);
        if (is_new) at->second = run.material(rgb);
        return at->second;
    };
    std::vector<Rgb> emissions;
    std::vector<float> opacities;
    bool glows = false, is_clear = false;
    for (Rgb& colour : part.colours) {
        const RecordedMaterial& here = material(colour);
        glows = glows || here.emission != glm::dvec3(0);
        is_clear = is_clear || here.opacity < 1;
        emissions.push_back(rgb_of(here.emission));
        opacities.push_back(static_cast<float>(here.opacity));
        if (here.emission == glm::dvec3(0)) continue;
        for (std::size_t k = 0; k < 3; ++k) {  // the colour holds the light that is emitted
            colour[k] = static_cast<std::uint8_t>(colour[k] - std::min(colour[k], emissions.back()[k]));
        }
    }
    if (glows) part.emissions = std::move(emissions);
    if (is_clear) part.opacities = std::move(opacities);
}

/// A background's triangles with points of their own.
struct BackgroundMesh {
    std::vector<glm::vec3> points, normals;
    std::vector<glm::vec2> uvs;
    std::vector<std::int32_t> corners;
};

}  // namespace

LitPart lit_part(const RecordedRun& run, const StageMesh& mesh, const LitDress& dress) {
    LitPart part{points_of(mesh), normals_of(mesh), uvs_of(mesh), corners_of(mesh), {}};
    part.is_thin = mesh.is_thin && !mesh.is_of_axes;
    if (!dress.texture.empty()) {
        part.texture = lit_texture(texture_image(run.folder(), dress.texture));
        part.relief = lit_texture(relief_images(run.folder(), dress.texture).normals);
    }
    part.colours.reserve(mesh.row_of_point.size());
    for (const std::uint32_t row : mesh.row_of_point) {
        part.colours.push_back(part.texture && dress.has_colours_of_texture ? Rgb{255, 255, 255} : dress.colours[row]);
    }
    if (dress.has_materials) add_materials(run, part);
    return part;
}

LitPart lit_background(const RecordedBackground& background) {
    auto mesh = std::make_shared<BackgroundMesh>();
    std::vector<Rgb> colours;
    std::vector<float> opacities;
    for (std::size_t i = 0; i < background.triangles.size(); ++i) {
        for (const std::int32_t corner : background.triangles[i]) {
            const auto at = static_cast<std::size_t>(corner);
            mesh->corners.push_back(static_cast<std::int32_t>(mesh->points.size()));
            mesh->points.push_back(background.points[at]);
            mesh->normals.push_back(background.normals[at]);
            colours.push_back(background.rgb[i]);
            opacities.push_back(std::clamp(background.opacities[i], 0.0F, 1.0F));
        }
    }
    mesh->uvs.resize(mesh->points.size());
    LitPart part{mesh->points, mesh->normals, mesh->uvs, mesh->corners, std::move(colours)};
    const auto is_clear = [](float opacity) { return opacity < 1; };
    if (std::any_of(opacities.begin(), opacities.end(), is_clear)) part.opacities = std::move(opacities);
    part.owner = std::move(mesh);
    return part;
}

}  // namespace espalier::picture
