#include "formats/usd_mesh.h"

#include "formats/usd_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace espalier::formats::usd {
namespace {

void append_subset(std::string& text, const std::string& material, const std::vector<std::size_t>& triangles,
                   std::size_t indent) {
    fmt::format_to(std::back_inserter(text),
                   "{0:{2}}def GeomSubset \"{1}\" (\n{0:{2}}    prepend apiSchemas = [\"MaterialBindingAPI\"]\n"
                   "{0:{2}})\n{0:{2}}{{\n{0:{2}}    uniform token elementType = \"face\"\n"
                   "{0:{2}}    uniform token familyName = \"materialBind\"\n"
                   "{0:{2}}    rel material:binding = </world/materials/{1}>\n{0:{2}}    int[] indices = {3}\n"
                   "{0:{2}}}}\n",
                   "", material, indent, numbers(triangles));
}

}  // namespace

void append_mesh(std::string& text, const std::string& name, const StillMesh& mesh, std::size_t indent) {
    const bool is_of_one = mesh.faces.size() == 1;
    fmt::format_to(std::back_inserter(text),
                   "{0:{2}}def Mesh \"{1}\" (\n{0:{2}}    prepend apiSchemas = [\"MaterialBindingAPI\"]\n{0:{2}})\n"
                   "{0:{2}}{{\n{0:{2}}    uniform bool doubleSided = true\n"
                   "{0:{2}}    uniform token subdivisionScheme = \"none\"\n"
                   "{0:{2}}    rel material:binding = </world/materials/{3}>\n",
                   "", name, indent, is_of_one ? mesh.faces.begin()->first : UsdMaterials::of_colours);
    const auto add = [&](const char* declaration, const char* interpolation, std::string value) {
        Samples samples(declaration, interpolation);
        samples.add(0, std::move(value));
        samples.append_to(text, indent + 4);
    };
    add("int[] faceVertexCounts", "", numbers(std::vector<int>(mesh.triangles.size(), 3)));
    add("int[] faceVertexIndices", "", corners(mesh.triangles));
    add("point3f[] points", "", vectors(mesh.points));
    add("normal3f[] normals", "vertex", vectors(mesh.normals));
    add("texCoord2f[] primvars:st", "vertex", places(mesh.uvs));
    const bool has_one_colour = !mesh.rgb.empty() && std::all_of(mesh.rgb.begin(), mesh.rgb.end(), [&](const Rgb& rgb) {
        return rgb == mesh.rgb.front();
    });
    if (has_one_colour) {
        add("color3f[] primvars:displayColor", "constant", colours({mesh.rgb.front()}));
    } else {
        add("color3f[] primvars:displayColor", "uniform", colours(mesh.rgb));
    }
    add("float3[] extent", "", extent(mesh.points, 0));
    if (!is_of_one) {
        fmt::format_to(std::back_inserter(text),
                       "{:{}}uniform token subsetFamily:materialBind:familyType = \"nonOverlapping\"\n", "",
                       indent + 4);
        for (const auto& [material, triangles] : mesh.faces) append_subset(text, material, triangles, indent + 4);
    }
    fmt::format_to(std::back_inserter(text), "{:{}}}}\n", "", indent);
}

}  // namespace espalier::formats::usd
