#include "espalier/base/file.h"

#include "formats/glb.h"
#include "formats/landscape_file.h"

namespace espalier::formats {
namespace {

class LandscapeGlb {
public:
    explicit LandscapeGlb(const LandscapeFile& file) : file_(file), glb_(file.run) {}

    ExportedFile write(const std::filesystem::path& path) {
        const std::size_t ground = add_mesh(file_.landscape.terrain.mesh(file_.ground));
        roots_.push_back(glb_.add_node({{"name", "terrain"}, {"mesh", ground}}));
        for (const auto& [shape, places] : places_by_shape(file_)) {
            if (shape.is_card())
                glb_.add_texture(texture_name_of(file_, shape), file_.cards[shape.species][shape.turn].png);
            const std::size_t mesh = add_mesh(mesh_of(file_, shape));
            roots_.push_back(add_instances(name_of(file_, shape), mesh, places));
        }
        write_text(path, glb_.bytes(roots_));
        return {path, vertices_, triangles_, file_.landscape.plants.size(), "plants", glb_.hint()};
    }

private:
    std::size_t add_mesh(const FrameMesh& mesh) {
        vertices_ += mesh.points.size();
        triangles_ += mesh.triangles.size();
        return glb_.add_mesh(mesh.points, mesh.normals, mesh.uvs, mesh.triangles, mesh.material_of, mesh.materials);
    }

    std::size_t add_instances(const std::string& name, std::size_t mesh, const ShapePlaces& places) {
        std::vector<glm::vec4> rotations;
        for (const glm::quat& q : places.rotations) rotations.emplace_back(q.x, q.y, q.z, q.w);
        std::vector<glm::vec3> scales;
        for (const float scale : places.scales) scales.emplace_back(scale);
        return glb_.add_instances({{"name", name}, {"mesh", mesh}}, places.translations, rotations, scales);
    }

    const LandscapeFile& file_;
    Glb glb_;
    std::vector<std::size_t> roots_;
    std::size_t vertices_ = 0, triangles_ = 0;
};

}  // namespace

ExportedFile write_landscape_glb(const LandscapeFile& file, const std::filesystem::path& path) {
    return LandscapeGlb(file).write(path);
}

}  // namespace espalier::formats
