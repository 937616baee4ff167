#include "simulation/plant/memory_budget.h"

#include <fmt/format.h>

#include <algorithm>

namespace espalier::simulation {
namespace {

// ", most of them F, which the production at plant.l:4:1 writes most of": what a plant grew too large by.
std::string commonest_module(const Model& model, const ModuleString& string) {
    if (string.empty()) return "";
    std::vector<std::size_t> counts(model.alphabet.size());
    for (const LetterId letter : string.letters) ++counts[letter];
    const auto letter = static_cast<LetterId>(std::max_element(counts.begin(), counts.end()) - counts.begin());
    const Production* writer = nullptr;
    std::ptrdiff_t most = 0;
    for (const LSystem& system : model.systems) {
        for (const Production& production : system.productions) {
            const std::ptrdiff_t written =
                std::count_if(production.successor.begin(), production.successor.end(),
                              [&](const ModuleTemplate& module) { return module.letter == letter; });
            if (written <= most) continue;
            most = written;
            writer = &production;
        }
    }
    std::string text = ", most of them " + model.alphabet.name(letter);
    if (writer) text += fmt::format(", which the production at {} writes most of", to_string(writer->place));
    return text;
}

}  // namespace

MemoryShares share_memory(std::size_t budget, std::size_t kept) {
    const std::size_t left = budget - std::min(budget, kept);
    // The rest is for the program itself, and for what is drawn of a step's strings before it is counted.
    return {left / 8 * 7, left / 16};
}

void MemoryBudget::limit_strings(GrowingPlant& plant) const {
    const std::size_t others = held_.total() - plant.memory.strings;
    const std::size_t taken = others + plant.derivation.working_memory(*plant.string);
    plant.derivation.set_memory(bytes_ - std::min(taken, bytes_));
}

void MemoryBudget::count_strings(GrowingPlant& plant) {
    const std::size_t before = plant.memory.strings;
    plant.memory.set_strings(plant.string_before(), plant.modules_before, *plant.string,
                             plant.derivation.working_memory(*plant.string));
    if (plant.memory.strings != before) strings_ += plant.memory.strings - before;
}

void MemoryBudget::check_strings(std::span<const GrowingPlant> plants, int step) {
    const std::size_t modules_before = modules_;
    const bool is_full = !has_room();
    if (is_full && plants.size() > 1) refuse_strings(plants, step, modules_before);
    sum(plants);
    // How much will be drawn is extrapolated from the previous step: as much of a module as then.
    const double growth = modules_before == 0 ? 1 : static_cast<double>(modules_) / static_cast<double>(modules_before);
    require(held_.grown(std::max(growth, 1.0), !recorders_.empty()), plants, step);
}

void MemoryBudget::count_drawn(GrowingPlant& plant, int step, bool many_plants) const {
    const std::size_t before = plant.memory.drawn;
    plant.memory.set_drawn(*plant.interpretation, many_plants);
    if (plant.is_staged()) plant.memory.add_staged(plant.drawn());
    if (recorders_.empty()) return;
    RecordedMemory recorded;
    for (const Recorder* recorder : recorders_) {
        recorded += recorder->memory(step, *plant.string, plant.drawn());
    }
    plant.memory.set_recorded(recorded, before);
}

void MemoryBudget::count_waiting(GrowingPlant& plant, std::size_t queries) {
    const std::size_t before = plant.memory.strings;
    const RecordedMemory recorded = plant.memory.recorded;
    plant.memory = {};
    plant.memory.strings = plant.string->content();
    plant.memory.drawn = queries * (sizeof(Query) + sizeof(Answer) + 2 * sizeof(double));
    plant.memory.recorded = {0, recorded.kept, recorded.finish};
    strings_ -= before - plant.memory.strings;
}

void MemoryBudget::check_drawn(std::span<const GrowingPlant> plants, int step) {
    sum(plants);
    require(held_, plants, step);
}

void MemoryBudget::check_received(std::span<const GrowingPlant> plants, int step) const {
    std::size_t received = 0;
    for (const GrowingPlant& plant : plants) {
        if (plant.is_local) continue;
        PlantMemory memory;
        memory.set_drawn(plant.drawn(), /*many_plants=*/true);
        received += plant.string->content() + memory.total();
    }
    if (held_.total() + received <= bytes_) return;
    throw RunError(
        fmt::format("step {}: what other ranks send of their plants takes {} MiB, and the plants of this rank "
                    "{} MiB, but --memory leaves {} MiB for plants",
                    step, received >> 20, held_.total() >> 20, bytes_ >> 20));
}

void MemoryBudget::sum(std::span<const GrowingPlant> plants) {
    held_ = {};
    modules_ = 0;
    for (const GrowingPlant& plant : plants) {
        held_.add(plant.memory);
        modules_ += plant.modules;
    }
    strings_ = held_.strings;
    besides_ = held_.total() - held_.strings;
}

// Which plants were rewritten when the others were given up depends on the threads: the message is about the strings
// before.
void MemoryBudget::refuse_strings(std::span<const GrowingPlant> plants, int step, std::size_t modules) const {
    const auto is_done = [&](const GrowingPlant& plant) { return plant.derivation.steps_done() == step; };
    const auto before = [&](const GrowingPlant& plant) {
        return is_done(plant) ? plant.modules_before : plant.modules;
    };
    const GrowingPlant& largest =
        *std::max_element(plants.begin(), plants.end(),
                          [&](const GrowingPlant& a, const GrowingPlant& b) { return before(a) < before(b); });
    // The commonest module is not known for a string whose memory may have been passed on.
    const bool is_kept = step > 0 && (!is_plentiful() || before(largest) > PlantMemory::most_of_small);
    const ModuleString* string = is_done(largest) ? largest.string_before() : &*largest.string;
    throw RunError(
        fmt::format("step {}: {} modules grow beyond the {} MiB that --memory leaves for plants; the largest was '{}' "
                    "with {} modules{}",
                    step, modules, bytes_ >> 20, largest.description->name, before(largest),
                    is_kept && string ? commonest_module(largest.model(), *string) : ""));
}

void MemoryBudget::require(const PlantMemory& needed, std::span<const GrowingPlant> plants, int step) const {
    if (needed.total() <= bytes_) return;
    const GrowingPlant& largest =
        *std::max_element(plants.begin(), plants.end(),
                          [](const GrowingPlant& a, const GrowingPlant& b) { return a.modules < b.modules; });
    throw RunError(
        fmt::format("step {}: {} modules take {} MiB, with what is drawn and recorded of them, but --memory "
                    "leaves {} MiB for plants; the largest is '{}' with {} modules{}",
                    step, modules_, needed.total() >> 20, bytes_ >> 20, largest.description->name, largest.modules,
                    commonest_module(largest.model(), *largest.string)));
}

}  // namespace espalier::simulation
