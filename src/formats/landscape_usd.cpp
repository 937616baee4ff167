#include "espalier/base/file.h"

#include "formats/landscape_file.h"
#include "formats/map_place.h"
#include "formats/usd_materials.h"
#include "formats/usd_mesh.h"
#include "formats/usd_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <iterator>
#include <map>
#include <utility>

namespace espalier::formats {
namespace {

using namespace usd;

/// Letters, digits and underscores, which names of prims consist of.
std::string prim_name(std::string name) {
    for (char& c : name) {
        const bool fits = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
        if (!fits) c = '_';
    }
    return name;
}

class LandscapeUsd {
public:
    LandscapeUsd(const LandscapeFile& file, const std::filesystem::path& path)
        : file_(file),
          path_(path),
          job_{file.run, {}, {}, path.parent_path(), {}, path.stem().string()},
          materials_(job_),
          places_(places_by_shape(file)) {}

    ExportedFile write() {
        std::string text =
            "#usda 1.0\n(\n    defaultPrim = \"world\"\n    doc = \"A landscape, made by espalier\"\n"
            "    metersPerUnit = 1\n    upAxis = \"Y\"\n" +
            origin_data(file_.run, 'y') + ")\n\ndef Xform \"world\"\n{\n";
        append(text, "terrain", file_.landscape.terrain.mesh(file_.ground), 4);
        append_plants(text);
        materials_.append_to(text);
        write_text(path_, text + "}\n");
        return {path_, vertices_, triangles_, file_.landscape.plants.size(), "plants", materials_.hint()};
    }

private:
    void append(std::string& text, const std::string& name, const FrameMesh& mesh, std::size_t indent) {
        vertices_ += mesh.points.size();
        triangles_ += mesh.triangles.size();
        std::vector<Rgb> rgb;
        std::map<std::string, std::vector<std::size_t>> subsets;
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            const MeshMaterial& look = mesh.materials[mesh.material_of[i]];
            rgb.push_back(look.rgb);
            subsets[materials_.name(look)].push_back(i);
        }
        append_mesh(text, name, {mesh.triangles, mesh.points, mesh.normals, mesh.uvs, rgb, std::move(subsets)}, indent);
    }

    void append_plants(std::string& text) {
        text += "    def PointInstancer \"plants\"\n    {\n";
        // Names of species may become equal, so that each prototype has its number too.
        std::vector<std::string> names, paths;
        for (const auto& [shape, places] : places_) {
            names.push_back(fmt::format("shape_{}_{}", names.size(), prim_name(name_of(file_, shape))));
            paths.push_back(fmt::format("</world/plants/shapes/{}>", names.back()));
        }
        text += fmt::format("        rel prototypes = [{}]\n", fmt::join(paths, ", "));
        append_places(text);
        text += "        def Scope \"shapes\"\n        {\n";
        std::size_t number = 0;
        for (const auto& [shape, places] : places_) {
            if (shape.is_card()) {
                materials_.add_picture(texture_name_of(file_, shape), file_.cards[shape.species][shape.turn].png);
            }
            append(text, names[number++], mesh_of(file_, shape), 12);
        }
        text += "        }\n    }\n";
    }

    void append_places(std::string& text) const {
        std::vector<std::size_t> shapes;
        std::vector<glm::vec3> positions, scales;
        std::vector<glm::quat> turns;
        std::size_t number = 0;
        for (const auto& [shape, places] : places_) {
            shapes.insert(shapes.end(), places.translations.size(), number++);
            positions.insert(positions.end(), places.translations.begin(), places.translations.end());
            turns.insert(turns.end(), places.rotations.begin(), places.rotations.end());
            for (const float scale : places.scales) scales.emplace_back(scale);
        }
        const auto add = [&](const char* declaration, const std::string& value) {
            fmt::format_to(std::back_inserter(text), "        {} = {}\n", declaration, value);
        };
        add("int[] protoIndices", numbers(shapes));
        add("point3f[] positions", vectors(positions));
        add("quath[] orientations", turns_as_text(turns));
        add("float3[] scales", vectors(scales));
        add("float3[] extent", extent(corners_of_plants(), 0));
    }

    /// The corners of the boxes around the shapes, in all their places.
    std::vector<glm::vec3> corners_of_plants() const {
        std::vector<glm::vec3> result;
        for (const auto& [shape, places] : places_) {
            const std::array<glm::vec3, 8> corners = corners_of(mesh_of(file_, shape).points);
            for (std::size_t i = 0; i < places.translations.size(); ++i) {
                for (const glm::vec3& corner : corners) {
                    result.push_back(places.translations[i] + places.rotations[i] * (places.scales[i] * corner));
                }
            }
        }
        return result;
    }

    static std::array<glm::vec3, 8> corners_of(const std::vector<glm::vec3>& points) {
        std::array<glm::vec3, 8> corners{};
        if (points.empty()) return corners;
        glm::vec3 lower = points.front(), upper = lower;
        for (const glm::vec3& point : points) lower = glm::min(lower, point), upper = glm::max(upper, point);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            corners[i] = {i & 1 ? upper.x : lower.x, i & 2 ? upper.y : lower.y, i & 4 ? upper.z : lower.z};
        }
        return corners;
    }

    const LandscapeFile& file_;
    std::filesystem::path path_;
    ExportJob job_;
    UsdMaterials materials_;
    std::map<LandscapeShape, ShapePlaces> places_;
    std::size_t vertices_ = 0, triangles_ = 0;
};

}  // namespace

ExportedFile write_landscape_usd(const LandscapeFile& file, const std::filesystem::path& path) {
    return LandscapeUsd(file, path).write();
}

}  // namespace espalier::formats
