// OBJ and MTL files read by the letter: what they do not say rightly is thrown.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace espalier {

struct ObjFile {
    struct Face {
        std::array<std::size_t, 3> points, uvs, normals;  ///< from 0
        std::string object, group, material;
    };
    struct Material {
        glm::dvec3 colour{-1};
        std::string picture, opacity;
    };

    std::vector<glm::dvec3> points, normals;
    std::vector<glm::dvec2> uvs;
    std::vector<Face> faces;
    std::map<std::string, Material> materials;

    explicit ObjFile(const std::filesystem::path& path) {
        std::ifstream file(path);
        Face now;
        for (std::string line; std::getline(file, line);) {
            std::istringstream words(line);
            std::string key;
            words >> key;
            if (key == "v") {
                words >> points.emplace_back().x >> points.back().y >> points.back().z;
            } else if (key == "vn") {
                words >> normals.emplace_back().x >> normals.back().y >> normals.back().z;
            } else if (key == "vt") {
                words >> uvs.emplace_back().x >> uvs.back().y;
            } else if (key == "o") {
                words >> now.object;
            } else if (key == "g") {
                words >> now.group;
            } else if (key == "usemtl") {
                words >> now.material;
                require(materials.contains(now.material), line);
            } else if (key == "f") {
                read_corners(words, now);
                faces.push_back(now);
            } else if (key == "mtllib") {
                std::string name;
                words >> name;
                read_materials(path.parent_path() / name);
            } else {
                require(key == "#", line);
            }
            require(key == "#" || (!words.fail() && (words >> std::ws).eof()), line);
        }
    }

    /// The positions of the corners of all triangles, in no order.
    std::multiset<std::array<double, 9>> triangles() const {
        std::multiset<std::array<double, 9>> result;
        for (const Face& face : faces) {
            std::array<double, 9> corners{};
            for (std::size_t k = 0; k < 9; ++k) corners[k] = points[face.points[k / 3]][static_cast<int>(k % 3)];
            result.insert(corners);
        }
        return result;
    }

    /// The vertices that the faces of each object use.
    std::map<std::string, std::set<std::size_t>> vertices_of_objects() const {
        std::map<std::string, std::set<std::size_t>> result;
        for (const Face& face : faces) result[face.object].insert(face.points.begin(), face.points.end());
        return result;
    }

private:
    static void require(bool right, const std::string& line) {
        if (!right) throw std::runtime_error("wrong line: " + line);
    }

    void read_corners(std::istringstream& words, Face& face) const {
        for (std::size_t k = 0; k < 3; ++k) {
            char slash = 0, other = 0;
            words >> face.points[k] >> slash >> face.uvs[k] >> other >> face.normals[k];
            require(slash == '/' && other == '/', "f");
            require(face.points[k] >= 1 && face.points[k] <= points.size(), "an index of a vertex");
            require(face.uvs[k] >= 1 && face.uvs[k] <= uvs.size(), "an index of texture coordinates");
            require(face.normals[k] >= 1 && face.normals[k] <= normals.size(), "an index of a normal");
            --face.points[k], --face.uvs[k], --face.normals[k];
        }
    }

    void read_materials(const std::filesystem::path& path) {
        std::ifstream file(path);
        require(file.is_open(), path.string());
        Material* now = nullptr;
        for (std::string line; std::getline(file, line);) {
            std::istringstream words(line);
            std::string key, name;
            words >> key;
            if (key == "newmtl") {
                words >> name;
                now = &materials[name];
            } else if (key == "Kd") {
                words >> now->colour.x >> now->colour.y >> now->colour.z;
            } else if (key == "map_Kd" || key == "map_d") {
                std::string& picture = key == "map_d" ? now->opacity : now->picture;
                words >> picture;
                require(std::filesystem::exists(path.parent_path() / picture), line);
            }
            require(!words.fail(), line);
        }
    }
};

}  // namespace espalier
