// A growth as one page that grows it again: the studio with its session as WebAssembly, and the files of the growth.
#pragma once

#include "espalier/base/read_log.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace espalier::studio {

struct LiveGrowth {
    std::map<std::filesystem::path, std::string> files;  ///< bytes by absolute paths
    std::filesystem::path opened;                        ///< a model or a scene, one of them
    std::optional<std::uint64_t> seed;
    std::optional<int> steps;
    std::string title;
    std::string lesson = {};  ///< JSON that the page shows beside the plant; empty: it is the studio alone
};

/// The bytes of what a growth has read. Throws UserError for a file that was too large to be kept.
std::map<std::filesystem::path, std::string> kept_bytes(const std::map<std::filesystem::path, ReadLog::File>& files);

/// HTML that loads nothing. The page has the files by their places within the folder that they have in common. Throws
/// UserError if that is the root of the file system.
std::string live_page(const LiveGrowth& growth);

}  // namespace espalier::studio
