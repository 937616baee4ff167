#include "looking_half.h"

#include "espalier/base/error.h"

#include "base/platform.h"
#include "module_file.h"

#include <algorithm>
#include <array>
#include <string>

namespace espalier::app {

bool open_looking_half() {
    static const bool opened = [] {
        const std::filesystem::path file = module_file("libespalier_look_commands.so");
        if (file.empty()) return false;
        std::string why;
        if (!platform::open_library(file, /*shared=*/true, why)) throw RunError("cannot open " + why);
        return true;
    }();
    return opened;
}

bool is_of_looking_half(std::string_view command) {
    static constexpr std::array<std::string_view, 17> names{
        "sweep", "tree", "render",       "landscape", "plot", "view",    "analyse",  "info",  "export",
        "share", "scan", "leaf-texture", "lesson",    "fit",  "dataset", "fit-leaf", "studio"};
    return std::find(names.begin(), names.end(), command) != names.end();
}

}  // namespace espalier::app
