// Plants that were measured: axes as polylines, as instruments and other programs write them.
#pragma once

#include "espalier/base/error.h"
#include "espalier/base/stations.h"
#include "espalier/language/reader.h"

#include <glm/mat4x3.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace espalier::language {

/// What a user says of a file. What is left out is as the file says, or else a guess that a warning names.
struct MeasuredOptions {
    std::string unit = {};              ///< of its lengths: "m", "dm", "cm", "mm", "um" or "inch"
    std::string up = {};                ///< which of its axes points upwards: "x", "y", "z", "-x", "-y" or "-z"
    std::optional<double> pixel = {};   ///< width of a pixel, m; lengths are pixels
    std::optional<bool> separate = {};  ///< each plant of the file is one of its own

    bool operator==(const MeasuredOptions&) const = default;
};

struct MeasuredNode {
    glm::dvec3 at{0};     ///< m, y upwards
    double diameter = 0;  ///< m
    double day = 0;       ///< of its birth
    bool linked = false;  ///< nothing grew between the node before and this one
};

/// What organs of a kind look like, in coordinates of their own.
struct MeasuredMesh {
    std::vector<glm::dvec3> points;
    std::vector<std::vector<std::uint32_t>> faces;  ///< corners, as numbers of points
    double lowest = 0, highest = 0;                 ///< x of the points
};

/// A leaf, flower or fruit, on a node of an axis.
struct MeasuredOrgan {
    std::size_t mesh = 0;
    std::size_t on_node = 0;
    glm::dmat4x3 place{1};        ///< of the mesh; m, y upwards
    double below = 1, above = 1;  ///< factors of its y and z where x is lowest and highest
};

/// An axis begins at its first node. Where that is not the node of its bearer, the piece between is a link: nobody's
/// wood, without surface and length.
struct MeasuredAxis {
    std::string label;
    std::size_t plant = 0;
    std::optional<std::size_t> bearer = {};  ///< an axis before it, of the same plant
    std::size_t on_node = 0;                 ///< of the bearer
    int order = 0;                           ///< of an axis without bearer: 0
    std::vector<MeasuredNode> nodes;         ///< one or more
    std::vector<MeasuredOrgan> organs = {};  ///< in the order of their nodes
    Place place;
};

struct MeasuredPlant {
    std::string label;
    glm::dvec3 base{0};  ///< where its first axis begins
};

struct MeasuredPlants {
    std::filesystem::path path;
    std::vector<MeasuredPlant> plants;
    std::vector<MeasuredAxis> axes;         ///< each after its bearer, those of a plant one after the other
    std::vector<MeasuredMesh> meshes = {};  ///< of organs
    std::string unit, up;                   ///< as it was read: "cm, 300 pixels per inch"
    bool has_times = false;
    bool separate = true;
    std::vector<Diagnostic> warnings;  ///< what was guessed, and what the file says and is not used
};

/// What a user compares with the program that wrote the file. Lengths in metres.
struct MeasuredSummary {
    std::size_t plants = 0, axes = 0, nodes = 0, organs = 0;
    std::vector<std::size_t> axes_of_order;
    double length = 0;                           ///< without links
    double surface = 0, volume = 0;              ///< of cylinders, each as thick as its upper node, as scans fit them
    double drawn_surface = 0, drawn_volume = 0;  ///< of the truncated cones that a turtle draws of them
    double link_length = 0;
    double organ_area = 0;                                           ///< of all faces of organs, one side
    std::array<glm::dvec3, 2> extent{glm::dvec3(0), glm::dvec3(0)};  ///< lowest and highest coordinates
};

/// Whether a file's notation holds measured plants.
bool holds_measured_plants(const std::filesystem::path& path);
/// Throws UserError with the place of a mistake.
MeasuredPlants read_measured_plants(const std::filesystem::path& path, const MeasuredOptions& options = {});
MeasuredSummary summary_of(const MeasuredPlants& plants);
/// Where the points of an organ are, m.
std::vector<glm::dvec3> points_of(const MeasuredMesh& mesh, const MeasuredOrgan& organ);

/// The model of one plant, which begins where the turtle stands, or of all, at their places.
std::shared_ptr<const Model> measured_model(const MeasuredPlants& plants, std::optional<std::size_t> plant,
                                            const ReadOptions& options = {});
/// The same as text, of all plants.
std::string measured_model_text(const MeasuredPlants& plants);

}  // namespace espalier::language
