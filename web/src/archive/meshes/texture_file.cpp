#include "archive/meshes/texture_file.h"

#include "espalier/base/file.h"

namespace espalier::archive {

// Scenes of a page name their files by whole paths.
std::filesystem::path texture_path(const std::filesystem::path& run, const std::string& file) {
    for (const std::filesystem::path& path : {run / file, std::filesystem::path(file)}) {
        if (is_readable(path)) return path;
    }
    return {};
}

}  // namespace espalier::archive
