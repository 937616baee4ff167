#include "archive/facet_areas.h"

#include "archive/meshes/texture_file.h"
#include "geometry/vectors.h"

#include <glm/geometric.hpp>

namespace espalier::archive {

FacetAreas::FacetAreas(const FrameGeometry& geometry, const std::filesystem::path& run) : geometry_(geometry) {
    for (const std::string& file : geometry.texture_files) {
        opacities_.push_back(file.empty() ? nullptr : Opacity::of(texture_path(run, file)));
    }
}

double FacetAreas::of(std::size_t polygon) const {
    const auto corners = geometry_.polygons[polygon];
    const auto point = [&](std::size_t i) { return static_cast<std::size_t>(corners[i]); };
    const double area =
        glm::length(area_vector(corners.size(), [&](std::size_t i) { return glm::dvec3(geometry_.points[point(i)]); }));
    const std::size_t cell = geometry_.polygons.first + polygon;
    const std::size_t texture = cell < geometry_.textures.size() ? geometry_.textures[cell] : 0;
    if (texture >= opacities_.size() || !opacities_[texture]) return area;
    std::vector<glm::dvec2> uvs;
    for (std::size_t i = 0; i < corners.size(); ++i) uvs.emplace_back(geometry_.uvs[point(i)]);
    return area * opacities_[texture]->over(uvs);
}

}  // namespace espalier::archive
