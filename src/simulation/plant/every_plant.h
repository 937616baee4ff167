// One stage of a step for every plant of a world, in parallel.
#pragma once

#include "espalier/base/error.h"
#include "espalier/base/read_log.h"

#include "base/parallel.h"
#include "simulation/plant/growing_plant.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>

#include <cstddef>
#include <exception>
#include <mutex>
#include <span>

namespace espalier::simulation {

/// What went wrong first, in the order of the plants, whichever thread failed first.
class FirstFailure {
public:
    explicit FirstFailure(std::size_t plants) : plant_(plants) {}

    void note(std::size_t plant, std::exception_ptr error) {
        const std::lock_guard lock(mutex_);
        if (plant >= plant_) return;
        plant_ = plant;
        error_ = std::move(error);
    }
    /// A plant that is not alone in its world is named.
    void throw_if_any(std::span<const GrowingPlant> plants, bool is_alone) const {
        if (!error_) return;
        try {
            std::rethrow_exception(error_);
        } catch (const RunError& error) {
            if (is_alone) throw;
            throw RunError(fmt::format("plant '{}': {}", plants[plant_].description->name, error.what()));
        }
    }

private:
    std::mutex mutex_;
    std::size_t plant_;
    std::exception_ptr error_;
};

using PrefetchPlant = void (GrowingPlant::*)() const;

/// What a stage reads of a plant: its values, then the columns in them.
struct StagePrefetch {
    PrefetchPlant values, columns;
};

/// Hints that the stage will soon come to the plants after this one. Many small plants take half the time with them:
/// without, each would wait for its lines of memory one by one.
inline void prefetch_ahead(std::span<const GrowingPlant> plants, const StagePrefetch& stage) {
    if (plants.size() > 6) plants[6].prefetch_itself();
    if (plants.size() > 4) (plants[4].*stage.values)();
    if (plants.size() > 2) (plants[2].*stage.columns)();
}

/// A stage gets a string, too, whose memory the plants of a thread pass on to each other. `is_alone`: the world has one
/// plant. `reads` notes the files that models read; may be null.
template <class Stage>
void for_every_plant(std::span<GrowingPlant> plants, bool is_alone, ReadLog* reads, const StagePrefetch& prefetch,
                     const Stage& stage) {
    FirstFailure failure(plants.size());
    for_in_parallel(tbb::blocked_range<std::size_t>(0, plants.size()), [&](const auto& range) {
        const ReadLog::Scope scope(reads);
        ModuleString spare;
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            prefetch_ahead(plants.subspan(i, range.end() - i), prefetch);
            try {
                stage(plants[i], spare);
            } catch (...) {
                failure.note(i, std::current_exception());
            }
        }
    });
    failure.throw_if_any(plants, is_alone);
}

}  // namespace espalier::simulation
