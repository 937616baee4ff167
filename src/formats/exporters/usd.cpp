// USD as text: growth as time samples. A plant has curves with widths for its axes and a mesh for its surfaces.
#include "espalier/base/error.h"
#include "espalier/base/file.h"
#include "espalier/formats/exporter.h"

#include "archive/meshes/axis_tree.h"
#include "archive/meshes/surface_mesh.h"
#include "archive/meshes/tubes.h"
#include "formats/map_place.h"
#include "formats/mesh_files.h"
#include "formats/usd_instances.h"
#include "formats/usd_materials.h"
#include "formats/usd_text.h"

#include <fmt/format.h>

#include <iterator>
#include <map>
#include <optional>

namespace espalier::formats {
namespace {

using namespace usd;

/// The axes of one plant at one frame.
struct Curves {
    std::vector<int> counts;
    std::vector<glm::vec3> points;
    std::vector<float> widths;
    std::vector<Rgb> rgb;
    std::vector<int> births;
    float widest = 0;
};

class PlantSamples {
public:
    void add(int step, const Curves& curves) {
        counts_.add(step, numbers(curves.counts));
        points_.add(step, vectors(curves.points));
        widths_.add(step, numbers(curves.widths));
        colours_.add(step, colours(curves.rgb));
        births_.add(step, numbers(curves.births));
        extent_.add(step, extent(curves.points, curves.widest / 2));
        shown_.add(step, visibility(!curves.counts.empty()));
        vertices_ += curves.points.size();
    }

    void add(int step, const FrameMesh& mesh, UsdMaterials& materials) {
        std::vector<Rgb> rgb;
        for (std::size_t i = 0; i < mesh.material_of.size(); ++i) {
            const MeshMaterial& look = mesh.materials[mesh.material_of[i]];
            rgb.push_back(look.rgb);
            faces_[materials.name(look)][step].push_back(i);
        }
        steps_.push_back(step);
        triangles_ += rgb.size();
        vertices_ += mesh.points.size();
        face_counts_.add(step, numbers(std::vector<int>(rgb.size(), 3)));
        corners_.add(step, corners(mesh.triangles));
        mesh_points_.add(step, vectors(mesh.points));
        normals_.add(step, vectors(mesh.normals));
        uvs_.add(step, places(mesh.uvs));
        mesh_colours_.add(step, colours(rgb));
        mesh_extent_.add(step, extent(mesh.points, 0));
        mesh_shown_.add(step, visibility(!rgb.empty()));
    }

    std::size_t vertices() const { return vertices_; }  ///< vertices of curves and surfaces, in all samples
    std::size_t triangles() const { return triangles_; }

    void append_axes_to(std::string& text) const {
        append_head(text, "BasisCurves", "axes", UsdMaterials::of_colours);
        text += "            uniform token type = \"linear\"\n";
        for (const Samples* samples : {&counts_, &points_, &widths_, &colours_, &births_, &extent_, &shown_}) {
            samples->append_to(text);
        }
        text += "        }\n";
    }

    /// The surfaces, and with them the axes where those are meshes.
    void append_mesh_to(std::string& text) const {
        const bool is_of_one = faces_.size() == 1;
        append_head(text, "Mesh", "surfaces", is_of_one ? faces_.begin()->first : UsdMaterials::of_colours);
        text += "            uniform bool doubleSided = true\n            uniform token subdivisionScheme = \"none\"\n";
        if (faces_.size() > 1) {
            text += "            uniform token subsetFamily:materialBind:familyType = \"nonOverlapping\"\n";
            for (const auto& [material, faces] : faces_) append_subset(text, material, faces);
        }
        for (const Samples* samples :
             {&face_counts_, &corners_, &mesh_points_, &normals_, &uvs_, &mesh_colours_, &mesh_extent_, &mesh_shown_}) {
            samples->append_to(text);
        }
        text += "        }\n";
    }

private:
    static void append_head(std::string& text, const char* type, const char* name, const std::string& material) {
        fmt::format_to(std::back_inserter(text),
                       "        def {} \"{}\" (\n            prepend apiSchemas = [\"MaterialBindingAPI\"]\n        )\n"
                       "        {{\n            rel material:binding = </world/materials/{}>\n",
                       type, name, material);
    }

    /// The faces that wear a material at each step.
    void append_subset(std::string& text, const std::string& material,
                       const std::map<int, std::vector<std::size_t>>& faces) const {
        fmt::format_to(std::back_inserter(text),
                       "            def GeomSubset \"{0}\" (\n                prepend apiSchemas = "
                       "[\"MaterialBindingAPI\"]\n            )\n            {{\n"
                       "                uniform token elementType = \"face\"\n"
                       "                uniform token familyName = \"materialBind\"\n"
                       "                rel material:binding = </world/materials/{0}>\n",
                       material);
        Samples indices("int[] indices", "");
        for (const int step : steps_) {
            const auto worn = faces.find(step);
            indices.add(step, worn == faces.end() ? "[]" : numbers(worn->second));
        }
        indices.append_to(text, 16);
        text += "            }\n";
    }

    Samples counts_{"int[] curveVertexCounts", ""}, points_{"point3f[] points", ""},
        widths_{"float[] widths", "vertex"}, colours_{"color3f[] primvars:displayColor", "vertex"},
        births_{"int[] primvars:birth", "vertex"}, extent_{"float3[] extent", ""}, shown_{"token visibility", ""};
    Samples face_counts_{"int[] faceVertexCounts", ""}, corners_{"int[] faceVertexIndices", ""},
        mesh_points_{"point3f[] points", ""}, normals_{"normal3f[] normals", "vertex"},
        uvs_{"texCoord2f[] primvars:st", "vertex"}, mesh_colours_{"color3f[] primvars:displayColor", "uniform"},
        mesh_extent_{"float3[] extent", ""}, mesh_shown_{"token visibility", ""};
    std::map<std::string, std::map<int, std::vector<std::size_t>>> faces_;  ///< faces of each material, by step
    std::vector<int> steps_;
    std::size_t vertices_ = 0, triangles_ = 0;
};

/// The axes of every plant.
std::vector<Curves> curves_of(const FrameGeometry& geometry, const ExportJob& job) {
    std::vector<Curves> result(job.run.plants().size());
    const float thinnest = thinnest_radius(geometry);
    for (const AxisPath& path : axis_paths(geometry, job.options)) {
        const TubeLine tube = tube_line(geometry, path.points, job.options.simplify, thinnest);
        if (tube.nodes.size() < 2) continue;
        Curves& curves = result[path.plant];
        curves.counts.push_back(static_cast<int>(tube.nodes.size()));
        for (const TubeNode& node : tube.nodes) {
            curves.points.push_back(upright(node.position, job.options.up));
            curves.widths.push_back(2 * node.radius);
            curves.widest = std::max(curves.widest, 2 * node.radius);
            curves.rgb.push_back(colour_of(geometry.of_points, node.point.row()));
            curves.births.push_back(geometry.of_points.births[node.point.row()]);
        }
    }
    return result;
}

// Quotes and backslashes end or change a text.
std::string quoted(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '"' || c == '\\') result += '\\';
        result += static_cast<unsigned char>(c) < 32 ? ' ' : c;
    }
    return result;
}

/// One job's file in the making.
class UsdFile {
public:
    explicit UsdFile(const ExportJob& job) : job_(job), materials_(job), plants_(job.run.plants().size()) {
        for (const RecordedFrame* frame : job.frames) add(*frame);
        if (job.instances) instancers_.emplace(job, materials_);
    }

    std::string text() const {
        std::string text = head(job_);
        for (std::uint32_t plant = 0; plant < plants_.size(); ++plant) {
            if (is_wanted(plant)) append_plant(text, plant);
        }
        materials_.append_to(text);
        return text + "}\n";
    }

    std::string hint() const { return materials_.hint(); }
    std::size_t vertices() const {
        std::size_t sum = instancers_ ? instancers_->vertices() : 0;
        for (const PlantSamples& plant : plants_) sum += plant.vertices();
        return sum;
    }
    std::size_t triangles() const {
        std::size_t sum = instancers_ ? instancers_->triangles() : 0;
        for (const PlantSamples& plant : plants_) sum += plant.triangles();
        return sum;
    }

private:
    bool is_wanted(std::uint32_t plant) const { return !job_.options.plant || *job_.options.plant == plant; }

    void add(const RecordedFrame& frame) {
        const FrameGeometry geometry = job_.geometry(frame);
        std::vector<Curves> curves(plants_.size());
        if (!job_.mesh_axes) curves = curves_of(geometry, job_);
        std::map<std::uint32_t, FrameMesh> meshes = by_plant(mesh(geometry));
        for (std::uint32_t plant = 0; plant < plants_.size(); ++plant) {
            if (!is_wanted(plant)) continue;
            plants_[plant].add(frame.step, curves[plant]);
            plants_[plant].add(frame.step, meshes[plant], materials_);
        }
    }

    FrameMesh mesh(const FrameGeometry& geometry) const {
        if (job_.instances) return job_.mesh_axes ? tubes_of(geometry, job_.options) : FrameMesh();
        return job_.mesh_axes ? mesh_of(geometry, job_.options) : surfaces_of(geometry, job_.options);
    }

    void append_plant(std::string& text, std::uint32_t plant) const {
        fmt::format_to(std::back_inserter(text),
                       "    def Xform \"plant_{}\" (\n        displayName = \"{}\"\n    )\n    {{\n", plant,
                       quoted(job_.run.plants()[plant].name));
        if (!job_.mesh_axes) plants_[plant].append_axes_to(text);
        if (!job_.instances || job_.mesh_axes) plants_[plant].append_mesh_to(text);
        if (instancers_) instancers_->append_to(text, plant, fmt::format("/world/plant_{}", plant));
        text += "    }\n";
    }

    static std::string head(const ExportJob& job) {
        return fmt::format(
            "#usda 1.0\n(\n    defaultPrim = \"world\"\n    doc = \"{}, made by espalier\"\n    metersPerUnit = 1\n"
            "    upAxis = \"{}\"\n{}    startTimeCode = {}\n    endTimeCode = {}\n    timeCodesPerSecond = {}\n)\n\n"
            "def Xform \"world\"\n{{\n",
            quoted(job.run.scene()), job.options.up == 'z' ? "Z" : "Y", origin_data(job.run, job.options.up),
            job.frames.front()->step, job.frames.back()->step, job.steps_per_second);
    }

    const ExportJob& job_;
    UsdMaterials materials_;
    std::vector<PlantSamples> plants_;
    std::optional<Instancers> instancers_;
};

class Usd final : public Exporter {
public:
    std::string extension() const override { return "usda"; }

    void check(const ExportJob& job) const override {
        if (job.most_vertices > 0) {
            throw UserError(fmt::format("--split {}: USD counts vertices in 32 bits; obj, gltf, ply and stl are split",
                                        job.most_vertices));
        }
        if (job.frames.size() > 1) {
            refuse_triangles_and_split(job, "every step would have other triangles; export one --step");
        } else if (job.instances) {
            refuse_triangles_and_split(
                job, "organs that are one shape in many places stay as they are; leave out --instances");
        } else if (!job.mesh_axes) {
            refuse_triangles_and_split(job, "axes are curves in USD; --mesh-axes makes them triangles");
        }
    }

    void write(const ExportJob& job) const override {
        const UsdFile file(job);
        const MeshName name{file.vertices(), file.triangles(), 0, ""};
        const auto path =
            job.frames.size() == 1 ? job.path(*job.frames[0], extension(), name) : job.path(extension(), name);
        write_text(path, file.text());
        job.report({path, file.vertices(), file.triangles(), job.frames.size(), "time samples",
                    joined_hints({hint_of_triangles(job, file.triangles()), file.hint()})});
    }
};

const Registered<ExporterType> entry{
    {"usd", "USD as text (.usda), growth as time samples: for Houdini, Blender, Omniverse, usdview",
     "One file: per plant the axes as curves with widths, colour and birth at every node, the surfaces as a mesh, and\n"
     "when either is visible; textures as .png beside it. --mesh-axes: the axes are part of the mesh. --instances: "
     "organs\n"
     "that look alike are one shape in many places. A step is a time code, --rate of them a second; --step all for "
     "the\n"
     "whole growth.\n"
     "three.js and Apple's viewers show no curves: give them --mesh-axes.\n"
     "Lost: identities, parameters; --sides and textures of axes mean nothing to curves",
     construct<Usd>}};

}  // namespace
}  // namespace espalier::formats
