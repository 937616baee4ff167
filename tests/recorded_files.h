// What a run recorded, but for what tells of the machine.
#pragma once

#include "temporary_folder.h"

#include <map>
#include <string>

/// The files of a run by their names in its folder; without run.json and timings.csv.
inline std::map<std::string, std::string> recorded_files(const std::filesystem::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& item : std::filesystem::recursive_directory_iterator(folder)) {
        const std::string name = item.path().lexically_relative(folder).string();
        if (item.is_regular_file() && name != "run.json" && name != "timings.csv") files[name] = text_of(item.path());
    }
    return files;
}
