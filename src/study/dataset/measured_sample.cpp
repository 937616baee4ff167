#include "study/dataset/measured_sample.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"
#include "espalier/base/random.h"
#include "espalier/base/stop.h"
#include "espalier/simulation/simulation.h"
#include "espalier/timeline/last_frame.h"

#include "archive/frame_organs.h"
#include "study/fit/form.h"

#include <fmt/format.h>
#include <tbb/task_group.h>

#include <exception>
#include <numeric>

namespace espalier::study {
namespace {

std::size_t write_scan(const ScanPlan& plan, std::uint64_t seed, const RecordedRun& run,
                       const std::filesystem::path& folder) {
    const RecordedFrame& frame = run.frames().front();
    const FrameGeometry& geometry = *frame.geometry;
    const ScannedPlants plants(geometry, plan.sides, plan.ground);
    ScanOptions options = plan.options;
    options.seed = seed;
    const StopRequest* const stop = StopRequest::current();
    const std::vector<ScanPoint> points =
        scan(plants, plan.beams, options, [&](std::size_t) { return stop && stop->is_asked(); });
    if (stop && stop->is_asked()) throw Stopped();
    PointNames names{{}, geometry.symbol_names, frame.step};
    for (const RecordedPlant& plant : run.plants()) names.plants.push_back(plant.name);
    write_points(points, plants, names, plan.points, folder / ("points" + plan.extension));
    write_text(folder / "organs.csv",
               organ_table(archive::FrameOrgans(geometry), geometry.symbol_names, names.plants, frame.step));
    return points.size();
}

std::size_t write_pictures(const PicturePlan& plan, const RecordedRun& run, const std::filesystem::path& folder) {
    const StopRequest* const stop = StopRequest::current();
    RenderJob job{run, {&run.frames().front()}, plan.style, plan.camera, 0, plan.ground, false, plan.size, {}};
    job.azimuths = plan.azimuths;
    job.masks = plan.masks;
    job.trace_progress = [&](double) {
        if (stop && stop->is_asked()) throw Stopped();
    };
    render_pictures(job, folder / "view.png");
    return plan.azimuths.size();
}

}  // namespace

GrownSample grown_sample(const DatasetPlan& plan, const DatasetSample& sample) {
    Scene scene = plan.growth.scene(plan.named(sample.values));
    scene.seed = sample.seed;
    LastFrame last;
    RunOptions options;
    options.recorder = &last;
    GrownSample grown;
    try {
        const RunResult result = run(scene, options);
        if (result.interrupted) throw Stopped();
        const RecordedFrame frame{last.step(), last.time(), {}, {}, last.geometry()};
        grown.run.emplace(result.record, std::vector{frame});
    } catch (const RunError& error) {
        grown.failure = error.what();
        return grown;
    }
    Grown world;
    world.geometry = last.geometry();
    world.plants.resize(grown.run->plants().size());
    std::iota(world.plants.begin(), world.plants.end(), 0);
    grown.forms = forms_of(world);
    return grown;
}

MeasuredSample measure(const DatasetPlan& plan, const DatasetSample& sample, const GrownSample& grown,
                       const std::filesystem::path& folder) {
    MeasuredSample measured;
    std::exception_ptr not_scanned, not_drawn;
    const auto keep_thrown = [stop = StopRequest::current()](std::exception_ptr& thrown, const auto& work) {
        const StopRequest::Scope scope(stop);
        try {
            work();
        } catch (...) {
            thrown = std::current_exception();  // the other work is done to its end
        }
    };
    tbb::task_group together;  // one thread alone draws
    if (plan.scan) {
        together.run([&] {
            keep_thrown(not_scanned, [&] {
                measured.points = write_scan(*plan.scan, mix(plan.seed, sample.number), *grown.run, folder);
            });
        });
    }
    together.run_and_wait([&] {
        if (!plan.pictures) return;
        keep_thrown(not_drawn, [&] { measured.pictures = write_pictures(*plan.pictures, *grown.run, folder); });
    });
    for (const std::exception_ptr& thrown : {not_scanned, not_drawn}) {
        if (thrown) std::rethrow_exception(thrown);
    }
    return measured;
}

}  // namespace espalier::study
