#include "studio/scene_words.h"

#include "espalier/base/registry.h"
#include "espalier/environment/environment_process.h"
#include "espalier/geometry/geometry_stage.h"
#include "espalier/simulation/scene.h"

#include <algorithm>
#include <sstream>

namespace espalier::studio {
namespace {

template <class Part>
std::string help_of(const std::string& name) {
    const auto known = registered<Part>().find(name);
    return known == registered<Part>().end() ? "" : known->second->help;
}

// From the line behind "[simulation]" or "[[plant]]" to the next such table.
std::string help_of_scene_table(const std::string& name) {
    const std::string help = scene_help(), heading = "[" + name + "]";
    const std::size_t begin = help.find(heading);
    if (begin == std::string::npos) return "";
    const std::size_t first = help.find('\n', begin);
    return help.substr(first, help.find("\n[", first) - first);
}

std::size_t indent_of(const std::string& line) {
    return line.find_first_not_of(' ');
}

// A row goes on in the lines that stand further in.
std::string row_of(const std::string& help, const std::string& key) {
    std::istringstream in(help);
    std::string row;
    std::size_t margin = 0;
    for (std::string line; std::getline(in, line);) {
        const std::size_t indent = std::min(indent_of(line), line.size());
        if (!row.empty() && (indent <= margin || indent == line.size())) break;
        if (!row.empty()) {
            row += " " + line.substr(indent);
        } else if (line.compare(indent, key.size() + 2, key + "  ") == 0) {
            margin = indent;
            row = line.substr(std::min(line.find_first_not_of(' ', indent + key.size()), line.size()));
        }
    }
    return row;
}

}  // namespace

std::string help_of_table(const Settings& table, const std::string& name, const std::string& outer) {
    if (table.has("process")) return help_of<ProcessType>(table.text_or("process", ""));
    if (table.has("stage")) return help_of<GeometryStageType>(table.text_or("stage", ""));
    const std::string help = help_of_scene_table(name);
    return help.empty() ? outer : help;
}

std::string words_of_key(const std::string& help, const std::string& key) {
    std::string words = key;
    std::replace(words.begin(), words.end(), '_', ' ');
    const std::string row = row_of(help, key);
    return row.empty() ? words : words + ": " + row.substr(0, row.find(". "));
}

}  // namespace espalier::studio
