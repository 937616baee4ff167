// View files (.v): what a model's author says about drawing it, and the side files that names.
#pragma once

#include "espalier/base/error.h"
#include "espalier/base/stations.h"
#include "espalier/language/reader.h"
#include "espalier/turtle/background.h"
#include "espalier/turtle/turtle.h"

#include <glm/vec3.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::turtle {

/// A light as the view file gives it: at a point, or from a direction.
struct Light {
    bool directional = false;
    glm::dvec3 vector{0, 0, 1};  ///< where it is, or where it comes from
    glm::dvec3 ambient{1, 1, 1}, diffuse{1, 1, 1}, specular{1, 1, 1};
    glm::dvec3 spot_direction{0, 0, -1};
    double spot_exponent = 0, spot_cutoff = 180;
    glm::dvec3 attenuation{1, 0, 0};  ///< constant, linear, quadratic
};

/// How its author looked at the plant. Nothing here changes what grows.
struct Camera {
    glm::dvec3 eye{0, 0, 1}, target{0, 0, 0};
    double twist = 0;  ///< degrees
    bool perspective = false;
    double angle = 45;  ///< degrees, perspective only
    double front = -100000, back = 100000;
    double scale = 1;
    std::optional<Box> box;
};

struct View {
    TurtleSettings turtle;
    std::shared_ptr<const Resources> resources;  ///< functions, curves, view volume: for ReadOptions::resources
    Defines function_names;                      ///< names of a function set: for ReadOptions::predefined
    /// True if queries are answered once before the first step and then after each ("environment display: before").
    bool exchanges_first = false;
    Camera camera;
    std::vector<Light> lights;
    std::optional<glm::dvec3> light_direction;    ///< to the light, of views without lights
    std::optional<glm::dvec3> background_colour;  ///< red, green, blue in [0, 1]
    std::string render_mode = "filled";
    std::vector<std::filesystem::path> backgrounds;
    std::shared_ptr<const Background> background;  ///< what those files show; null if there are none
    /// What did not keep the rest from being read: errors are what a run passes over and `check` refuses.
    std::vector<Diagnostic> diagnostics;
    std::vector<std::string> unused;           ///< settings that were read and have no meaning without a window
    std::vector<std::filesystem::path> files;  ///< side files that were read, in the order of reading
};

/// Reads a view file and every file it names, each looked for beside the file that names it, then in `folder`.
/// Throws UserError for files that are missing or cannot be understood.
View read_view_file(const std::filesystem::path& path, const Defines& defines = {},
                    const std::filesystem::path& folder = {});
/// The same from text; `name` is the file's: it stands in messages, and beside it files are looked for.
View read_view_text(std::string_view text, const std::string& name, const Defines& defines = {},
                    const std::filesystem::path& folder = {});

}  // namespace espalier::turtle
