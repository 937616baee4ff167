// A plant of a world as it grows.
#pragma once

#include "espalier/environment/environment_process.h"
#include "espalier/lsystem/derivation.h"
#include "espalier/simulation/scene.h"
#include "espalier/timeline/frame.h"
#include "espalier/turtle/interpretation.h"

#include "simulation/world/insertion.h"
#include "simulation/world/plant_memory.h"
#include "simulation/world/reusable.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace espalier::simulation {

/// Rounds the parameters as the arithmetic of a model keeps them.
void round_as_stored(ModuleString& string, Arithmetic arithmetic);

/// What a Plant of the scene has become: its derivation, and its values of the current step.
class GrowingPlant {
public:
    GrowingPlant(std::uint32_t number, const Plant& description, std::shared_ptr<const SymbolTable> symbols,
                 const DerivationSettings& settings);

    // These write the next string in `spare`, which gets the memory of the old one, if the plant is small and no frame
    // reads its string; else, or if `spare` is null, in memory of the plant's own.
    void write_axiom(ModuleString* spare);
    void derive(ModuleString* spare);
    /// `fields`: what its vector fields read; `time`: of its geometry stages.
    void interpret(const FieldValues& fields, double time);
    void set_length(int steps);
    /// After its string and its derivation were restored from a checkpoint.
    void note_derived();

    // Hints that a stage will soon come to this plant: of its values first, then of the columns in them.
    void prefetch_values() const;
    void prefetch_for_derivation() const;
    void prefetch_for_interpretation() const;

    const Model& model() const { return *model_; }
    /// The string of the step before; null if its memory was passed on.
    const ModuleString* string_before() const { return keeps_previous_ ? &*previous_ : nullptr; }
    PlantView view() const { return {number, &model(), &*string, &*interpretation, asks_, &drawn().geometry}; }
    /// After `string` and `interpretation` came from the rank that holds the plant.
    void note_received();
    /// Another rank holds it from now on: only its description stays.
    void give_away();
    /// Has these values in place of its own, of which no memory stays: of a plant that waits elsewhere, or was there.
    void hold(std::shared_ptr<const ModuleString> string, std::shared_ptr<const Interpretation> interpretation);
    PlantFrame frame(std::vector<Quantity> quantities) const;

    std::uint32_t number;
    const Plant* description;
    Derivation derivation;
    // As derivation leaves them: to look them up elsewhere would cost much of a small plant's step.
    std::size_t modules = 0, modules_before = 0;
    int length = 0;
    bool stopped = false;
    bool is_here = true;  ///< false: another rank holds it, and what it sent of the plant is all there is
    Reusable<ModuleString> string;
    Reusable<Interpretation> interpretation;
    /// For light and recorders: the interpretation as the geometry stages leave it.
    const Interpretation& drawn() const { return *shown(); }
    PlantMemory memory;

private:
    void regrow(ModuleString& to);
    const Reusable<Interpretation>& shown() const { return is_staged_ ? staged_ : interpretation; }
    const Derivation& drawing() const { return regrown_ ? *regrown_ : derivation; }
    template <class Rewrite>
    void rewrite(const Rewrite& rewrite, ModuleString* spare);

    DerivationSettings settings_;
    const Model* model_;
    std::optional<Derivation> regrown_;  ///< derivation of a plant that grows anew in every step
    Insertions insertions_;
    std::shared_ptr<const SymbolTable> symbols_;
    Reusable<ModuleString> previous_;  // the string of the step before; the next one is written in its memory
    bool keeps_previous_ = false;
    Reusable<Interpretation> staged_;
    RandomKey stage_key_;
    bool has_pictures_;
    bool asks_ = false;
    bool is_staged_ = false;  ///< what is drawn of this step is in staged_
};

}  // namespace espalier::simulation
