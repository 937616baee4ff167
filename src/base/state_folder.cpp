#include "base/state_folder.h"

#include <cstdlib>

namespace espalier {

std::filesystem::path state_folder() {
    const char* const state = std::getenv("XDG_STATE_HOME");
    const char* const home = std::getenv("HOME");
    if (state && *state) return std::filesystem::path(state) / "espalier";
    if (home && *home) return std::filesystem::path(home) / ".local/state" / "espalier";
    return {};
}

}  // namespace espalier
