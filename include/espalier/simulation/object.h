// Objects: a model with the files that stand beside it, as a command line or a folder names them.
#pragma once

#include "espalier/base/stations.h"
#include "espalier/simulation/scene.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace espalier::simulation {

/// One model and its side files; all but the model may be missing. Paths can be opened from the current directory.
struct ObjectFiles {
    std::string name;  ///< name of the scene it makes; default: the model's
    std::filesystem::path model, view, animation, environment;
    std::map<int, std::filesystem::path> colour_maps, materials;  ///< by set; 1 is the turtle's
    /// The colour map of a model that chooses colours by index, ;(3), where neither map nor materials are given.
    std::filesystem::path colours_of_library;
    std::filesystem::path folder;  ///< where files are looked for that are not beside the one that names them
    Defines defines;
    std::vector<std::string> insertions;  ///< --insert: "X(1)@5:F.3"
    Arithmetic arithmetic = Arithmetic::double_precision;
    bool warns_of_unanswered = true;  ///< warns if no process answers ?E
    bool keeps_unanswered = true;     ///< queries without a process keep their parameters
    std::vector<std::string> listed;  ///< what the folder's own list says belongs to it
    std::vector<Diagnostic> diagnostics;
};

/// Reads a folder as the virtual laboratory keeps them: the first command `cpfg ...` of its file `specifications` says
/// which files to take and how. Without that file, extensions decide. Its arithmetic is cpfg's, except for models in
/// other notations. Throws UserError for files that are missing or lead out of the folder, for a choice that is not
/// clear, and for objects of lpfg.
ObjectFiles read_object_folder(const std::filesystem::path& folder);

/// The scene of an object: one plant at the origin and its environment.
Scene scene_of_object(const ObjectFiles& object, const SceneOptions& options = {});

/// Which of the listed files no file of the object names.
std::vector<std::string> unused_files(const ObjectFiles& object);

}  // namespace espalier::simulation
