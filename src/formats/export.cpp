#include "espalier/base/error.h"
#include "espalier/formats/exporter.h"

#include "archive/meshes/axis_lines.h"
#include "base/folder.h"
#include "base/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace espalier::formats {
namespace {

std::string file_name(const RecordedRun& run) {
    std::string name = run.scene().empty() ? "run" : run.scene();
    std::replace(name.begin(), name.end(), '/', '-');
    return name;
}

/// The stem with what the job's names say of a mesh, and a number if they are taken.
std::filesystem::path file_of(const ExportJob& job, std::string stem, const std::string& extension,
                              const MeshName& mesh) {
    if (mesh.piece > 0) stem += fmt::format("-{}", mesh.piece);
    if (job.counts && mesh.triangles > 0) stem += fmt::format("-{}-{}", mesh.vertices, mesh.triangles);
    const auto is_taken = [&](const std::string& name) {
        return std::filesystem::exists(job.folder / fmt::format("{}.{}", name, extension)) ||
               (!mesh.companion.empty() &&
                std::filesystem::exists(job.folder / fmt::format("{}.{}", name, mesh.companion)));
    };
    std::string name = stem;
    for (int number = 2; job.keep && is_taken(name); ++number) name = fmt::format("{}-{}", stem, number);
    return job.folder / fmt::format("{}.{}", name, extension);
}

}  // namespace

FrameGeometry ExportJob::geometry(const RecordedFrame& frame) const {
    FrameGeometry geometry = run.geometry(frame);
    if (!bark.empty()) apply_bark(geometry, bark);
    return geometry;
}

std::filesystem::path ExportJob::path(const std::string& extension, const MeshName& mesh) const {
    return file_of(*this, name.empty() ? file_name(run) : name, extension, mesh);
}

std::filesystem::path ExportJob::path(const RecordedFrame& frame, const std::string& extension,
                                      const MeshName& mesh) const {
    if (!name.empty() && frames.size() == 1) return path(extension, mesh);
    return file_of(*this, fmt::format("{}-{:04}", name.empty() ? file_name(run) : name, frame.step), extension, mesh);
}

std::string format_of_extension(const std::string& extension) {
    for (const auto& [name, type] : registered<ExporterType>()) {
        if (extension == fmt::format(".{}", type->make()->extension())) return name;
    }
    return "";
}

void export_run(const ExportJob& job, std::span<const std::string> formats) {
    std::vector<std::string> known;
    for (const auto& type : registered<ExporterType>()) known.push_back(type.first);
    std::vector<std::unique_ptr<Exporter>> exporters;
    ExportJob all = job;
    for (const std::string& format : formats) {
        const auto type = registered<ExporterType>().find(format);
        if (type == registered<ExporterType>().end()) {
            throw UserError(fmt::format("'{}' is none of the formats {}{}", format, fmt::join(known, ", "),
                                        did_you_mean(format, known)));
        }
        exporters.push_back(type->second->make());
        all.beside_meshes |= format == "obj" || format == "gltf" || format == "usd";
    }
    for (const auto& exporter : exporters) exporter->check(all);
    if (!job.folder.empty()) make_folder(job.folder);
    for (const auto& exporter : exporters) exporter->write(all);
}

}  // namespace espalier::formats
