// A plant of a world as it grows.
#pragma once

#include "espalier/environment/environment_process.h"
#include "espalier/lsystem/derivation.h"
#include "espalier/simulation/scene.h"
#include "espalier/timeline/frame.h"
#include "espalier/turtle/interpretation.h"

#include "plant_memory.h"
#include "reusable.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace espalier {

/// What a Plant of the scene has become: its derivation, and its values of the current step.
class GrowingPlant {
public:
    GrowingPlant(std::uint32_t number, const Plant& description, std::shared_ptr<const SymbolTable> symbols,
                 const DerivationSettings& settings);

    void write_axiom();
    void derive();
    void interpret();
    void set_length(int steps);
    /// After its derivation was restored from a checkpoint.
    void note_end();

    // Hints that a stage will soon come to this plant; the first some time before the second.
    void prefetch_values() const;
    void prefetch_columns() const;

    const Model& model() const { return source_of(*description->model); }
    const ModuleString& modules_before() const { return *previous_; }
    PlantView view() const { return {number, &model(), &*string, &*interpretation, asks_}; }
    PlantFrame frame(std::vector<Quantity> quantities) const;

    std::uint32_t number;
    const Plant* description;
    Derivation derivation;
    // As derivation leaves them: asking it again would cost a step of many small plants more.
    int length = 0;
    bool stopped = false;
    Reusable<ModuleString> string;
    Reusable<Interpretation> interpretation;
    PlantMemory memory;

private:
    std::shared_ptr<const SymbolTable> symbols_;
    Reusable<ModuleString> previous_;  // the string of the step before; the next one is written in its memory
    bool asks_ = false;
};

}  // namespace espalier
