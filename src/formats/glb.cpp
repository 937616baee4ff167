#include "formats/glb.h"

#include "espalier/base/error.h"

#include "base/json_text.h"
#include "formats/bytes.h"
#include "formats/colour.h"
#include "formats/textures.h"

#include <glm/common.hpp>

#include <algorithm>
#include <limits>
#include <string_view>

namespace espalier::formats {
namespace {

// Numbers of the standard: component types and what a buffer view is for.
constexpr const char *instancing = "EXT_mesh_gpu_instancing", *levels = "MSFT_lod", *unlit = "KHR_materials_unlit";
constexpr int unsigned_short = 5123, unsigned_int = 5125, float_number = 5126, vertex_buffer = 34962,
              index_buffer = 34963;

Glb::Json json_of(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}

Glb::Json bounds_of(const std::vector<glm::vec3>& points) {
    glm::vec3 lower = points.front(), upper = lower;
    for (const glm::vec3& point : points) {
        lower = glm::min(lower, point);
        upper = glm::max(upper, point);
    }
    return {{"min", json_of(lower)}, {"max", json_of(upper)}};
}

void append_chunk(std::string& bytes, std::string_view type, std::string_view content, char padding) {
    const std::size_t padded = (content.size() + 3) / 4 * 4;
    append_bytes(bytes, static_cast<std::uint32_t>(padded));
    bytes.append(type).append(content).append(padded - content.size(), padding);
}

}  // namespace

std::size_t Glb::add_view(const void* bytes, std::size_t size, int target) {
    binary_.resize((binary_.size() + 3) / 4 * 4);  // behind an image of any length
    Json view = {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", size}};
    if (target != 0) view["target"] = target;
    views_.push_back(std::move(view));
    binary_.append(static_cast<const char*>(bytes), size);
    return views_.size() - 1;
}

template <class T>
std::size_t Glb::add_accessor(const T* values, std::size_t count, int component_type, const char* type, int target,
                              Json bounds) {
    const std::size_t view = add_view(values, count * sizeof(T), target);
    Json accessor = {{"bufferView", view}, {"componentType", component_type}, {"count", count}, {"type", type}};
    accessor.update(bounds);
    accessors_.push_back(std::move(accessor));
    return accessors_.size() - 1;
}

std::optional<std::size_t> Glb::texture(const std::string& file, TextureMap map) {
    const auto [at, is_new] = texture_number_.emplace(std::pair(file, map), std::nullopt);
    if (!is_new || file.empty()) return at->second;
    const std::string png = png_of(run_.folder(), file, map);
    if (png.empty()) {
        if (map == TextureMap::colours) missing_.push_back(file);
        return at->second;
    }
    add_texture(file, png, map);
    return at->second;
}

void Glb::add_texture(const std::string& file, const std::string& png, TextureMap map) {
    images_.push_back({{"bufferView", add_view(png.data(), png.size(), 0)},
                       {"mimeType", "image/png"},
                       {"name", std::filesystem::path(file).stem().string()}});
    textures_.push_back({{"source", images_.size() - 1}});  // without a sampler it repeats
    if (is_transparent(png)) cut_out_.insert(textures_.size() - 1);
    texture_number_[{file, map}] = textures_.size() - 1;
}

void Glb::add_lit_picture(const std::string& file, const std::string& png) {
    add_texture(file, png);
    lit_.insert(textures_.size() - 1);
}

std::string Glb::hint() const {
    return hint_of_missing(missing_);
}

std::size_t Glb::material(const MeshMaterial& look) {
    const auto known = material_number_.find(look);
    if (known != material_number_.end()) return known->second;
    const RecordedMaterial recorded = run_.material(look.rgb);
    const ColourParts parts = parts_of(look.rgb, recorded);
    const glm::vec3 colour = linear_light(parts.reflected), light = linear_light(parts.emitted);
    Json surface = {{"baseColorFactor", {colour.x, colour.y, colour.z, recorded.opacity}},
                    {"metallicFactor", 0},
                    {"roughnessFactor", 0.9}};
    Json material = {{"name", material_name(look)}, {"doubleSided", true}};
    if (light != glm::vec3(0)) material["emissiveFactor"] = {light.x, light.y, light.z};
    if (recorded.opacity < 1) material["alphaMode"] = "BLEND";
    if (const auto number = texture(look.texture, TextureMap::colours)) {
        surface["baseColorTexture"] = {{"index", *number}};
        if (cut_out_.contains(*number) && recorded.opacity == 1) material["alphaMode"] = "MASK";
        if (lit_.contains(*number)) material["extensions"] = {{unlit, Json::object()}};
    }
    if (const auto number = texture(look.texture, TextureMap::normals))
        material["normalTexture"] = {{"index", *number}};
    material["pbrMetallicRoughness"] = std::move(surface);
    materials_.push_back(std::move(material));
    return material_number_[look] = materials_.size() - 1;
}

// Adds indices of 16 bits where they suffice; the standard excludes the largest number of such indices.
std::size_t Glb::add_indices(const std::vector<std::uint32_t>& indices, std::size_t vertices) {
    const Json none = Json::object();
    if (vertices > std::numeric_limits<std::uint16_t>::max()) {
        return add_accessor(indices.data(), indices.size(), unsigned_int, "SCALAR", index_buffer, none);
    }
    const std::vector<std::uint16_t> small(indices.begin(), indices.end());
    return add_accessor(small.data(), small.size(), unsigned_short, "SCALAR", index_buffer, none);
}

std::size_t Glb::add_mesh(const std::vector<glm::vec3>& points, const std::vector<glm::vec3>& normals,
                          const std::vector<glm::vec2>& uvs, const std::vector<std::array<std::uint32_t, 3>>& triangles,
                          const std::vector<std::uint32_t>& material_of, const std::vector<MeshMaterial>& materials) {
    const Json none = Json::object();
    std::vector<glm::vec2> places;  // in glTF v runs down
    for (const glm::vec2& uv : uvs) places.emplace_back(uv.x, 1 - uv.y);
    const Json attributes = {
        {"POSITION",
         add_accessor(points.data(), points.size(), float_number, "VEC3", vertex_buffer, bounds_of(points))},
        {"NORMAL", add_accessor(normals.data(), normals.size(), float_number, "VEC3", vertex_buffer, none)},
        {"TEXCOORD_0", add_accessor(places.data(), places.size(), float_number, "VEC2", vertex_buffer, none)}};
    std::map<std::uint32_t, std::vector<std::uint32_t>> corners;  // by material
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        auto& list = corners[material_of[i]];
        list.insert(list.end(), triangles[i].begin(), triangles[i].end());
    }
    Json primitives = Json::array();
    for (const auto& [number, list] : corners) {
        primitives.push_back({{"attributes", attributes},
                              {"indices", add_indices(list, points.size())},
                              {"material", material(materials[number])}});
    }
    meshes_.push_back({{"primitives", std::move(primitives)}});
    return meshes_.size() - 1;
}

std::size_t Glb::add_node(Json node) {
    nodes_.push_back(std::move(node));
    return nodes_.size() - 1;
}

std::size_t Glb::add_instances(Json node, const std::vector<glm::vec3>& translations,
                               const std::vector<glm::vec4>& rotations, const std::vector<glm::vec3>& scales) {
    const Json none = Json::object();
    const auto add = [&](const auto& values, const char* type) {
        return add_accessor(values.data(), values.size(), float_number, type, 0, none);
    };
    const Json attributes = {{"TRANSLATION", add(translations, "VEC3")},
                             {"ROTATION", add(rotations, "VEC4")},
                             {"SCALE", add(scales, "VEC3")}};
    node["extensions"] = {{instancing, {{"attributes", attributes}}}};
    has_instances_ = true;
    return add_node(std::move(node));
}

void Glb::add_levels(std::size_t node, const std::vector<std::size_t>& coarser, const std::vector<double>& ends) {
    nodes_[node]["extensions"][levels] = {{"ids", coarser}};
    nodes_[node]["extras"]["MSFT_screencoverage"] = ends;
    has_levels_ = true;
}

std::size_t Glb::times_accessor(const std::vector<float>& times) {
    const auto known = times_.find(times);
    if (known != times_.end()) return known->second;
    const Json bounds = {{"min", Json::array({times.front()})}, {"max", Json::array({times.back()})}};
    return times_[times] = add_accessor(times.data(), times.size(), float_number, "SCALAR", 0, bounds);
}

void Glb::animate(std::size_t node, const char* path, const std::vector<float>& times,
                  const std::vector<glm::vec4>& values, const char* interpolation) {
    const std::size_t input = times_accessor(times);
    std::size_t output = 0;
    if (std::string_view(path) == "rotation") {
        output = add_accessor(values.data(), values.size(), float_number, "VEC4", 0, Json::object());
    } else {
        const std::vector<glm::vec3> vectors(values.begin(), values.end());
        output = add_accessor(vectors.data(), vectors.size(), float_number, "VEC3", 0, Json::object());
    }
    samplers_.push_back({{"input", input}, {"interpolation", interpolation}, {"output", output}});
    channels_.push_back({{"sampler", samplers_.size() - 1}, {"target", {{"node", node}, {"path", path}}}});
}

std::string Glb::bytes(const std::vector<std::size_t>& roots) const {
    Json asset = {{"version", "2.0"}, {"generator", "espalier"}};
    if (run_.origin()) asset["extras"] = {{"origin", {run_.origin()->x, run_.origin()->y, run_.origin()->z}}};
    Json json = {{"asset", asset},
                 {"scene", 0},
                 {"scenes", Json::array({roots.empty() ? Json::object() : Json{{"nodes", roots}}})}};
    // The standard forbids empty lists.
    const auto add_unless_empty = [&](const char* key, const Json& list) {
        if (!list.empty()) json[key] = list;
    };
    if (!lit_.empty()) json["extensionsUsed"].push_back(unlit);
    if (has_levels_) json["extensionsUsed"].push_back(levels);  // who does not know them shows the finest
    if (has_instances_) {
        json["extensionsUsed"].push_back(instancing);
        json["extensionsRequired"] = Json::array({instancing});
    }
    add_unless_empty("nodes", nodes_);
    add_unless_empty("meshes", meshes_);
    add_unless_empty("materials", materials_);
    add_unless_empty("images", images_);
    add_unless_empty("textures", textures_);
    add_unless_empty("accessors", accessors_);
    add_unless_empty("bufferViews", views_);
    if (!binary_.empty()) json["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
    if (!channels_.empty()) {
        json["animations"] = Json::array({{{"name", "growth"}, {"samplers", samplers_}, {"channels", channels_}}});
    }
    const std::string text = json_text(json, -1);
    if (text.size() + binary_.size() + 64 > std::numeric_limits<std::uint32_t>::max()) {
        throw RunError("a .glb holds no more than 4 GiB; fewer frames, fewer --sides or one --plant make it smaller");
    }
    std::string chunks;
    append_chunk(chunks, "JSON", text, ' ');
    if (!binary_.empty()) append_chunk(chunks, std::string_view("BIN\0", 4), binary_, '\0');
    std::string file = "glTF";
    append_bytes(file, std::uint32_t{2});
    append_bytes(file, static_cast<std::uint32_t>(12 + chunks.size()));
    return file + chunks;
}

}  // namespace espalier::formats
