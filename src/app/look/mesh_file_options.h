// Options of the commands that write meshes.
#pragma once

#include "espalier/formats/exporter.h"

#include "axis_surface_options.h"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

namespace espalier::app {

class MeshFileOptions {
public:
    /// `sides` is the default of --sides, `group` the heading of all these options in the command's help.
    MeshFileOptions(CLI::App& command, int sides, const std::string& group = "Options");

    /// What was said of the meshes; files are none's yet. Throws UserError for what does not go together.
    void put_into(ExportJob& job) const;
    bool says_sides() const { return sides_option_->count() > 0; }

private:
    int sides_;
    CLI::Option* sides_option_;
    double simplify_ = 0, distance_ = 0;
    std::optional<std::size_t> triangles_;
    std::size_t most_vertices_ = 0;
    std::string up_ = "y";
    bool instances_ = false, mesh_axes_ = false, counts_ = false;
    std::optional<AxisSurfaceOptions> axes_;
};

}  // namespace espalier::app
