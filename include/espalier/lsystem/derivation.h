// Derivation: old string in, new string out. A production is chosen for every module, then the new string is written;
// in parallel, unless the order of the productions is part of the model's meaning.
#pragma once

#include "espalier/base/random.h"
#include "espalier/base/stations.h"
#include "espalier/lsystem/lsystem.h"
#include "espalier/lsystem/module_string.h"
#include "espalier/lsystem/printout.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace espalier::lsystem {

struct DerivationSettings {
    std::uint64_t seed = 0;
    std::uint32_t plant = 0;
    /// Keep who every module is, who bore it and when. Models that take random numbers keep it without being asked.
    bool lineage = false;
    /// Replace one module after the other and look for contexts step by step: slow, and what the faster ways are
    /// compared with.
    bool one_by_one = false;
    /// Bytes that this plant's strings, arrays and files may take; a step that would exceed them throws RunError before
    /// it allocates.
    std::size_t memory = std::size_t(-1);
    /// Where fopen() looks for files to read, besides those the model itself wrote.
    std::filesystem::path input_folder;
    /// Where files the model writes go; if empty they are kept in memory and forgotten with the derivation.
    std::filesystem::path output_folder;
    /// Where printf goes, and warnings about what the model does; null: standard error.
    std::shared_ptr<Printout> printout;
};

class CompiledModel;

/// Compiles expressions and indexes productions, once per model; shared by all plants that grow from it.
/// Throws UserError for constant expressions that cannot be evaluated.
std::shared_ptr<const CompiledModel> compile(std::shared_ptr<const Model> model);
const Model& source_of(const CompiledModel& compiled);

/// True if the model's productions assign globals, print or read files, so that it is derived in order.
bool has_order(const CompiledModel& compiled);
bool uses_random_numbers(const CompiledModel& compiled);

/// The growth of one plant: the model's globals, arrays and step counter, and the rule that turns a string into the
/// next. Random numbers depend on seed, plant, module identity, step and their own number only.
class Derivation {
public:
    Derivation(std::shared_ptr<const CompiledModel> model, DerivationSettings settings = {});
    ~Derivation();
    Derivation(Derivation&&) noexcept;
    Derivation& operator=(Derivation&&) noexcept;

    /// Runs the Start block and writes the axiom to `string`.
    void start(ModuleString& string);

    /// One derivation step: Q + 1, StartEach, every module of `from` replaced at once, EndEach; the End block too if it
    /// was the last step. `to`'s memory is reused. Throws RunError for division by zero, a NaN or infinite parameter
    /// (naming file, line, column, module and values), and when the memory budget would be exceeded.
    void step(const ModuleString& from, ModuleString& to);

    /// A hint that step() will be called soon.
    void prefetch() const;

    /// Bytes that a step from `string`, which the last step made, holds besides it and its successor: what is chosen
    /// for its modules and what they see of each other. Told from the modules, not from the memory at hand.
    std::size_t working_memory(const ModuleString& string) const;
    /// Instead of DerivationSettings::memory from now on.
    void set_memory(std::size_t bytes);
    /// Instead of DerivationSettings::lineage, before start().
    void set_lineage(bool kept);

    int steps_done() const;
    /// The model's derivation length, or what a scene set with set_length().
    int length() const;
    void set_length(int steps);
    /// True once the model called stop().
    bool stopped() const;

    /// Replaces a module by its picture (homomorphism), depth first to the maximum depth, for interpretation.
    /// Appends to `picture` and returns how many modules it stands for: 1, more for a predecessor of several, 0 if no
    /// production applies. `links` belong to `string`.
    /// Contexts are those of the original string; random numbers come from the homomorphism's own stream. Thread safe.
    std::size_t picture(const ModuleString& string, const std::vector<std::size_t>* offsets, const BranchLinks& links,
                        std::size_t module, std::size_t parameters_at, ModuleString& picture) const;
    /// False if `picture` returns 0 for this letter whatever its context.
    bool may_have_picture(LetterId letter) const;
    bool has_homomorphism() const;

    /// Globals, arrays and random state as bytes, for a checkpoint.
    void save(std::ostream& out) const;
    void restore(std::istream& in);

    struct State;  // known to the engine's own files only

private:
    std::unique_ptr<State> state_;
};

}  // namespace espalier::lsystem
