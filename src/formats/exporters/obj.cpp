// Wavefront OBJ with its MTL: an object per plant, a group per axis and organ, materials by colour and texture.
#include "espalier/base/file.h"
#include "espalier/formats/exporter.h"

#include "archive/meshes/surface_mesh.h"
#include "formats/textures.h"

#include <fmt/format.h>

#include <iterator>

namespace espalier::formats {
namespace {

// Two files may have one stem.
std::string numbered_name(const MeshMaterial& material, std::size_t number) {
    return material.texture.empty() ? material_name(material) : fmt::format("{}_{}", material_name(material), number);
}

std::string mtl(const FrameMesh& mesh, TextureCopies& textures) {
    std::string text = "# made by espalier\n";
    for (std::size_t i = 0; i < mesh.materials.size(); ++i) {
        const MeshMaterial& material = mesh.materials[i];
        const auto [red, green, blue] = material.rgb;
        fmt::format_to(std::back_inserter(text),
                       "newmtl {}\nKa 0 0 0\nKd {:.6f} {:.6f} {:.6f}\nKs 0 0 0\nd 1\nillum 1\n",
                       numbered_name(material, i), red / 255.0, green / 255.0, blue / 255.0);
        const std::string& copy = textures.name(material.texture);
        if (!copy.empty()) text += "map_Kd " + copy + "\n";
    }
    return text;
}

class ObjText {
public:
    ObjText(const RecordedRun& run, const FrameMesh& mesh) : run_(run), mesh_(mesh) {}

    std::string text(const std::string& library) {
        text_ = fmt::format("# made by espalier; metres\nmtllib {}\n", library);
        for (const glm::vec3& p : mesh_.points) add("v {} {} {}\n", p.x, p.y, p.z);
        for (const glm::vec2& uv : mesh_.uvs) add("vt {} {}\n", uv.x, uv.y);
        for (const glm::vec3& n : mesh_.normals) add("vn {} {} {}\n", n.x, n.y, n.z);
        for (std::size_t i = 0; i < mesh_.parts.size(); ++i) add_part(i);
        return std::move(text_);
    }

private:
    template <class... Values>
    void add(fmt::format_string<Values...> format, Values&&... values) {
        fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
    }

    void add_part(std::size_t number) {
        const MeshPart& part = mesh_.parts[number];
        if (number == 0 || part.plant != mesh_.parts[number - 1].plant) {
            add("o {}\n", run_.plants()[part.plant].name);
        }
        add("g {}\n", part_name(run_, part, number));
        for (std::size_t i = 0; i < part.triangles; ++i) {
            const std::size_t triangle = part.first_triangle + i;
            const std::uint32_t material = mesh_.material_of[triangle];
            if (i == 0 || material != mesh_.material_of[triangle - 1]) {
                add("usemtl {}\n", numbered_name(mesh_.materials[material], material));
            }
            text_ += 'f';
            for (const std::uint32_t corner : mesh_.triangles[triangle]) add(" {0}/{0}/{0}", corner + 1);
            text_ += '\n';
        }
    }

    const RecordedRun& run_;
    const FrameMesh& mesh_;
    std::string text_;
};

class Obj final : public Exporter {
public:
    std::string extension() const override { return "obj"; }

    void write(const ExportJob& job) const override {
        TextureCopies textures(job);
        for (const RecordedFrame* frame : job.frames) {
            const FrameMesh mesh = mesh_of(job.run.geometry(*frame), job.options);
            const auto path = job.path(*frame, extension()), library = job.path(*frame, "mtl");
            write_text(library, mtl(mesh, textures));
            write_text(path, ObjText(job.run, mesh).text(library.filename().string()));
            job.report({path, mesh.points.size(), mesh.triangles.size(), 0, ""});
        }
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
