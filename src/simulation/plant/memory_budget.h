// The memory of a run: how it is shared out, and whether the plants stay within their share.
#pragma once

#include "espalier/timeline/recorder.h"

#include "simulation/plant/growing_plant.h"
#include "simulation/plant/plant_memory.h"

#include <atomic>
#include <cstddef>
#include <span>
#include <vector>

namespace espalier::simulation {

/// What the fields of processes leave of a budget.
struct MemoryShares {
    std::size_t plants;  ///< strings, old and new, what is drawn of them, and what recording takes
    std::size_t frames;  ///< frames that wait to be written, if there are several
};
/// `kept`: bytes for fields.
MemoryShares share_memory(std::size_t budget, std::size_t kept);

/// The plants' share. Stages limit and count each plant in parallel, then check all of them together; a check throws
/// RunError that names the step, the size and the largest plant, the same with any number of threads.
class MemoryBudget {
public:
    explicit MemoryBudget(std::size_t bytes) : bytes_(bytes) {}

    /// The share changes with what the fields leave.
    void set_bytes(std::size_t bytes) { bytes_ = bytes; }
    std::size_t held() const { return held_.total(); }

    /// What it takes counts, too, from now on. It outlives the steps.
    void count_recorder(const Recorder& recorder) { recorders_.push_back(&recorder); }

    // Around derivation. Strings never give memory back: as soon as some take too much, the others need not be made.
    bool has_room() const { return strings_ + besides_ <= bytes_; }
    /// So plentiful is memory that the strings of the step before need not be kept for a message about their growth.
    bool is_plentiful() const { return held_.total() <= bytes_ / 16; }
    void limit_strings(GrowingPlant& plant) const;
    void count_strings(GrowingPlant& plant);
    void check_strings(std::span<const GrowingPlant> plants, int step);

    /// Of a plant only the parameters of its queries are left in memory, and `queries` of them during an exchange.
    void count_waiting(GrowingPlant& plant, std::size_t queries);

    // Around interpretation.
    void count_drawn(GrowingPlant& plant, int step, bool many_plants) const;
    void check_drawn(std::span<const GrowingPlant> plants, int step);
    /// Those plants that other ranks hold must fit beside what is here.
    void check_received(std::span<const GrowingPlant> plants, int step) const;

    std::size_t bytes() const { return bytes_; }
    std::size_t modules() const { return modules_; }

private:
    void sum(std::span<const GrowingPlant> plants);
    [[noreturn]] void refuse_strings(std::span<const GrowingPlant> plants, int step, std::size_t modules) const;
    void require(const PlantMemory& needed, std::span<const GrowingPlant> plants, int step) const;

    std::size_t bytes_;
    std::vector<const Recorder*> recorders_;
    PlantMemory held_;         // memory of all plants, as the last check left it
    std::size_t modules_ = 0;  // the same
    std::size_t besides_ = 0;  // held beside the strings
    std::atomic<std::size_t> strings_{0};
};

}  // namespace espalier::simulation
