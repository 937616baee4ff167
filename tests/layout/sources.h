// The sources as the layout tests read them.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace layout {

namespace fs = std::filesystem;

/// The growing half, then what looks at its files, each in the order of its line.
inline const std::vector<std::string> growing{"base",   "geometry",    "lsystem",  "language",
                                              "turtle", "environment", "timeline", "simulation"};
inline const std::vector<std::string> looking{"base", "geometry", "archive", "analysis", "formats", "picture", "view"};

/// What grows and looks: these stand behind both lines.
inline const std::vector<std::string> both{"study", "studio", "python"};

inline bool is_in(const std::vector<std::string>& line, const std::string& station) {
    return std::find(line.begin(), line.end(), station) != line.end();
}

inline bool is_station(const std::string& name) {
    return is_in(growing, name) || is_in(looking, name) || is_in(both, name) || name == "app";
}

/// True if a file of `station` may include headers of `other`: those that stand before it in its line. The stations
/// analysis, formats and picture stand side by side.
inline bool may_include(const std::string& station, const std::string& other) {
    if (station == other || station == "app") return true;
    if (is_in(both, station)) {
        const auto at = std::find(both.begin(), both.end(), station);
        return other != "app" && std::find(at, both.end(), other) == both.end();
    }
    const std::vector<std::string>& line = is_in(growing, station) ? growing : looking;
    const auto at = std::find(line.begin(), line.end(), station);
    if ((station == "formats" || station == "picture") && (other == "analysis" || other == "formats")) return false;
    return std::find(line.begin(), at, other) != at;
}

inline const fs::path root = ESPALIER_SOURCE_DIR;

/// Headers and sources below `folder` (relative to the root), sorted.
inline std::vector<fs::path> sources_below(const fs::path& folder) {
    std::vector<fs::path> files;
    if (fs::is_directory(root / folder)) {
        for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
            const fs::path& path = entry.path();
            if (path.extension() == ".h" || path.extension() == ".cpp") files.push_back(fs::relative(path, root));
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

inline std::vector<std::string> lines_of(const fs::path& file) {
    std::ifstream in(root / file);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

/// What a file includes, without quotes or angle brackets, in order.
inline std::vector<std::string> includes_of(const fs::path& file) {
    std::vector<std::string> includes;
    for (const std::string& line : lines_of(file)) {
        if (!line.starts_with("#include")) continue;
        const std::size_t begin = line.find_first_of("<\"");
        const std::size_t end = line.find_last_of(">\"");
        if (begin != std::string::npos && end > begin) includes.push_back(line.substr(begin + 1, end - begin - 1));
    }
    return includes;
}

}  // namespace layout
