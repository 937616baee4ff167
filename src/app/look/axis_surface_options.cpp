#include "axis_surface_options.h"

#include "espalier/base/error.h"

#include "app/program_data.h"
#include "archive/meshes/bark.h"

#include <fmt/format.h>

namespace espalier::app {

AxisSurfaceOptions::AxisSurfaceOptions(CLI::App& command) {
    command.add_option("--bark", bark_,
                       "texture and relief of axes that wear no texture: a .bark file, such as models/trees/oak.bark");
    command
        .add_option("--skin", skin_,
                    "tubes: axes run into each other; smooth: one surface, with saddles in forks and a flare at roots")
        ->check(CLI::IsMember({"tubes", "smooth"}))
        ->capture_default_str();
    command
        .add_option("--blend", blend_, "smooth: radius of the fillets between two axes, in radii of the thinner one")
        ->check(CLI::Range(0.0, 10.0))
        ->capture_default_str();
    command
        .add_option("--voxel", voxel_,
                    "smooth: metres between vertices; default: fine enough for the thinnest axis, or for 300,000 "
                    "triangles")
        ->check(CLI::Range(1e-9, 1e9));
    command.add_flag("--displace", displace_,
                     "smooth: the relief of bark moves the vertices, so that it shows in the outline");
}

std::string AxisSurfaceOptions::bark() const {
    if (bark_.empty()) return "";
    const std::filesystem::path file = here_or_with_program(bark_);
    if (!is_bark(file.string())) {
        throw UserError(fmt::format("--bark {}: expected a file whose name ends in .bark", bark_));
    }
    read_bark(file);
    return file.string();
}

archive::AxisSkin AxisSurfaceOptions::skin(const std::filesystem::path& run) const {
    const bool is_smooth = skin_ == "smooth";
    if (displace_ && !is_smooth) throw UserError("--displace moves the vertices of a skin: add --skin smooth");
    return {is_smooth, blend_, voxel_, displace_, run};
}

}  // namespace espalier::app
