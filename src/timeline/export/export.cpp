#include "espalier/base/error.h"
#include "espalier/base/text.h"
#include "espalier/timeline/exporter.h"

#include "timeline/folder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace espalier {
namespace {

std::string file_name(const RecordedRun& run) {
    std::string name = run.scene().empty() ? "run" : run.scene();
    std::replace(name.begin(), name.end(), '/', '-');
    return name;
}

}  // namespace

std::filesystem::path ExportJob::path(const std::string& extension) const {
    return folder / fmt::format("{}.{}", file_name(run), extension);
}

std::filesystem::path ExportJob::path(const RecordedFrame& frame, const std::string& extension) const {
    return folder / fmt::format("{}-{:04}.{}", file_name(run), frame.step, extension);
}

void export_run(const ExportJob& job, std::span<const std::string> formats) {
    std::vector<std::string> known;
    for (const auto& [name, entry] : ExporterRegistry::entries()) known.push_back(name);
    std::vector<std::unique_ptr<Exporter>> exporters;
    for (const std::string& format : formats) {
        const auto entry = ExporterRegistry::entries().find(format);
        if (entry == ExporterRegistry::entries().end()) {
            throw UserError(fmt::format("'{}' is none of the formats {}{}", format, fmt::join(known, ", "),
                                        did_you_mean(format, known)));
        }
        exporters.push_back(entry->second.make());
    }
    make_folder(job.folder);
    for (const auto& exporter : exporters) exporter->write(job);
}

}  // namespace espalier
