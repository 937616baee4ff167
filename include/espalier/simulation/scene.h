// A scene: an experiment, described by a program or by a TOML file. Plants, processes, timeline.
#pragma once

#include "espalier/base/map_origin.h"
#include "espalier/base/settings.h"
#include "espalier/base/stations.h"
#include "espalier/environment/environment.h"
#include "espalier/geometry/palette.h"
#include "espalier/language/reader.h"
#include "espalier/timeline/frame_selection.h"
#include "espalier/turtle/geometry_stage.h"
#include "espalier/turtle/view_file.h"

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace espalier::simulation {

/// Modules that are put into the string of a step, as a mouse did in a window: they are there when the step is
/// interpreted, and the next derivation sees them.
struct Insertion {
    std::string modules = {};  ///< as strings are printed: "X(1)[Y]"
    int step = 0;
    std::string before = {};  ///< the symbol they stand before; empty: they begin the string
    int number = 1;           ///< which of these
    Place place = {};         ///< where a file asks for it; not known otherwise
};

class DrawingInTime;
class EnvironmentInTime;
class ModelInTime;

/// One plant of a scene: a model growing at a place with a seed. The world makes a GrowingPlant of it.
struct Plant {
    std::string name = {};                            ///< default: the model's
    std::shared_ptr<const CompiledModel> model = {};  ///< plants with the same model and defines share it
    TurtleSettings turtle = {};                       ///< its pose is the plant's place and orientation
    std::optional<std::uint32_t> stream = {};     ///< which random numbers it draws; default: its number in the scene
    std::shared_ptr<const Palette> palette = {};  ///< what colour indices look like; null if unknown
    std::shared_ptr<const View> view = {};        ///< its view file; null if it has none
    std::vector<Insertion> insertions = {};       ///< in the order in which those of one step are made
    GeometryStages stages = {};                   ///< what is drawn goes through them before it is recorded
    /// The plant grows anew in every step, from the model of that time; null: it grows from step to step.
    std::shared_ptr<const ModelInTime> in_time = {};
    /// Settings of the turtle and stages of each time; null: those above hold for all times.
    std::shared_ptr<const DrawingInTime> drawing_in_time = {};
};

/// The model of a file, or of a text in the same language, ready to grow. Throws UserError with every mistake found.
Plant plant_of_file(const std::filesystem::path& model, const Defines& defines = {});
Plant plant_of_text(std::string_view model, const std::string& name = "plant", const Defines& defines = {});

/// What answers the plants' queries: processes by name, in the order in which they advance.
struct SceneEnvironment {
    /// `process`: what it is, one of `espalier list processes` or registered by this program.
    void add(const std::string& name, const std::string& process, const Settings& parameters = {});

    std::vector<std::pair<std::string, Settings>> processes;  ///< [environment.<name>] in the file's order
    std::string default_process;                              ///< answers ?E; "": the only one
    bool routed = false;                                      ///< the first parameter of ?E counts the processes from 0
    bool keeps_unanswered = false;                            ///< queries without a process keep their parameters
    /// What changes between steps; null: nothing does.
    std::shared_ptr<const EnvironmentInTime> in_time = {};
};

/// A value of a scene file that an expression gave.
struct ComputedValue {
    Place place;                        ///< place of its key
    std::string expression;             ///< without the '='
    std::vector<std::string> settings;  ///< settings of the model that it reads
};

/// What was noticed in the files of a scene and did not keep it from being read.
struct SceneNotes {
    std::vector<Diagnostic> diagnostics;       ///< errors are what `check` refuses and a run ignores
    std::vector<std::string> unused;           ///< "plant.v: twist, font": read, without meaning outside a window
    std::vector<std::filesystem::path> files;  ///< side files that were read, in the order of reading
};

/// Fill it in, or read it from a file. `World` grows it, `run` grows and records it.
struct Scene {
    /// Animations with a later last frame were made for a window that the user closes.
    static constexpr int most_frames_unasked = 10000;

    std::string name;
    std::vector<Plant> plants;
    SceneEnvironment environment;
    /// The derivation length of all plants, which a model may change; none: the longest of theirs.
    std::optional<int> steps;
    std::uint64_t seed = 0;
    double dt = 1;  ///< time one derivation step stands for
    std::string time_unit = "step";
    std::optional<Box> domain;  ///< metres; none: grows with the plants
    /// What is subtracted from places of files; a file may decide it while the world is made. Null: nothing is.
    std::shared_ptr<MapOrigin> origin;
    /// Blocks of ground along x and z, which ranks hold; none: as many as suit the number of plants.
    std::optional<std::array<int, 2>> blocks;
    Settings timeline;  ///< what `run` records; see `espalier list recorders`

    // An animation's. Without `steps` it leaves the plants' derivation lengths alone.
    std::optional<FrameSelection> frames;  ///< instead of the timeline's `first` and `every`
    std::optional<int> last_frame;         ///< where the run ends, whatever the derivation lengths are

    // Where the scene was read from.
    std::filesystem::path path;                                  ///< the file, empty if the scene was read from text
    std::string text;                                            ///< as it was read, before overrides
    std::vector<std::pair<std::string, std::string>> overrides;  ///< --set key=value, and --steps and --seed
    Settings root;                                               ///< the whole file, for `resolved_json`
    std::vector<ComputedValue> computed;                         ///< the expressions of the file
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

}  // namespace espalier::simulation
