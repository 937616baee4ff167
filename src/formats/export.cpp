#include "espalier/base/error.h"
#include "espalier/formats/exporter.h"

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

}  // namespace

std::filesystem::path ExportJob::path(const std::string& extension) const {
    return folder / fmt::format("{}.{}", name.empty() ? file_name(run) : name, extension);
}

std::filesystem::path ExportJob::path(const RecordedFrame& frame, const std::string& extension) const {
    if (!name.empty() && frames.size() == 1) return path(extension);
    return folder / fmt::format("{}-{:04}.{}", name.empty() ? file_name(run) : name, frame.step, extension);
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
    for (const std::string& format : formats) {
        const auto type = registered<ExporterType>().find(format);
        if (type == registered<ExporterType>().end()) {
            throw UserError(fmt::format("'{}' is none of the formats {}{}", format, fmt::join(known, ", "),
                                        did_you_mean(format, known)));
        }
        exporters.push_back(type->second->make());
    }
    if (!job.folder.empty()) make_folder(job.folder);
    for (const auto& exporter : exporters) exporter->write(job);
}

}  // namespace espalier::formats
