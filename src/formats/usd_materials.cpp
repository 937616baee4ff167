#include "formats/usd_materials.h"

#include "formats/colour.h"
#include "formats/textures.h"

#include <fmt/format.h>

#include <iterator>

namespace espalier::formats {

const std::string& UsdMaterials::name(const MeshMaterial& look) {
    const auto [at, is_new] = names_.emplace(look, "");
    if (!is_new) return at->second;
    const std::string& copy = copies_.copy(look.texture).name;
    const bool is_plain = copy.empty() && run_.material(look.rgb).is_plain();
    if (is_plain && !look.texture.empty()) return at->second = name({look.rgb, ""});
    at->second =
        is_plain ? material_name(look) : fmt::format("{}_{}", copy.empty() ? "material" : "texture", looks_.size());
    looks_.push_back({&at->first, copy, copies_.copy(look.texture, TextureMap::normals).name});
    return at->second;
}

/// The lines of the surface that a recorded material decides.
std::string UsdMaterials::surface(const MeshMaterial& look, bool has_picture) const {
    const RecordedMaterial material = run_.material(look.rgb);
    const ColourParts parts = parts_of(look.rgb, material);
    const glm::vec3 reflected = linear_light(parts.reflected), emitted = linear_light(parts.emitted);
    std::string text;
    const auto add = [&](const char* input, const glm::vec3& colour) {
        fmt::format_to(std::back_inserter(text), "                color3f inputs:{} = ({}, {}, {})\n", input, colour.x,
                       colour.y, colour.z);
    };
    if (!has_picture) {
        add("diffuseColor", reflected);
        fmt::format_to(std::back_inserter(text), "                float inputs:opacity = {}\n", material.opacity);
    }
    if (emitted != glm::vec3(0)) add("emissiveColor", emitted);
    return text;
}

/// Reads the picture of normals, whose channels run from -1 to 1.
std::string UsdMaterials::relief(const std::string& name, const std::string& normals) {
    if (normals.empty()) return "";
    return fmt::format(R"(            def Shader "relief"
            {{
                uniform token info:id = "UsdUVTexture"
                asset inputs:file = @./{1}@
                float4 inputs:scale = (2, 2, 2, 1)
                float4 inputs:bias = (-1, -1, -1, 0)
                token inputs:sourceColorSpace = "raw"
                float2 inputs:st.connect = </world/materials/{0}/st.outputs:result>
                token inputs:wrapS = "repeat"
                token inputs:wrapT = "repeat"
                float3 outputs:rgb
            }}
)",
                       name, normals);
}

void UsdMaterials::append_to(std::string& text) const {
    fmt::format_to(std::back_inserter(text), R"(    def Scope "materials"
    {{
        def Material "{0}"
        {{
            token outputs:surface.connect = </world/materials/{0}/surface.outputs:surface>
            def Shader "surface"
            {{
                uniform token info:id = "UsdPreviewSurface"
                color3f inputs:diffuseColor.connect = </world/materials/{0}/colour.outputs:result>
                float inputs:roughness = 0.9
                token outputs:surface
            }}
            def Shader "colour"
            {{
                uniform token info:id = "UsdPrimvarReader_float3"
                string inputs:varname = "displayColor"
                float3 outputs:result
            }}
        }}
)",
                   of_colours);
    for (const auto& [look, copy, normals] : looks_) {
        if (copy.empty()) {
            fmt::format_to(std::back_inserter(text), R"(        def Material "{0}"
        {{
            token outputs:surface.connect = </world/materials/{0}/surface.outputs:surface>
            def Shader "surface"
            {{
                uniform token info:id = "UsdPreviewSurface"
{1}                float inputs:roughness = 0.9
                token outputs:surface
            }}
        }}
)",
                           names_.at(*look), surface(*look, false));
            continue;
        }
        const glm::vec3 colour = linear_light(parts_of(look->rgb, run_.material(look->rgb)).reflected);
        fmt::format_to(std::back_inserter(text),
                       R"(        def Material "{0}"
        {{
            token outputs:surface.connect = </world/materials/{0}/surface.outputs:surface>
            def Shader "surface"
            {{
                uniform token info:id = "UsdPreviewSurface"
                color3f inputs:diffuseColor.connect = </world/materials/{0}/picture.outputs:rgb>
                float inputs:opacity.connect = </world/materials/{0}/picture.outputs:a>
                float inputs:opacityThreshold = 0.5
{5}{6}                float inputs:roughness = 0.9
                token outputs:surface
            }}
{7}            def Shader "picture"
            {{
                uniform token info:id = "UsdUVTexture"
                asset inputs:file = @./{1}@
                float4 inputs:scale = ({2}, {3}, {4}, 1)
                float2 inputs:st.connect = </world/materials/{0}/st.outputs:result>
                token inputs:wrapS = "repeat"
                token inputs:wrapT = "repeat"
                float outputs:a
                float3 outputs:rgb
            }}
            def Shader "st"
            {{
                uniform token info:id = "UsdPrimvarReader_float2"
                string inputs:varname = "st"
                float2 outputs:result
            }}
        }}
)",
                       names_.at(*look), copy, colour.x, colour.y, colour.z, surface(*look, true),
                       normals.empty() ? ""
                                       : fmt::format("                normal3f inputs:normal.connect = "
                                                     "</world/materials/{}/relief.outputs:rgb>\n",
                                                     names_.at(*look)),
                       relief(names_.at(*look), normals));
    }
    text += "    }\n";
}

}  // namespace espalier::formats
