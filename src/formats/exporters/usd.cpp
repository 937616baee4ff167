// USD as text: growth as time samples. A plant has curves with widths for its axes and a mesh for its surfaces.
#include "espalier/base/file.h"
#include "espalier/formats/exporter.h"

#include "archive/meshes/axis_tree.h"
#include "archive/meshes/surface_mesh.h"
#include "archive/meshes/tubes.h"
#include "formats/colour.h"
#include "formats/usd_materials.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <iterator>
#include <map>

namespace espalier::formats {
namespace {

/// An attribute's value at each frame, as text.
class Samples {
public:
    /// `declaration` is as in "point3f[] points"; `metadata` may be "".
    Samples(std::string declaration, std::string metadata)
        : declaration_(std::move(declaration)), metadata_(std::move(metadata)) {}

    void add(int step, std::string value) {
        // Between three equal ones the middle one says nothing.
        const std::size_t count = values_.size();
        if (count >= 2 && values_[count - 1].second == value && values_[count - 2].second == value) values_.pop_back();
        values_.emplace_back(step, std::move(value));
    }

    void append_to(std::string& text, std::size_t indent = 12) const {
        const std::string margin(indent, ' ');
        const auto add = [&](fmt::string_view format, const auto&... values) {
            fmt::vformat_to(std::back_inserter(text), fmt::format("{}{}\n", margin, format),
                            fmt::make_format_args(values...));
        };
        const std::string metadata =
            metadata_.empty() ? "" : fmt::format(" (\n{0}    interpolation = \"{1}\"\n{0})", margin, metadata_);
        if (values_.size() == 1) return add("{} = {}{}", declaration_, values_[0].second, metadata);
        if (!metadata.empty()) add("{}{}", declaration_, metadata);
        add("{}.timeSamples = {{", declaration_);
        for (const auto& [step, value] : values_) add("    {}: {},", step, value);
        text += margin + "}\n";
    }

private:
    std::string declaration_, metadata_;
    std::vector<std::pair<int, std::string>> values_;
};

template <class Range, class Format>
std::string list(const Range& range, const Format& format) {
    std::string text = "[";
    for (const auto& value : range) {
        if (text.size() > 1) text += ", ";
        format(text, value);
    }
    return text + "]";
}

void put_number(std::string& text, auto number) {
    fmt::format_to(std::back_inserter(text), "{}", number);
}

void put_vector(std::string& text, const glm::vec3& v) {
    fmt::format_to(std::back_inserter(text), "({}, {}, {})", v.x, v.y, v.z);
}

std::string numbers(const auto& range) {
    return list(range, [](std::string& text, const auto& value) { put_number(text, value); });
}

std::string vectors(const std::vector<glm::vec3>& range) {
    return list(range, put_vector);
}

std::string colours(const std::vector<Rgb>& range) {
    return list(range, [](std::string& text, const Rgb& rgb) { put_vector(text, linear_light(rgb)); });
}

std::string extent(const std::vector<glm::vec3>& points, float margin) {
    if (points.empty()) return "[(0, 0, 0), (0, 0, 0)]";
    glm::vec3 lower = points.front(), upper = lower;
    for (const glm::vec3& point : points) {
        lower = glm::min(lower, point);
        upper = glm::max(upper, point);
    }
    return vectors({lower - margin, upper + margin});
}

const char* visibility(bool visible) {
    return visible ? "\"inherited\"" : "\"invisible\"";
}

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
            const std::string& name = materials.name(look);
            if (!name.empty()) faces_[name][step].push_back(i);
        }
        steps_.push_back(step);
        triangles_ += rgb.size();
        vertices_ += mesh.points.size();
        face_counts_.add(step, numbers(std::vector<int>(rgb.size(), 3)));
        corners_.add(step, list(mesh.triangles, [](std::string& text, const auto& corners) {
                         fmt::format_to(std::back_inserter(text), "{}, {}, {}", corners[0], corners[1], corners[2]);
                     }));
        mesh_points_.add(step, vectors(mesh.points));
        normals_.add(step, vectors(mesh.normals));
        uvs_.add(step, list(mesh.uvs, [](std::string& text, const glm::vec2& uv) {
                     fmt::format_to(std::back_inserter(text), "({}, {})", uv.x, uv.y);
                 }));
        mesh_colours_.add(step, colours(rgb));
        mesh_extent_.add(step, extent(mesh.points, 0));
        mesh_shown_.add(step, visibility(!rgb.empty()));
    }

    std::size_t vertices() const { return vertices_; }  ///< of curves and surfaces, in all samples
    std::size_t triangles() const { return triangles_; }

    void append_to(std::string& text, const std::string& name, const std::string& label) const {
        text += "    def Xform \"" + name + "\" (\n        displayName = \"" + label + "\"\n    )\n    {\n";
        text += "        def BasisCurves \"axes\"\n        {\n            uniform token type = \"linear\"\n";
        for (const Samples* samples : {&counts_, &points_, &widths_, &colours_, &births_, &extent_, &shown_}) {
            samples->append_to(text);
        }
        text +=
            "        }\n        def Mesh \"surfaces\"\n        {\n            uniform bool doubleSided = true\n"
            "            uniform token subdivisionScheme = \"none\"\n";
        if (!faces_.empty()) {
            text += "            uniform token subsetFamily:materialBind:familyType = \"nonOverlapping\"\n";
        }
        for (const auto& [material, faces] : faces_) append_subset(text, material, faces);
        for (const Samples* samples :
             {&face_counts_, &corners_, &mesh_points_, &normals_, &uvs_, &mesh_colours_, &mesh_extent_, &mesh_shown_}) {
            samples->append_to(text);
        }
        text += "        }\n    }\n";
    }

private:
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
    std::map<std::string, std::map<int, std::vector<std::size_t>>> faces_;  ///< of each material, by step
    std::vector<int> steps_;
    std::size_t vertices_ = 0, triangles_ = 0;
};

/// The axes of every plant.
std::vector<Curves> curves_of(const RecordedGeometry& geometry, const ExportJob& job) {
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
            curves.rgb.push_back(colour_of(geometry.of_points, static_cast<std::size_t>(node.row)));
            curves.births.push_back(geometry.of_points.births[static_cast<std::size_t>(node.row)]);
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

class Usd final : public Exporter {
public:
    std::string extension() const override { return "usda"; }

    void write(const ExportJob& job) const override {
        std::vector<PlantSamples> plants(job.run.plants().size());
        UsdMaterials materials(job);
        const auto wanted = [&](std::uint32_t plant) { return !job.options.plant || *job.options.plant == plant; };
        for (const RecordedFrame* frame : job.frames) {
            const RecordedGeometry geometry = job.run.geometry(*frame);
            const std::vector<Curves> curves = curves_of(geometry, job);
            std::map<std::uint32_t, FrameMesh> surfaces = by_plant(surfaces_of(geometry, job.options));
            for (std::uint32_t plant = 0; plant < plants.size(); ++plant) {
                if (!wanted(plant)) continue;
                plants[plant].add(frame->step, curves[plant]);
                plants[plant].add(frame->step, surfaces[plant], materials);
            }
        }
        std::string text = head(job);
        std::size_t vertices = 0, triangles = 0;
        for (std::uint32_t plant = 0; plant < plants.size(); ++plant) {
            if (!wanted(plant)) continue;
            const std::string& name = job.run.plants()[plant].name;
            plants[plant].append_to(text, fmt::format("plant_{}", plant), quoted(name));
            vertices += plants[plant].vertices();
            triangles += plants[plant].triangles();
        }
        materials.append_to(text);
        text += "}\n";
        const auto path = job.frames.size() == 1 ? job.path(*job.frames[0], extension()) : job.path(extension());
        write_text(path, text);
        job.report({path, vertices, triangles, job.frames.size(), "time samples"});
    }

private:
    static std::string head(const ExportJob& job) {
        return fmt::format(
            "#usda 1.0\n(\n    defaultPrim = \"world\"\n    doc = \"{}, made by espalier\"\n    metersPerUnit = 1\n"
            "    upAxis = \"{}\"\n    startTimeCode = {}\n    endTimeCode = {}\n    timeCodesPerSecond = 24\n)\n\n"
            "def Xform \"world\"\n{{\n",
            quoted(job.run.scene()), job.options.up == 'z' ? "Z" : "Y", job.frames.front()->step,
            job.frames.back()->step);
    }
};

const Registered<ExporterType> entry{
    {"usd", "USD as text (.usda), growth as time samples: for Houdini, Blender, Omniverse, usdview",
     "One file: per plant the axes as curves with widths, colour and birth at every node, the surfaces as a mesh, and\n"
     "when either is visible; textures as .png beside it. A step is a time code, 24 of them a second; --step all for "
     "the whole growth.\n"
     "Lost: identities, parameters; --sides means nothing to curves",
     construct<Usd>}};

}  // namespace
}  // namespace espalier::formats
