// Meshes and their files, written here because the readers are what is tested.
#pragma once

#include <fmt/format.h>
#include <glm/vec3.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <string>
#include <vector>

struct TestMesh {
    std::vector<glm::dvec3> points;
    std::vector<std::vector<std::uint32_t>> polygons;
};

/// Triangles between circles of latitude, counter-clockwise from outside.
inline TestMesh unit_sphere(int resolution) {
    TestMesh mesh{{{0, 0, 1}, {0, 0, -1}}, {}};
    const auto point = [&](int ring, int i) {
        return static_cast<std::uint32_t>(2 + ring * resolution + i % resolution);
    };
    for (int ring = 0; ring < resolution - 1; ++ring) {
        const double polar = std::numbers::pi * (ring + 1) / resolution;
        for (int i = 0; i < resolution; ++i) {
            const double around = 2 * std::numbers::pi * i / resolution;
            mesh.points.push_back(
                {std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around), std::cos(polar)});
        }
    }
    for (int i = 0; i < resolution; ++i) {
        mesh.polygons.push_back({0, point(0, i), point(0, i + 1)});
        for (int ring = 0; ring + 2 < resolution; ++ring) {
            mesh.polygons.push_back({point(ring, i), point(ring + 1, i), point(ring + 1, i + 1)});
            mesh.polygons.push_back({point(ring, i), point(ring + 1, i + 1), point(ring, i + 1)});
        }
        mesh.polygons.push_back({1, point(resolution - 2, i + 1), point(resolution - 2, i)});
    }
    return mesh;
}

/// Six squares.
inline TestMesh box_of_squares(const glm::dvec3& lower, const glm::dvec3& upper) {
    TestMesh mesh;
    for (int i = 0; i < 8; ++i) {
        mesh.points.push_back({i & 1 ? upper.x : lower.x, i & 2 ? upper.y : lower.y, i & 4 ? upper.z : lower.z});
    }
    mesh.polygons = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    return mesh;
}

inline TestMesh triangulated(const TestMesh& mesh) {
    TestMesh result{mesh.points, {}};
    for (const auto& polygon : mesh.polygons) {
        for (std::size_t i = 2; i < polygon.size(); ++i) {
            result.polygons.push_back({polygon[0], polygon[i - 1], polygon[i]});
        }
    }
    return result;
}

template <class T>
void append_bytes(std::string& bytes, T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    bytes.append(raw, sizeof(T));
}

/// Numbers as this machine lays them out, which is the smallest byte first.
inline std::string binary_ply(const TestMesh& mesh) {
    std::string bytes = fmt::format(
        "ply\nformat binary_little_endian 1.0\ncomment written for a test\nelement vertex {}\nproperty float x\n"
        "property float y\nproperty float z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
        mesh.points.size(), mesh.polygons.size());
    for (const glm::dvec3& point : mesh.points) {
        for (int axis = 0; axis < 3; ++axis) append_bytes(bytes, static_cast<float>(point[axis]));
    }
    for (const auto& polygon : mesh.polygons) {
        append_bytes(bytes, static_cast<std::uint8_t>(polygon.size()));
        for (const std::uint32_t corner : polygon) append_bytes(bytes, static_cast<std::int32_t>(corner));
    }
    return bytes;
}

inline std::string text_stl(const TestMesh& mesh) {
    std::string text = "solid test\n";
    for (const auto& polygon : triangulated(mesh).polygons) {
        text += " facet normal 0 0 0\n  outer loop\n";
        for (const std::uint32_t corner : polygon) {
            const glm::dvec3& point = mesh.points[corner];
            text += fmt::format("   vertex {} {} {}\n", point.x, point.y, point.z);
        }
        text += "  endloop\n endfacet\n";
    }
    return text + "endsolid\n";
}

inline std::string text_obj(const TestMesh& mesh) {
    std::string text;
    for (const glm::dvec3& point : mesh.points) text += fmt::format("v {} {} {}\n", point.x, point.y, point.z);
    for (const auto& polygon : mesh.polygons) {
        text += "f";
        for (const std::uint32_t corner : polygon) text += fmt::format(" {}", corner + 1);
        text += "\n";
    }
    return text;
}
