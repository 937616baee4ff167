#include "looking_half.h"

#include "espalier/base/error.h"

#include "base/platform.h"
#include "module_file.h"

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

}  // namespace espalier::app
