// A glTF 2.0 file in its binary form: a JSON chunk that describes, a binary chunk that holds the numbers.
#pragma once

#include "archive/meshes/surface_mesh.h"
#include "formats/textures.h"

#include <glm/vec4.hpp>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace espalier::formats {

class Glb {
public:
    using Json = nlohmann::ordered_json;

    /// Textures are looked for as `texture_image` does.
    explicit Glb(const RecordedRun& run) : run_(run) {}

    /// Vertices and triangles of one mesh; returns the mesh's number. `material_of` counts in `materials`.
    std::size_t add_mesh(const std::vector<glm::vec3>& points, const std::vector<glm::vec3>& normals,
                         const std::vector<glm::vec2>& uvs, const std::vector<std::array<std::uint32_t, 3>>& triangles,
                         const std::vector<std::uint32_t>& material_of, const std::vector<MeshMaterial>& materials);
    /// What surfaces that wear this file wear, instead of what lies there.
    void add_texture(const std::string& file, const std::string& png, TextureMap map = TextureMap::colours);
    /// As `add_texture`, of a picture that shows its own light and shade: lights of the viewer leave it as it is
    /// (KHR_materials_unlit).
    void add_lit_picture(const std::string& file, const std::string& png);
    /// Returns the node's number.
    std::size_t add_node(Json node);
    /// A mesh in many places, one node (EXT_mesh_gpu_instancing); returns its number.
    std::size_t add_instances(Json node, const std::vector<glm::vec3>& translations,
                              const std::vector<glm::vec4>& rotations, const std::vector<glm::vec3>& scales);
    /// Samples of `path` ("translation", "rotation", "scale") of a node, linear between `times` in seconds, or held
    /// from each to the next.
    void animate(std::size_t node, const char* path, const std::vector<float>& times,
                 const std::vector<glm::vec4>& values, const char* interpolation = "LINEAR");

    /// A node, and what viewers show instead of it where it covers less of the picture (MSFT_lod): the share of the
    /// picture's height at which each of the nodes ends, the finest first. The others are no roots.
    void add_levels(std::size_t node, const std::vector<std::size_t>& coarser, const std::vector<double>& ends);

    Json& nodes() { return nodes_; }
    /// Names the textures that are missing.
    std::string hint() const;
    /// The whole file; `roots` are the nodes of the scene. Throws RunError beyond 4 GiB.
    std::string bytes(const std::vector<std::size_t>& roots) const;

private:
    template <class T>
    std::size_t add_accessor(const T* values, std::size_t count, int component_type, const char* type, int target,
                             Json bounds);
    std::size_t add_indices(const std::vector<std::uint32_t>& indices, std::size_t vertices);
    std::size_t add_view(const void* bytes, std::size_t size, int target);
    std::size_t material(const MeshMaterial& look);
    /// Embedded as PNG; nothing if it is no picture.
    std::optional<std::size_t> texture(const std::string& file, TextureMap map);
    std::size_t times_accessor(const std::vector<float>& times);

    Json accessors_ = Json::array(), views_ = Json::array(), meshes_ = Json::array(), materials_ = Json::array(),
         nodes_ = Json::array(), samplers_ = Json::array(), channels_ = Json::array();
    Json images_ = Json::array(), textures_ = Json::array();
    const RecordedRun& run_;
    std::map<MeshMaterial, std::size_t> material_number_;
    std::map<std::pair<std::string, TextureMap>, std::optional<std::size_t>> texture_number_;
    std::vector<std::string> missing_;  ///< textures
    std::set<std::size_t> cut_out_;     ///< textures whose pictures are partly transparent
    std::set<std::size_t> lit_;         ///< textures that show their own light
    std::map<std::vector<float>, std::size_t> times_;
    std::string binary_;
    bool has_instances_ = false, has_levels_ = false;
};

}  // namespace espalier::formats
