// Animation files (.a): which steps their author wanted to see.
#pragma once

#include "espalier/base/error.h"
#include "espalier/timeline/frame_selection.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace espalier::simulation {

struct Animation {
    FrameSelection frames{1, 1, {}};
    std::optional<int> last;  ///< may be more than the derivation length; none: the derivation length
    /// Lines that could not be understood and are ignored.
    std::vector<Diagnostic> diagnostics;
    std::vector<std::string> unused;  ///< what was read and has no meaning without a window
};

/// Throws UserError if the file cannot be read. `text` is its content, `name` stands in messages.
Animation read_animation_file(const std::filesystem::path& path);
Animation read_animation_text(const std::string& text, const std::string& name);

}  // namespace espalier::simulation
