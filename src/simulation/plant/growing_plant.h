// A plant of a world as it grows.
#pragma once

#include "espalier/environment/environment_process.h"
#include "espalier/lsystem/derivation.h"
#include "espalier/simulation/scene.h"
#include "espalier/timeline/frame.h"
#include "espalier/turtle/interpretation.h"

#include "base/holders.h"
#include "lsystem/model/birth_numbers.h"
#include "simulation/plant/plant_memory.h"
#include "simulation/scene/insertion.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace espalier::simulation {

/// Values that are written anew every step, while frames still read those of earlier steps. What a frame holds is set
/// aside until the frame lets go of it; the memory is then used again.
template <class T>
class Reusable {
public:
    T& operator*() { return *now_; }
    const T& operator*() const { return *now_; }
    T* operator->() { return now_.get(); }
    const T* operator->() const { return now_.get(); }
    std::shared_ptr<const T> share() const { return now_; }
    bool is_shared() const { return is_held_by_others(now_, 1); }

    /// A value that others may read, too: while they do, it is not written.
    void hold(std::shared_ptr<const T> value) { now_ = std::const_pointer_cast<T>(std::move(value)); }

    /// A new value, and no memory of those before but what others hold.
    void release() {
        now_ = std::make_shared<T>();
        held_.clear();
    }

    /// A value that no frame reads, its content left over from an earlier step.
    T& for_writing() {
        if (is_shared()) set_aside();
        return *now_;
    }

private:
    void set_aside() {
        const auto is_free = [](const std::shared_ptr<T>& one) { return !is_held_by_others(one, 1); };
        const auto free = std::find_if(held_.begin(), held_.end(), is_free);
        std::shared_ptr<T> next = free == held_.end() ? std::make_shared<T>() : std::move(*free);
        // One is enough: of more that are free, some would stay so for ever.
        std::erase_if(held_, [&](const std::shared_ptr<T>& one) { return !one || is_free(one); });
        held_.push_back(std::exchange(now_, std::move(next)));
    }

    std::shared_ptr<T> now_ = std::make_shared<T>();
    std::vector<std::shared_ptr<T>> held_;
};

/// Rounds the parameters as the arithmetic of a model keeps them.
void round_as_stored(ModuleString& string, Arithmetic arithmetic);

/// What a Plant of the scene has become: its derivation, and its values of the current step.
///
/// Of ten thousand small plants each line of memory counts: what every step reads stands in the first four, what is
/// read of all plants, one after the other, in the first.
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
    /// Notes how many modules were born in this step.
    void count_births();
    /// Numbers those in its string, if `births_before` is known.
    void number_births();

    // Hints that a stage will soon come to this plant: of itself, then of its values, then of the columns in them.
    void prefetch_itself() const;
    void prefetch_string() const;
    void prefetch_values() const;
    void prefetch_for_derivation() const;
    void prefetch_for_interpretation() const;

    const Model& model() const { return *model_; }
    /// The string of the step before; null if its memory was passed on.
    const ModuleString* string_before() const { return keeps_previous_ ? &*previous_ : nullptr; }
    /// The turtle or a process, in this step.
    bool asks() const { return asks_; }
    /// It has drawn something or asked a process, in this step or before, on this rank and since a restart.
    bool has_shown() const { return has_shown_; }
    PlantView view() const { return {number, &model(), &*string, &*interpretation, asks_, &drawn().geometry}; }
    /// After `string` and `interpretation` came from the rank that holds the plant.
    void note_received();
    /// Frees them, but for what frames still read.
    void free_received();
    /// Another rank holds it from now on: only its description stays.
    void become_remote();
    /// Frees its values and has these instead: of a plant that waits on disk, or comes from there.
    void hold(std::shared_ptr<const ModuleString> string, std::shared_ptr<const Interpretation> interpretation);
    PlantFrame frame(std::vector<Quantity> quantities) const;

    alignas(64) PlantMemory memory;
    // As derivation leaves them: to look them up elsewhere would cost much of a small plant's step.
    std::size_t modules = 0;
    std::size_t born = 0;  ///< in this step, unless they are not counted
    int length = 0;
    bool stopped = false;
    bool is_numbered = true;  ///< the string came with its numbers
    bool is_local = true;     ///< false: another rank holds it, and what it sent of the plant is all there is
    const Plant* description;
    Derivation derivation;
    std::size_t modules_before = 0;
    Reusable<ModuleString> string;
    Reusable<Interpretation> interpretation;
    static constexpr std::uint64_t unknown = std::uint64_t(-1);
    std::uint64_t births_before = unknown;          ///< modules of the run that were born before those of this step
    std::unique_ptr<lsystem::KeptNumbers> numbers;  ///< of a plant that grows anew in every step; else null
    std::uint32_t number;
    /// For light and recorders: the interpretation as the geometry stages leave it.
    const Interpretation& drawn() const { return *shown(); }
    /// Geometry stages changed what is drawn of this step.
    bool is_staged() const { return is_staged_; }

private:
    void regrow(ModuleString& to);
    const Reusable<Interpretation>& shown() const { return is_staged_ ? staged_ : interpretation; }
    const Derivation& drawing() const { return regrown_ ? *regrown_ : derivation; }
    template <class Rewrite>
    void rewrite(const Rewrite& rewrite, ModuleString* spare);

    bool asks_ = false;
    bool has_shown_ = false;
    bool is_staged_ = false;  ///< what is drawn of this step is in staged_
    /// Without pictures and stages, and nothing of it changes with time: most of its description is never read.
    bool is_plain_;
    bool keeps_previous_ = false;
    const Model* model_;
    std::shared_ptr<const SymbolTable> symbols_;
    Insertions insertions_;

    Reusable<ModuleString> previous_;  // the string of the step before; the next one is written in its memory
    Reusable<Interpretation> staged_;
    RandomKey stage_key_;
    std::unique_ptr<const DerivationSettings> regrowth_;  ///< of a plant that grows anew in every step; else null
    std::unique_ptr<Derivation> regrown_;                 ///< its derivation of this step
};

}  // namespace espalier::simulation
