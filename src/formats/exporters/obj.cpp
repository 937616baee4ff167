// Wavefront OBJ with its MTL: an object per plant, a group per axis and organ, materials by colour and texture.
#include "espalier/base/file.h"
#include "espalier/formats/exporter.h"

#include "archive/meshes/mesh_pieces.h"
#include "archive/meshes/surface_mesh.h"
#include "formats/colour.h"
#include "formats/map_place.h"
#include "formats/mesh_files.h"
#include "formats/textures.h"

#include <fmt/format.h>

#include <iterator>

namespace espalier::formats {
namespace {

// Two files may have one stem.
std::string numbered_name(const MeshMaterial& material, std::size_t number) {
    return material.texture.empty() ? material_name(material) : fmt::format("{}_{}", material_name(material), number);
}

std::string mtl(const RecordedRun& run, const FrameMesh& mesh, TextureCopies& textures) {
    std::string text = "# made by espalier\n";
    for (std::size_t i = 0; i < mesh.materials.size(); ++i) {
        const MeshMaterial& material = mesh.materials[i];
        const RecordedMaterial recorded = run.material(material.rgb);
        const auto [reflected, emitted] = parts_of(material.rgb, recorded);
        fmt::format_to(std::back_inserter(text),
                       "newmtl {}\nKa 0 0 0\nKd {:.6f} {:.6f} {:.6f}\nKs 0 0 0\nd {}\nillum 1\n",
                       numbered_name(material, i), reflected[0] / 255.0, reflected[1] / 255.0, reflected[2] / 255.0,
                       recorded.opacity);
        if (emitted != Rgb{0, 0, 0}) {
            fmt::format_to(std::back_inserter(text), "Ke {:.6f} {:.6f} {:.6f}\n", emitted[0] / 255.0,
                           emitted[1] / 255.0, emitted[2] / 255.0);
        }
        const TextureCopy& copy = textures.copy(material.texture);
        if (!copy.name.empty()) text += "map_Kd " + copy.name + "\n";
        if (copy.is_transparent) text += "map_d " + copy.name + "\n";
        const std::string& heights = textures.copy(material.texture, TextureMap::heights).name;
        if (heights.empty()) continue;
        text += "map_Bump " + heights + "\n";
        text += "norm " + textures.copy(material.texture, TextureMap::normals).name + "\n";
    }
    return text;
}

class ObjText {
public:
    ObjText(const RecordedRun& run, char up, const std::string& library)
        : run_(run),
          text_(fmt::format("# made by espalier; metres\n{}mtllib {}\n", origin_line("# ", run, up), library)) {}

    /// An object for each plant. A piece of one that is not its first has its number behind its name.
    void add_mesh(const FrameMesh& mesh, std::size_t piece = 1) {
        for (const glm::vec3& p : mesh.points) add("v {} {} {}\n", p.x, p.y, p.z);
        for (const glm::vec2& uv : mesh.uvs) add("vt {} {}\n", uv.x, uv.y);
        for (const glm::vec3& n : mesh.normals) add("vn {} {} {}\n", n.x, n.y, n.z);
        for (std::size_t i = 0; i < mesh.parts.size(); ++i) {
            const std::uint32_t plant = mesh.parts[i].plant;
            if (i == 0 || plant != mesh.parts[i - 1].plant) {
                add("o {}{}\n", run_.plants()[plant].name, piece > 1 ? fmt::format("_{}", piece) : "");
            }
            add_part(mesh, mesh.parts[i]);
        }
        vertices_ += mesh.points.size();
    }

    const std::string& text() const { return text_; }

private:
    template <class... Values>
    void add(fmt::format_string<Values...> format, Values&&... values) {
        fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
    }

    void add_part(const FrameMesh& mesh, const MeshPart& part) {
        add("g {}\n", part_name(run_, part, groups_++));
        for (std::size_t i = 0; i < part.triangles; ++i) {
            const std::size_t triangle = part.first_triangle + i;
            const std::uint32_t material = mesh.material_of[triangle];
            if (i == 0 || material != mesh.material_of[triangle - 1]) {
                add("usemtl {}\n", numbered_name(mesh.materials[material], material));
            }
            text_ += 'f';
            for (const std::uint32_t corner : mesh.triangles[triangle]) add(" {0}/{0}/{0}", vertices_ + corner + 1);
            text_ += '\n';
        }
    }

    const RecordedRun& run_;
    std::string text_;
    std::size_t vertices_ = 0, groups_ = 0;  ///< written so far
};

class Obj final : public Exporter {
public:
    std::string extension() const override { return "obj"; }

    void write(const ExportJob& job) const override {
        TextureCopies textures(job);
        for (const RecordedFrame* frame : job.frames) {
            const FrameMesh mesh = mesh_of(job.geometry(*frame), job.options);
            const std::vector<Object> objects = objects_of(job, mesh);
            std::size_t vertices = 0;
            for (const Object& object : objects) vertices += object.mesh.points.size();
            const auto path = job.path(*frame, extension(), {vertices, mesh.triangles.size(), 0, "mtl"});
            const auto library = std::filesystem::path(path).replace_extension("mtl");
            ObjText text(job.run, job.options.up, library.filename().string());
            for (const Object& object : objects) text.add_mesh(object.mesh, object.piece);
            write_text(library, mtl(job.run, mesh, textures));
            write_text(path, text.text());
            job.report({path, vertices, mesh.triangles.size(), 0, "",
                        joined_hints({hint_of_triangles(job, mesh.triangles.size()), textures.hint()})});
        }
    }

private:
    struct Object {
        FrameMesh mesh;
        std::size_t piece;
    };

    static std::vector<Object> objects_of(const ExportJob& job, const FrameMesh& mesh) {
        if (job.most_vertices == 0) return {{mesh, 1}};
        std::vector<Object> objects;
        for (const auto& [plant, own] : by_plant(mesh)) {
            std::size_t piece = 0;
            for (FrameMesh& part : pieces_of(own, {.vertices = job.most_vertices})) {
                objects.push_back({std::move(part), ++piece});
            }
        }
        return objects;
    }
};

const Registered<ExporterType> entry{
    {"obj", "Wavefront OBJ and MTL, a file per frame: for every 3D program",
     "An object per plant, a group per axis and organ; normals, texture coordinates, materials by colour and texture,\n"
     "textures as .png beside it.\n"
     "Lost: time, identities, parameters; a point's colour other than its face's",
     construct<Obj>}};

}  // namespace
}  // namespace espalier::formats
