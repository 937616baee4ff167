#include "studio/growth/export_job.h"

#include "espalier/formats/exporter.h"
#include "espalier/simulation/simulation.h"
#include "espalier/timeline/last_frame.h"

#include "base/reason.h"
#include "simulation/run/allowed_memory.h"
#include "studio/document/document_files.h"
#include "studio/packets/textures.h"

#include <exception>
#include <set>
#include <utility>

namespace espalier::studio {

namespace fs = std::filesystem;

namespace {

// Materials and textures, which the files that are reported name.
void add_companions(const fs::path& folder, std::vector<fs::path>& files) {
    std::set<fs::path> others;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file()) others.insert(entry.path());
    }
    for (const fs::path& file : files) others.erase(file);
    files.insert(files.end(), others.begin(), others.end());
}

}  // namespace

fs::path export_folder(const fs::path& scratch) {
    return scratch / "export";
}

ExportRun::ExportRun(ExportOrder order, Workers& workers, Progressed progressed, Done done)
    : order_(std::move(order)),
      progressed_(std::move(progressed)),
      done_(std::move(done)),
      running_(workers.run([this] { work(); })) {}

ExportRun::~ExportRun() {
    stop_.ask();
    running_.wait();
}

void ExportRun::work() {
    const StopRequest::Scope scope(&stop_);
    try {
        std::vector<fs::path> files = write();
        if (!stop_.is_asked()) done_(std::move(files), "");
    } catch (const Stopped&) {
    } catch (const std::exception& error) {
        if (!stop_.is_asked()) done_({}, reason_of(error));
    }
}

// The frames of a film, and fields, lie in files; else the last frame is in memory.
bool ExportRun::needs_folder() const {
    const auto format = registered<ExporterType>().find(order_.format);
    return order_.is_film || (format != registered<ExporterType>().end() && format->second->of_fields);
}

RecordedRun ExportRun::grow() {
    const ReadLog reads(std::size_t(16) << 20, order_.unsaved, order_.permission);
    Opened opened = order_.opened;
    if (order_.step >= 0) opened.steps = order_.step;
    const Scene scene = order_.read(opened);
    note_texture_files(scene);

    LastFrame last(scene.timeline);
    RunOptions options;
    if (needs_folder()) {
        options.output = order_.scratch / "run";
    } else {
        options.recorder = &last;
    }
    options.overwrite = true;
    options.memory = allowed_memory(order_.memory, order_.opened.path);
    options.inputs = &reads;
    options.progress = [this](const Progress& progress) {
        if (progress.steps > 0) progressed_(double(progress.step) / progress.steps);
    };
    const RunResult result = run(scene, options);
    if (!options.output.empty()) return RecordedRun(options.output);
    return RecordedRun(result.record, {{last.step(), last.time(), {}, {}, last.geometry()}});
}

std::vector<fs::path> ExportRun::write() {
    const RecordedRun recorded = is_run(order_.opened.path) ? RecordedRun(order_.opened.path) : grow();
    if (stop_.is_asked()) return {};
    std::vector<const RecordedFrame*> frames;
    for (const RecordedFrame& frame : recorded.frames()) {
        if (order_.step < 0 || frame.step <= order_.step) frames.push_back(&frame);
    }
    if (!order_.is_film && !frames.empty()) frames.erase(frames.begin(), frames.end() - 1);
    std::vector<fs::path> files;
    const auto report = [&](const ExportedFile& file) {
        end_if_asked();
        files.push_back(file.path);
    };
    ExportJob job{recorded, frames, {}, export_folder(order_.scratch), report};
    job.options.triangles = order_.triangles;
    job.options.skin.smooth = job.mesh_axes = order_.is_smooth;
    job.options.skin.folder = recorded.folder();
    job.instances = order_.has_instances;
    export_run(job, std::vector{order_.format});
    add_companions(job.folder, files);
    return files;
}

}  // namespace espalier::studio
