#include "part_kinds.h"

#include "espalier/environment/environment_process.h"
#include "espalier/environment/shape.h"
#include "espalier/formats/exporter.h"
#include "espalier/language/notation.h"
#include "espalier/simulation/scene.h"
#include "espalier/timeline/recorder.h"
#include "espalier/turtle/geometry_stage.h"
#include "espalier/turtle/symbol.h"

#include "geometry/grid_operations.h"
#include "looking_half.h"

#include <algorithm>

namespace espalier::app {
namespace {

namespace fs = std::filesystem;
using Parts = std::vector<PartDescription>;

template <class Kind>
Parts parts_of() {
    Parts parts;
    for (const auto& [name, part] : registered<Kind>()) parts.push_back({name, part->summary, part->help});
    return parts;
}

Parts symbol_parts() {
    Parts parts;
    for (const auto& [name, symbol] : registered<Symbol>()) parts.push_back({name, symbol->help, ""});
    return parts;
}

Parts scene_parts() {
    Parts parts;
    for (const fs::path& file : scenes_below("environments")) parts.push_back(describe_file(file));
    return parts;
}

}  // namespace

const std::vector<PartKind>& part_kinds() {
    static const std::vector<PartKind> all{
        {"processes", "the environment of the plants: [environment.<name>] process = \"...\"",
         [] {
             open_grid_library();
             return parts_of<ProcessType>();
         }},
        {"symbols", "the symbols of the turtle and what they do", symbol_parts},
        {"recorders", "the files of a run: [timeline]", parts_of<RecorderType>},
        {"notations", "other ways to write a model, which run, derive and scenes take", parts_of<NotationType>},
        {"stages", "what changes a plant's geometry before it is recorded: [[plant.stage]] stage = \"...\"",
         parts_of<GeometryStageType>},
        {"exporters", "formats of `espalier export`",
         [] {
             open_looking_half();
             return parts_of<ExporterType>();
         }},
        {"models", "the library of models, folder by folder", nullptr},
        {"scenes", "the scenes in ./environments", scene_parts},
        {"scene", "the keys of a scene file",
         [] {
             return Parts{{"scene", "the tables of a scene file", scene_help()}};
         }},
        {"shapes", "the solids of the process `shape`",
         [] {
             return Parts{{"shapes", "how to describe a solid", shape_help()}};
         }},
    };
    return all;
}

const PartKind* find_part_kind(const std::string& name) {
    for (const PartKind& kind : part_kinds()) {
        if (kind.name == name) return &kind;
    }
    return nullptr;
}

std::vector<fs::path> scenes_below(const fs::path& folder) {
    std::vector<fs::path> files;
    if (!fs::is_directory(folder)) return files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file() && describes_scene(entry.path())) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace espalier::app
