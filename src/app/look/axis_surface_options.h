// Options of commands that draw or write axes: their bark and how they join.
#pragma once

#include "espalier/archive/mesh_options.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <string>

namespace espalier::app {

/// --bark, --skin, --blend, --voxel and --displace.
class AxisSurfaceOptions {
public:
    explicit AxisSurfaceOptions(CLI::App& command);

    /// Throws UserError if there is no such file, or its settings are wrong.
    std::string bark() const;
    /// `run`: the folder that textures may lie in. Throws UserError for --displace without a skin.
    archive::AxisSkin skin(const std::filesystem::path& run) const;

private:
    std::string bark_, skin_ = "tubes";
    double blend_ = 1.5, voxel_ = 0;
    bool displace_ = false;
};

}  // namespace espalier::app
