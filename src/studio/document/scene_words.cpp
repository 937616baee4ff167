#include "studio/document/scene_words.h"

#include "espalier/base/registry.h"
#include "espalier/environment/environment_process.h"
#include "espalier/simulation/scene.h"
#include "espalier/turtle/geometry_stage.h"

#include "base/part_help.h"

#include <fmt/format.h>

#include <map>

namespace espalier::studio {
namespace {

template <class Part>
std::string help_of(const std::string& name) {
    const auto known = registered<Part>().find(name);
    return known == registered<Part>().end() ? "" : known->second->help;
}

// From the line behind "[simulation]" or "[[plant]]" to the next such table.
std::string help_of_scene_table(const std::string& name) {
    const std::string help = scene_help(), heading = fmt::format("[{}]", name);
    const std::size_t begin = help.find(heading);
    if (begin == std::string::npos) return "";
    const std::size_t first = help.find('\n', begin);
    return help.substr(first, help.find("\n[", first) - first);
}

// Whether a row, which may tell of several keys, tells of this one.
bool is_row_of(const HelpRow& row, const std::string& key) {
    return fmt::format(", {}, ", row.name).find(fmt::format(", {}, ", key)) != std::string::npos;
}

// Describes keys of tables within a row, which have no rows of their own.
std::string words_of_inner_key(const std::string& key) {
    static const std::map<std::string, std::string> words{
        {"angle", "angle by which a shape is turned, degrees"},
        {"attraction", "strength of a source that tips grow to"},
        {"base_radius", "radius of a shape at its base, metres"},
        {"begin", "value at the beginning"},
        {"below", "share of the height that is cut off below"},
        {"blend", "shapes that are closer than this merge, metres"},
        {"colour", "number of a colour of the turtle"},
        {"columns", "plants along x"},
        {"crowd", "weight of free space"},
        {"edge", "distance over which a region fades, metres"},
        {"elasticity", "bending of a segment by a tropism"},
        {"end", "value at the end"},
        {"inhibition", "strength of a source that tips avoid"},
        {"jitter", "random shift of each plant, metres"},
        {"light", "weight of light"},
        {"line_width", "diameter of segments whose width the model does not set, metres"},
        {"near", "weight of being near the surface"},
        {"perception", "angle about its heading in which a node sees points, degrees"},
        {"radius", "radius of a shape, metres"},
        {"rows", "plants along z"},
        {"spacing", "distance between plants, metres"},
        {"spline", "values run along a smooth curve"},
        {"steps", "number of steps in which the value changes"},
        {"straight", "weight of going straight on"},
        {"tip_radius", "radius of a shape at its tip, metres"},
        {"up", "weight of growing upwards"},
        {"value", "value in a region"},
    };
    const auto known = words.find(key);
    return known == words.end() ? "" : known->second;
}

}  // namespace

std::string help_of_table(const Settings& table, const std::string& name, const std::string& outer) {
    if (table.has("process")) return help_of<ProcessType>(table.text_or("process", ""));
    if (table.is_text("stage")) return help_of<GeometryStageType>(table.text_or("stage", ""));
    const std::string help = help_of_scene_table(name);
    return help.empty() ? outer : help;
}

KeyWords words_of_key(const std::string& help, const std::string& key) {
    for (const HelpRow& row : parameters_of(help)) {
        if (is_row_of(row, key) && !row.meaning.empty())
            return {row.meaning.substr(0, row.meaning.find(". ")), row.unit};
    }
    const std::string words = words_of_inner_key(key);
    return {words.empty() ? key : words, ""};
}

}  // namespace espalier::studio
