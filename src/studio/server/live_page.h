// A growth as one page that grows it again: the studio with its session as WebAssembly, and the files of the growth.
#pragma once

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
    std::string title;
};

/// HTML that loads nothing. The page has the files by their places within the folder that they have in common. Throws
/// UserError if that is the root of the file system.
std::string live_page(const LiveGrowth& growth);

}  // namespace espalier::studio
