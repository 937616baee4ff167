// The side files of a plant, each read once: its view and its colours.
#pragma once

#include "espalier/simulation/scene.h"

#include <filesystem>
#include <map>
#include <memory>

namespace espalier::simulation {

class SideFiles {
public:
    explicit SideFiles(SceneNotes& notes) : notes_(notes) {}

    /// `folder` is where files are looked for that are not beside the view.
    std::shared_ptr<const View> view(const std::filesystem::path& path, const Defines& defines,
                                     const std::filesystem::path& folder);
    /// The colours of a plant's table: `colour_map` and `materials`. Null if it has neither.
    std::shared_ptr<const Palette> palette(const Settings& table);

private:
    using Sets = std::map<int, std::filesystem::path>;

    SceneNotes& notes_;
    std::map<std::pair<std::filesystem::path, Defines>, std::shared_ptr<const View>> views_;
    std::map<std::pair<Sets, Sets>, std::shared_ptr<const Palette>> palettes_;
};

}  // namespace espalier::simulation
