#include "studio/growth/sweep_run.h"

#include "espalier/base/file.h"
#include "espalier/simulation/staged_world.h"

#include "base/reason.h"
#include "simulation/run/allowed_memory.h"
#include "studio/growth/kept_steps.h"
#include "studio/growth/printed_text.h"
#include "studio/growth/reuse_plan.h"
#include "studio/packets/textures.h"

#include <fmt/format.h>

#include <exception>
#include <utility>

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;

std::map<std::string, std::string> units_of(const Frame& frame) {
    std::map<std::string, std::string> units;
    for (const PlantFrame& plant : frame.plants) {
        for (const Quantity& one : plant.quantities) units[one.name] = one.unit;
    }
    return units;
}

std::string statistics_of(const Frame& frame, const World& world, const fs::path& folder) {
    Settings settings;
    registered<RecorderType>().at("statistics")->make(settings, {folder, world.last_step()})->record(frame);
    return read_text(folder / "statistics.csv");
}

}  // namespace

/// The plant at hand; of the worker's thread.
struct SweepRun::Work {
    Work(Scene grown, std::size_t memory, fs::path its_folder)
        : scene(std::move(grown)), folder(std::move(its_folder)), world(scene, memory, folder, unheard.printout()) {}

    bool is_over() const { return derived >= world.last_step() || (derived >= 0 && world.stopped()); }

    void step() {
        if (is_apart && derived < 0) {
            world.write_axioms();
        } else if (is_apart) {
            world.derive();
        } else if (derived < 0) {
            world.start();
        } else {
            world.step();
        }
        derived = world.steps_done();
    }

    Frame frame() {
        if (is_apart) {
            world.interpret();
            world.exchange();
        }
        return world.frame();
    }

    const Scene scene;
    const fs::path folder;
    PrintedText unheard{[](const std::string&) {}};
    StagedWorld world;
    const bool is_apart = draws_apart(scene);  ///< only the last step need be drawn
    int derived = -1;
};

SweepRun::SweepRun(SweepOrder order, std::function<void(SweptPlant)> grown, Workers& workers)
    : order_(std::move(order)), grown_(std::move(grown)), running_(workers.run(*this)) {}

SweepRun::~SweepRun() {
    stop();
    running_.wait();
}

// One piece of its life: a plant is read, grows by a step, or is drawn.
SweepRun::Then SweepRun::next() {
    const StopRequest::Scope stops(&request_);
    try {
        end_if_asked();
        const ReadLog::Scope reads(reads_.get());
        if (!work_) {
            open();
        } else if (!work_->is_over()) {
            work_->step();
        } else {
            grown_(drawn());
            return go_on();
        }
        return Then::goes_on;
    } catch (const Stopped&) {
        at_ = order_.states.size();
    } catch (const std::exception& error) {
        SweptPlant plant;
        plant.growth = order_.first + static_cast<std::uint32_t>(at_);
        plant.reason = reason_of(error);
        grown_(std::move(plant));
    }
    return go_on();
}

void SweepRun::open() {
    const DocumentState& state = order_.states[at_];
    reads_ = std::make_unique<ReadLog>(std::size_t(64) << 20, state.unsaved, order_.permission);
    Scene scene = order_.read(state.opened);
    note_texture_files(scene);
    const fs::path folder = order_.scratch / fmt::format("swept-{}", order_.first + at_);
    fs::create_directories(folder);
    work_ = std::make_unique<Work>(std::move(scene), allowed_memory(order_.memory, state.opened.path), folder);
}

SweptPlant SweepRun::drawn() const {
    SweptPlant plant;
    plant.growth = order_.first + static_cast<std::uint32_t>(at_);
    KeptSteps steps(plant.growth, work_->folder / "steps");
    const Frame frame = work_->frame();
    steps.add(frame);
    plant.messages = steps.shapes();
    plant.messages.push_back(steps.packet(work_->derived));
    plant.statistics = statistics_of(frame, work_->world, work_->folder);
    plant.units = units_of(frame);
    return plant;
}

// To the next plant.
SweepRun::Then SweepRun::go_on() {
    if (work_) {
        const fs::path folder = work_->folder;
        work_.reset();
        std::error_code ignored;
        fs::remove_all(folder, ignored);
    }
    reads_.reset();
    return ++at_ < order_.states.size() ? Then::goes_on : Then::ended;
}

}  // namespace espalier::studio
