#include "mesh_file_options.h"

#include "espalier/base/error.h"

namespace espalier::app {

MeshFileOptions::MeshFileOptions(CLI::App& command, int sides, const std::string& group) : sides_(sides) {
    const std::string before = command.option_defaults()->get_group();
    command.option_defaults()->group(group);
    sides_option_ =
        command
            .add_option("--sides", sides_,
                        "number of corners of the rings of tubes; spheres and discs have the sides that were drawn")
            ->check(CLI::Range(3, 256))
            ->capture_default_str();
    command
        .add_option("--simplify", simplify_,
                    "leave out nodes of axes if middle line and radius change by at most so many metres")
        ->check(CLI::Range(0.0, 1e6))
        ->capture_default_str();
    command
        .add_option("--triangles", triangles_,
                    "obj, ply, stl, gltf, usd: make coarser what is seen least, until so many are left")
        ->check(CLI::Range(std::size_t{1}, std::size_t{1} << 31));
    command
        .add_option("--distance", distance_,
                    "obj, ply, stl, gltf, usd: as seen from so many metres; what is smaller than a thousandth of it "
                    "becomes a line, goes or is merged")
        ->check(CLI::Range(0.0, 1e9));
    command
        .add_option("--split", most_vertices_,
                    "obj, gltf: several meshes, ply, stl: several files, of at most so many vertices each; 65535 "
                    "for indices of 16 bits")
        ->check(CLI::Range(std::size_t{3}, std::size_t{1} << 31));
    command.add_option("--up", up_, "the vertical axis: y or z")
        ->check(CLI::IsMember({"y", "z"}))
        ->capture_default_str();
    command.add_flag("--instances", instances_, "gltf of one frame, usd: organs that look alike are one shape");
    command.add_flag(
        "--mesh-axes", mesh_axes_,
        "usd: axes as meshes, with --sides and textures, and not as curves; --bark and --skin smooth imply it");
    command.add_flag("--counts", counts_, "file names end in the numbers of vertices and triangles");
    axes_.emplace(command);
    command.option_defaults()->group(before);
}

void MeshFileOptions::put_into(ExportJob& job) const {
    job.options.sides = sides_;
    job.options.simplify = simplify_;
    job.options.triangles = triangles_;
    job.options.distance = distance_;
    job.options.up = up_[0];
    job.most_vertices = most_vertices_;
    job.instances = instances_;
    job.bark = axes_->bark();
    job.options.skin = axes_->skin(job.run.folder());
    if (job.options.skin.smooth && triangles_) {
        throw UserError("--triangles makes tubes coarser; with --skin smooth a larger --voxel gives fewer triangles");
    }
    job.mesh_axes = mesh_axes_ || job.options.skin.smooth || !job.bark.empty();
    job.counts = counts_;
}

}  // namespace espalier::app
