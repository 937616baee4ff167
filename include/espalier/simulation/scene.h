// A scene: an experiment as a TOML file describes it. Plants, processes, timeline.
#pragma once

#include "espalier/base/settings.h"
#include "espalier/environment/environment.h"
#include "espalier/geometry/palette.h"
#include "espalier/language/reader.h"
#include "espalier/timeline/frame_selection.h"
#include "espalier/turtle/view_file.h"

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace espalier {

/// One plant of the world: a model growing at a place with a seed.
struct PlantDescription {
    std::string name;
    std::shared_ptr<const CompiledModel> model;  ///< plants with the same model and defines share it
    TurtleSettings turtle;                       ///< its pose is the plant's place and orientation
    std::uint32_t stream = 0;                    ///< which random numbers it draws; default: its number in the scene
    std::shared_ptr<const Palette> palette;      ///< what colour indices look like; null if nobody says
    std::shared_ptr<const View> view;            ///< its view file; null if it has none
};

/// What was noticed in the files of a scene and did not keep it from being read.
struct SceneNotes {
    std::vector<Diagnostic> diagnostics;       ///< errors are what `check` refuses and a run passes over
    std::vector<std::string> unused;           ///< "plant.v: twist, font": read, without meaning outside a window
    std::vector<std::filesystem::path> files;  ///< side files that were read, in the order of reading
};

struct Scene {
    std::filesystem::path path;  ///< the file, empty if the scene was read from text
    std::string name;
    std::string text;                                            ///< as it was read, before overrides
    std::vector<std::pair<std::string, std::string>> overrides;  ///< --set key=value, and --steps and --seed
    int steps = 0;  ///< as planned; a model may change its derivation length
    /// Where the run ends whatever the derivation lengths are (an animation's last frame); none: at the longest of
    /// them.
    std::optional<int> last_frame;
    std::optional<FrameSelection> frames;  ///< an animation's, instead of the timeline's `first` and `every`
    bool sets_length = true;               ///< the plants' derivation length is `steps`
    std::uint64_t seed = 0;
    double dt = 1;  ///< time one derivation step stands for
    std::string time_unit = "step";
    std::optional<Box> domain;
    std::vector<PlantDescription> plants;
    std::vector<std::pair<std::string, Settings>> processes;  ///< [environment.<name>] in the file's order
    std::string default_process;                              ///< who answers ?E, "" = the only one
    bool routed = false;                                      ///< the first parameter of ?E counts the processes from 0
    bool keeps_unanswered = false;                            ///< queries nobody answers keep their parameters
    Settings timeline;
    Settings root;  ///< the whole file, for `resolved_json` and `reject_unread`
    SceneNotes notes;
};

struct SceneOptions {
    std::vector<std::pair<std::string, std::string>> overrides;  ///< --set key=value
    std::optional<int> steps;
    std::optional<std::uint64_t> seed;
};

/// Reads a scene and the models it names, but makes no process: World does. Throws UserError with every mistake it can
/// find at once.
Scene read_scene(const std::filesystem::path& path, const SceneOptions& options = {});
Scene read_scene_text(std::string_view text, const std::string& name, const std::filesystem::path& folder,
                      const SceneOptions& options = {});
/// The scene of a model alone: one plant at the origin, nothing around it.
Scene scene_of_model(const std::filesystem::path& model, const SceneOptions& options = {});

/// The documentation of scene files, for `espalier list scene`.
const char* scene_help();

}  // namespace espalier
