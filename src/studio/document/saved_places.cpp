#include "studio/document/saved_places.h"

#include "studio/document/sharing.h"

#include <algorithm>

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;

// Folders between `folder` and what lies below it.
std::ptrdiff_t depth(const fs::path& below, const fs::path& folder) {
    const fs::path relative = below.lexically_relative(folder);
    return relative == "." ? 0 : std::distance(relative.begin(), relative.end());
}

}  // namespace

std::map<fs::path, fs::path> saved_places(const fs::path& main, const std::map<fs::path, std::string>& files,
                                          const fs::path& path, const fs::path& folder) {
    const fs::path before = main.parent_path(), root = common_folder(main, files);
    fs::path home = path.parent_path();
    if (depth(home, folder) < depth(before, root)) home = home / path.stem() / before.lexically_relative(root);
    std::map<fs::path, fs::path> places;
    for (const auto& [file, text] : files) {
        fs::path place = (home / file.lexically_relative(before)).lexically_normal();
        if (file == main) place = home / path.filename();
        for (const char* extension : {".v", ".panel"}) {  // these go by the name of the model
            if (file == fs::path(main).replace_extension(extension)) place = home / path.stem().concat(extension);
        }
        if (place != file) places[file] = place;
    }
    return places;
}

}  // namespace espalier::studio
