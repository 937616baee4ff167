// What a derivation remembers between steps.
#pragma once

#include "espalier/lsystem/derivation.h"

#include "lsystem/derive/step.h"
#include "lsystem/derive/sub_systems.h"
#include "lsystem/programs/files.h"

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <set>

namespace espalier::lsystem {

struct Derivation::State {
    State(std::shared_ptr<const CompiledModel> compiled, DerivationSettings given);

    bool keeps_lineage(bool asked) const;
    void reset();
    void run_block(const Program& block, const char* name);
    void follow_length();
    /// Runs what belongs to no module; its random numbers form one sequence from the beginning of the growth.
    void in_block(Machine& machine, const std::string& name, const std::function<void()>& work);
    RandomKey key(Stream stream) const { return RandomKey(settings.seed, settings.plant, stream, services.salt); }
    /// Runs something with services that print nothing and write nothing.
    void dry_run(const std::function<void(Services& silent)>& work);
    void evaluate_seed();
    void evaluate_length();
    void evaluate_axiom(ModuleString& string);
    void run_axiom(ModuleString& string);
    void bear_axiom(ModuleString& string) const;
    void cut(const ModuleString& from);
    std::size_t end_of_cut(const ModuleString& from, std::size_t cut) const;
    void find_contexts(const ModuleString& from, StringView& view);
    StepInput prepare(const ModuleString& from);
    void rewrite(const ModuleString& from, ModuleString& to);
    /// One module after the other, each by the rules of the L-system it belongs to.
    void rewrite_in_order(const StepInput& input, ModuleString& to);
    void warn_of_depth();
    /// Bytes that are held from step to step besides the string.
    std::size_t lasting_memory() const;
    /// What is left of the memory is left to the step that begins.
    void begin_memory();
    void warn_once(const Place& place, const std::string& message);

    // What every step touches stands together, from the end of the services to the beginning of the variables: of ten
    // thousand small plants each line of memory counts.
    Services services;
    std::shared_ptr<const CompiledModel> model;
    const CompiledSystem& main;
    Machines machines;
    std::uint32_t step = 0;
    int length = 0;
    bool length_is_set = false;  ///< by set_length(), not by the model
    std::atomic<bool> depth_limit{false};
    bool warned_of_depth = false;
    const bool in_order;  ///< steps replace one module after the other
    /// Letters may decide alone what a step writes, and need nothing besides the string.
    const bool may_be_simple;
    bool lineage;  ///< births are kept: a recorder or process asks, or random numbers are taken
    /// Grows with every change of variables, so that writers of pictures know what they have seen.
    std::uint64_t generation = 0;
    Scratch* scratch = nullptr;  ///< lent for the step at hand
    std::size_t memory;          ///< bytes that the plant may take
    Variables variables;
    DerivationSettings settings;

    ModelFiles files;
    std::unique_ptr<Scratch> own_scratch;
    SubSystems sub_systems;
    Machine block_machine;
    RandomSamples block_random{RandomKey(), 0, 0};
    /// Never the same for two states.
    const std::uint64_t serial;
    std::mutex warning;
    std::set<std::pair<std::string, std::pair<int, int>>> warned;
};

}  // namespace espalier::lsystem
