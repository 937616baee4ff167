// An exporter turns frames of a recorded run into another program's files. One file in src/formats/exporters/ per
// format.
#pragma once

#include "espalier/archive/mesh_options.h"
#include "espalier/archive/recorded_run.h"
#include "espalier/base/registry.h"
#include "espalier/base/stations.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>

namespace espalier::formats {

/// A file that was written. Counts are 0 where a format has no such thing.
struct ExportedFile {
    std::filesystem::path path;
    std::size_t vertices = 0, triangles = 0;
    std::size_t elements = 0;  ///< internodes, organs, roots, voxels: what `noun` says
    std::string noun;
    std::string hint{};  ///< what would be better, if anything
};

/// What a file's name says of its mesh.
struct MeshName {
    std::size_t vertices = 0, triangles = 0;
    std::size_t piece = 0;    ///< from 1; 0 where there is one only
    std::string companion{};  ///< the extension of a file of the same name, whose name must be free too
};

struct ExportJob {
    const RecordedRun& run;
    std::span<const RecordedFrame* const> frames;  ///< at least one
    MeshOptions options;
    std::filesystem::path folder;  ///< is made if need be
    std::function<void(const ExportedFile&)> report;
    std::string name{};  ///< name of the files; empty: the scene's, and the step of a frame that has a file of its own

    // Options that only some formats use.
    double steps_per_second = 24;  ///< speed of growth as an animation
    /// Growth: organs that are born and die together are one object. None: where there are many, as the format says.
    std::optional<bool> grouped{};
    bool instances = false;         ///< organs that look alike are one shape in many places
    bool mesh_axes = false;         ///< axes are meshes where the format has curves
    std::string bark{};             ///< the texture of axes that wear none: a file
    bool voxel_corners = false;     ///< a voxel stands where its lower corner is, not its centre: for Blender
    bool beside_meshes = false;     ///< fields are written with meshes that Blender turns upright
    std::size_t most_vertices = 0;  ///< most vertices of a mesh, which is otherwise cut into pieces; 0: any number

    // How files are named.
    bool counts = false;  ///< names say the numbers of vertices and triangles
    bool keep = false;    ///< a file that is there stays, and the new one has a number behind its name

    /// A frame's plants with their bark.
    FrameGeometry geometry(const RecordedFrame& frame) const;

    /// A file of the whole job, or of a frame.
    std::filesystem::path path(const std::string& extension, const MeshName& mesh = {}) const;
    std::filesystem::path path(const RecordedFrame& frame, const std::string& extension,
                               const MeshName& mesh = {}) const;
};

/// Files appear complete or not at all; equal runs give equal bytes.
class Exporter {
public:
    virtual ~Exporter() = default;
    /// Returns the extension of its files: "obj".
    virtual std::string extension() const = 0;
    /// Throws UserError for what the format cannot have, before anything is written.
    virtual void check(const ExportJob&) const {}
    virtual void write(const ExportJob& job) const = 0;
};

/// What a file of src/formats/exporters/ registers.
struct ExporterType {
    std::string name;     ///< name of the format
    std::string summary;  ///< one line about the format
    std::string help;     ///< what the files contain and what they lose
    std::function<std::unique_ptr<Exporter>()> make;
    bool of_fields = false;  ///< it takes fields, which lie in files only, instead of plants
};

/// The format whose files have this extension, ".glb"; empty if there is none.
std::string format_of_extension(const std::string& extension);

/// Writes the frames in every format. Throws UserError for a format that is none, RunError if a file cannot be written.
void export_run(const ExportJob& job, std::span<const std::string> formats);

}  // namespace espalier::formats
